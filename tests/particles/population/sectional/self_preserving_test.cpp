// The self-preserving distribution against Friedlander's (2000) geometric standard deviations, 1.46 for free-molecular
// and 1.44 for continuum coagulation, and against itself from other starts and on other grids.
#include "particles/population/sectional/self_preserving.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/monte_carlo_options.hpp"
#include "particles/population/sectional/sectional_solver.hpp"
#include "tests/particles/population/sectional/sectional_fixtures.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::particles {
namespace {

using Distribution = InitialPopulation::Distribution;

CollisionKernelOptions brownian(CollisionKernelType type) {
  CollisionKernelOptions kernel;
  kernel.type = type;
  kernel.gas = {1500, 101325, 0.24, 5e-5, 0.029};
  if (type == CollisionKernelType::continuum) kernel.gas = continuumLimit(kernel.gas);
  return kernel;
}

SelfPreservingDistribution reached(CollisionKernelType type, Distribution distribution, std::size_t sections) {
  InitialPopulation initial;
  initial.distribution = distribution;
  initial.number = 1e18;
  initial.volume = 1e-26;
  initial.geometricDeviation = 1.6;
  const bool narrow = distribution == Distribution::monodisperse;
  return selfPreserving(brownian(type), 1800, initial, test::gridOf(sections, narrow ? 1e-26 : 1e-29, 1e-18), 5);
}

struct Limit {
  CollisionKernelType type;
  double deviation;
};

class SelfPreserving : public testing::TestWithParam<Limit> {};

TEST_P(SelfPreserving, DeviationIsReachedFromAnyStart) {
  for (const auto distribution : {Distribution::monodisperse, Distribution::exponential, Distribution::lognormal}) {
    // Pivots 20 % apart from a monodisperse start, 29 % apart otherwise.
    const SelfPreservingDistribution found = reached(GetParam().type, distribution, 100);
    EXPECT_NEAR(found.geometricDeviation, GetParam().deviation, 0.02);
    EXPECT_NEAR(found.change, 0, 0.005);
  }
}

TEST_P(SelfPreserving, DeviationIsOfSecondOrderInTheSpacing) {
  double found[3];
  std::size_t k = 0;
  for (const std::size_t sections : {41U, 81U, 161U})  // halved spacing of the logarithms
    found[k++] = reached(GetParam().type, Distribution::monodisperse, sections).geometricDeviation;
  EXPECT_NEAR(std::log2((found[0] - found[1]) / (found[1] - found[2])), 2, 0.3);
  // The published values are rounded to 0.01.
  const double extrapolated = found[2] + (found[2] - found[1]) / 3;
  EXPECT_NEAR(extrapolated, GetParam().deviation, 0.0075);
  std::printf("geometric standard deviation %.4f %.4f %.4f, extrapolated %.4f\n", found[0], found[1], found[2],
              extrapolated);
}

// The curve from a monodisperse and an exponential start, with the same spacing but other pivots.
TEST_P(SelfPreserving, CurveDoesNotDependOnTheStart) {
  std::vector<double> edges;
  for (double eta = 0.05; eta < 6; eta *= 1.25) edges.push_back(eta);
  std::vector<std::vector<double>> curves;
  for (const auto distribution : {Distribution::monodisperse, Distribution::exponential}) {
    const auto sections = distribution == Distribution::monodisperse ? 81U : 111U;
    const SelfPreservingDistribution found = reached(GetParam().type, distribution, sections);
    double number = 0, volume = 0;
    const double spacing = found.volumes[1] / found.volumes[0];
    std::vector<double> curve(edges.size(), 0.0);
    for (std::size_t p = 0; p < found.psi.size(); ++p) {
      const double part = found.psi[p] * 2 * (spacing - 1) / (spacing + 1) * found.volumes[p];
      number += part;
      volume += part * found.volumes[p];
    }
    EXPECT_NEAR(number, 1, 1e-8);  // less the part at volume zero
    EXPECT_NEAR(volume, 1, 1e-12);
    // ln(psi), linear between pivots.
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const double at = std::log(edges[e] / found.volumes[0]) / std::log(spacing);
      const auto p = static_cast<std::size_t>(at);
      const double x = at - static_cast<double>(p);
      curve[e] = std::exp((1 - x) * std::log(found.psi[p]) + x * std::log(found.psi[p + 1]));
    }
    curves.push_back(curve);
  }
  // Interpolation in pivots 26 % apart: (ln 1.26)^2 / 8 = 0.7 % for each unit of curvature of ln(psi), up to 6 here.
  for (std::size_t e = 0; e < edges.size(); ++e) EXPECT_NEAR(curves[0][e], curves[1][e], 0.04 * curves[0][e]);
}

