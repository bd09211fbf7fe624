#include "chemistry/transport/multicomponent_pairs.hpp"

#include <array>
#include <cmath>

#include "chemistry/transport/fit_points.hpp"
#include "chemistry/transport/polynomial_fit.hpp"

namespace lampblack::chemistry {

MulticomponentPairs::MulticomponentPairs(const PureGas& gas, std::span<const double> weights)
    : n_(weights.size()),
      ld_(paddedToLanes(n_)),
      conductance_(n_),
      thermal_(n_),
      exchange_(n_),
      energy_(n_),
      own_(terms * ld_, 0.0) {
  const FitPoints points;
  const PolynomialFit fit(points.s, terms);
  std::array<double, FitPoints::count> resistance, values;
  std::array<double, terms> a;
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t j = 0; j <= k; ++j) {
      const double mass = weights[j] + weights[k];
      const auto set = [&](Polynomials& polynomials, auto&& factor) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = resistance[i] * factor(points.T[i]);
        fit.solve(values, a);
        polynomials.set(j, k, a);
      };
      for (std::size_t i = 0; i < resistance.size(); ++i) resistance[i] = gas.resistance(j, k, points.T[i]);
      set(exchange_, [&](double T) { return gas.ratioA(j, k, T) / mass; });
      set(energy_, [&](double T) { return (13.75 - 3.0 * gas.ratioB(j, k, T)) / (mass * mass); });
      if (j != k) {
        set(thermal_, [&](double T) { return (1.2 * gas.ratioC(j, k, T) - 1.0) / mass; });
        set(conductance_, [](double) { return 1.0; });
      } else {
        fit.solve(resistance, a);
        for (std::size_t m = 0; m < terms; ++m) own_[m * ld_ + k] = a[m];
      }
    }
}

void MulticomponentPairs::fill(double T, Matrices& matrices) {
  const auto powers = fitPowers<terms>(T, 1.0 / (T * std::sqrt(T)));
  conductance_.values(powers.data(), matrices.conductance);
  thermal_.values(powers.data(), matrices.thermal);
  exchange_.values(powers.data(), matrices.exchange);
  energy_.values(powers.data(), matrices.energy);
  matrices.own.assign(ld_, 0.0);
  for (std::size_t m = 0; m < terms; ++m)
    for (std::size_t k = 0; k < ld_; ++k) matrices.own[k] += powers[m] * own_[m * ld_ + k];
}

}  // namespace lampblack::chemistry
