// Construction of Transport: least squares in ln T replace kinetic theory.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "chemistry/transport/fit_points.hpp"
#include "chemistry/transport/polynomial_fit.hpp"
#include "chemistry/transport/pure_gas.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "numerics/lanes.hpp"

namespace lampblack::chemistry {

namespace {

std::vector<double> inverseLewisNumbers(const Mechanism& mechanism, const TransportOptions& options) {
  std::vector<double> result(mechanism.numSpecies(), 1.0);
  if (options.diffusion != DiffusionModel::ConstantLewis) return result;
  if (options.lewisNumbers.size() != result.size())
    throw InputError(fmt::format("{} Lewis numbers; expected one for each of the {} species of {}",
                                 options.lewisNumbers.size(), result.size(), mechanism.fileName()));
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (!(options.lewisNumbers[k] > 0 && std::isfinite(options.lewisNumbers[k])))
      throw InputError(fmt::format("the Lewis number of species '{}' is {}; expected a positive number",
                                   mechanism.speciesName(k), options.lewisNumbers[k]));
    result[k] = 1.0 / options.lewisNumbers[k];
  }
  return result;
}

std::optional<SutherlandLaw> checkedSutherland(const TransportOptions& options) {
  if (!options.sutherland) return std::nullopt;
  const SutherlandLaw& law = *options.sutherland;
  if (options.diffusion == DiffusionModel::MixtureAveraged)
    throw InputError("Sutherland's law knows no mixture-averaged diffusion; expected Lewis numbers");
  for (const auto& [name, value] : {std::pair{"viscosity", law.viscosity},
                                    {"temperature", law.temperature},
                                    {"constant", law.constant},
                                    {"Prandtl number", law.prandtl}})
    if (!(value > 0 && std::isfinite(value)))
      throw InputError(fmt::format("the {} of Sutherland's law is {}; expected a positive number", name, value));
  return options.sutherland;
}

}  // namespace

Transport::Transport(const Mechanism& mechanism, const TransportOptions& options)
    : n_(mechanism.numSpecies()),
      ld_(paddedToLanes(n_)),
      model_(options.diffusion),
      inverseLewis_(inverseLewisNumbers(mechanism, options)),
      sutherland_(checkedSutherland(options)),
      thermo_(mechanism.allSpecies()),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()),
      resistance_(n_),
      thermal_(n_),
      wilke_(n_ * ld_, 0.0) {
  for (const double W : weights_) {
    gasConstants_.push_back(constants::gasConstant / W);
    roots_.push_back(std::sqrt(W));
    quarterRoots_.push_back(1.0 / std::sqrt(std::sqrt(W)));
  }
  // Behind the last species come finite numbers to compute with, which no result contains.
  for (auto* ofSpecies : {&gasConstants_, &roots_, &quarterRoots_}) ofSpecies->resize(ld_, 1.0);
  for (auto* work : {&cp_, &x_, &root_, &u_, &a_, &b_, &c_, &sum0_, &sum1_, &sum2_}) work->assign(ld_, 0.0);
  wilkeSum_.assign(ld_, 1.0);
  const PureGas gas(mechanism, options.integrals);
  fitPure(gas);
  fitPairs(gas);
}

void Transport::fitPure(const PureGas& gas) {
  const FitPoints points;
  const PolynomialFit fit(points.s, kPureTerms);
  std::array<double, FitPoints::count> values;
  std::array<double, kPureTerms> a;
  const auto store = [&](std::vector<double>& table, std::size_t k, auto&& function) {
    std::transform(points.T.begin(), points.T.end(), values.begin(), function);
    fit.solve(values, a);
    for (std::size_t m = 0; m < kPureTerms; ++m) table[m * ld_ + k] = a[m];
  };
  viscosity_.assign(kPureTerms * ld_, 0.0);
  std::fill_n(viscosity_.begin(), ld_, 1.0);
  rigid_ = vibrating_ = viscosity_;
  for (std::size_t k = 0; k < n_; ++k) {
    store(viscosity_, k, [&](double T) { return std::sqrt(gas.viscosity(k, T) / std::sqrt(T)); });
    store(rigid_, k, [&](double T) { return gas.euckenFactors(k, T).rigid; });
    store(vibrating_, k, [&](double T) { return gas.euckenFactors(k, T).vibrating; });
  }
}

void Transport::fitPairs(const PureGas& gas) {
  const FitPoints points;
  const PolynomialFit resistances(points.s, kPairTerms), thermal(points.s, kThermalTerms);
  std::array<double, FitPoints::count> values;
  std::array<double, kPairTerms> a;
  std::array<double, kThermalTerms> b;
  ownResistance_.assign(kPairTerms * ld_, 0.0);
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t j = 0; j <= k; ++j) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = gas.resistance(j, k, points.T[i]);
      resistances.solve(values, a);
      if (j == k) {
        // No species diffuses through itself: the diagonal stays zero.
        for (std::size_t m = 0; m < kPairTerms; ++m) ownResistance_[m * ld_ + k] = a[m];
      } else {
        resistance_.set(j, k, a);
        for (std::size_t i = 0; i < values.size(); ++i)
          values[i] *= (1.2 * gas.ratioC(j, k, points.T[i]) - 1.0) / (weights_[j] + weights_[k]);
        thermal.solve(values, b);
        thermal_.set(j, k, b);
      }
      wilke_[j * ld_ + k] = wilke_[k * ld_ + j] = 1.0 / std::sqrt(8.0 * (weights_[j] + weights_[k]));
    }
}

double Transport::largestFitError(const PureGas& gas) const {
  double error = 0;
  const auto compare = [&](double fitted, double exact) { error = std::max(error, std::abs(fitted / exact - 1.0)); };
  constexpr std::size_t points = 41;  // not those of the fit
  for (std::size_t i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (points - 1.0);
    const double T =
        std::clamp(minTemperature * std::pow(maxTemperature / minTemperature, share), minTemperature, maxTemperature);
    const auto at = basis(T);
    for (std::size_t k = 0; k < n_; ++k) {
      const double lambda = speciesConductivity(T, k);  // leaves cp_ behind
      compare(lambda, gas.conductivity(k, T, cp_[k]));
      compare(speciesViscosity(T, k), gas.viscosity(k, T));
      for (std::size_t j = 0; j <= k; ++j) compare(pairResistance(at, j, k), gas.resistance(j, k, T));
    }
  }
  return error;
}

}  // namespace lampblack::chemistry
