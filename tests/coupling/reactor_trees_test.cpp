// Trees of primaries in a closed reactor: atoms of gas and particles, and what a mechanism has to have.
#include "coupling/reactor_trees.hpp"

#include <gtest/gtest.h>

#include "chemistry/reactor/closed_reactor.hpp"
#include "core/errors.hpp"
#include "coupling/reactor_balance.hpp"
#include "tests/coupling/toy_particles.hpp"

namespace lampblack::coupling {
namespace {

const Mechanism& siliconMechanism() {
  static const Mechanism mechanism = Mechanism::fromFile(test::sourcePath("cases/mechanisms/silica_teos_29.yaml"));
  return mechanism;
}

TreeOptions treeOptions() {
  TreeOptions options;
  options.material = silica();
  options.particles = 500;
  options.fullAt = 2e19;
  return options;
}

std::string messageOf(const Mechanism& mechanism, const TreeOptions& options) {
  try {
    const ReactorTrees trees(mechanism, options, GasViscosity::air, std::nullopt);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ReactorTrees, KeepsSiliconOxygenAndHydrogenToRoundOff) {
  const Mechanism& mechanism = siliconMechanism();
  const std::size_t n = mechanism.numSpecies();
  const GasState gas = test::gasOf(mechanism, 1173, "C8H20O4SI: 5e-5, N2: 0.99995");
  for (const auto held : {ReactorSystem::Held::Pressure, ReactorSystem::Held::Density}) {
    ReactorTrees trees(mechanism, treeOptions(), GasViscosity::air, std::nullopt);
    ParticlesAtRest atRest(1, trees.elements());
    ClosedReactor reactor(mechanism, gas, held, TemperatureProfile(1173), &atRest);
    SplitReactor::Gas own;
    own.system = &reactor;
    own.density = [&](const double* y) { return reactor.density(y); };
    own.pressure = [&](const double* y) { return reactor.pressure(y); };
    own.timePerUnit = [](const double*) { return 1.0; };
    own.kept = {SplitReactor::Gas::Kept::temperature};
    SplitReactor::Options options;
    options.integrator = {1e-6, 1e-14, 0, 1000000};
    options.change = 0.2;
    SplitReactor split(mechanism, own, trees, options);
    ReactorBalance balance(mechanism, atRest, atRest.unitElements(mechanism));
    const std::vector<double> start = reactor.initialState();
    split.start(0, start);
    split.advance(0.02);
    const auto y = split.state();
    const auto elements = [&](std::span<const double> at) {
      return balance.elements(at.first(n), at.subspan(n + 1, atRest.size()));
    };
    EXPECT_LT(largestImbalance(elements(start), elements(y)), 1e-13);
    // Most of the silicon is in particles by then, and the sample has what was booked.
    const std::size_t silicon = mechanism.elementIndex("Si");
    const auto at = static_cast<std::size_t>(std::find(trees.elements().begin(), trees.elements().end(), "Si") -
                                             trees.elements().begin());
    EXPECT_GT(y[n + 1 + at], 0.5 * elements(start)[silicon]);
    ASSERT_EQ(trees.population().counters().removals, 0U);
    const double booked = reactor.density(y.data()) * y[n + 1 + at] / mechanism.atomicWeight(silicon);
    EXPECT_NEAR(trees.population().totals().units[0] / (booked * constants::avogadro), 1, 1e-6);
  }
}

TEST(ReactorTrees, AMechanismWithoutThePrecursorSaysSo) {
  EXPECT_NE(messageOf(test::ethylene(), treeOptions()).find("'H4O4SI'"), std::string::npos);
  EXPECT_EQ(messageOf(siliconMechanism(), treeOptions()), "");
}

TEST(ReactorTrees, AProcessThatMakesAtomsIsRefused) {
  TreeOptions options = treeOptions();
  options.material.siteReactions().nucleus = {2, 2, 6};
  EXPECT_NE(messageOf(siliconMechanism(), options).find("inception makes 1 atoms of O"), std::string::npos)
      << messageOf(siliconMechanism(), options);
}

}  // namespace
}  // namespace lampblack::coupling
