// Coagulation of stochastic soot against references that share no code with them: the exact cluster sizes of the
// constant kernel, and for the physical kernels a sectional solution by the fixed pivot technique (Kumar and Ramkrishna
// 1996).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "particles/ensemble/ensemble.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/packed_sizes.hpp"

namespace lampblack::app {
namespace {

constexpr double rho = 1850;

CarrierGas gasAt(double pressure) {
  CarrierGas gas;
  gas.temperature = 1700;
  gas.pressure = pressure;
  gas.meanMolecularWeight = 0.028;
  gas.density = pressure * 0.028 / (constants::gasConstant * 1700);
  gas.viscosity = 6e-5;
  return gas;
}

// Equal spheres of one mass (kg), at n0 (1/m3), after coagulation by `kernel` alone for a time.
std::unique_ptr<Ensemble> coagulated(const CollisionKernelOptions& kernel, const CarrierGas& gas, std::uint64_t owner,
                                     std::size_t particles, double mass, double n0, double time) {
  EnsembleOptions options;
  options.particles = particles;
  options.owner = owner;
  options.kernel = kernel;
  options.soot.surfaceGrowth = options.soot.oxidation = false;
  auto soot = makeEnsemble(options);
  soot->initialise(std::vector<GivenParticle>(particles, {mass, 0, 1, n0 / static_cast<double>(particles)}));
  const std::vector<double> none(SootSpecies::fixed);
  soot->advance({gas, none}, 0, time);
  return soot;
}

struct Repeats {
  std::vector<double> values;
  [[nodiscard]] double mean() const {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
  }
  [[nodiscard]] double standardError() const {
    const double n = static_cast<double>(values.size()), m = mean();
    double sum = 0;
    for (const double v : values) sum += (v - m) * (v - m);
    return std::sqrt(sum / (n * (n - 1)));
  }
};

// The kernel written out here on its own: Davies' slip, harmonic mean (Wang 2025, eqs. 9-28 to 9-30).
double kernelOf(const CarrierGas& gas, bool transition, double vi, double vj) {
  const double kT = constants::boltzmann * gas.temperature;
  const double di = std::cbrt(6 * vi / constants::pi), dj = std::cbrt(6 * vj / constants::pi);
  const double fm = 2.2 * std::sqrt(0.5 * constants::pi * kT / rho * (1 / vi + 1 / vj)) * std::pow(di + dj, 2);
  if (!transition) return fm;
  const double path =
      gas.viscosity / gas.pressure * std::sqrt(constants::pi * constants::gasConstant * gas.temperature / (2 * 0.028));
  const auto slip = [&](double d) {
    const double kn = 2 * path / d;
    return 1 + kn * (1.257 + 0.4 * std::exp(-1.1 / kn));
  };
  const double continuum = 2 * kT / (3 * gas.viscosity) * (slip(di) / di + slip(dj) / dj) * (di + dj);
  return 1 / (1 / fm + 1 / continuum);
}

struct Sectional {
  double number = 0, spread = 0, massError = 0;
};

Sectional solveSectional(const CarrierGas& gas, bool transition, double v0, double n0, double time, double ratio) {
  const auto sections = static_cast<std::size_t>(std::log(3e5) / std::log(ratio));
  std::vector<double> v(sections), n(sections, 0.0);
  for (std::size_t k = 0; k < sections; ++k) v[k] = v0 * std::pow(ratio, static_cast<double>(k));
  n[0] = n0;
  struct Target {
    double kernel, low;
    std::size_t at;
  };
  std::vector<Target> pairs(sections * sections);
  for (std::size_t i = 0; i < sections; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double sum = v[i] + v[j];
      std::size_t k = std::min(i, sections - 2);
      while (k + 2 < sections && v[k + 1] <= sum) ++k;
      pairs[i * sections + j] = {kernelOf(gas, transition, v[i], v[j]), (v[k + 1] - sum) / (v[k + 1] - v[k]), k};
    }
  }
  double fastest = 0;
  const auto rates = [&](const std::vector<double>& x) {
    std::vector<double> r(sections, 0.0), loss(sections, 0.0);
    for (std::size_t i = 0; i < sections; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const Target& t = pairs[i * sections + j];
        const double events = (i == j ? 0.5 : 1.0) * t.kernel * x[i] * x[j];
        r[t.at] += t.low * events;
        r[t.at + 1] += (1 - t.low) * events;
        r[i] -= events;
        r[j] -= events;
        loss[i] += t.kernel * x[j];
        if (i != j) loss[j] += t.kernel * x[i];
      }
    }
    fastest = 0;
    for (std::size_t i = 0; i < sections; ++i) fastest = std::max(fastest, loss[i]);
    return r;
  };
  for (double t = 0; t < time;) {
    const auto k1 = rates(n);
    const double dt = std::min(test::fewOrMany(0.3, 0.1) / fastest, time - t);
    std::vector<double> middle = n;
    for (std::size_t i = 0; i < sections; ++i) middle[i] += 0.5 * dt * k1[i];
    const auto k2 = rates(middle);
    for (std::size_t i = 0; i < sections; ++i) n[i] += dt * k2[i];
    t += dt;
  }
  Sectional out;
  double mass = 0, mean = 0, square = 0;
  for (std::size_t i = 0; i < sections; ++i) {
    const double logD = std::log(v[i] / v0) / 3;
    out.number += n[i];
    mass += n[i] * v[i];
    mean += n[i] * logD;
    square += n[i] * logD * logD;
  }
  mean /= out.number;
  out.spread = std::exp(std::sqrt(square / out.number - mean * mean));
  out.massError = std::abs(mass / (n0 * v0) - 1);
  return out;
}

