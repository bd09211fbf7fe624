// A kind of particles that no place knows (two_colours.hpp) along paths: of a gas that is given, by repeats over the
// ranks, and of a flame, whose gas is told what they took.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "coupling/flame_coupling.hpp"
#include "coupling/path_ensemble.hpp"
#include "particles/models/element_enthalpies.hpp"
#include "tests/coupling/cell_vessel.hpp"
#include "tests/coupling/two_colours.hpp"

namespace lampblack::test {
namespace {

constexpr double uptakeOfRed = 1e-14, end = 2e-3;
constexpr double firstAmount = 3e-3, lastAmount = 1e-3;    // mol/m3 of acetylene
constexpr double firstSpread = 100.0, lastSpread = 500.0;  // 1/s

double perMole() {
  return 2.0 * ethylene().mechanism.atomicWeight(ethylene().mechanism.elementIndex("C"));
}

// Three points; acetylene falls and the divergence rises, both linearly in time.
ParticlePath pathOfPoints() {
  ParticlePath path;
  for (const double w : {0.0, 0.25, 1.0}) {
    GasSample& at = path.points.emplace_back();
    at.time = w * end;
    at.gas = {1500.0, constants::oneAtmosphere, 0.22, 5e-5, 0.028};
    at.concentrations = {firstAmount + w * (lastAmount - firstAmount), 0.0};
  }
  const auto spread = [](double w) { return firstSpread + w * (lastSpread - firstSpread); };
  path.divergence = {{spread(0.0), spread(0.25)}, {spread(0.25), spread(1.0)}};
  return path;
}

MakePopulation painted(double moreAnOwner = 0.0) {
  return [moreAnOwner](std::uint64_t owner) {
    auto population = TwoColours::some(ethylene().mechanism, uptakeOfRed);
    population->dilute(1.0 + moreAnOwner * static_cast<double>(owner));
    return population;
  };
}

// What a particle has taken up is the integral of the gas, and the number what the divergence leaves of it.
TEST(TwoColoursOnAPath, TakeUpTheGasOfTheirWayAndSpread) {
  const auto population = painted()(0);
  const PathMarch march{.bins = {-9.0, -6.0, 30}, .division = {.relativeStep = 0.01}};
  const PathResult result = marchPath(*population, pathOfPoints(), march);
  ASSERT_EQ(result.records.size(), 3U);
  const double dose = 0.5 * (firstAmount + lastAmount) * end, left = std::exp(-0.5 * (firstSpread + lastSpread) * end);
  const double number = 12.0 * TwoColours::eachNumber * left,
               carbon = TwoColours::carbonAtStart + perMole() * uptakeOfRed * dose * (4.0 + 8.0 / 3.0) / 12.0;
  EXPECT_NEAR(result.records[2].values[1] / number, 1.0, 1e-12);
  EXPECT_NEAR(result.records[2].values[0] / (number * carbon / TwoColours::density), 1.0, 1e-12);
  // Rates are those in the gas of the record.
  EXPECT_NEAR(result.records[2].values[3] / (number * uptakeOfRed * (4.0 + 8.0 / 3.0) / 12.0 * lastAmount), 1.0, 1e-12);
  ASSERT_EQ(result.content.size(), 1U);
  EXPECT_NEAR(result.content[0] / (number * carbon), 1.0, 1e-12);
  // An interval's exchange is that of it alone, with the hydrogen that goes back: of second order in its parts.
  ASSERT_EQ(result.exchange.size(), 2U);
  for (const PathExchange& x : result.exchange) {
    EXPECT_NEAR(x.elements[0] / (-perMole() * x.gas[0]), 1.0, 1e-12);
    EXPECT_EQ(x.gas[1], -x.gas[0]);
  }
  const auto taken = [](double from, double to) {  // by many small steps
    double sum = 0.0;
    for (int k = 0; k < 1000; ++k) {
      const double w = from + (k + 0.5) * 1e-3 * (to - from);
      sum += (firstAmount + w * (lastAmount - firstAmount)) *
             std::exp(-end * (firstSpread * w + 0.5 * w * w * (lastSpread - firstSpread)));
    }
    return sum * 1e-3 * (to - from) * end * TwoColours::eachNumber * uptakeOfRed * (4.0 + 8.0 / 3.0);
  };
  EXPECT_NEAR(-result.exchange[0].gas[0] / taken(0.0, 0.25), 1.0, 1e-4);
  EXPECT_NEAR(-result.exchange[1].gas[0] / taken(0.25, 1.0), 1.0, 1e-4);
  double counted = 0.0;
  for (const double density : result.records[2].distribution) counted += density * march.bins.width();
  EXPECT_NEAR(counted / number, 1.0, 1e-12);
}

// Owners n, n + 1 and n + 2 have each a tenth more of the first number.
TEST(TwoColoursOnAPath, AreRepeatedOverTheRanks) {
  for (MPI_Comm comm : {MPI_COMM_WORLD, MPI_COMM_SELF}) {
    const PathEnsemble paths = runPathEnsemble(comm, pathOfPoints(), painted(0.1), 5, 3, {}, "paint");
    EXPECT_EQ(paths.material, "paint");
    const RepeatedValue& number = paths.valuesOf("number_density");
    ASSERT_EQ(number.mean.size(), 3U);
    EXPECT_NEAR(number.mean[0] / (1.6 * 12.0 * TwoColours::eachNumber), 1.0, 1e-12);
    EXPECT_NEAR(number.error[0] / (0.1 / std::sqrt(3.0) * 12.0 * TwoColours::eachNumber), 1.0, 1e-12);
    EXPECT_NEAR(paths.count("particles_in_a_cubic_centimetre") / (3e-6 * number.mean[2]), 1.0, 1e-12);
    ASSERT_EQ(paths.exchange.size(), 2U);
    EXPECT_NEAR(paths.exchangeError[1].gas[0] / (-paths.exchange[1].gas[0] / 16.0 / std::sqrt(3.0)), 1.0, 1e-9);
    EXPECT_NEAR(paths.exchange[1].elements[0] / (-perMole() * paths.exchange[1].gas[0]), 1.0, 1e-12);
    EXPECT_NEAR(paths.content[0] / (paths.valuesOf("volume_fraction").mean[2] * TwoColours::density), 1.0, 1e-12);
  }
}

// A flame of three points through which all move alike: its gas loses the acetylene and the heat of the carbon that the
// particles have in the end.
TEST(TwoColoursOnAPath, AreCoupledWithTheGasOfAFlame) {
  const Mechanism& mechanism = ethylene().mechanism;
  const std::size_t n = mechanism.numSpecies();
  const double speed = 0.5;
  FlameProfile profile{{n, 0}, {0.0, 1e-3, 3e-3}, {}};
  profile.x.assign(profile.size(), 0.0);
  GasOfFlame gas;
  gas.z = profile.z;
  for (std::size_t i = 0; i < 3; ++i) {
    profile.at(i, FlameLayout::temperature) = 1500.0;
    gas.carrier.push_back({1500.0, constants::oneAtmosphere, 0.22, 5e-5, 0.028});
    gas.concentrations.insert(gas.concentrations.end(), {2e-3, 0.0});
    gas.velocity.push_back(speed);
    gas.thermophoresis.push_back(0.0);
    gas.spread.push_back(0.0);
  }
  FlameEnsembleOptions options;
  options.make = painted();
  options.repeats = 2;
  options.paths.resize(1);
  const auto paths = runFlameEnsemble(MPI_COMM_SELF, gas, options);
  const auto kind = painted()(0);
  const FlameExchange exchange = exchangeOf(mechanism, *kind, profile, paths);
  const auto enthalpies = elementEnthalpies(kind->elements());
  ASSERT_TRUE(enthalpies.has_value());
  const GivenExchange given = relaxed({}, profile, *enthalpies, exchange, FlameExchange(profile.z, n, 1), 1.0);
  const auto integral = [&](const auto& value) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < 3; ++i) sum += 0.5 * (value(i) + value(i + 1)) * (profile.z[i + 1] - profile.z[i]);
    return sum;
  };
  const std::size_t acetylene = mechanism.speciesIndex("C2H2");
  const double gained = speed * (paths[0].content[0] - 12.0 * TwoColours::eachNumber * TwoColours::carbonAtStart);
  EXPECT_GT(gained, 0.0);
  EXPECT_NEAR(-integral([&](std::size_t i) { return given.species[i * n + acetylene]; }) /
                  (gained * mechanism.molecularWeights()[acetylene] / perMole()),
              1.0, 1e-12);
  EXPECT_NEAR(integral([&](std::size_t i) { return given.enthalpy[i]; }) / (-gained * (*enthalpies)[0](1500.0).first),
              1.0, 1e-12);
}

}  // namespace
}  // namespace lampblack::test
