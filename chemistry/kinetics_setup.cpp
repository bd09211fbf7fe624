// Kinetics' construction: flat tables from the list of reactions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/kinetics.hpp"
#include "core/errors.hpp"

namespace lampblack {

namespace {

// ln k of a rate constant of zero: its exponential vanishes beside any other rate.
constexpr double kLogOfZero = -1e4;

double lnMagnitude(double A) {
  return A == 0 ? kLogOfZero : std::log(std::abs(A));
}

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

void requireSupported(const Mechanism& mechanism, const Reaction& reaction) {
  const bool known = reaction.type == Reaction::Type::Elementary || reaction.type == Reaction::Type::ThreeBody ||
                     (reaction.type == Reaction::Type::Falloff && !reaction.sri);
  if (!known)
    throw InputError(fmt::format("{}:{}: reaction '{}': rates of this type are not computed yet", mechanism.fileName(),
                                 reaction.line, reaction.equation));
}

}  // namespace

Kinetics::Kinetics(const Mechanism& mechanism)
    : numSpecies_(mechanism.numSpecies()), numReactions_(mechanism.numReactions()), table_(mechanism.allSpecies()) {
  for (const auto& reaction : mechanism.reactions()) requireSupported(mechanism, reaction);
  orderReactions(mechanism);
  setRates(mechanism);
  setSlots(mechanism);
  setThirdBodies(mechanism);
  setProductionTable(mechanism);
  setJacobianTerms();
  sizeWorkspace();
}

void Kinetics::orderReactions(const Mechanism& mechanism) {
  for (const bool reversible : {true, false})
    for (std::size_t r = 0; r < numReactions_; ++r)
      if (mechanism.reaction(r).reversible == reversible) original_.push_back(r);
  for (const auto& reaction : mechanism.reactions()) numReversible_ += reaction.reversible ? 1 : 0;
}

void Kinetics::setRates(const Mechanism& mechanism) {
  for (const auto r : original_) {
    const auto& rate = mechanism.reaction(r).rate;
    lnA_.push_back(lnMagnitude(rate.A));
    b_.push_back(rate.b);
    Ta_.push_back(rate.activationTemperature);
    sign_.push_back(rate.A < 0 ? -1.0 : 1.0);
    anyNegative_ = anyNegative_ || rate.A < 0;
  }
}

void Kinetics::setSlots(const Mechanism& mechanism) {
  const auto none = static_cast<std::int32_t>(numSpecies_);
  for (std::size_t i = 0; i < numReactions_; ++i) {
    const auto& reaction = mechanism.reaction(original_[i]);
    std::array<std::int32_t, 3> left{none, none, none}, right{none, none, none};
    // The products of an irreversible reaction are no concentrations of any rate.
    const bool fits = fillSlots(reaction.reactants, left) &&
                      (!reaction.reversible || fillSlots(reaction.products, right)) && reaction.orders.empty();
    if (!fits) {
      left = right = {none, none, none};
      GeneralReaction general{i, reaction.reactants, reaction.products};
      for (auto& term : general.forwardOrders)
        for (const auto& order : reaction.orders)
          if (order.species == term.species) term.coefficient = order.coefficient;
      if (!reaction.reversible) general.reverseOrders.clear();
      general_.push_back(std::move(general));
    }
    for (std::size_t s = 0; s < 3; ++s) {
      reactant_[s].push_back(left[s]);
      product_[s].push_back(right[s]);
    }
    netTerms_.push_back(netStoichiometry(reaction));
    double sum = 0;
    for (const auto& t : netTerms_.back()) sum += t.coefficient;
    nuSum_.push_back(sum);
  }
}

std::size_t Kinetics::thirdBodySet(const ThirdBody& body) {
  ThirdBodySet set;
  set.base = body.defaultEfficiency;
  set.efficiencies.assign(numSpecies_, set.base);
  for (const auto& e : body.efficiencies) set.efficiencies[e.species] = e.coefficient;
  for (std::size_t i = 0; i < sets_.size(); ++i)
    if (sets_[i].base == set.base && sets_[i].efficiencies == set.efficiencies) return i;
  for (std::size_t k = 0; k < numSpecies_; ++k)
    if (set.efficiencies[k] != set.base) set.excess.push_back({k, set.efficiencies[k] - set.base});
  sets_.push_back(std::move(set));
  return sets_.size() - 1;
}

void Kinetics::setThirdBodies(const Mechanism& mechanism) {
  for (std::size_t i = 0; i < numReactions_; ++i) {
    const auto& reaction = mechanism.reaction(original_[i]);
    if (reaction.type == Reaction::Type::Elementary) continue;
    const auto set = thirdBodySet(*reaction.thirdBody);
    if (reaction.type == Reaction::Type::ThreeBody) {
      threeBody_.push_back({i, set});
      continue;
    }
    auto& f = falloff_;
    f.reaction.push_back(i);
    f.set.push_back(set);
    f.lnA.push_back(lnMagnitude(reaction.lowPressureRate.A));
    f.b.push_back(reaction.lowPressureRate.b);
    f.Ta.push_back(reaction.lowPressureRate.activationTemperature);
    const auto troe = reaction.troe.value_or(TroeBroadening{1.0, 0.0, 0.0, std::nullopt});
    const bool lindemann = !reaction.troe;
    const bool hasT3 = troe.T3 != 0, hasT1 = troe.T1 != 0 || lindemann, hasT2 = troe.T2.value_or(0) != 0;
    f.w3.push_back(hasT3 ? 1.0 - troe.A : 0.0);
    f.w1.push_back(hasT1 ? troe.A : 0.0);
    f.w2.push_back(hasT2 ? 1.0 : 0.0);
    f.inverseT3.push_back(hasT3 ? 1.0 / troe.T3 : 0.0);
    f.inverseT1.push_back(troe.T1 != 0 ? 1.0 / troe.T1 : 0.0);
    f.T2.push_back(hasT2 ? *troe.T2 : 0.0);
  }
}

void Kinetics::setProductionTable(const Mechanism& mechanism) {
  const auto none = static_cast<std::int32_t>(numReactions_);
  rows_.push_back(0);
  for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) {
    for (std::size_t i = 0; i < numReactions_; ++i)
      for (const auto& term : netTerms_[i])
        if (term.species == k) {
          rowReaction_.push_back(static_cast<std::int32_t>(i));
          rowNu_.push_back(term.coefficient);
        }
    while (rowReaction_.size() % 4 != 0) {
      rowReaction_.push_back(none);
      rowNu_.push_back(0.0);
    }
    rows_.push_back(rowReaction_.size());
  }
}

