#include "chemistry/mechanism/reaction_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include "chemistry/mechanism/collider_reader.hpp"
#include "chemistry/mechanism/equation_parser.hpp"
#include "chemistry/mechanism/rate_reader.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::chemistry {

namespace {

using Type = Reaction::Type;

constexpr std::array<std::pair<std::string_view, Type>, 19> kTypes{{
    {"elementary", Type::Elementary},
    {"Arrhenius", Type::Elementary},
    {"Blowers-Masel", Type::Elementary},
    {"three-body", Type::ThreeBody},
    {"three-body-Arrhenius", Type::ThreeBody},
    {"three-body-Blowers-Masel", Type::ThreeBody},
    {"falloff", Type::Falloff},
    {"falloff-Lindemann", Type::Falloff},
    {"falloff-Troe", Type::Falloff},
    {"falloff-SRI", Type::Falloff},
    {"falloff-Tsang", Type::Falloff},
    {"chemically-activated", Type::ChemicallyActivated},
    {"chemically-activated-Lindemann", Type::ChemicallyActivated},
    {"chemically-activated-Troe", Type::ChemicallyActivated},
    {"chemically-activated-SRI", Type::ChemicallyActivated},
    {"chemically-activated-Tsang", Type::ChemicallyActivated},
    {"pressure-dependent-Arrhenius", Type::PressureLog},
    {"Chebyshev", Type::Chebyshev},
    {"linear-Burke", Type::LinearBurke},
}};

// Keys that not all types of reactions have.
struct KeyOfTypes {
  std::string_view key;
  std::initializer_list<Type> types;
};
constexpr std::array<KeyOfTypes, 14> kKeysOfTypes{{
    {"rate-constant", {Type::Elementary, Type::ThreeBody}},
    {"rate-constants", {Type::PressureLog}},
    {"low-P-rate-constant", {Type::Falloff, Type::ChemicallyActivated}},
    {"high-P-rate-constant", {Type::Falloff, Type::ChemicallyActivated}},
    {"Troe", {Type::Falloff, Type::ChemicallyActivated}},
    {"SRI", {Type::Falloff, Type::ChemicallyActivated}},
    {"Tsang", {Type::Falloff, Type::ChemicallyActivated}},
    {"efficiencies", {Type::Elementary, Type::ThreeBody, Type::Falloff, Type::ChemicallyActivated}},
    {"default-efficiency", {Type::Elementary, Type::ThreeBody, Type::Falloff, Type::ChemicallyActivated}},
    {"negative-A", {Type::Elementary, Type::ThreeBody, Type::Falloff, Type::ChemicallyActivated}},
    {"temperature-range", {Type::Chebyshev}},
    {"pressure-range", {Type::Chebyshev}},
    {"data", {Type::Chebyshev}},
    {"colliders", {Type::LinearBurke}},
}};

const std::vector<std::string_view>& knownKeys() {
  static const std::vector<std::string_view> keys = [] {
    std::vector<std::string_view> all{"equation",           "type", "units", "duplicate", "orders", "negative-orders",
                                      "nonreactant-orders", "note", "id",    "reference", "comment"};
    for (const auto& [key, types] : kKeysOfTypes) all.push_back(key);
    return all;
  }();
  return keys;
}

// Words of what other programs may mean to change a rate by, which has no key here.
constexpr std::array<std::string_view, 7> kOthersOfRates{"reversible", "irreversible", "falloff", "multiplier",
                                                         "third-body", "eff",          "order"};

// Whether a key that is not known has the words of one that a rate depends on: "third-body-efficiencies". 'data' may be
// of anything.
bool asksForAnotherRate(std::string_view key) {
  const auto sharesWords = [&](std::string_view known) { return !nameOfSameWords(key, {std::string(known)}).empty(); };
  return sharesWords("orders") || std::ranges::any_of(kOthersOfRates, sharesWords) ||
         std::ranges::any_of(kKeysOfTypes, [&](const auto& of) { return of.key != "data" && sharesWords(of.key); });
}

bool has(const ParsedEquation::Side& side, std::string_view name) {
  return std::any_of(side.begin(), side.end(), [&](const auto& term) { return term.first == name; });
}

// "(+AR)", or "AR" on both sides.
bool isCollider(const ParsedEquation& parsed, std::string_view name) {
  if (parsed.hasM || !parsed.falloffCollider.empty()) return name == parsed.falloffCollider;
  return has(parsed.reactants, name) && has(parsed.products, name);
}

// A species that the phase does not have.
struct Undeclared {
  std::string name;
};

// Whether a '+' stands between two other characters.
bool hasInnerPlus(std::string_view name) {
  for (std::size_t i = 1; i + 1 < name.size(); ++i)
    if (name[i] == '+' && name[i - 1] != '+' && name[i + 1] != '+') return true;
  return false;
}

class ReactionReader {
 public:
  ReactionReader(const YamlAccess& yaml, const UnitSystem& units, const YAML::Node& node, const ReactionScope& scope,
                 std::vector<std::string>& warnings)
      : yaml_(yaml), units_(units), entry_(yaml, node, "reaction"), scope_(scope), warnings_(warnings) {}