void compareWithSections(CollisionKernelType kernel, const CarrierGas& gas, double mass, double n0, double time,
                         double selfPreservingSpread) {
  const bool transition = kernel == CollisionKernelType::transition;
  const Sectional fine = solveSectional(gas, transition, mass / rho, n0, time, 1.12);
  const Sectional coarse = solveSectional(gas, transition, mass / rho, n0, time, 1.12 * 1.12);
  ASSERT_LT(fine.massError, 1e-9);
  ASSERT_LT(fine.number, 0.05 * n0);
  Repeats number, spread;
  const auto repeats = test::fewOrMany<std::uint64_t>(32, 96);
  for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
    const auto soot = coagulated({.type = kernel}, gas, repeat, 8192, mass, n0, time);
    number.values.push_back(soot->totals().number / n0);
    spread.values.push_back(soot->geometricDeviation());
  }
  // The sectional method is of second order in the ratio less one: its fine error is below the difference of the two.
  const double zLimit = 3.3;
  EXPECT_NEAR(number.mean(), fine.number / n0,
              zLimit * number.standardError() + std::abs(fine.number - coarse.number) / n0);
  EXPECT_NEAR(spread.mean(), fine.spread, zLimit * spread.standardError() + std::abs(fine.spread - coarse.spread));
  // Friedlander's value, rounded to two decimals.
  EXPECT_NEAR(spread.mean(), selfPreservingSpread, zLimit * spread.standardError() + 0.005);
  std::printf("number %.5f +- %.5f sections %.5f (coarse %.5f); spread %.4f +- %.4f sections %.4f (coarse %.4f)\n",
              number.mean(), number.standardError(), fine.number / n0, coarse.number / n0, spread.mean(),
              spread.standardError(), fine.spread, coarse.spread);
}

TEST(ParticlesVerification, FreeMolecularCoagulationMatchesTheSectionalSolution) {
  compareWithSections(CollisionKernelType::freeMolecular, gasAt(101325), 1e-23, 1e18, 0.02, 1.46);
}

TEST(ParticlesVerification, ContinuumCoagulationMatchesTheSectionalSolution) {
  compareWithSections(CollisionKernelType::transition, gasAt(1e8), 1e-17, 1e14, 1500, 1.44);
}

TEST(ParticlesVerification, ConstantKernelGivesTheExactClusterSizes) {
  const double tau = 1, K = 1e-15, n0 = 1e18, mass = 1e-23;
  std::vector<Repeats> sizes(5);
  for (std::uint64_t repeat = 0; repeat < 100; ++repeat) {
    const auto soot = coagulated({.type = CollisionKernelType::constant, .rate = K}, gasAt(101325), repeat, 4096, mass,
                                 n0, tau / (K * n0));
    // A bin around each of the first five cluster sizes.
    std::vector<double> count(5, 0.0);
    for (std::size_t k = 0; k < 5; ++k) {
      const auto at = [&](double monomers) { return std::log10(std::cbrt(6 * monomers * mass / rho / constants::pi)); };
      const double size = static_cast<double>(k + 1), low = at(size - 0.4), high = at(size + 0.4);
      count[k] = test::sizesOf(*soot, {low, high, 1})[0] * (high - low) / n0;
    }
    for (std::size_t k = 0; k < 5; ++k) sizes[k].values.push_back(count[k]);
  }
  for (std::size_t k = 0; k < 5; ++k) {
    const double exact = std::pow(tau / 2, static_cast<double>(k)) / std::pow(1 + tau / 2, static_cast<double>(k + 2));
    EXPECT_LT(std::abs(sizes[k].mean() - exact) / sizes[k].standardError(), 3.5)
        << k + 1 << " monomers";  // five at 99.9 %
  }
}

}  // namespace
}  // namespace lampblack::app
