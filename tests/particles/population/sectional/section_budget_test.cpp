// The discretisation: every process changes number and volume exactly as the population balance says, whatever the
// spectrum; tolerances are a few roundings of the gross rates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/modules.hpp"
#include "particles/population/sectional/linear_processes.hpp"
#include "particles/population/sectional/section_coagulation.hpp"
#include "particles/population/sectional/section_growth.hpp"
#include "tests/particles/population/sectional/sectional_fixtures.hpp"

namespace lampblack::particles {
namespace {

constexpr double roundOff = 1e-14;

CollisionKernelOptions kernelOf(CollisionKernelType type) {
  CollisionKernelOptions kernel;
  kernel.type = type;
  kernel.rate = 0.7;
  kernel.gas = {1700, 101325, 0.2, 6e-5, 0.028};
  return kernel;
}

struct CoagulationCase {
  CollisionKernelType type;
  double spacing;
  std::size_t sections;
};

class SectionCoagulationRates : public testing::TestWithParam<CoagulationCase> {};

// Event by event with Kumar and Ramkrishna's weights, from the grid's own search for the interval of each sum.
TEST_P(SectionCoagulationRates, AreThoseOfTheFixedPivotTechnique) {
  const CoagulationCase c = GetParam();
  const SectionGrid grid(test::spacedGrid(c.sections, 1e-27, c.spacing));
  const SectionLayout layout = grid.layout();
  const CollisionKernel kernel(kernelOf(c.type));
  const double density = 1800;
  const std::vector<double> y = test::roughSpectrum(layout);
  SectionCoagulation coagulation(grid, kernel, density);
  std::vector<double> f(layout.size(), 0.0);
  coagulation.addRates(y.data(), f.data());

  const auto particle = [&](double volume) {
    return CollisionKernel::Properties{volume, density * volume, std::cbrt(6 * volume / constants::pi)};
  };
  const bool physical = c.type == CollisionKernelType::freeMolecular || c.type == CollisionKernelType::transition;
  std::vector<double> expected(layout.size(), 0.0), gross(layout.size(), 0.0);
  double events = 0, grossVolume = 0;
  const auto add = [&](std::size_t k, double rate) {
    expected[k] += rate;
    gross[k] += std::abs(rate);
  };
  for (std::size_t i = 0; i < layout.sections; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      // Brownian kernels are infinite at volume zero: half of the first pivot instead.
      const auto at = [&](std::size_t k) {
        return particle(k == 0 && physical ? 0.5 * grid.volume(1) : grid.volume(k));
      };
      const double event = (i == j ? 0.5 : 1.0) * kernel.value(at(i), at(j)) * y[i] * y[j];
      const double sum = grid.volume(i) + grid.volume(j);
      events += event;
      grossVolume += event * sum;
      add(i, -event);
      add(j, -event);
      if (sum > grid.volume(grid.last())) {
        add(layout.overNumber(), event);
        add(layout.overVolume(), event * sum / grid.volume(grid.last()));
      } else {
        const auto place = grid.pivotsAround(sum);
        add(place.lower, (1 - place.upper) * event);
        add(place.lower + 1, place.upper * event);
      }
    }
  }
  for (std::size_t k = 0; k < layout.size(); ++k) {
    // The place of a sum has the rounding of the volumes over the width of a section.
    EXPECT_NEAR(f[k], expected[k], 1e-13 * c.spacing / (c.spacing - 1) * gross[k]) << "section " << k;
  }
  // Sums of up to 400 x 400 / 2 events, their round-off as a random walk.
  EXPECT_NEAR(test::numberOf(layout, f), -events, 3 * roundOff * events);
  EXPECT_NEAR(test::volumeOf(grid, f), 0, 3 * roundOff * grossVolume);
}

INSTANTIATE_TEST_SUITE_P(KernelsAndSpacings, SectionCoagulationRates,
                         testing::Values(CoagulationCase{CollisionKernelType::constant, 1.05, 150},
                                         CoagulationCase{CollisionKernelType::constant, 2.0, 20},
                                         CoagulationCase{CollisionKernelType::additive, std::sqrt(2), 40},
                                         CoagulationCase{CollisionKernelType::multiplicative, 3.7, 20},
                                         CoagulationCase{CollisionKernelType::freeMolecular, 1.3, 100},
                                         CoagulationCase{CollisionKernelType::freeMolecular, 1.02, 400},
                                         CoagulationCase{CollisionKernelType::transition, 1.19, 101}));

// The rates are quadratic in the numbers, so that a central difference is exact but for rounding.
TEST(SectionCoagulationJacobian, IsTheDerivativeOfTheRates) {
  for (const double spacing : {1.2, 2.5}) {
    const SectionGrid grid(test::spacedGrid(30, 1e-27, spacing));
    const SectionLayout layout = grid.layout();
    SectionCoagulation coagulation(grid, CollisionKernel(kernelOf(CollisionKernelType::freeMolecular)), 1800);
    const std::vector<double> y = test::roughSpectrum(layout);
    const std::size_t n = layout.size();
    std::vector<double> J(n * n, 0.0);
    coagulation.addJacobian(y.data(), J.data(), n);
    for (std::size_t j = 0; j < n; ++j) {
      auto above = y, below = y;
      std::vector<double> f(n, 0.0), g(n, 0.0);
      const double step = std::max(y[j], 1.0);
      above[j] += step;
      below[j] -= step;
      coagulation.addRates(above.data(), f.data());
      coagulation.addRates(below.data(), g.data());
      for (std::size_t i = 0; i < n; ++i) {
        const double scale = std::max(std::abs(f[i]), std::abs(g[i])) / step;
        EXPECT_NEAR(J[i + n * j], (f[i] - g[i]) / (2 * step), 1e-13 * scale) << i << " " << j;
      }
    }
  }
}

TEST(SectionBreakage, MakesTheFragmentsAndKeepsTheVolumeOfEverySection) {
  const SectionGrid grid(test::spacedGrid(60, 0.01, 1.2));
  const SectionLayout layout = grid.layout();
  for (const double exponent : {0.0, 1.0, 1.8, -0.5}) {
    for (const int fragments : {2, 3, 12, -2}) {  // below zero: uniform
      PopulationModel model;
      model.breakage =
          BreakageOptions{0.4, exponent, std::abs(fragments),
                          fragments > 0 ? BreakageOptions::Daughters::equal : BreakageOptions::Daughters::uniform};
      const LinearProcesses processes(grid, model);
      for (std::size_t j = 0; j < layout.sections; ++j) {
        std::vector<double> y(layout.size(), 0.0), f(layout.size(), 0.0);
        y[j] = 1;
        processes.addRates(y.data(), f.data());
        const double v = j == 0 && exponent < 0 ? 0.5 * grid.volume(1) : grid.volume(j);
        const double rate = 0.4 * std::pow(v, exponent), pieces = std::abs(fragments);
        EXPECT_NEAR(test::numberOf(layout, f), (pieces - 1) * rate, roundOff * pieces * rate);
        EXPECT_NEAR(test::volumeOf(grid, f), 0, roundOff * rate * grid.volume(j));
        for (std::size_t k = 0; k < j; ++k) EXPECT_GE(f[k], 0);
      }
    }
  }
}

TEST(SectionDepositionAndDilution, TakeTheirPartOfEverySection) {
  const SectionGrid grid(test::spacedGrid(20, 0.01, 2));
  PopulationModel model;
  model.deposition = DepositionOptions{0.3, 0.5};
  model.dilution = 0.2;
  const LinearProcesses processes(grid, model);
  const SectionLayout layout = grid.layout();
  const std::vector<double> y = test::roughSpectrum(layout);
  std::vector<double> f(layout.size(), 0.0);
  processes.addRates(y.data(), f.data());
  for (std::size_t k = 0; k < layout.sections; ++k)
    EXPECT_DOUBLE_EQ(f[k], -(0.3 * std::sqrt(grid.volume(k)) + 0.2) * y[k]);
}

struct GrowthCase {
  GrowthOptions growth;
  SectionGrowthScheme scheme;
};

class SectionGrowthRates : public testing::TestWithParam<GrowthCase> {};

TEST_P(SectionGrowthRates, KeepNumberAndGiveTheGrowthOfVolume) {
  const auto [options, scheme] = GetParam();
  const SectionGrid grid(test::spacedGrid(50, 0.01, 1.3));
  const SectionLayout layout = grid.layout();
  const SectionGrowth growth(grid, options, scheme);
  const std::vector<double> y = test::roughSpectrum(layout);
  std::vector<double> f(layout.size(), 0.0);
  growth.addRates(y.data(), f.data());
  double expected = 0, gross = 0, grossNumber = 0;
  for (std::size_t k = 1; k < layout.sections; ++k) {
    const double v = grid.volume(k), surface = std::cbrt(36 * constants::pi * v * v);
    const double rate = y[k] * (options.condensation * v + options.surface() * surface);
    expected += rate;
    gross += std::abs(rate);
    grossNumber += std::abs(rate) / (0.3 / 1.3 * v);  // per width of the narrower neighbouring interval
  }
  // What moves has the volume of its section: the gross flux of volume is that of number times the pivot.
  EXPECT_NEAR(test::numberOf(layout, f), 0, roundOff * grossNumber);
  EXPECT_NEAR(test::volumeOf(grid, f, growth.vanishingVolume()), expected, roundOff * gross * 1.3 / 0.3);
}

TEST_P(SectionGrowthRates, NeverTakeFromAnEmptySection) {
  const auto [options, scheme] = GetParam();
  const SectionGrid grid(test::spacedGrid(50, 0.01, 1.3));
  const SectionLayout layout = grid.layout();
  const SectionGrowth growth(grid, options, scheme);
  for (std::size_t empty = 0; empty < layout.sections; ++empty) {
    std::vector<double> y = test::roughSpectrum(layout), f(layout.size(), 0.0);
    y[empty] = 0;
    growth.addRates(y.data(), f.data());
    EXPECT_GE(f[empty], 0);
  }
}

TEST_P(SectionGrowthRates, HaveTheirDerivativeAsJacobian) {
  const auto [options, scheme] = GetParam();
  const SectionGrid grid(test::spacedGrid(30, 0.01, 1.3));
  const SectionLayout layout = grid.layout();
  const SectionGrowth growth(grid, options, scheme);
  const std::vector<double> y = test::roughSpectrum(layout);
  const std::size_t n = layout.size();
  std::vector<double> J(n * n, 0.0);
  growth.addJacobian(y.data(), J.data(), n);
  for (std::size_t j = 0; j < n; ++j) {
    auto above = y, below = y;
    std::vector<double> f(n, 0.0), g(n, 0.0);
    // Rounding and the third derivative make about 1e-10 of it each.
    const double step = 1e-5 * std::max(y[j], 1.0);
    above[j] += step;
    below[j] -= step;
    growth.addRates(above.data(), f.data());
    growth.addRates(below.data(), g.data());
    double rounding = 0;
    for (std::size_t i = 0; i < n; ++i) rounding = std::max(rounding, 1e-15 * std::abs(f[i]) / step);
    for (std::size_t i = 0; i < n; ++i) {
      const double value = J[i + n * j];
      EXPECT_NEAR(value, (f[i] - g[i]) / (2 * step), rounding + 1e-8 * std::abs(value)) << i << " " << j;
    }
  }
}

GrowthOptions growing(double condensation, double surface, double smallest = 0) {
  GrowthOptions options;
  options.condensation = condensation;
  (surface > 0 ? options.surfaceGrowth : options.oxidation) = std::abs(surface);
  options.smallestVolume = smallest;
  return options;
}

INSTANTIATE_TEST_SUITE_P(Processes, SectionGrowthRates,
                         testing::Values(GrowthCase{growing(0.3, 0), SectionGrowthScheme::upwind},
                                         GrowthCase{growing(0.3, 0.2), SectionGrowthScheme::limited},
                                         GrowthCase{growing(0, -0.4, 0.005), SectionGrowthScheme::upwind},
                                         GrowthCase{growing(0, -0.4, 0.01), SectionGrowthScheme::limited},
                                         // Evaporation of small, growth of large particles.
                                         GrowthCase{growing(0.5, -0.4), SectionGrowthScheme::limited},
                                         GrowthCase{growing(-0.5, 0.4), SectionGrowthScheme::limited}));

// Upwind adds sum D_k G_k to the rate of the second moment, (spacing - 1) / 2 of it for condensation. What the limited
// scheme adds is of third order: D_k (1 - r)^2.
TEST(SectionGrowthSchemes, DifferInTheSecondMoment) {
  const auto excess = [](double spacing, SectionGrowthScheme scheme) {
    const SectionGrid grid(test::spacedGrid(static_cast<std::size_t>(17 / std::log(spacing)), 1e-4, spacing));
    const SectionLayout layout = grid.layout();
    std::vector<double> y(layout.size(), 0.0), f(layout.size(), 0.0);
    double exact = 0, sum = 0;
    for (std::size_t k = 1; k < layout.sections; ++k) {
      const double v = grid.volume(k);
      y[k] = v * std::exp(-v);
      exact += y[k] * 2 * 0.3 * v * v;
    }
    SectionGrowth(grid, growing(0.3, 0), scheme).addRates(y.data(), f.data());
    for (std::size_t k = 1; k < layout.sections; ++k) sum += f[k] * grid.volume(k) * grid.volume(k);
    return sum / exact - 1;
  };
  EXPECT_NEAR(excess(1.1, SectionGrowthScheme::upwind), 0.05, 1e-12);
  const double coarse = excess(1.1, SectionGrowthScheme::limited), fine = excess(1.05, SectionGrowthScheme::limited);
  EXPECT_GT(fine, 0);
  EXPECT_NEAR(std::log2(coarse / fine), 3, 0.25);
}

}  // namespace
}  // namespace lampblack::particles
