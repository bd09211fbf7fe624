#include "chemistry/kinetics/kinetics_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

// The species of one side, each as often as its coefficient says; empty if that is not possible in three slots.
bool fillSlots(const std::vector<StoichiometricTerm>& terms, std::array<std::int32_t, 3>& slots) {
  std::size_t used = 0;
  for (const auto& term : terms) {
    if (term.coefficient != std::floor(term.coefficient) || term.coefficient > 3) return false;
    for (int i = 0; i < static_cast<int>(term.coefficient); ++i) {
      if (used == 3) return false;
      slots[used++] = static_cast<std::int32_t>(term.species);
    }
  }
  return true;
}

std::vector<StoichiometricTerm> netStoichiometry(const Reaction& reaction) {
  std::vector<StoichiometricTerm> net;
  const auto add = [&](std::size_t species, double coefficient) {
    for (auto& term : net)
      if (term.species == species) {
        term.coefficient += coefficient;
        return;
      }
    net.push_back({species, coefficient});
  };
  for (const auto& t : reaction.reactants) add(t.species, -t.coefficient);
  for (const auto& t : reaction.products) add(t.species, t.coefficient);
  std::erase_if(net, [](const auto& t) { return t.coefficient == 0; });
  return net;
}

// The coefficients of the reactants, replaced or joined by the orders given; orders of zero are left out.
std::vector<StoichiometricTerm> forwardOrders(const Mechanism& mechanism, const Reaction& reaction) {
  if (reaction.reversible && !reaction.orders.empty())
    throw InputError(fmt::format("{}: reaction '{}': orders are for irreversible reactions only; expected '=>'",
                                 mechanism.placeOf(reaction), reaction.equation));
  auto orders = reaction.reactants;
  for (const auto& given : reaction.orders) {
    const auto same =
        std::find_if(orders.begin(), orders.end(), [&](const auto& t) { return t.species == given.species; });
    if (same != orders.end())
      same->coefficient = given.coefficient;
    else
      orders.push_back(given);
  }
  std::erase_if(orders, [](const auto& t) { return t.coefficient == 0; });
  return orders;
}

}  // namespace

KineticsTables::KineticsTables(const Mechanism& mechanism) : KineticsTables(mechanism, mechanism.reactions()) {}

KineticsTables::KineticsTables(const Mechanism& mechanism, std::span<const Reaction> reactions)
    : numSpecies(mechanism.numSpecies()), numReactions(reactions.size()) {
  orderReactions(mechanism, reactions);
  setRates(mechanism, reactions);
  setSlots(mechanism, reactions);
  setFactors(mechanism, reactions);
  setProductionTable();
}

void KineticsTables::orderReactions(const Mechanism& mechanism, std::span<const Reaction> reactions) {
  const auto isConstant = [&](const Reaction& reaction) {
    const auto rate = baseRate(mechanism, reaction);
    return rate.A > 0 && rate.b == 0 && rate.activationTemperature == 0 && !reaction.blowersMasel;
  };
  const auto append = [&](bool reversible, bool constant) {
    for (std::size_t r = 0; r < numReactions; ++r) {
      const auto& reaction = reactions[r];
      if (reaction.reversible == reversible && isConstant(reaction) == constant) original.push_back(r);
    }
    return original.size();
  };
  constantBegin = append(true, false);
  numReversible = append(true, true);
  constantEnd = append(false, true);
  append(false, false);
}

void KineticsTables::setRates(const Mechanism& mechanism, std::span<const Reaction> reactions) {
  for (const auto r : original) {
    const auto& reaction = reactions[r];
    const auto rate = baseRate(mechanism, reaction);
    lnA.push_back(lnMagnitude(rate.A));
    b.push_back(rate.b);
    Ta.push_back(rate.activationTemperature);
    sign.push_back(rate.A < 0 ? -1.0 : 1.0);
    anyNegative = anyNegative || rate.A < 0;
  }
}