  std::optional<Reaction> read() {
    reaction_.equation = yaml_.text(entry_.at("equation"), "reaction equation");
    reaction_.line = YamlAccess::line(entry_.node());
    entry_.rename(fmt::format("reaction '{}'", reaction_.equation));
    if (const auto* own = entry_.find("units")) units_ = yaml_.units(*own, units_);
    const auto parsed = parse();
    readType(parsed);
    checkKeys();
    reaction_.reversible = parsed.reversible;
    reaction_.duplicate = entry_.flag("duplicate", false);
    try {
      reaction_.reactants = terms(parsed.reactants);
      reaction_.products = terms(parsed.products);
      readOrders();
      readThirdBody(parsed);
    } catch (const Undeclared& species) {
      if (scope_.skipUndeclaredSpecies) return std::nullopt;
      if (scope_.skipUndeclaredThirdBodies && isCollider(parsed, species.name)) return std::nullopt;
      // "H+O2": names may have '+' in them, so that blanks part the terms of an equation. "NO+" is an ion.
      fail(entry_.node(), fmt::format("species '{}' is not declared in the phase{}", species.name,
                                      hasInnerPlus(species.name) ? "; expected blanks around '+'" : ""));
    }
    readRates(yaml_, units_, entry_, reaction_, warnings_);
    if (reaction_.type == Type::LinearBurke)
      reaction_.colliders = readColliders(yaml_, units_, entry_, reaction_, scope_, warnings_);
    return std::move(reaction_);
  }

 private:
  [[noreturn]] void fail(const YAML::Node& where, std::string_view message) const {
    yaml_.fail(where, fmt::format("{}: {}", entry_.what(), message));
  }

  ParsedEquation parse() const {
    try {
      return parseEquation(reaction_.equation);
    } catch (const InputError& error) {
      yaml_.fail(entry_.node(), error.what());
    }
  }