void Kinetics::setJacobianTerms() {
  const auto none = static_cast<std::int32_t>(numSpecies_);
  const auto addTerms = [&](std::size_t i, std::size_t column, std::size_t source) {
    for (const auto& term : netTerms_[i])
      jacobianTerms_.push_back({static_cast<std::uint32_t>(term.species), static_cast<std::uint32_t>(column),
                                static_cast<std::uint32_t>(source), term.coefficient});
  };
  for (std::size_t s = 0; s < 6; ++s) {
    const auto& slot = s < 3 ? reactant_[s] : product_[s - 3];
    const std::size_t count = s < 3 ? numReactions_ : numReversible_;
    for (std::size_t i = 0; i < count; ++i)
      if (slot[i] != none) addTerms(i, static_cast<std::size_t>(slot[i]), s * numReactions_ + i);
  }
  std::size_t source = 6 * numReactions_;
  for (const auto& general : general_) {
    for (const auto& term : general.forwardOrders) addTerms(general.reaction, term.species, source++);
    for (const auto& term : general.reverseOrders) addTerms(general.reaction, term.species, source++);
  }
  derivatives_.assign(source, 0.0);
}

void Kinetics::sizeWorkspace() {
  const std::size_t n = numReactions_, nf = falloff_.reaction.size();
  lnkf_.assign(n, 0.0);
  kf_.assign(n, 0.0);
  lnkr_.assign(numReversible_, 0.0);
  kr_.assign(n, 0.0);
  gibbs_.assign(numSpecies_ + 1, 0.0);
  enthalpy_.assign(numSpecies_ + 1, 0.0);
  lowOverHigh_.assign(nf, 0.0);
  lnFcent_.assign(nf, 0.0);
  troeTerms_.assign(3 * nf, 0.0);
  falloffWork_.assign(2 * nf, 0.0);
  c_.assign(numSpecies_ + 1, 1.0);
  M_.assign(sets_.size(), 0.0);
  factor_.assign(n, 1.0);
  forward_.assign(n, 0.0);
  reverse_.assign(n, 0.0);
  progress_.assign(n + 1, 0.0);
  factorByT_.assign(n, 0.0);
  setColumn_.assign(numSpecies_, 0.0);
}

}  // namespace lampblack