void KineticsTables::setSlots(const Mechanism& mechanism, std::span<const Reaction> reactions) {
  const auto none = static_cast<std::int32_t>(numSpecies);
  for (std::size_t i = 0; i < numReactions; ++i) {
    const auto& reaction = reactions[original[i]];
    std::array<std::int32_t, 3> left{none, none, none}, right{none, none, none};
    // The products of an irreversible reaction are no concentrations of any rate.
    const bool fits = fillSlots(reaction.reactants, left) &&
                      (!reaction.reversible || fillSlots(reaction.products, right)) && reaction.orders.empty();
    if (!fits) {
      left = right = {none, none, none};
      GeneralReaction entry{i, forwardOrders(mechanism, reaction), reaction.products};
      if (!reaction.reversible) entry.reverseOrders.clear();
      general.push_back(std::move(entry));
    }
    for (std::size_t s = 0; s < 3; ++s) {
      reactant[s].push_back(left[s]);
      product[s].push_back(right[s]);
    }
    netTerms.push_back(netStoichiometry(reaction));
    double sum = 0;
    for (const auto& t : netTerms.back()) sum += t.coefficient;
    nuSum.push_back(sum);
  }
}

std::size_t KineticsTables::thirdBodySet(const ThirdBody& body) {
  ThirdBodySet set;
  set.base = body.defaultEfficiency;
  set.efficiencies.assign(numSpecies, set.base);
  for (const auto& e : body.efficiencies) set.efficiencies[e.species] = e.coefficient;
  for (std::size_t i = 0; i < sets.size(); ++i)
    if (sets[i].base == set.base && sets[i].efficiencies == set.efficiencies) return i;
  for (std::size_t k = 0; k < numSpecies; ++k)
    if (set.efficiencies[k] != set.base) set.excess.push_back({k, set.efficiencies[k] - set.base});
  sets.push_back(std::move(set));
  return sets.size() - 1;
}

void KineticsTables::setFactors(const Mechanism& mechanism, std::span<const Reaction> reactions) {
  pressureLog.points.push_back(0);
  pressureLog.rates.push_back(0);
  for (std::size_t i = 0; i < numReactions; ++i) {
    const auto& reaction = reactions[original[i]];
    if (reaction.blowersMasel)
      enthalpyDependent.push_back({i, reaction.rate.activationTemperature, reaction.blowersMasel->bondEnergy});
    switch (reaction.type) {
      case Reaction::Type::Elementary:
        break;
      case Reaction::Type::ThreeBody:
        threeBody.push_back({i, thirdBodySet(*reaction.thirdBody)});
        break;
      case Reaction::Type::Falloff:
      case Reaction::Type::ChemicallyActivated:
        addFalloff(i, mechanism, reaction);
        break;
      case Reaction::Type::PressureLog:
        addPressureLog(i, mechanism, reaction);
        break;
      case Reaction::Type::Chebyshev:
        addChebyshev(i, *reaction.chebyshev);
        break;
      case Reaction::Type::LinearBurke:
        addLinearBurke(i, reaction);
        break;
    }
  }
}

void KineticsTables::setProductionTable() {
  std::vector<std::vector<std::size_t>> sources(numSpecies);
  for (std::size_t i = 0; i < numReactions; ++i)
    for (const auto& term : netTerms[i]) {
      const double count = std::abs(term.coefficient);
      if (count != std::floor(count) || count > 4)
        decimalTerms.push_back({term.species, i, term.coefficient});
      else
        sources[term.species].insert(sources[term.species].end(), static_cast<std::size_t>(count),
                                     term.coefficient > 0 ? i : numReactions + i);
    }
  rows.push_back(0);
  for (const auto& row : sources) {
    for (const auto source : row) rowSource.push_back(static_cast<std::int32_t>(source));
    while (rowSource.size() % 4 != 0) rowSource.push_back(static_cast<std::int32_t>(2 * numReactions));
    rows.push_back(rowSource.size());
  }
}

}  // namespace lampblack::chemistry
