#include "chemistry/mechanism/collider_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "chemistry/mechanism/rate_checks.hpp"
#include "chemistry/mechanism/rate_reader.hpp"

namespace lampblack::chemistry {

namespace {

using Type = Reaction::Type;

constexpr std::array<std::pair<std::string_view, Type>, 3> kTypes{{
    {"falloff", Type::Falloff},
    {"pressure-dependent-Arrhenius", Type::PressureLog},
    {"Chebyshev", Type::Chebyshev},
}};

class ColliderReader {
 public:
  ColliderReader(const YamlAccess& yaml, const UnitSystem& units, const YamlMap& entry, const Reaction& reaction,
                 const ReactionScope& scope, std::vector<std::string>& warnings)
      : yaml_(yaml), units_(units), entry_(entry), reaction_(reaction), scope_(scope), warnings_(warnings) {}

  std::vector<Collider> read() {
    const auto& list = entry_.at("colliders");
    yaml_.requireSequence(list, entry_.what() + ", 'colliders'");
    for (const auto& node : list) readOne(node);
    if (colliders_.empty()) yaml_.fail(list, entry_.what() + ": expected 'M' as the first of 'colliders'");
    return std::move(colliders_);
  }

 private:
  void readOne(const YAML::Node& node) {
    YamlMap map(yaml_, node, entry_.what() + ", a collider");
    const auto& name = yaml_.text(map.at("name"), map.what());
    map.rename(fmt::format("{}, collider '{}'", entry_.what(), name));
    map.allowOnly({"name", "efficiency", "eig0", "type", "low-P-rate-constant", "high-P-rate-constant", "Troe", "SRI",
                   "Tsang", "rate-constants", "temperature-range", "pressure-range", "data", "note"});
    const bool first = colliders_.empty();
    if (first != (name == "M"))
      yaml_.fail(map.at("name"), fmt::format("{}: expected 'M' as the first of 'colliders', found '{}'", entry_.what(),
                                             first ? name : "M at another place"));
    Collider collider;
    readEfficiency(map, collider);
    readRate(map, collider);
    if (!first) {
      collider.species = scope_.findSpecies(name);
      if (!collider.species && !scope_.skipUndeclaredThirdBodies)
        yaml_.fail(map.at("name"), fmt::format("{}: the species is not declared in the phase", map.what()));
      if (!collider.species) return;
      for (const auto& other : colliders_)
        if (other.species == collider.species) yaml_.fail(node, map.what() + ": the collider is there twice");
    }
    colliders_.push_back(std::move(collider));
  }

  void readEfficiency(const YamlMap& map, Collider& collider) {
    const auto *efficiency = map.find("efficiency"), *eigenvalue = map.find("eig0");
    const bool first = colliders_.empty();
    if (first) byEigenvalue_ = eigenvalue != nullptr;
    if (efficiency != nullptr && eigenvalue != nullptr)
      yaml_.fail(*eigenvalue, map.what() + ": expected one of 'efficiency' and 'eig0', not both");
    if (first && efficiency == nullptr && eigenvalue == nullptr) return;
    const auto* given = byEigenvalue_ ? eigenvalue : efficiency;
    if (given == nullptr)
      yaml_.fail(map.node(), fmt::format("{}: expected '{}', as the colliders before have it", map.what(),
                                         byEigenvalue_ ? "eig0" : "efficiency"));
    const auto values = yaml_.values(*given, {"A", "b", "Ea"}, map.what());
    Arrhenius rate{yaml_.number(values[0], map.what()), yaml_.number(values[1], map.what()),
                   yaml_.activationTemperature(values[2], units_, map.what())};
    if (!(rate.A > 0)) yaml_.fail(*given, map.what() + ": expected a positive 'A' of the efficiency");
    if (first && byEigenvalue_) {
      reference_ = rate;
      return;
    }
    if (first && (rate.A != 1 || rate.b != 0 || rate.activationTemperature != 0))
      yaml_.fail(*given, map.what() + ": expected an efficiency of one, {A: 1, b: 0, Ea: 0}");
    auto& relative = collider.efficiency;
    relative = {rate.A / reference_.A, rate.b - reference_.b,
                rate.activationTemperature - reference_.activationTemperature};
    if (!(relative.A > 0) || !std::isfinite(relative.A) || !std::isfinite(relative.b) ||
        !std::isfinite(relative.activationTemperature))
      yaml_.fail(*given, map.what() + ": the efficiency is out of range");
  }

  void readRate(const YamlMap& map, Collider& collider) {
    const auto* node = map.find("type");
    if (node == nullptr) {
      if (colliders_.empty())
        yaml_.fail(map.node(), map.what() +
                                   ": expected a 'type' (falloff, pressure-dependent-Arrhenius or Chebyshev) "
                                   "and its rate");
      return map.allowOnly({"name", "efficiency", "eig0", "note"});
    }
    const auto& given = yaml_.text(*node, map.what());
    const auto* known = std::ranges::find(kTypes, given, &std::pair<std::string_view, Type>::first);
    if (known == kTypes.end())
      yaml_.fail(*node, fmt::format("{}: type '{}' is not supported; expected falloff, pressure-dependent-Arrhenius or "
                                    "Chebyshev",
                                    map.what(), given));
    collider.ownRate = true;
    collider.rate.type = known->second;
    collider.rate.equation = fmt::format("{} of {}", reaction_.equation, yaml_.text(map.at("name"), map.what()));
    collider.rate.line = YamlAccess::line(map.node());
    collider.rate.reactants = reaction_.reactants;
    collider.rate.products = reaction_.products;
    collider.rate.orders = reaction_.orders;
    collider.rate.reversible = false;
    if (known->second == Type::Falloff) collider.rate.thirdBody = ThirdBody{};
    readRates(yaml_, units_, map, collider.rate, warnings_);
    // A reaction's own are looked at with its duplicates (joinPressureRates).
    if (const auto problem = pressureRateProblem(collider.rate.pressureRates); !problem.empty())
      yaml_.fail(map.at("rate-constants"), fmt::format("{}: {}", map.what(), problem));
  }

  const YamlAccess& yaml_;
  const UnitSystem& units_;
  const YamlMap& entry_;
  const Reaction& reaction_;
  const ReactionScope& scope_;
  std::vector<std::string>& warnings_;
  bool byEigenvalue_ = false;
  Arrhenius reference_{1, 0, 0};  // eig0 of M
  std::vector<Collider> colliders_;
};

}  // namespace

std::vector<Collider> readColliders(const YamlAccess& yaml, const UnitSystem& units, const YamlMap& entry,
                                    const Reaction& reaction, const ReactionScope& scope,
                                    std::vector<std::string>& warnings) {
  return ColliderReader(yaml, units, entry, reaction, scope, warnings).read();
}

}  // namespace lampblack::chemistry
