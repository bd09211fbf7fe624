// A given gas as particles meet it: concentrations, and what its expansion does to their number; any model in it.
#include "coupling/given_gas.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "coupling/model_along.hpp"
#include "coupling/path_ensemble.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "particles/models/two_equation/dimer_soot.hpp"
#include "tests/particles/soot_fixtures.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::coupling {
namespace {

const Mechanism& ethylene() {
  static const Mechanism mechanism =
      Mechanism::fromFile(test::sourcePath("cases/mechanisms/ethylene_abf2000_101.yaml"));
  return mechanism;
}

// Two gases that differ in temperature, pressure and weight, as rows.
GasHistory twoRows() {
  const Mechanism& m = ethylene();
  GasHistory history{{1e-3, 3e-3}, {400, 1600}, {2e5, 1e5}, std::vector<double>(2 * m.numSpecies(), 0.0)};
  const auto X = [&](std::size_t row, const char* name) -> double& {
    return history.fractions[row * m.numSpecies() + m.speciesIndex(name)];
  };
  X(0, "AR") = 0.9;
  X(0, "H2") = 0.1;
  X(1, "H2") = 0.6;
  X(1, "AR") = 0.3;
  X(1, "A4") = 0.1;
  return history;
}

const std::vector<std::string> seen{"H2", "A4", "no such species"};

TEST(GivenPath, ConcentrationsAndDensityAreThoseOfAnIdealGas) {
  const ParticlePath path = givenPath(ethylene(), twoRows(), seen, GasViscosity::air);
  const GasSample &first = path.points.front(), &last = path.points.back();
  const double R = constants::gasConstant, c0 = 2e5 / (R * 400), c1 = 1e5 / (R * 1600);
  EXPECT_NEAR(first.concentrations[0] / (0.1 * c0), 1, 1e-14);
  EXPECT_EQ(first.concentrations[1], 0);
  EXPECT_NEAR(last.concentrations[0] / (0.6 * c1), 1, 1e-14);
  EXPECT_NEAR(last.concentrations[1] / (0.1 * c1), 1, 1e-14);
  EXPECT_EQ(last.concentrations[2], 0);
  // Weights of argon, hydrogen and pyrene, g/mol.
  EXPECT_NEAR(first.gas.density / (1e-3 * c0 * (0.9 * 39.95 + 0.1 * 2.016)), 1, 1e-4);
  EXPECT_NEAR(last.gas.density / (1e-3 * c1 * (0.6 * 2.016 + 0.3 * 39.95 + 0.1 * 202.256)), 1, 1e-4);
  EXPECT_NEAR(last.gas.viscosity / (1.458e-6 * std::pow(1600, 1.5) / (1600 + 110.4)), 1, 1e-14);
  EXPECT_EQ(first.time, 1e-3);
  EXPECT_EQ(last.time, 3e-3);
}

TEST(GivenPath, FractionsAreDividedByTheirSum) {
  GasHistory history = twoRows();
  for (double& x : history.fractions) x *= 1.01;
  const ParticlePath scaled = givenPath(ethylene(), history, seen, GasViscosity::air);
  const ParticlePath plain = givenPath(ethylene(), twoRows(), seen, GasViscosity::air);
  EXPECT_NEAR(scaled.points.back().concentrations[0] / plain.points.back().concentrations[0], 1, 1e-14);
}

// Without collisions and chemistry the number goes with the mass of gas in a volume, whatever changes that, and
// whatever the points are: the particles per kg of gas stay to round-off.
TEST(GivenPath, InertParticlesStayAsManyPerMassOfGas) {
  ParticlePath path = givenPath(ethylene(), twoRows(), sootSpecies(test::jumpsOnly(false, false)), GasViscosity::air);
  const std::vector<double> times{1e-3, 1.3e-3, 2e-3, 2.0001e-3, 3e-3};
  const std::vector<std::size_t> at = insertPoints(path, times);
  for (const EnsembleMethod method : {EnsembleMethod::dsmc, EnsembleMethod::sammc}) {
    EnsembleOptions options;
    options.method = method;
    options.particles = 32;
    options.soot = test::jumpsOnly(false, false);
    SootEnsemble soot(ethylene(), options);
    soot.ensemble().initialise(test::equalSpheres(20, 1e-21, 0, 1e15));
    PathMarch march;
    march.recorded = at;
    const PathResult result = marchPath(soot, path, march);
    const auto number = [&](std::size_t i) { return result.records[i].values[1]; };
    ASSERT_EQ(soot.columns()[1].name, "soot_number_density");
    ASSERT_EQ(result.records.size(), times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_EQ(path.points[at[i]].time, times[i]);
      const double expected = 1e15 * path.points[at[i]].gas.density / path.points[0].gas.density;
      EXPECT_NEAR(number(i) / expected, 1, i == 0 || i == 4 ? 1e-12 : 1e-4) << i;
    }
    EXPECT_LT(number(result.records.size() - 1), 0.5e15);  // the gas has grown by more than that
  }
}

// A divergence that is linear in time stays the same line, in pieces.
TEST(GivenPath, PointsPutInLeaveTheDivergenceAsItIs) {
  ParticlePath path;
  for (const double t : {0.0, 1.0, 3.0}) {
    GasSample& point = path.points.emplace_back();
    point.time = t;
    point.gas.temperature = 300 + 100 * t;
    point.concentrations = {t};
  }
  path.divergence = {{10, 20}, {20, 0}};
  const std::vector<double> times{0.25, 0.5, 1, 2, 2.5};
  const std::vector<std::size_t> at = insertPoints(path, times);
  EXPECT_EQ(at, (std::vector<std::size_t>{1, 2, 3, 4, 5}));
  ASSERT_EQ(path.points.size(), 7u);
  const double expected[7] = {10, 12.5, 15, 20, 10, 5, 0};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(path.divergence[k].first, expected[k], 1e-12) << k;
    EXPECT_NEAR(path.divergence[k].last, expected[k + 1], 1e-12) << k;
  }
  for (const GasSample& point : path.points) {
    EXPECT_NEAR(point.gas.temperature, 300 + 100 * point.time, 1e-10);
    EXPECT_NEAR(point.concentrations[0], point.time, 1e-12);
  }
}

