// Ensembles along the path of a flame: the same on any number of ranks, and atoms that balance along the path.
#include "coupling/flame_ensemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::coupling {
namespace {

// The soot-forming zone of a burner flame: no spreading, the temperature falls.
GasOfFlame burntGas(std::size_t points) {
  GasOfFlame gas;
  const double pressure = constants::oneAtmosphere, weight = 0.027, flux = 0.08;
  std::vector<double> T;
  for (std::size_t i = 0; i < points; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(points - 1);
    gas.z.push_back(0.02 * s);
    CarrierGas state;
    state.temperature = 1700 - 250 * s;
    state.pressure = pressure;
    state.meanMolecularWeight = weight;
    const double c = pressure / (constants::gasConstant * state.temperature);
    state.density = c * weight;
    state.viscosity = 1.8e-5 * std::pow(state.temperature / 300, 0.7);
    gas.carrier.push_back(state);
    for (const double X : {5e-4 * (1 - 0.8 * s), 0.05, 1e-6, 0.1, 0.0, 0.03, 0.0, 2e-6})  // SootSpecies, then A2
      gas.concentrations.push_back(X * c);
    gas.velocity.push_back(flux / state.density);
    gas.thermophoresis.push_back(0.55 * state.viscosity / state.density * 250 / 0.02 / state.temperature);
    gas.spread.push_back(0);
  }
  return gas;
}

FlameEnsembleOptions smallEnsemble() {
  static const Mechanism mechanism =
      Mechanism::fromFile(test::sourcePath("cases/mechanisms/ethylene_bisetti2012_47.yaml"));
  FlameEnsembleOptions options;
  options.make = [](std::uint64_t owner) {
    EnsembleOptions soot;
    soot.method = EnsembleMethod::sammc;
    soot.particles = 100;
    soot.soot.pah = {{"A2", 10, 8, 2.0e-3}};
    soot.owner = owner;
    return std::make_unique<SootEnsemble>(mechanism, soot);
  };
  options.repeats = 3;
  options.march.bins.count = 20;
  options.paths.resize(1);
  return options;
}

TEST(FlameEnsemble, IsTheSameOnAnyNumberOfRanks) {
  const GasOfFlame gas = burntGas(21);
  const auto together = runFlameEnsemble(MPI_COMM_WORLD, gas, smallEnsemble());
  const auto alone = runFlameEnsemble(MPI_COMM_SELF, gas, smallEnsemble());
  ASSERT_EQ(together.size(), 1u);
  EXPECT_GT(together[0].valuesOf("volume_fraction").mean.back(), 1e-10);
  EXPECT_GT(together[0].valuesOf("volume_fraction").error.back(), 0);
  for (std::size_t c = 0; c < together[0].columns.size(); ++c) {
    EXPECT_EQ(together[0].values[c].mean, alone[0].values[c].mean);
    EXPECT_EQ(together[0].values[c].error, alone[0].values[c].error);
  }
  EXPECT_EQ(together[0].content, alone[0].content);
  EXPECT_EQ(together[0].counts, alone[0].counts);
  EXPECT_EQ(together[0].distribution.mean, alone[0].distribution.mean);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_EQ(together[0].exchange[k].gas, alone[0].exchange[k].gas);
    EXPECT_EQ(together[0].exchangeError[k].processes, alone[0].exchangeError[k].processes);
  }
}

