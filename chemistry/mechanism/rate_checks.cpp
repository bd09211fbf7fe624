#include "chemistry/mechanism/rate_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace lampblack::chemistry {

namespace {

// ln |k|
double logarithm(const Arrhenius& rate, double T) {
  return std::log(std::abs(rate.A)) + rate.b * std::log(T) - rate.activationTemperature / T;
}

// Whether the rates of one pressure have a positive sum.
bool positiveSum(std::span<const PressureRate> rates, double T) {
  double largest = -HUGE_VAL, sum = 0;
  for (const auto& entry : rates) largest = std::max(largest, logarithm(entry.rate, T));
  for (const auto& entry : rates) sum += std::copysign(std::exp(logarithm(entry.rate, T) - largest), entry.rate.A);
  return sum > 0;
}

}  // namespace

std::string rateProblem(const Reaction& reaction) {
  using Type = Reaction::Type;
  if (reaction.type == Type::Falloff || reaction.type == Type::ChemicallyActivated) {
    const double low = reaction.lowPressureRate.A, high = reaction.rate.A;
    if (low == 0 || high == 0 || (low > 0) != (high > 0))
      return "expected 'A' of both limits to be other than zero and of one sign";
  }
  if (const auto& sri = reaction.sri; sri && (sri->a < 0 || sri->c < 0 || !(sri->a > 0 || sri->c > 0) || !(sri->d > 0)))
    return "SRI: expected a and c of zero or more, not both zero, and a positive d";
  if (const auto& masel = reaction.blowersMasel;
      masel && !(reaction.rate.activationTemperature >= 0 && std::isfinite(masel->bondEnergy) &&
                 masel->bondEnergy > reaction.rate.activationTemperature))
    return "expected 'Ea0' of zero or more and a bond energy 'w' above it";
  return {};
}

std::string pressureRateProblem(std::span<const PressureRate> rates) {
  for (std::size_t first = 0, next = 0; first < rates.size(); first = next) {
    for (next = first; next < rates.size() && rates[next].pressure == rates[first].pressure;) ++next;
    for (const double T : {300.0, 500.0, 1000.0, 2000.0, 5000.0, 10000.0})
      if (!positiveSum(rates.subspan(first, next - first), T))
        return fmt::format("the rate constants of {:.6g} Pa add up to zero or less at {} K; expected a positive sum",
                           rates[first].pressure, T);
  }
  return {};
}

}  // namespace lampblack::chemistry