// Monte Carlo, which shares only the kernel with the sections, has the same curve: the number in bins of the volume in
// units of the mean, whose error of the sections is of second order and extrapolated.
TEST_P(SelfPreserving, CurveIsThatOfMonteCarlo) {
  PopulationModel model;
  model.coagulation = brownian(GetParam().type);
  InitialPopulation initial;
  initial.distribution = Distribution::exponential;
  initial.number = 1e18;
  initial.volume = 1e-26;
  std::vector<double> edges;
  for (double eta = 1.0 / 64; eta < 9; eta *= 2) edges.push_back(eta);
  std::vector<std::vector<double>> sections;
  double end = 0;
  for (const std::size_t count : {100U, 199U}) {
    const auto grid = test::gridOf(count, 1e-29, 1e-20);
    if (end == 0) end = selfPreserving(*model.coagulation, 1800, initial, grid, 3).time;
    SectionalSolver solver(model, initial, grid);
    solver.advance(end);
    sections.push_back(reducedDistribution(solver, edges));
    sections.back().push_back(std::log(solver.geometricDeviation()));
  }
  std::vector<std::vector<double>> samples(edges.size());
  for (std::uint64_t repeat = 0; repeat < 32; ++repeat) {
    MonteCarloOptions options;
    options.method = MonteCarloMethod::dsmc;
    options.particles = 2000;
    options.repeat = repeat;
    const auto solver = makeMonteCarlo(model, initial, options);
    solver->advance(end);
    const auto psi = reducedDistribution(*solver, edges);
    for (std::size_t b = 0; b < psi.size(); ++b) samples[b].push_back(psi[b]);
    samples.back().push_back(std::log(solver->geometricDeviation()));
  }
  for (std::size_t b = 0; b < samples.size(); ++b) {
    const test::Sample sample = test::summarise(samples[b]);
    const double extrapolated = sections[1][b] + (sections[1][b] - sections[0][b]) / 3;
    // Half of the correction is left for what is not of second order: the edges of bins between pivots.
    const double left = 0.5 * std::abs(extrapolated - sections[1][b]);
    EXPECT_NEAR(sample.mean, extrapolated, 3.6 * sample.standardError + left) << "bin " << b;
    std::printf("%s %.4f +- %.4f, sections %.4f %.4f\n", b + 1 < edges.size() ? "psi" : "ln of the deviation",
                sample.mean, sample.standardError, sections[0][b], sections[1][b]);
  }
}

INSTANTIATE_TEST_SUITE_P(Limits, SelfPreserving,
                         testing::Values(Limit{CollisionKernelType::freeMolecular, 1.46},
                                         Limit{CollisionKernelType::continuum, 1.44}));

// The constant kernel has a closed form, psi = exp(-eta); ln(eta) has the variance pi^2 / 6.
TEST(SelfPreservingConstantKernel, IsTheExponential) {
  CollisionKernelOptions kernel;
  kernel.rate = 1;
  InitialPopulation initial;
  initial.distribution = Distribution::monodisperse;
  initial.number = 1;
  const SelfPreservingDistribution found = selfPreserving(kernel, 1, initial, test::gridOf(200, 1, 4e6), 5);
  for (std::size_t p = 0; p < found.psi.size(); ++p) {
    if (found.volumes[p] > 0.01 && found.volumes[p] < 5) {
      // 8 % between pivots, of second order.
      EXPECT_NEAR(found.psi[p] * std::exp(found.volumes[p]), 1, 0.01) << found.volumes[p];
    }
  }
  EXPECT_NEAR(found.geometricDeviation, std::exp(constants::pi / std::sqrt(6) / 3), 2e-3);
}

TEST(SelfPreservingInput, NeedsAHomogeneousKernel) {
  EXPECT_THROW((void)reached(CollisionKernelType::transition, Distribution::monodisperse, 50), InputError);
}

TEST(ReducedDistribution, HasNumberAndVolumeOne) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->rate = 1;
  InitialPopulation initial;
  initial.distribution = Distribution::exponential;
  initial.number = 5;
  initial.volume = 3;
  SectionalSolver solver(model, initial, test::gridOf(200, 1e-3, 1e4));
  solver.advance(1);
  std::vector<double> edges{0};
  for (double eta = 1e-4; eta < 100; eta *= 1.01) edges.push_back(eta);
  const std::vector<double> psi = reducedDistribution(solver, edges);
  double number = 0, volume = 0;
  for (std::size_t b = 0; b < psi.size(); ++b) {
    const double part = psi[b] * (edges[b + 1] - edges[b]);
    number += part;
    volume += part * 0.5 * (edges[b] + edges[b + 1]);
  }
  EXPECT_NEAR(number, 1, 1e-12);
  EXPECT_NEAR(volume, 1, 1e-4);  // bins of 1 %
}

}  // namespace
}  // namespace lampblack::particles
