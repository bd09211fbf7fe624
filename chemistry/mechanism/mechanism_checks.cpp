#include "chemistry/mechanism/mechanism_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/mechanism/nasa_polynomials.hpp"
#include "chemistry/mechanism/pressure_rate_sums.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

struct Values {
  double cp = 0, h = 0, s = 0;  // of R, RT and R
};

// The texts of what jumps from below to above a bound of two ranges; empty if all meet.
std::string jumps(const Values& below, const Values& above) {
  std::string text;
  const auto compare = [&](const char* name, double low, double high, double limit) {
    if (!(std::abs(high - low) > limit)) return;
    text += fmt::format("{}{} by {:.3g} ({:.6g} below, {:.6g} above)", text.empty() ? "" : ", ", name, high - low, low,
                        high);
  };
  compare("cp/R", below.cp, above.cp, 0.01 * (std::abs(below.cp) + 1e-4));
  compare("h/RT", below.h, above.h, 1e-3 * std::abs(below.cp));
  compare("s/R", below.s, above.s, 1e-3 * std::abs(std::abs(below.s) + below.cp));
  return text;
}

Values valuesAt(const std::array<double, 7>& a, double T) {
  return {cpOverR(a, T), enthalpyOverRT(a, T), entropyOverR(a, T, std::log(T))};
}

Values valuesAt(const std::array<double, 9>& a, double T) {
  return {cpOverR(a, T), enthalpyOverRT(a, T, std::log(T)), entropyOverR(a, T, std::log(T))};
}

}  // namespace

void checkBalances(const std::string& file, std::span<const Element> elements, std::span<const Species> species,
                   std::span<const Reaction> reactions) {
  for (const auto& reaction : reactions)
    for (std::size_t i = 0; i < elements.size(); ++i) {
      double left = 0, right = 0;
      for (const auto& t : reaction.reactants) left += t.coefficient * species[t.species].atoms[i];
      for (const auto& t : reaction.products) right += t.coefficient * species[t.species].atoms[i];
      // Lumped reactions carry decimal coefficients with a few digits.
      if (std::abs(left - right) > 1e-4 * std::max({1.0, left, right}))
        throw InputError(
            fmt::format("{}:{}: reaction '{}' does not balance: {} atoms of {} on the left, {} on the right",
                        reaction.file.empty() ? file : reaction.file, reaction.line, reaction.equation, left,
                        elements[i].name, right));
    }
}

namespace {

// A fall-off curve whose centre vanishes brings its reaction to nothing: "TROE/ 0.5 0 0/" for a centre of 0.5.
bool centreIsZero(const TroeBroadening& troe) {
  const auto term = [](double T, double by) { return by == 0 ? 0.0 : std::exp(-T / by); };
  for (const double T : {300.0, 1000.0, 2500.0})
    if ((1 - troe.A) * term(T, troe.T3) + troe.A * term(T, troe.T1) + (troe.T2 ? std::exp(-*troe.T2 / T) : 0) > 1e-30)
      return false;
  return true;
}

void warnOfZeroCentres(const std::string& file, std::span<const Reaction> reactions,
                       std::vector<std::string>& warnings) {
  for (const auto& reaction : reactions)
    if (reaction.troe && centreIsZero(*reaction.troe))
      warnings.push_back(
          fmt::format("{}:{}: reaction '{}': with T3 = {:g} and T1 = {:g} the centre of its fall-off is zero at all "
                      "temperatures, and so is its rate; a constant centre A has a T3 next to zero (1e-30) and a large "
                      "T1 (1e30)",
                      reaction.file.empty() ? file : reaction.file, reaction.line, reaction.equation, reaction.troe->T3,
                      reaction.troe->T1));
}

}  // namespace

void settleReactions(const std::string& file, std::span<const Species> species, std::vector<Reaction>& reactions,
                     const MechanismRules& rules, std::vector<std::string>& warnings) {
  if (rules.permissive) markDuplicates(file, species, reactions, warnings);
  joinPressureRates(file, reactions, warnings);
  warnOfZeroCentres(file, reactions, warnings);
}

void checkThermo(const std::string& file, std::span<const Species> species, std::vector<std::string>& warnings) {
  for (const auto& s : species) {
    const auto warn = [&](const Values& below, const Values& above, double T) {
      if (const auto text = jumps(below, above); !text.empty())
        warnings.push_back(fmt::format("{}:{}: species '{}': the thermodynamic data jump at {:.6g} K: {}",
                                       s.file.empty() ? file : s.file, s.line, s.name, T, text));
    };
    if (s.nasa9) {
      for (std::size_t i = 0; i + 1 < s.nasa9->ranges.size(); ++i) {
        const double T = s.nasa9->temperatures[i + 1];
        warn(valuesAt(s.nasa9->ranges[i], T), valuesAt(s.nasa9->ranges[i + 1], T), T);
      }
    } else if (s.thermo.midTemperature < s.thermo.maxTemperature) {
      const double T = s.thermo.midTemperature;
      warn(valuesAt(s.thermo.low, T), valuesAt(s.thermo.high, T), T);
    }
  }
}

namespace {

// What no molecule of so many atoms has; empty if nothing. A diameter of less than an Angstrom is one in another unit.
std::string oddityOf(const TransportData& data, double atoms) {
  if (data.diameter < 1e-10)
    return fmt::format("a diameter of {:.3g} Angstrom, smaller than any atom's; is it in another unit?",
                       1e10 * data.diameter);
  const auto shaped = [&](const char* shape) {
    return fmt::format("the geometry '{}', but the species has {:g} atom(s)", shape, atoms);
  };
  if (data.shape == MoleculeShape::Atom && atoms > 1) return shaped("atom");
  if (data.shape == MoleculeShape::Linear && atoms < 2) return shaped("linear");
  if (data.shape == MoleculeShape::Nonlinear && atoms < 3) return shaped("nonlinear");
  return {};
}

}  // namespace

void checkTransport(const std::string& file, std::span<const Element> elements, std::span<const Species> species,
                    std::vector<std::string>& warnings) {
  for (const auto& s : species) {
    if (!s.transport) continue;
    double atoms = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) atoms += elements[i].name == "E" ? 0 : s.atoms[i];
    if (atoms == 0) continue;  // electrons
    if (const auto oddity = oddityOf(*s.transport, atoms); !oddity.empty())
      warnings.push_back(fmt::format("{}:{}: species '{}': the transport data are taken as they are, with {}",
                                     s.file.empty() ? file : s.file, s.line, s.name, oddity));
  }
}

}  // namespace lampblack::chemistry
