#include "chemistry/reaction_reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "chemistry/equation_parser.hpp"
#include "core/errors.hpp"

namespace lampblack {

namespace {

class ReactionReader {
 public:
  ReactionReader(const YamlAccess& yaml, const FileUnits& units, const YAML::Node& node, const SpeciesFinder& find)
      : yaml_(yaml), units_(units), node_(node), find_(find) {}

  Reaction read() {
    yaml_.requireMap(node_, "reaction");
    equation_ = yaml_.text(yaml_.member(node_, "equation", "reaction"), "reaction equation");
    reaction_.equation = equation_;
    reaction_.line = YamlAccess::line(node_);
    const auto parsed = parse();
    readType(parsed);
    checkKeys();
    reaction_.reversible = parsed.reversible;
    reaction_.reactants = terms(parsed.reactants);
    reaction_.products = terms(parsed.products);
    if (node_["duplicate"].IsDefined()) reaction_.duplicate = yaml_.flag(node_["duplicate"], "duplicate");
    readOrders();
    readThirdBody(parsed);
    readRates();
    return reaction_;
  }

 private:
  [[noreturn]] void fail(const YAML::Node& where, std::string_view message) const {
    yaml_.fail(where, fmt::format("reaction '{}': {}", equation_, message));
  }

  ParsedEquation parse() const {
    try {
      return parseEquation(equation_);
    } catch (const InputError& error) {
      yaml_.fail(node_, error.what());
    }
  }

  void readType(const ParsedEquation& parsed) {
    const YAML::Node node = node_["type"];
    std::string type;
    if (node.IsDefined()) type = yaml_.text(node, "reaction type");
    if (type.empty() || type == "elementary" || type == "Arrhenius") {
      // Cantera takes "+ M" without a type as three-body too. A collider named in the equation needs no type here:
      // k [A][B][collider] is the rate of an elementary reaction of the same order.
      reaction_.type = parsed.hasM ? Reaction::Type::ThreeBody : Reaction::Type::Elementary;
      if (!parsed.falloffCollider.empty()) fail(node_, "'(+M)' needs 'type: falloff'");
    } else if (type == "three-body" || type == "three-body-Arrhenius") {
      reaction_.type = Reaction::Type::ThreeBody;
      if (!parsed.falloffCollider.empty()) fail(node, "'(+M)' needs 'type: falloff', not 'three-body'");
      if (!parsed.hasM) {
        requireNamedCollider(parsed, node);
        reaction_.type = Reaction::Type::Elementary;
      }
    } else if (type == "falloff" || type == "falloff-Troe" || type == "falloff-Lindemann") {
      reaction_.type = Reaction::Type::Falloff;
      if (parsed.falloffCollider.empty()) fail(node, "'type: falloff' needs '(+M)' on both sides of the equation");
    } else {
      fail(node,
           fmt::format("rate type '{}' is not supported yet; supported are elementary, three-body and falloff", type));
    }
  }

  void requireNamedCollider(const ParsedEquation& parsed, const YAML::Node& where) const {
    for (const auto& [name, coefficient] : parsed.reactants)
      for (const auto& [other, otherCoefficient] : parsed.products)
        if (name == other) return;
    fail(where, "'type: three-body' needs 'M' or a collider named on both sides of the equation");
  }

  void checkKeys() const {
    for (const char* key : {"SRI", "Tsang", "rate-constants", "temperature-range", "pressure-range", "data",
                            "coverage-dependencies", "nonreactant-orders"})
      if (node_[key].IsDefined()) fail(node_[key], fmt::format("'{}' is not supported yet", key));
    const auto what = fmt::format("reaction '{}'", equation_);
    if (reaction_.type == Reaction::Type::Falloff)
      yaml_.allowOnly(node_,
                      {"equation", "type", "low-P-rate-constant", "high-P-rate-constant", "Troe", "efficiencies",
                       "default-efficiency", "duplicate", "orders", "note", "id"},
                      what);
    else if (reaction_.type == Reaction::Type::ThreeBody)
      yaml_.allowOnly(node_,
                      {"equation", "type", "rate-constant", "efficiencies", "default-efficiency", "duplicate", "orders",
                       "negative-A", "note", "id"},
                      what);
    else
      yaml_.allowOnly(node_, {"equation", "type", "rate-constant", "duplicate", "orders", "negative-A", "note", "id"},
                      what);
  }

  std::size_t index(const std::string& name, const YAML::Node& where) const {
    if (const auto k = find_(name)) return *k;
    fail(where, fmt::format("species '{}' is not declared in the phase", name));
  }

  std::vector<StoichiometricTerm> terms(const ParsedEquation::Side& side) const {
    std::vector<StoichiometricTerm> result;
    for (const auto& [name, coefficient] : side) result.push_back({index(name, node_), coefficient});
    return result;
  }

  void readOrders() {
    const YAML::Node orders = node_["orders"];
    if (!orders.IsDefined()) return;
    yaml_.requireMap(orders, "orders");
    if (reaction_.reversible) fail(orders, "'orders' need an irreversible reaction ('=>')");
    for (const auto& entry : orders) {
      const auto k = index(yaml_.text(entry.first, "orders"), entry.first);
      bool reactant = false;
      for (const auto& term : reaction_.reactants) reactant = reactant || term.species == k;
      if (!reactant) fail(entry.first, "'orders' of a species that is not a reactant are not supported yet");
      const double order = yaml_.number(entry.second, "order");
      if (order < 0) fail(entry.second, "negative orders are not supported yet");
      reaction_.orders.push_back({k, order});
    }
  }

