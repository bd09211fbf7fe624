#include "chemistry/chemkin/chemkin_reaction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "chemistry/mechanism/rate_checks.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

using Numbers = std::vector<double>;

class ReactionBuilder {
 public:
  ReactionBuilder(const ChemkinSource& source, const ChemkinReactionEntry& entry, const ChemkinUnits& units,
                  const ChemkinEquationParser& species, bool permissive, std::vector<std::string>& warnings)
      : source_(source),
        entry_(entry),
        units_(units),
        species_(species),
        permissive_(permissive),
        warnings_(warnings) {}

  std::vector<Reaction> build() {
    try {
      equation_ = species_.parse(entry_.equation);
    } catch (const InputError& error) {
      source_.fail(entry_.line, error.what());
    }
    for (const auto& item : entry_.auxiliaries) take(item);
    takeLight();
    takeMixtureOfTables();
    checkTogether();
    reaction_.line = entry_.line;
    reaction_.reactants = equation_.reactants;
    reaction_.products = equation_.products;
    reaction_.reversible = equation_.reversible && !reverse_ && !equation_.hasLight;
    reaction_.orders = ordersThatDiffer(forwardOrders_, reaction_.reactants);
    if (equation_.hasM || low_ || high_) reaction_.thirdBody = thirdBody();
    setRates();
    if (const auto problem = rateProblem(reaction_); !problem.empty()) fail(entry_.line, problem);
    std::vector<Reaction> result{reaction_};
    if (reverse_ && (*reverse_)[0] != 0) result.push_back(reversed());
    return result;
  }

 private:
  [[noreturn]] void fail(int line, std::string_view message) const {
    source_.fail(line, fmt::format("reaction '{}': {}", entry_.equation, message));
  }

  std::size_t speciesOf(const std::string& name, int line, std::string_view where) const {
    if (const auto k = species_.find(name)) return *k;
    fail(line, fmt::format("species '{}' of {} is not declared{}", name, where, species_.suggestion(name)));
  }

  double number(const std::string& word, const ChemkinAuxiliary& item) const {
    if (const auto value = fortranNumber(word)) return *value;
    fail(item.line, fmt::format("'{}': expected a number, found '{}'", item.key, word));
  }

  // All values of a keyword, as many as one of `counts` says.
  Numbers numbers(const ChemkinAuxiliary& item, std::initializer_list<std::size_t> counts,
                  std::string_view meaning) const {
    if (std::ranges::find(counts, item.values.size()) == counts.end())
      fail(item.line, fmt::format("'{}': expected {}, found {} values", item.key, meaning, item.values.size()));
    Numbers result;
    for (const auto& word : item.values) result.push_back(number(word, item));
    return result;
  }

  template <typename Value>
  void setOnce(std::optional<Value>& target, Value value, const ChemkinAuxiliary& item) const {
    if (target) fail(item.line, fmt::format("'{}' is given twice", item.key));
    target = std::move(value);
  }

  void take(const ChemkinAuxiliary& item) {
    const auto key = upperCase(item.key);
    if (key == "HV" && equation_.hasLight) return;  // the wavelength
    constexpr std::string_view arrhenius = "the three numbers A, b and Ea";
    if (std::string_view meaning; isUnsupportedChemkinKeyword(key, meaning) && !species_.find(item.key))
      fail(item.line, fmt::format("the keyword '{}' ({}) is not supported", item.key, meaning));
    if (key == "DUP" || key == "DUPLICATE")
      reaction_.duplicate = true;
    else if (key == "LOW")
      setOnce(low_, numbers(item, {3}, arrhenius), item);
    else if (key == "HIGH")
      setOnce(high_, numbers(item, {3}, arrhenius), item);
    else if (key == "REV")
      setOnce(reverse_, numbers(item, {3}, arrhenius), item);
    else if (key == "TROE")
      setOnce(troe_, numbers(item, {3, 4}, "three or four numbers A, T3, T1 and T2"), item);
    else if (key == "SRI")
      setOnce(sri_, numbers(item, {3, 5}, "three or five numbers a, b, c, d and e"), item);
    else if (key == "PLOG")
      pressureLog_.push_back(numbers(item, {4}, "the four numbers p, A, b and Ea"));
    else if (key == "TCHEB")
      setOnce(chebyshevTemperatures_, numbers(item, {2}, "the lowest and the highest temperature"), item);
    else if (key == "PCHEB")
      setOnce(chebyshevPressures_, numbers(item, {2}, "the lowest and the highest pressure"), item);
    else if (key == "CHEB")
      for (const auto& word : item.values) chebyshev_.push_back(number(word, item));
    else if (key == "FORD")
      takeOrder(item, forwardOrders_);
    else if (key == "RORD")
      takeOrder(item, reverseOrders_);
    else if (key == "UNITS")
      takeUnits(item);
    else
      takeEfficiency(item);
  }

