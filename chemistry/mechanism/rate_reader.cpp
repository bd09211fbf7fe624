#include "chemistry/mechanism/rate_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/mechanism/rate_checks.hpp"
#include "core/constants.hpp"

namespace lampblack::chemistry {

namespace {

using Type = Reaction::Type;

// Sum of the powers of concentrations in the forward rate, without that of [M].
double forwardOrder(const Reaction& reaction) {
  double order = 0;
  for (const auto& o : reaction.orders) order += o.coefficient;
  for (const auto& term : reaction.reactants) {
    const bool replaced = std::any_of(reaction.orders.begin(), reaction.orders.end(),
                                      [&](const auto& o) { return o.species == term.species; });
    if (!replaced) order += term.coefficient;
  }
  return order;
}

class RateReader {
 public:
  RateReader(const YamlAccess& yaml, const UnitSystem& units, const YamlMap& entry, Reaction& reaction,
             std::vector<std::string>& warnings)
      : yaml_(yaml), units_(units), entry_(entry), reaction_(reaction), warnings_(warnings) {}

  void read() {
    const double order = forwardOrder(reaction_);
    switch (reaction_.type) {
      case Type::Elementary:
      case Type::ThreeBody:
        readElementary(order + (reaction_.type == Type::ThreeBody ? 1 : 0));
        break;
      case Type::Falloff:
      case Type::ChemicallyActivated: {
        // k_0 [M] of a fall-off reaction and k_0 of a chemically activated one have the unit of k.
        const double low = reaction_.type == Type::Falloff ? order + 1 : order;
        reaction_.lowPressureRate = limit("low-P-rate-constant", low);
        reaction_.rate = limit("high-P-rate-constant", low - 1);
        readBroadening();
        requireSound(entry_.node());
        break;
      }
      case Type::PressureLog:
        readPressureRates(order);
        break;
      case Type::Chebyshev:
        readChebyshev(order);
        break;
      case Type::LinearBurke:  // each collider is read by itself
        break;
    }
  }

 private:
  [[noreturn]] void fail(const YAML::Node& where, std::string_view message) const {
    yaml_.fail(where, fmt::format("{}: {}", entry_.what(), message));
  }

  std::string label(std::string_view key) const { return fmt::format("{}, '{}'", entry_.what(), key); }

  Arrhenius arrhenius(const YAML::Node& A, const YAML::Node& b, const YAML::Node& Ea, double order) const {
    Arrhenius rate;
    rate.A = yaml_.quantity(A, rateConstantUnit(order), units_.rateConstant(order), entry_.what());
    rate.b = yaml_.number(b, entry_.what());
    rate.activationTemperature = yaml_.activationTemperature(Ea, units_, entry_.what());
    if (!std::isfinite(rate.A) || !std::isfinite(rate.activationTemperature))
      fail(A, "the rate constant is out of range");
    return rate;
  }

  void requireSign(const YAML::Node& node, double A) const {
    if (A < 0 && !entry_.flag("negative-A", false))
      fail(node, "negative 'A'; expected 'negative-A: true' or a positive number");
  }

  void readElementary(double order) {
    const auto* type = entry_.find("type");
    if (type == nullptr || !yaml_.text(*type, entry_.what()).ends_with("Blowers-Masel")) {
      reaction_.rate = limit("rate-constant", order);
      return;
    }
    const auto& node = entry_.at("rate-constant");
    const auto values = yaml_.values(node, {"A", "b", "Ea0", "w"}, label("rate-constant"));
    reaction_.rate = arrhenius(values[0], values[1], values[2], order);
    reaction_.blowersMasel = BlowersMasel{yaml_.activationTemperature(values[3], units_, entry_.what())};
    requireSign(node, reaction_.rate.A);
    requireSound(node);
  }

  Arrhenius limit(std::string_view key, double order) const {
    const auto* node = entry_.find(key);
    if (node == nullptr) fail(entry_.node(), fmt::format("expected '{}'", key));
    const auto values = yaml_.values(*node, {"A", "b", "Ea"}, label(key));
    const auto rate = arrhenius(values[0], values[1], values[2], order);
    requireSign(*node, rate.A);
    return rate;
  }

  void requireSound(const YAML::Node& where) const {
    if (const auto problem = rateProblem(reaction_); !problem.empty()) fail(where, problem);
  }

  void readBroadening() {
    const auto *troe = entry_.find("Troe"), *sri = entry_.find("SRI"), *tsang = entry_.find("Tsang");
    if (int{troe != nullptr} + int{sri != nullptr} + int{tsang != nullptr} > 1)
      fail(sri != nullptr ? *sri : *tsang, "expected only one of 'Troe', 'SRI' and 'Tsang'");
    if (troe != nullptr) readTroe(*troe);
    if (sri != nullptr) readSri(*sri);
    if (tsang != nullptr) readTsang(*tsang);
  }

  double temperature(const YamlMap& map, std::string_view key) const {
    return yaml_.quantity(map.at(key), kKelvin, 1.0, map.what());
  }