  void readThirdBody(const ParsedEquation& parsed) {
    if (reaction_.type == Reaction::Type::Elementary) return;
    ThirdBody body;
    const bool named = !parsed.falloffCollider.empty() && parsed.falloffCollider != "M";
    if (named) {
      if (node_["efficiencies"].IsDefined())
        fail(node_["efficiencies"], "a collider named in the equation excludes 'efficiencies'");
      body.defaultEfficiency = 0;
      body.efficiencies.push_back({index(parsed.falloffCollider, node_), 1.0});
    }
    if (const YAML::Node standard = node_["default-efficiency"]; standard.IsDefined()) {
      if (named) fail(standard, "a collider named in the equation excludes 'default-efficiency'");
      body.defaultEfficiency = yaml_.number(standard, "default-efficiency");
      if (body.defaultEfficiency < 0) fail(standard, "expected an efficiency of zero or more");
    }
    if (const YAML::Node list = node_["efficiencies"]; list.IsDefined()) {
      yaml_.requireMap(list, "efficiencies");
      for (const auto& entry : list) {
        const double value = yaml_.number(entry.second, "efficiency");
        if (value < 0) fail(entry.second, "expected an efficiency of zero or more");
        body.efficiencies.push_back({index(yaml_.text(entry.first, "efficiencies"), entry.first), value});
      }
    }
    reaction_.thirdBody = std::move(body);
  }

  double forwardOrder() const {
    double order = 0;
    for (const auto& term : reaction_.reactants) {
      double exponent = term.coefficient;
      for (const auto& o : reaction_.orders)
        if (o.species == term.species) exponent = o.coefficient;
      order += exponent;
    }
    return order;
  }

  double activationTemperature(const YAML::Node& node) const {
    double value = 0;
    if (node.IsScalar() && YAML::convert<double>::decode(node, value) && std::isfinite(value))
      return value * units_.activationTemperature;
    // "15.2 kcal/mol"
    const auto given = yaml_.text(node, fmt::format("reaction '{}': 'Ea'", equation_));
    const auto parsed = std::from_chars(given.data(), given.data() + given.size(), value);
    std::string_view unit(parsed.ptr, static_cast<std::size_t>(given.data() + given.size() - parsed.ptr));
    while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
    const double factor = activationUnitInKelvin(unit);
    if (parsed.ec != std::errc{} || factor == 0)
      fail(node, fmt::format("'Ea': expected a number or a number with a unit such as cal/mol, found '{}'", given));
    return value * factor;
  }

  Arrhenius readArrhenius(const char* key, double order, bool mayBeNegative) const {
    const YAML::Node rate = node_[key];
    if (!rate.IsDefined()) fail(node_, fmt::format("expected '{}'", key));
    YAML::Node A, b, Ea;
    if (rate.IsSequence()) {
      if (rate.size() != 3) fail(rate, fmt::format("'{}': expected three numbers A, b, Ea", key));
      A.reset(rate[0]);
      b.reset(rate[1]);
      Ea.reset(rate[2]);
    } else {
      const auto what = fmt::format("reaction '{}', '{}'", equation_, key);
      yaml_.requireMap(rate, what);
      yaml_.allowOnly(rate, {"A", "b", "Ea"}, what);
      A.reset(yaml_.member(rate, "A", what));
      b.reset(yaml_.member(rate, "b", what));
      Ea.reset(yaml_.member(rate, "Ea", what));
    }
    Arrhenius result;
    const double volumePerAmount = std::pow(units_.length, 3) / units_.quantity;
    const double given = yaml_.number(A, fmt::format("reaction '{}': 'A'", equation_));
    if (given < 0 && !mayBeNegative) fail(A, "negative 'A'; expected 'negative-A: true' or a positive number");
    result.A = given * std::pow(volumePerAmount, order - 1) / units_.time;
    result.b = yaml_.number(b, fmt::format("reaction '{}': 'b'", equation_));
    result.activationTemperature = activationTemperature(Ea);
    return result;
  }

  void readRates() {
    const double order = forwardOrder();
    if (reaction_.type == Reaction::Type::Falloff) {
      reaction_.rate = readArrhenius("high-P-rate-constant", order, false);
      reaction_.lowPressureRate = readArrhenius("low-P-rate-constant", order + 1, false);
      if (!(reaction_.rate.A > 0) || !(reaction_.lowPressureRate.A > 0))
        fail(node_, "expected positive 'A' in both limits of a fall-off reaction");
      readTroe();
      return;
    }
    const bool negative = node_["negative-A"].IsDefined() && yaml_.flag(node_["negative-A"], "negative-A");
    const double extra = reaction_.type == Reaction::Type::ThreeBody ? 1 : 0;
    reaction_.rate = readArrhenius("rate-constant", order + extra, negative);
  }

  void readTroe() {
    const YAML::Node node = node_["Troe"];
    if (!node.IsDefined()) return;
    const auto what = fmt::format("reaction '{}', 'Troe'", equation_);
    yaml_.requireMap(node, what);
    yaml_.allowOnly(node, {"A", "T3", "T1", "T2"}, what);
    TroeBroadening troe;
    troe.A = yaml_.number(yaml_.member(node, "A", what), what);
    troe.T3 = yaml_.number(yaml_.member(node, "T3", what), what);
    troe.T1 = yaml_.number(yaml_.member(node, "T1", what), what);
    if (node["T2"].IsDefined()) troe.T2 = yaml_.number(node["T2"], what);
    reaction_.troe = troe;
  }

  const YamlAccess& yaml_;
  const FileUnits& units_;
  const YAML::Node& node_;
  const SpeciesFinder& find_;
  std::string equation_;
  Reaction reaction_;
};

}  // namespace

Reaction readReaction(const YamlAccess& yaml, const FileUnits& units, const YAML::Node& node,
                      const SpeciesFinder& findSpecies) {
  return ReactionReader(yaml, units, node, findSpecies).read();
}

}  // namespace lampblack