  void takeOrder(const ChemkinAuxiliary& item, std::vector<StoichiometricTerm>& orders) const {
    if (item.values.size() != 2)
      fail(item.line,
           fmt::format("'{}': expected a species and its order, found {} values", item.key, item.values.size()));
    const auto k = speciesOf(item.values[0], item.line, item.key);
    for (const auto& order : orders)
      if (order.species == k) fail(item.line, fmt::format("'{}' of '{}' is given twice", item.key, item.values[0]));
    orders.push_back({k, number(item.values[1], item)});
  }

  void takeUnits(const ChemkinAuxiliary& item) {
    if (item.values.empty()) fail(item.line, fmt::format("'UNITS': expected {}", ChemkinUnits::expected()));
    for (const auto& word : item.values)
      if (!units_.set(word))
        fail(item.line, fmt::format("'UNITS': unknown unit '{}'; expected {}", word, ChemkinUnits::expected()));
  }

  void takeEfficiency(const ChemkinAuxiliary& item) {
    if (!species_.find(item.key)) {
      const bool looksLikeEfficiency = item.values.size() == 1 && fortranNumber(item.values[0]);
      if (permissive_ && looksLikeEfficiency) {
        warnings_.push_back(
            fmt::format("{}:{}: reaction '{}': the efficiency of '{}' is left out: it is no declared species",
                        source_.file(), item.line, entry_.equation, item.key));
        return;
      }
      const auto keyword = suggestChemkinKeyword(item.key);
      fail(item.line,
           fmt::format("'{}' is neither a keyword nor a declared species{}{}", item.key,
                       keyword.empty() ? species_.suggestion(item.key) : keyword,
                       looksLikeEfficiency ? "; --permissive leaves efficiencies of other species out" : ""));
    }
    const auto k = *species_.find(item.key);
    if (item.values.size() != 1)
      fail(item.line, fmt::format("expected one efficiency of '{}', found {} values", item.key, item.values.size()));
    const double value = number(item.values[0], item);
    if (value < 0)
      fail(item.line,
           fmt::format("expected an efficiency of zero or more of '{}', found '{}'", item.key, item.values[0]));
    if (!(equation_.hasM || (equation_.hasFalloff && !equation_.collider)))
      fail(item.line, fmt::format("the efficiency of '{}' needs '+M' or '(+M)' in the equation", item.key));
    for (const auto& e : efficiencies_)
      if (e.species == k) fail(item.line, fmt::format("the efficiency of '{}' is given twice", item.key));
    efficiencies_.push_back({k, value});
  }

  // Light that leaves the gas: nothing comes back from it.
  void takeLight() {
    if (!equation_.hasLight) return;
    if (reverse_ && (*reverse_)[0] != 0) fail(entry_.line, "REV: light (hv) that leaves the gas has no reverse rate");
    warnings_.push_back(fmt::format("{}: reaction '{}': the light (hv) is passed over, and the reaction taken as {}",
                                    source_.place(entry_.line), entry_.equation,
                                    equation_.reversible ? "irreversible, as if written with '=>'" : "it stands"));
  }

  // The tables hold the dependence on pressure: CHEMKIN reads their '+M' as '(+M)', without a factor [M].
  void takeMixtureOfTables() {
    if (!equation_.hasM || (pressureLog_.empty() && chebyshev_.empty())) return;
    equation_.hasM = false;
    equation_.hasFalloff = true;
    warnings_.push_back(
        fmt::format("{}: reaction '{}': '+M' is taken as '(+M)', for PLOG and CHEB have the dependence "
                    "on pressure",
                    source_.place(entry_.line), entry_.equation));
  }