TEST(GivenPath, SaysWhatCannotBeAGas) {
  const auto refuses = [](auto spoil) {
    GasHistory history = twoRows();
    spoil(history);
    EXPECT_THROW(static_cast<void>(givenPath(ethylene(), history, seen, GasViscosity::air)), InputError);
  };
  refuses([](GasHistory& h) { h.time[1] = h.time[0]; });
  refuses([](GasHistory& h) { h.time[1] = 0; });
  refuses([](GasHistory& h) { h.temperature[1] = -5; });
  refuses([](GasHistory& h) { h.pressure[0] = 0; });
  refuses([](GasHistory& h) { h.fractions[0] = -0.1; });
  refuses([](GasHistory& h) { h.fractions[0] += 0.05; });
  refuses([](GasHistory& h) { h = {}; });
  ParticlePath path = givenPath(ethylene(), twoRows(), seen, GasViscosity::air);
  const std::vector<double> late{4e-3};
  EXPECT_THROW(static_cast<void>(insertPoints(path, late)), InputError);
}

// A model in a gas that does not change forgets nothing and takes nothing: twice the time in one piece or in two. And
// what nucleates goes with inception at the concentration that the gas keeps.
TEST(ModelAlong, TheGasIsNotUsedUp) {
  const SootModelOptions soot = test::naphthalene();
  SootModelOptions options = soot;
  options.coagulation = options.condensation = options.surfaceGrowth = options.oxidation = false;
  const DimerSoot model(options);
  const test::FlameGas gas(1600, 1e-4, 0.03, 1e-5, 0.08, 1e-5, 0.03, {1e-4});
  ParticlePath path;
  for (const double t : {0.0, 0.01, 0.02}) path.points.push_back({t, gas.state, gas.concentrations});
  path.divergence.assign(2, {0, 0});
  const std::vector<std::size_t> recorded{0, 1, 2};
  const ModelAlong result = marchModel(model, path, recorded);
  ASSERT_EQ(result.records.size(), 3u);
  const double rate = result.records[0].processes.nucleationNumber;
  ASSERT_GT(rate, 0);
  EXPECT_NEAR(result.records[1].properties.numberDensity / (0.01 * rate), 1, 1e-3);
  EXPECT_NEAR(result.records[2].properties.numberDensity / (0.02 * rate), 1, 1e-3);
  // And expansion at 50 1/s, N' = J - 50 N, in n states of the gas: the midpoint rule for an integral of exp(-50 t),
  // which errs by a part (50 dt)^2/24 of it.
  const double exact = rate * (1 - std::exp(-1.0)) / 50;
  for (const std::size_t n : {10, 20}) {
    path.points.clear();
    for (std::size_t i = 0; i <= n; ++i)
      path.points.push_back({0.02 * static_cast<double>(i) / static_cast<double>(n), gas.state, gas.concentrations});
    path.divergence.assign(n, {50, 50});
    const std::vector<std::size_t> ends{0, n};
    const double z = 1.0 / static_cast<double>(n);
    EXPECT_NEAR(marchModel(model, path, ends).records[1].properties.numberDensity / exact, 1 - z * z / 24, 1e-6) << n;
  }
}