  void readTroe(const YAML::Node& node) {
    const YamlMap map(yaml_, node, label("Troe"));
    if (map.entries().empty()) return;
    map.allowOnly({"A", "T3", "T1", "T2"});
    TroeBroadening troe;
    troe.A = yaml_.number(map.at("A"), map.what());
    troe.T3 = temperature(map, "T3");
    troe.T1 = temperature(map, "T1");
    if (map.has("T2")) {
      troe.T2 = temperature(map, "T2");
      // exp(-0/T) would add 1 to the broadening; a zero is written where the term is meant to be absent.
      if (*troe.T2 == 0) {
        troe.T2.reset();
        warnings_.push_back(fmt::format("{}:{}: {}: T2 is zero and its term left out; expected no 'T2' then",
                                        yaml_.file(), YamlAccess::line(map.at("T2")), map.what()));
      }
    }
    reaction_.troe = troe;
  }

  void readSri(const YAML::Node& node) {
    const YamlMap map(yaml_, node, label("SRI"));
    if (map.entries().empty()) return;
    map.allowOnly({"A", "B", "C", "D", "E"});
    SriBroadening sri;
    sri.a = yaml_.number(map.at("A"), map.what());
    sri.b = temperature(map, "B");
    sri.c = temperature(map, "C");
    sri.d = map.number("D", 1.0);
    sri.e = map.number("E", 0.0);
    reaction_.sri = sri;
  }

  void readTsang(const YAML::Node& node) {
    const YamlMap map(yaml_, node, label("Tsang"));
    if (map.entries().empty()) return;
    map.allowOnly({"A", "B"});
    reaction_.tsang = TsangBroadening{yaml_.number(map.at("A"), map.what()), map.number("B", 0.0)};
  }

  void readPressureRates(double order) {
    const auto& list = entry_.at("rate-constants");
    yaml_.requireSequence(list, label("rate-constants"));
    for (const auto& node : list) {
      const YamlMap map(yaml_, node, label("rate-constants"));
      map.allowOnly({"P", "A", "b", "Ea"});
      PressureRate rate;
      rate.pressure = yaml_.quantity(map.at("P"), kPascal, units_.pressure(), map.what());
      if (!(rate.pressure > 0) || !std::isfinite(rate.pressure)) fail(map.at("P"), "expected a positive pressure");
      rate.rate = arrhenius(map.at("A"), map.at("b"), map.at("Ea"), order);
      reaction_.pressureRates.push_back(rate);
    }
    if (reaction_.pressureRates.empty()) fail(list, "'rate-constants': expected at least one pressure");
    std::stable_sort(reaction_.pressureRates.begin(), reaction_.pressureRates.end(),
                     [](const auto& a, const auto& b) { return a.pressure < b.pressure; });
  }

  std::pair<double, double> range(std::string_view key, const MechanismUnit& unit, double factor) const {
    const auto& node = entry_.at(key);
    yaml_.requireSequence(node, label(key));
    if (node.size() != 2) fail(node, fmt::format("'{}': expected the least and the largest value", key));
    const double least = yaml_.quantity(node[0], unit, factor, label(key));
    const double largest = yaml_.quantity(node[1], unit, factor, label(key));
    if (!(least > 0) || !(largest > least) || !std::isfinite(largest))
      fail(node, fmt::format("'{}': expected two rising positive values", key));
    return {least, largest};
  }

  void readChebyshev(double order) {
    ChebyshevRate rate;
    std::tie(rate.minTemperature, rate.maxTemperature) = range("temperature-range", kKelvin, 1.0);
    std::tie(rate.minPressure, rate.maxPressure) = range("pressure-range", kPascal, units_.pressure());
    const auto& data = entry_.at("data");
    yaml_.requireSequence(data, label("data"));
    for (const auto& row : data) {
      yaml_.requireSequence(row, label("data"));
      if (rate.numTemperature == 0) rate.numPressure = row.size();
      if (row.size() != rate.numPressure || row.size() == 0)
        fail(row, "'data': expected rows of the same number of coefficients");
      for (const auto& coefficient : row) rate.coefficients.push_back(yaml_.number(coefficient, label("data")));
      ++rate.numTemperature;
    }
    if (rate.coefficients.empty()) fail(data, "'data': expected rows of coefficients");
    rate.coefficients[0] += std::log10(units_.rateConstant(order));
    if (!std::isfinite(rate.coefficients[0])) fail(data, "the rate constant is out of range");
    reaction_.chebyshev = std::move(rate);
  }

  const YamlAccess& yaml_;
  const UnitSystem& units_;
  const YamlMap& entry_;
  Reaction& reaction_;
  std::vector<std::string>& warnings_;
};

}  // namespace

void readRates(const YamlAccess& yaml, const UnitSystem& units, const YamlMap& entry, Reaction& reaction,
               std::vector<std::string>& warnings) {
  RateReader(yaml, units, entry, reaction, warnings).read();
}

}  // namespace lampblack::chemistry
