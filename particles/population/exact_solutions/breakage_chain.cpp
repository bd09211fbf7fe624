#include "particles/population/exact_solutions/breakage_chain.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::particles::exact {

std::vector<double> breakageChain(int pieces, double exponent, double tau) {
  if (!(tau > 0)) return {1.0};
  if (exponent == 0) {  // a Poisson process
    std::vector<double> result;
    const auto generations = static_cast<int>(pieces * tau + 15 * std::sqrt(pieces * tau) + 60);
    for (int k = 0; k <= generations; ++k) {
      result.push_back(std::exp(k * std::log(pieces * tau) - tau - std::lgamma(k + 1.0)));
    }
    return result;
  }
  // At rate B_0 for all the number would grow by (1 + (pieces - 1)) per event: its Poisson weights are centred at
  // pieces * tau for p = 0, at tau for steep rates.
  const double centre = pieces * tau;
  if (!(centre < 1e7)) {
    throw InputError("the exact solution of breakage into equal pieces is for times below 1e7 / (pieces B(v0))");
  }
  const auto events = static_cast<std::size_t>(centre + 15 * std::sqrt(centre) + 60);
  // Poisson weights by recurrence from the mode, then made to add up to one.
  std::vector<double> weight(events + 1, 0.0);
  const auto mode = static_cast<std::size_t>(tau);
  weight[mode] = 1;
  for (std::size_t m = mode; m > 0; --m) weight[m - 1] = weight[m] * static_cast<double>(m) / tau;
  for (std::size_t m = mode; m < events; ++m) weight[m + 1] = weight[m] * tau / static_cast<double>(m + 1);
  double sum = 0;
  for (const double w : weight) sum += w;

  // state[k] = probability of generation k after m events, times pieces^k.
  std::vector<double> state{1.0}, result{weight[0]}, breaks{1.0};
  for (std::size_t m = 1; m <= events; ++m) {
    const double last = state.back() * breaks.back() * pieces;
    double total = 0;
    for (const double x : state) total += x;
    if (last > 1e-25 * total) {
      state.push_back(0.0);
      result.push_back(0.0);
      breaks.push_back(std::pow(static_cast<double>(pieces), -exponent * static_cast<double>(breaks.size())));
    }
    for (std::size_t k = state.size() - 1; k > 0; --k) {
      state[k] = (1 - breaks[k]) * state[k] + breaks[k - 1] * pieces * state[k - 1];
    }
    state[0] = 0;  // B_0 / B_0 = 1
    if (weight[m] > 0) {
      for (std::size_t k = 0; k < state.size(); ++k) result[k] += weight[m] * state[k];
    }
  }
  for (double& number : result) {
    number /= sum;
    if (!std::isfinite(number)) throw InputError("the exact solution of breakage into equal pieces has overflowed");
  }
  return result;
}

}  // namespace lampblack::particles::exact
