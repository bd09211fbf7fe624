#include "chemistry/kinetics/kinetics_linear_burke.hpp"

#include <algorithm>
#include <cmath>

#include "chemistry/kinetics/kinetics_powers.hpp"
#include "core/constants.hpp"

namespace lampblack::chemistry {

namespace {

// The rate constants of all groups, in the order of the tables and of their colliders.
std::vector<Reaction> groupRates(const Mechanism& mechanism, const KineticsTables& tables) {
  std::vector<Reaction> rates;
  for (const auto& one : tables.linearBurke)
    for (const auto& collider : mechanism.reaction(tables.original[one.reaction]).colliders)
      if (collider.ownRate) rates.push_back(collider.rate);
  return rates;
}

}  // namespace

LinearBurkeFactors::LinearBurkeFactors(const Mechanism& mechanism, const KineticsTables& tables)
    : LinearBurkeFactors(mechanism, tables, groupRates(mechanism, tables)) {}

LinearBurkeFactors::LinearBurkeFactors(const Mechanism& mechanism, const KineticsTables& tables,
                                       const std::vector<Reaction>& rates)
    : rates_(mechanism, rates), falloff_(rates_), pressureRates_(rates_) {
  std::vector<std::size_t> internal(rates.size());
  for (std::size_t i = 0; i < rates.size(); ++i) internal[rates_.original[i]] = i;
  std::size_t next = 0;
  for (const auto& table : tables.linearBurke) {
    auto& one = reactions_.emplace_back();
    one.reaction = table.reaction;
    for (const auto& collider : mechanism.reaction(tables.original[table.reaction]).colliders) {
      if (collider.species) {
        auto efficiency = collider.efficiency;
        efficiency.A = std::log(efficiency.A);
        one.named.push_back({*collider.species, collider.ownRate ? one.groups.size() : 0, efficiency});
      }
      if (!collider.ownRate) continue;
      auto& group = one.groups.emplace_back();
      group.internal = internal[next++];
      if (collider.species) group.named = one.named.size() - 1;
    }
    one.excess.assign(one.named.size(), 0.0);
  }
  findEntries();
  lnBase_.assign(rates.size(), 0.0);
  effective_.assign(rates_.falloff.reaction.size(), 0.0);
  values_.assign(reactions_.size(), 0.0);
}

// Every fall-off entry gets a set of its own, so that each has its own [M].
void LinearBurkeFactors::findEntries() {
  const auto assign = [this](const std::vector<std::size_t>& entries, Group::Kind kind) {
    for (auto& one : reactions_)
      for (auto& group : one.groups) {
        const auto found = std::ranges::find(entries, group.internal);
        if (found == entries.end()) continue;
        group.kind = kind;
        group.entry = static_cast<std::size_t>(found - entries.begin());
      }
  };
  assign(rates_.falloff.reaction, Group::Kind::Falloff);
  assign(rates_.pressureLog.reaction, Group::Kind::PressureLog);
  assign(rates_.chebyshev.reaction, Group::Kind::Chebyshev);
  for (std::size_t i = 0; i < rates_.falloff.set.size(); ++i) rates_.falloff.set[i] = i;
}

void LinearBurkeFactors::setTemperature(double T, double lnT, const double* lnBase) {
  if (reactions_.empty()) return;
  T_ = T;
  for (std::size_t i = 0; i < lnBase_.size(); ++i) lnBase_[i] = rates_.lnA[i] + rates_.b[i] * lnT - rates_.Ta[i] / T;
  falloff_.setTemperature(rates_, T, lnT, lnBase_.data());
  pressureRates_.setTemperature(rates_, T, lnT);
  for (auto& one : reactions_) {
    one.lnBase = lnBase[one.reaction];
    for (auto& named : one.named) {
      const auto& e = named.efficiency;
      named.value = std::exp(e.A + e.b * lnT - e.activationTemperature / T);
      named.byT = named.value * (e.b + e.activationTemperature / T) / T;
    }
  }
}

void LinearBurkeFactors::setAmounts(OneReaction& one, const double* c, double total) {
  for (auto& group : one.groups) group.amount = group.amountByT = 0;
  auto& others = one.groups[0];
  others.amount = total;
  for (const auto& named : one.named) {
    others.amount -= c[named.species];
    one.groups[named.group].amount += named.value * c[named.species];
    one.groups[named.group].amountByT += named.byT * c[named.species];
  }
  one.sum = 0;
  for (const auto& group : one.groups) one.sum += group.amount;
  one.empty = !(one.sum > smallestConcentration);
  if (one.empty) {
    for (auto& group : one.groups) group.amount = group.amountByT = 0;
    one.sum = others.amount = smallestConcentration;
  }
  for (auto& group : one.groups) {
    group.effective = one.sum / (group.named == none ? 1.0 : one.named[group.named].value);
    if (group.kind == Group::Kind::Falloff) effective_[group.entry] = group.effective;
  }
}

double LinearBurkeFactors::lnPressure(const Group& group) const {
  return std::log(constants::gasConstant * T_ * group.effective);
}

std::span<const double> LinearBurkeFactors::evaluate(const double* c, double total) {
  if (reactions_.empty()) return {};
  for (auto& one : reactions_) setAmounts(one, c, total);
  const auto falloff = falloff_.evaluate(rates_, effective_.data());
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    auto& one = reactions_[i];
    one.factor = 0;
    for (auto& group : one.groups) {
      const double lnBase = lnBase_[group.internal];
      if (group.kind == Group::Kind::Falloff)
        group.relative = falloff[group.entry];
      else if (group.kind == Group::Kind::PressureLog)
        group.relative = std::exp(pressureRates_.logarithmic(rates_, group.entry, lnPressure(group)) - lnBase);
      else
        group.relative = std::exp(pressureRates_.chebyshev(rates_, group.entry, lnPressure(group)) - lnBase);
      group.factor = group.relative * std::exp(lnBase - one.lnBase);
      one.factor += group.amount / one.sum * group.factor;
    }
    values_[i] = one.factor;
  }
  return values_;
}