// What single processes did to the mass, of which nothing is thinned here, and what they exchanged is the same mass: in
// each interval, and what is there in the end.
TEST(FlameEnsemble, TellsWhatProcessesDidBetweenRecords) {
  const auto path = std::move(runFlameEnsemble(MPI_COMM_SELF, burntGas(11), smallEnsemble())[0]);
  const auto process = [&](const PathExchange& x, const std::string& name) {
    const auto found = std::ranges::find(path.processes, name, &Quantity::name);
    return x.processes.at(static_cast<std::size_t>(found - path.processes.begin()));
  };
  ASSERT_EQ(path.exchange.size(), 10U);
  double nucleated = 0;
  for (const PathExchange& x : path.exchange) {
    const double gained = process(x, "nucleation") + process(x, "condensation") + process(x, "growth") -
                          process(x, "oxidation_O2") - process(x, "oxidation_OH");
    EXPECT_NEAR(gained / (x.elements[0] + x.elements[1]), 1, 1e-9);
    nucleated += process(x, "nucleation");
  }
  EXPECT_GT(nucleated, 0);
  ASSERT_EQ(path.content.size(), 2U);
  EXPECT_NEAR(path.content[0] / path.valuesOf("carbon").mean.back(), 1, 1e-12);
  EXPECT_NEAR(path.content[1] / path.valuesOf("hydrogen").mean.back(), 1, 1e-12);
  EXPECT_GT(path.count("nucleations"), 0);
  EXPECT_EQ(path.count("nothing"), 0);
}

// Without spreading the carbon that flows with the particles is what the exchange took on the way: d(C w)/dz = S. The
// mean S of an interval times its length is that to second order in the intervals.
TEST(FlameEnsemble, LeavesWithTheCarbonThatItTookFromTheGas) {
  const auto difference = [](std::size_t points) {
    const auto result = runFlameEnsemble(MPI_COMM_SELF, burntGas(points), smallEnsemble());
    const FlamePath& path = result[0].path;
    const auto& at = path.path.points;
    double taken = 0;
    for (std::size_t k = 0; k + 1 < at.size(); ++k)
      taken += result[0].exchange[k].elements[0] / (at[k + 1].time - at[k].time) * (path.z[k + 1] - path.z[k]);
    return std::abs(taken / (result[0].content[0] * path.velocity.back()) - 1);
  };
  EXPECT_LT(difference(21), 2e-3);
  EXPECT_LT(difference(81), 2e-4);
}

// Repeats are the same however many there are: of two, mean and error tell both; a third gives the mean of three, and
// with them the standard error of that mean, sqrt(sum of squared deviations / (n (n - 1))).
TEST(FlameEnsemble, TellsTheStandardErrorOfTheMean) {
  FlameEnsembleOptions options = smallEnsemble();
  const auto of = [&](std::size_t repeats) {
    options.repeats = repeats;
    const auto result = runFlameEnsemble(MPI_COMM_SELF, burntGas(11), options);
    const RepeatedValue& fraction = result[0].valuesOf("volume_fraction");
    return std::pair{fraction.mean.back(), fraction.error.back()};
  };
  const auto [two, errorOfTwo] = of(2);
  const auto [three, errorOfThree] = of(3);
  ASSERT_GT(errorOfTwo, 0);
  double squares = 0;
  for (const double value : {two - errorOfTwo, two + errorOfTwo, 3 * three - 2 * two})
    squares += (value - three) * (value - three);
  EXPECT_NEAR(errorOfThree / std::sqrt(squares / 6), 1, 1e-9);
}

TEST(FlameEnsemble, PathsHaveRandomNumbersOfTheirOwn) {
  FlameEnsembleOptions options = smallEnsemble();
  options.paths.resize(2);
  const auto twins = runFlameEnsemble(MPI_COMM_SELF, burntGas(11), options);
  EXPECT_EQ(twins[0].path.z, twins[1].path.z);
  EXPECT_NE(twins[0].valuesOf("volume_fraction").mean, twins[1].valuesOf("volume_fraction").mean);
  EXPECT_NE(twins[0].valuesOf("volume_fraction").error, twins[1].valuesOf("volume_fraction").error);
}

TEST(FlameEnsemble, NeedsTwoRepeats) {
  FlameEnsembleOptions options = smallEnsemble();
  options.repeats = 1;
  EXPECT_THROW((void)runFlameEnsemble(MPI_COMM_WORLD, burntGas(11), options), InputError);
}

}  // namespace
}  // namespace lampblack::coupling