  void checkTogether() const {
    const bool chebyshev = !chebyshev_.empty(), pressureLog = !pressureLog_.empty();
    const int kinds = int{low_.has_value()} + int{high_.has_value()} + int{pressureLog} + int{chebyshev};
    const auto refuse = [&](bool wrong, std::string_view message) {
      if (wrong) fail(entry_.line, message);
    };
    refuse(kinds > 1, "expected only one of LOW, HIGH, PLOG and CHEB");
    refuse(equation_.hasM && kinds > 0, "expected '(+M)' in place of '+M' with LOW or HIGH");
    refuse(equation_.hasFalloff && kinds == 0, "'(+M)' needs LOW, HIGH, PLOG or CHEB");
    refuse(!equation_.hasFalloff && (low_ || high_), "LOW and HIGH need '(+M)' on both sides of the equation");
    refuse((troe_ || sri_) && !(low_ || high_), "TROE and SRI need LOW or HIGH");
    refuse(troe_ && sri_, "expected only one of TROE and SRI");
    refuse((chebyshevTemperatures_ || chebyshevPressures_) && !chebyshev, "TCHEB and PCHEB need CHEB");
    refuse((pressureLog || chebyshev) && (equation_.collider || !efficiencies_.empty()),
           "PLOG and CHEB know no single colliders or efficiencies");
    refuse(reverse_ && kinds > 0, "REV is not supported with LOW, HIGH, PLOG or CHEB");
    refuse(reverse_ && (*reverse_)[0] != 0 && !equation_.reversible, "REV needs a reversible equation ('=' or '<=>')");
    refuse(!forwardOrders_.empty() && equation_.reversible && !reverse_ && !equation_.hasLight,
           "FORD needs an irreversible reaction ('=>' or REV): the reverse rate would contradict equilibrium");
    refuse(!reverseOrders_.empty() && !(reverse_ && (*reverse_)[0] != 0), "RORD needs REV with a rate of its own");
  }

  static std::vector<StoichiometricTerm> ordersThatDiffer(const std::vector<StoichiometricTerm>& orders,
                                                          const std::vector<StoichiometricTerm>& reactants) {
    std::vector<StoichiometricTerm> result;
    for (const auto& order : orders) {
      double coefficient = 0;
      for (const auto& term : reactants)
        if (term.species == order.species) coefficient = term.coefficient;
      if (order.coefficient != coefficient) result.push_back(order);
    }
    return result;
  }

  ThirdBody thirdBody() const {
    if (equation_.collider) return {0.0, {{*equation_.collider, 1.0}}};
    return {1.0, efficiencies_};
  }

  static double order(const std::vector<StoichiometricTerm>& reactants, const std::vector<StoichiometricTerm>& orders) {
    double sum = 0;
    for (const auto& term : reactants)
      if (std::ranges::find(orders, term.species, &StoichiometricTerm::species) == orders.end())
        sum += term.coefficient;
    for (const auto& term : orders) sum += term.coefficient;
    return sum;
  }

  // What one unit of A is in (m3/mol)^(order-1)/s.
  double unitOfA(double order) const { return std::pow(1e-6 / units_.quantity, order - 1); }

  Arrhenius arrhenius(std::span<const double> given, double order) const {
    Arrhenius rate{given[0] * unitOfA(order), given[1], given[2] * units_.activationTemperature};
    if (!std::isfinite(rate.A) || !std::isfinite(rate.activationTemperature))
      fail(entry_.line, fmt::format("A = {} and Ea = {} are beyond any rate constant", given[0], given[2]));
    return rate;
  }

  void setRates() {
    const double forward = order(reaction_.reactants, reaction_.orders);
    if (low_) {
      reaction_.type = Reaction::Type::Falloff;
      reaction_.rate = arrhenius(entry_.rate, forward);
      reaction_.lowPressureRate = arrhenius(*low_, forward + 1);
    } else if (high_) {
      reaction_.type = Reaction::Type::ChemicallyActivated;
      reaction_.lowPressureRate = arrhenius(entry_.rate, forward);
      reaction_.rate = arrhenius(*high_, forward - 1);
    } else if (!pressureLog_.empty()) {
      reaction_.type = Reaction::Type::PressureLog;
      setPressureLog(forward);
    } else if (!chebyshev_.empty()) {
      reaction_.type = Reaction::Type::Chebyshev;
      setChebyshev(forward);
    } else {
      reaction_.type = equation_.hasM ? Reaction::Type::ThreeBody : Reaction::Type::Elementary;
      reaction_.rate = arrhenius(entry_.rate, forward + (equation_.hasM ? 1 : 0));
    }
    setBroadening();
  }