LinearBurkeFactors::Slope LinearBurkeFactors::slope(const Group& group) const {
  if (group.kind == Group::Kind::Falloff) {
    const auto r = group.internal;
    return {falloff_.byM()[group.entry] * group.effective / group.relative,
            falloff_.byT()[group.entry] / group.relative + (rates_.b[r] + rates_.Ta[r] / T_) / T_};
  }
  const auto at = group.kind == Group::Kind::PressureLog
                      ? pressureRates_.logarithmicSlope(rates_, group.entry, lnPressure(group))
                      : pressureRates_.chebyshevSlope(rates_, group.entry, lnPressure(group));
  return {at.byLnP, at.byT + at.byLnP / T_};
}

// With s_r = d ln k_r/d ln(E/e_r): dk/dc_j = e_j/E (k_r - k + sum_r m_r/E k_r s_r), j of group r.
void LinearBurkeFactors::evaluateSlopes() {
  if (reactions_.empty()) return;
  falloff_.evaluateSlopes(rates_);
  for (auto& one : reactions_) {
    double sumByT = 0, amounts = 0;
    for (const auto& group : one.groups) sumByT += group.amountByT;
    one.byT = -one.factor * sumByT / one.sum;
    for (const auto& group : one.groups) {
      const auto by = slope(group);
      const double weight = group.amount / one.sum * group.factor;
      const double ownByT = group.named == none ? 0 : one.named[group.named].byT / one.named[group.named].value;
      one.byT +=
          group.amountByT / one.sum * group.factor + weight * (by.byT + by.byLnAmount * (sumByT / one.sum - ownByT));
      amounts += weight * by.byLnAmount;
    }
    const auto byConcentration = [&](double efficiency, const Group& group) {
      return one.empty ? 0.0 : efficiency / one.sum * (group.factor - one.factor + amounts);
    };
    one.byOther = byConcentration(1, one.groups[0]);
    for (std::size_t j = 0; j < one.named.size(); ++j)
      one.excess[j] = byConcentration(one.named[j].value, one.groups[one.named[j].group]) - one.byOther;
  }
}

}  // namespace lampblack::chemistry