// Of a gas that is the same but for its PAH: what particles take of it is missing, atom for atom, where it is given as
// constant; and without particles it stays what is given, rising and falling.
TEST(ModelAlong, DepletedSpeciesAreWhatParticlesLeave) {
  SootModelOptions options = test::naphthalene();
  options.coagulation = options.surfaceGrowth = options.oxidation = false;
  const DimerSoot model(options);
  const test::FlameGas gas(1600, 1e-4, 0.03, 1e-5, 0.08, 1e-5, 0.03, {3e-5});
  ParticlePath path;
  for (std::size_t i = 0; i <= 20; ++i)
    path.points.push_back({0.001 * static_cast<double>(i), gas.state, gas.concentrations});
  path.divergence.assign(20, {0, 0});
  const std::vector<std::size_t> recorded{0, 10, 20}, pah = model.precursors();
  ASSERT_EQ(pah, std::vector<std::size_t>{SootSpecies::fixed});
  const double given = gas.concentrations[SootSpecies::fixed];
  const ModelAlong result = marchModel(model, path, recorded, pah);
  const ModelAlong undepleted = marchModel(model, path, recorded);
  ASSERT_LT(result.records[2].depleted[0], 0.9 * given);
  ASSERT_GT(result.records[2].depleted[0], 0.0);
  EXPECT_LT(result.records[2].properties.volumeFraction, undepleted.records[2].properties.volumeFraction);
  for (const std::size_t i : {1, 2}) {
    // This soot keeps the hydrogen of its PAH, C10H8.
    const double mass = result.records[i].properties.volumeFraction * options.sootDensity;
    EXPECT_NEAR(mass / (0.12817 * (given - result.records[i].depleted[0])), 1, 1e-4) << i;
  }
  // Twice as long parts change little: second order.
  ParticlePath coarse = path;
  coarse.points = {path.points[0], path.points[10], path.points[20]};
  coarse.divergence.assign(2, {0, 0});
  const std::vector<std::size_t> ends{0, 1, 2};
  EXPECT_NEAR(marchModel(model, coarse, ends, pah).records[2].depleted[0] / result.records[2].depleted[0], 1, 5e-3);
  // Without inception nothing is taken, whatever is given.
  SootModelOptions idle = options;
  idle.pah[0].stickingCoefficient = 0;
  for (std::size_t i = 0; i <= 20; ++i) {
    const double x = static_cast<double>(i) / 20;
    path.points[i].concentrations[SootSpecies::fixed] = given * (i < 10 ? 0.1 + x : 0.6 - (x - 0.5));
    path.points[i].gas.density *= 1 + x;
  }
  const ModelAlong none = marchModel(DimerSoot(idle), path, recorded, pah);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(none.records[i].depleted[0] / path.points[recorded[i]].concentrations[SootSpecies::fixed], 1, 1e-3)
        << i;
}

// A path through all species becomes the history that it was, and thins particles by what their divergence has beyond
// the gas's.
TEST(HistoryAlong, IsWhatThePathCameFrom) {
  const Mechanism& m = ethylene();
  std::vector<std::string> all;
  for (std::size_t k = 0; k < m.numSpecies(); ++k) all.push_back(m.speciesName(k));
  ParticlePath path = givenPath(m, twoRows(), all, GasViscosity::air);
  for (ParticlePath::Divergence& divergence : path.divergence) {
    divergence.first += 10;
    divergence.last += 30;
  }
  const GasHistory history = historyAlong(path);
  ASSERT_EQ(history.time.size(), path.points.size());
  EXPECT_EQ(history.temperature.back(), 1600);
  EXPECT_EQ(history.pressure.front(), 2e5);
  const std::size_t n = m.numSpecies();
  for (const std::size_t row : {std::size_t{0}, history.time.size() - 1})
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_NEAR(history.fractions[row * n + k], twoRows().fractions[(row > 0 ? n : 0) + k], 1e-12) << k;
  for (const double numberLossRate : history.numberLossRate) EXPECT_NEAR(numberLossRate, 20, 1e-8);
}

}  // namespace
}  // namespace lampblack::coupling
