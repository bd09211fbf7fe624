#include "chemistry/mechanism/pressure_rate_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "chemistry/mechanism/rate_checks.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

std::string placeAndName(const std::string& file, const Reaction& reaction) {
  return fmt::format("{}:{}: reaction '{}'", reaction.file.empty() ? file : reaction.file, reaction.line,
                     reaction.equation);
}

bool sameTerms(std::vector<StoichiometricTerm> a, std::vector<StoichiometricTerm> b) {
  std::ranges::sort(a, {}, &StoichiometricTerm::species);
  std::ranges::sort(b, {}, &StoichiometricTerm::species);
  return std::ranges::equal(
      a, b, [](const auto& x, const auto& y) { return x.species == y.species && x.coefficient == y.coefficient; });
}

bool sameEquation(const Reaction& a, const Reaction& b) {
  return a.reversible == b.reversible && sameTerms(a.reactants, b.reactants) && sameTerms(a.products, b.products) &&
         sameTerms(a.orders, b.orders);
}

bool sameInAnyDirection(const Reaction& a, const Reaction& b) {
  return (sameTerms(a.reactants, b.reactants) && sameTerms(a.products, b.products)) ||
         ((a.reversible || b.reversible) && sameTerms(a.reactants, b.products) && sameTerms(a.products, b.reactants));
}

std::vector<double> pressures(const Reaction& reaction) {
  std::vector<double> result;
  for (const auto& rate : reaction.pressureRates)
    if (result.empty() || result.back() != rate.pressure) result.push_back(rate.pressure);
  return result;
}

bool isZeroRate(const PressureRate& rate) {
  return rate.rate.A == 0;
}

bool isTable(const Reaction& reaction) {
  return reaction.type == Reaction::Type::PressureLog && !reaction.pressureRates.empty();
}

// Reaction `r` and all that belong to it as the first of them; the others are left without rates, for their removal.
void join(const std::string& file, std::vector<Reaction>& reactions, std::size_t r, const std::string& problem,
          std::vector<std::string>& warnings) {
  std::vector<std::size_t> parts;
  for (std::size_t other = 0; other < reactions.size(); ++other)
    if (other == r || (reactions[r].duplicate && isTable(reactions[other]) && reactions[other].duplicate &&
                       sameEquation(reactions[other], reactions[r])))
      parts.push_back(other);
  if (parts.size() == 1)
    throw InputError(fmt::format(
        "{}: {}; rates that are positive only in a sum belong under one equation, or under several that are "
        "all marked as duplicates",
        placeAndName(file, reactions[r]), problem));
  auto& joined = reactions[parts[0]];
  const int line = reactions[parts[1]].line;
  for (const auto other : parts) {
    auto& part = reactions[other];
    if (&part == &joined) continue;
    if (pressures(part) != pressures(joined))
      throw InputError(
          fmt::format("{}: {}, and its duplicate at line {} cannot be added, for it has other pressures; "
                      "expected the same pressures in both, or one reaction with all of them",
                      placeAndName(file, reactions[r]), problem, (other == r ? joined : part).line));
    joined.pressureRates.insert(joined.pressureRates.end(), part.pressureRates.begin(), part.pressureRates.end());
    part.pressureRates.clear();
  }
  std::ranges::stable_sort(joined.pressureRates, {}, &PressureRate::pressure);
  if (const auto wrong = pressureRateProblem(joined.pressureRates); !wrong.empty())
    throw InputError(fmt::format("{}: with its duplicate at line {}, {}", placeAndName(file, joined), line, wrong));
  std::erase_if(joined.pressureRates, isZeroRate);
  warnings.push_back(
      fmt::format("{}: its rates and those of its duplicate at line {} are added pressure by pressure ({} reactions "
                  "become one), for they are positive only together",
                  placeAndName(file, joined), line, parts.size()));
  joined.duplicate = std::ranges::any_of(reactions, [&](const Reaction& other) {
    const bool removed = other.type == Reaction::Type::PressureLog && !isTable(other);
    return &other != &joined && !removed && other.duplicate && sameInAnyDirection(other, joined);
  });
}

}  // namespace

void joinPressureRates(const std::string& file, std::vector<Reaction>& reactions, std::vector<std::string>& warnings) {
  for (std::size_t r = 0; r < reactions.size(); ++r) {
    auto& reaction = reactions[r];
    if (!isTable(reaction)) continue;
    if (std::ranges::all_of(reaction.pressureRates, isZeroRate)) {
      warnings.push_back(fmt::format("{}: the rate constants are zero at all pressures, so is the rate",
                                     placeAndName(file, reaction)));
      reaction.type = Reaction::Type::Elementary;
      reaction.rate = {};
      reaction.pressureRates.clear();
    } else if (const auto problem = pressureRateProblem(reaction.pressureRates); !problem.empty()) {
      join(file, reactions, r, problem, warnings);
    }
  }
  std::erase_if(reactions, [](const Reaction& reaction) {
    return reaction.type == Reaction::Type::PressureLog && !isTable(reaction);
  });
}

}  // namespace lampblack::chemistry