  void readType(const ParsedEquation& parsed) {
    const auto* node = entry_.find("type");
    const auto& where = node == nullptr ? entry_.node() : *node;
    if (node == nullptr) {
      reaction_.type = parsed.hasM ? Type::ThreeBody : Type::Elementary;
    } else {
      const auto& given = yaml_.text(*node, "reaction type");
      const auto* known = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == given; });
      if (known == kTypes.end())
        fail(*node, fmt::format("rate type '{}' is not supported; supported are elementary, three-body, falloff, "
                                "chemically-activated, pressure-dependent-Arrhenius, Chebyshev, Blowers-Masel and "
                                "linear-Burke",
                                given));
      reaction_.type = known->second;
      if (given == "Blowers-Masel" && parsed.hasM) reaction_.type = Type::ThreeBody;
    }
    const bool inBrackets = !parsed.falloffCollider.empty();
    switch (reaction_.type) {
      case Type::Elementary:
      case Type::ThreeBody:
        if (inBrackets) fail(where, fmt::format("'(+{})' needs 'type: falloff'", parsed.falloffCollider));
        if (reaction_.type == Type::Elementary && parsed.hasM) fail(where, "'M' needs 'type: three-body' or no type");
        break;
      case Type::Falloff:
      case Type::ChemicallyActivated:
        if (!inBrackets)
          fail(where, fmt::format("'type: {}' needs '(+M)' on both sides of the equation", node->Scalar()));
        break;
      case Type::PressureLog:
      case Type::Chebyshev:
      case Type::LinearBurke:
        // "(+M)" says no more here than that the constant depends on pressure.
        if (parsed.hasM || (inBrackets && parsed.falloffCollider != "M"))
          fail(where, fmt::format("'type: {}' takes no third body", node->Scalar()));
        break;
    }
  }

  // What no type of reaction has is for another program, unless it would change the rate.
  void checkKeys() {
    for (const auto& entry : entry_.entries())
      if (std::ranges::find(knownKeys(), entry.key) == knownKeys().end() && asksForAnotherRate(entry.key))
        fail(entry.keyNode,
             fmt::format("unknown key '{}', which may be meant to change the rate; the nearest known key "
                         "is '{}'",
                         entry.key, closestName(entry.key, knownKeys())));
    entry_.warnOfOthers(knownKeys(), warnings_);
    for (const auto& [key, types] : kKeysOfTypes)
      if (const auto* found = entry_.find(key);
          found != nullptr && std::ranges::find(types, reaction_.type) == types.end())
        fail(*found, fmt::format("'{}' does not belong to a reaction of this type", key));
  }

  std::size_t index(std::string_view name) const {
    if (const auto k = scope_.findSpecies(name)) return *k;
    throw Undeclared{std::string(name)};
  }

  std::vector<StoichiometricTerm> terms(const ParsedEquation::Side& side) const {
    std::vector<StoichiometricTerm> result;
    for (const auto& [name, coefficient] : side) result.push_back({index(name), coefficient});
    return result;
  }

  void readOrders() {
    const auto* node = entry_.find("orders");
    if (node == nullptr) return;
    const YamlMap orders(yaml_, *node, entry_.what() + ", 'orders'");
    if (reaction_.reversible && !orders.entries().empty()) fail(*node, "'orders' need an irreversible reaction ('=>')");
    const bool anySpecies = entry_.flag("nonreactant-orders", false);
    const bool anySign = entry_.flag("negative-orders", false);
    for (const auto& [key, keyNode, value] : orders.entries()) {
      const auto k = index(key);
      const bool reactant = std::any_of(reaction_.reactants.begin(), reaction_.reactants.end(),
                                        [&](const auto& term) { return term.species == k; });
      if (!reactant && !anySpecies)
        fail(keyNode, fmt::format("an order of '{}', which is no reactant; expected 'nonreactant-orders: true'", key));
      const double order = yaml_.number(value, orders.what());
      if (order < 0 && !anySign)
        fail(value, fmt::format("a negative order of '{}'; expected 'negative-orders: true'", key));
      reaction_.orders.push_back({k, order});
    }
  }

  void readThirdBody(const ParsedEquation& parsed) {
    switch (reaction_.type) {
      case Type::Elementary:
      case Type::ThreeBody:
        if (parsed.hasM)
          reaction_.thirdBody = mixture();
        else
          readNamedCollider(parsed);
        break;
      case Type::Falloff:
      case Type::ChemicallyActivated:
        reaction_.thirdBody = parsed.falloffCollider == "M" ? mixture() : collider(parsed.falloffCollider);
        break;
      case Type::PressureLog:
      case Type::Chebyshev:
      case Type::LinearBurke:
        break;
    }
  }

  double efficiency(const YAML::Node& value) const {
    const double given = yaml_.number(value, entry_.what() + ", 'efficiencies'");
    if (given < 0) fail(value, "expected an efficiency of zero or more");
    return given;
  }

  ThirdBody mixture() const {
    ThirdBody body;
    if (const auto* standard = entry_.find("default-efficiency")) body.defaultEfficiency = efficiency(*standard);
    const auto* node = entry_.find("efficiencies");
    if (node == nullptr) return body;
    const YamlMap list(yaml_, *node, entry_.what() + ", 'efficiencies'");
    for (const auto& entry : list.entries()) {
      const double value = efficiency(entry.value);
      if (const auto k = scope_.findSpecies(entry.key))
        body.efficiencies.push_back({*k, value});
      else if (!scope_.skipUndeclaredThirdBodies)
        fail(entry.keyNode, fmt::format("species '{}' of 'efficiencies' is not declared in the phase", entry.key));
    }
    return body;
  }

  // One species alone, as "(+AR)" or "+ AR" says; 'efficiencies' may only repeat it, with its efficiency.
  ThirdBody collider(std::string_view name) const {
    ThirdBody body;
    body.defaultEfficiency = 0;
    body.efficiencies.push_back({index(name), 1.0});
    if (const auto* standard = entry_.find("default-efficiency"); standard != nullptr && efficiency(*standard) != 0)
      fail(*standard, fmt::format("the collider '{}' of the equation excludes a default efficiency but zero", name));
    if (const auto* node = entry_.find("efficiencies")) {
      const YamlMap list(yaml_, *node, entry_.what() + ", 'efficiencies'");
      if (list.entries().size() != 1 || list.entries()[0].key != name)
        fail(*node, fmt::format("the collider '{}' of the equation excludes 'efficiencies' of others", name));
      body.efficiencies[0].coefficient = efficiency(list.entries()[0].value);
    }
    return body;
  }

  // "H + O2 + AR <=> HO2 + AR". With an efficiency of one, k [H][O2][AR] is the rate of an elementary reaction.
  void readNamedCollider(const ParsedEquation& parsed) {
    std::vector<std::string_view> both;
    for (const auto& [name, coefficient] : parsed.reactants)
      for (const auto& [other, otherCoefficient] : parsed.products)
        if (name == other && coefficient >= 1 && otherCoefficient >= 1) both.push_back(name);
    const bool asked = reaction_.type == Type::ThreeBody;
    reaction_.type = Type::Elementary;
    if (asked && both.empty())
      fail(entry_.at("type"), "'type: three-body' needs 'M' or a collider named on both sides of the equation");
    const auto* efficiencies = entry_.find("efficiencies");
    const auto* standard = entry_.find("default-efficiency");
    if (efficiencies == nullptr && standard == nullptr) return;
    const auto& where = efficiencies != nullptr ? *efficiencies : *standard;
    if (both.empty() || (entry_.has("type") && !asked)) fail(where, "efficiencies need a third body in the equation");
    std::string_view name = both.front();
    if (both.size() > 1) {  // the one the efficiencies name
      if (efficiencies == nullptr || !efficiencies->IsMap() || efficiencies->size() != 1)
        fail(where, "more than one species may be the collider; expected 'efficiencies' of the one that is meant");
      const auto& named = yaml_.text(efficiencies->begin()->first, entry_.what());
      const auto found = std::find(both.begin(), both.end(), named);
      if (found == both.end()) fail(where, fmt::format("'{}' is not on both sides of the equation", named));
      name = *found;
    }
    auto body = collider(name);
    if (body.efficiencies[0].coefficient == 1) return;
    reaction_.type = Type::ThreeBody;
    for (auto* side : {&reaction_.reactants, &reaction_.products}) {
      for (auto& term : *side)
        if (term.species == body.efficiencies[0].species) term.coefficient -= 1;
      std::erase_if(*side, [](const auto& term) { return term.coefficient == 0; });
    }
    reaction_.thirdBody = std::move(body);
  }

  const YamlAccess& yaml_;
  UnitSystem units_;
  YamlMap entry_;
  const ReactionScope& scope_;
  std::vector<std::string>& warnings_;
  Reaction reaction_;
};

}  // namespace

std::optional<Reaction> readReaction(const YamlAccess& yaml, const UnitSystem& units, const YAML::Node& node,
                                     const ReactionScope& scope, std::vector<std::string>& warnings) {
  return ReactionReader(yaml, units, node, scope, warnings).read();
}

}  // namespace lampblack::chemistry