  void setBroadening() {
    if (troe_) {
      const auto& t = *troe_;
      reaction_.troe = TroeBroadening{t[0], t[1], t[2], std::nullopt};
      if (t.size() == 4 && t[3] != 0)
        reaction_.troe->T2 = t[3];
      else if (t.size() == 4)
        warnings_.push_back(fmt::format("{}: reaction '{}': T2 of zero in TROE is taken as not given",
                                        source_.place(entry_.line), entry_.equation));
    }
    if (sri_) {
      const auto& s = *sri_;
      reaction_.sri = SriBroadening{s[0], s[1], s[2], s.size() == 5 ? s[3] : 1.0, s.size() == 5 ? s[4] : 0.0};
    }
  }

  void setPressureLog(double forward) {
    for (const auto& given : pressureLog_) {
      if (!(given[0] > 0)) fail(entry_.line, "'PLOG': expected a pressure above zero");
      reaction_.pressureRates.push_back(
          {given[0] * constants::oneAtmosphere, arrhenius(std::span(given).subspan(1), forward)});
    }
    std::ranges::stable_sort(reaction_.pressureRates, {}, &PressureRate::pressure);
  }

  void setChebyshev(double forward) {
    const auto T = chebyshevTemperatures_.value_or(Numbers{300, 2500});
    const auto p = chebyshevPressures_.value_or(Numbers{0.001, 100});
    if (!(T[0] > 0 && T[0] < T[1])) fail(entry_.line, "'TCHEB': expected two rising temperatures above zero");
    if (!(p[0] > 0 && p[0] < p[1])) fail(entry_.line, "'PCHEB': expected two rising pressures above zero");
    const auto isCount = [](double n) { return n >= 1 && n <= 100 && n == std::floor(n); };
    if (chebyshev_.size() < 2 || !isCount(chebyshev_[0]) || !isCount(chebyshev_[1]))
      fail(entry_.line, "'CHEB': expected the numbers of coefficients in temperature and in pressure first");
    ChebyshevRate rate;
    rate.minTemperature = T[0];
    rate.maxTemperature = T[1];
    rate.minPressure = p[0] * constants::oneAtmosphere;
    rate.maxPressure = p[1] * constants::oneAtmosphere;
    rate.numTemperature = static_cast<std::size_t>(chebyshev_[0]);
    rate.numPressure = static_cast<std::size_t>(chebyshev_[1]);
    rate.coefficients.assign(chebyshev_.begin() + 2, chebyshev_.end());
    if (rate.coefficients.size() != rate.numTemperature * rate.numPressure)
      fail(entry_.line, fmt::format("'CHEB': expected {} x {} coefficients, found {}", rate.numTemperature,
                                    rate.numPressure, rate.coefficients.size()));
    rate.coefficients[0] += std::log10(unitOfA(forward));
    reaction_.chebyshev = std::move(rate);
  }

  Reaction reversed() const {
    Reaction result = reaction_;
    std::swap(result.reactants, result.products);
    result.orders = ordersThatDiffer(reverseOrders_, result.reactants);
    result.rate = arrhenius(*reverse_, order(result.reactants, result.orders) + (equation_.hasM ? 1 : 0));
    return result;
  }

  const ChemkinSource& source_;
  const ChemkinReactionEntry& entry_;
  ChemkinUnits units_;
  const ChemkinEquationParser& species_;
  bool permissive_;
  std::vector<std::string>& warnings_;
  ChemkinEquation equation_;
  Reaction reaction_;
  std::optional<Numbers> low_, high_, reverse_, troe_, sri_, chebyshevTemperatures_, chebyshevPressures_;
  std::vector<Numbers> pressureLog_;
  Numbers chebyshev_;
  std::vector<StoichiometricTerm> forwardOrders_, reverseOrders_, efficiencies_;
};

}  // namespace

std::vector<Reaction> readChemkinReaction(const ChemkinSource& source, const ChemkinReactionEntry& entry,
                                          const ChemkinUnits& units, const ChemkinEquationParser& species,
                                          bool permissive, std::vector<std::string>& warnings) {
  return ReactionBuilder(source, entry, units, species, permissive, warnings).build();
}

}  // namespace lampblack::chemistry
