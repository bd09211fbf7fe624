// Reactors in lanes against the same steps one by one, and against each other in other company.
#include "chemistry/reactor/reactor_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "chemistry/reactor/reactor_rosenbrock.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::measured;
using lampblack::test::shipped;
using Instructions = BatchKinetics::Instructions;
using Outcome = ReactorLanes::Reactor::Outcome;

constexpr ReactorLanes::Tolerance kTolerance{1e-6, 1e-12, 40};
constexpr double kLeastFraction = -1e-10;

std::vector<Instructions> available() {
  std::vector<Instructions> result;
  for (const auto i : {Instructions::Generic, Instructions::Avx2, Instructions::Avx512})
    if (BatchKinetics::available(i)) result.push_back(i);
  return result;
}

// Fuel and air on their way to equilibrium, as cells of a flow: some without a source, some with one that balances most
// of the reactions, heated or not, at several pressures, with first steps of their own.
struct Reactors {
  std::vector<std::vector<double>> states, sources;
  std::vector<ReactorLanes::Reactor> list;

  Reactors(const Mechanism& mechanism, const std::string& mixture, std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform;
    const std::size_t n = mechanism.numSpecies();
    std::vector<double> fresh(n);
    Thermo(mechanism).moleToMass(parseComposition(mechanism, mixture), fresh);
    ReactorSystem system(mechanism);
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<double> y = fresh;
      double sum = 0;
      for (double& value : y) sum += value += 1e-6 * std::pow(10.0, -8 * uniform(random));
      for (double& value : y) value /= sum;
      if (i % 7 == 6)  // as transport may leave what is scarce
        for (double& value : y) value = value < 1e-5 ? -value : value;
      y.push_back(400 + 2000 * uniform(random));
      ReactorLanes::Reactor reactor;
      reactor.pressure = constants::oneAtmosphere * std::pow(10.0, uniform(random) - 0.5);
      reactor.heating = i % 3 == 0 ? 1e7 * uniform(random) : 0;
      reactor.duration = 1e-5;
      reactor.firstStep = i % 4 == 0 ? 1e-6 : 0;
      system.setConditions(reactor.pressure, {});
      std::vector<double> source(n + 1);
      system.chemicalRates(y.data(), source.data());
      source.pop_back();
      for (double& value : source) value *= -(1 - 1e-4 * uniform(random));
      states.push_back(y);
      sources.push_back(i % 5 == 4 ? std::vector<double>() : source);
      list.push_back(reactor);
    }
    connect();
  }
  Reactors(const Reactors& other) : states(other.states), sources(other.sources), list(other.list) { connect(); }
  Reactors& operator=(const Reactors&) = delete;

  void connect() {
    for (std::size_t i = 0; i < list.size(); ++i) {
      list[i].state = states[i];
      list[i].source = sources[i];
    }
  }
};

class EveryKindOfLanes : public testing::TestWithParam<Instructions> {};
INSTANTIATE_TEST_SUITE_P(Instructions, EveryKindOfLanes, testing::ValuesIn(available()),
                         [](const auto& kind) { return std::to_string(static_cast<int>(kind.param)); });

// They differ by round-off in k1..k4, magnified by the stiffness of the matrix: measured below 1e-4 of the tolerance.
TEST_P(EveryKindOfLanes, TakeTheStepsOfTheScalarMethod) {
  struct Case {
    const char *mechanism, *mixture;
  };
  for (const auto& [name, mixture] :
       {Case{"hydrogen_h2o2_10", "H2: 2, O2: 1, N2: 3.76"}, Case{"methane_drm19_21", "CH4: 1, O2: 2, N2: 7.52"},
        Case{"ethylene_bisetti2012_47", "C2H4: 1, O2: 2, N2: 7.52"},
        Case{"methane_gri30_53", "CH4: 1, O2: 2, N2: 7.52"}}) {
    const auto mechanism = shipped(name);
    const std::size_t n = mechanism.numSpecies();
    Reactors reactors(mechanism, mixture, 61), scalar(reactors);
    ReactorLanes lanes(mechanism, kLeastFraction, GetParam());
    lanes.advance(reactors.list, kTolerance);
    ReactorSystem system(mechanism, nullptr, kLeastFraction);
    ReactorRosenbrock rosenbrock(system);
    double worst = 0;
    int arrived = 0, left = 0;
    for (std::size_t i = 0; i < reactors.list.size(); ++i) {
      const auto& reactor = reactors.list[i];
      system.setConditions(reactor.pressure, reactor.source, reactor.heating);
      ReactorIntegrator::Work work;
      const bool does = rosenbrock.advance(
          {reactor.duration, reactor.firstStep, kTolerance.relative, kTolerance.absolute, kTolerance.maximumSteps},
          scalar.states[i], work);
      if (reactor.outcome == Outcome::Left) {  // on the way to a temperature outside the range of its data
        ++left;
        continue;
      }
      ASSERT_EQ(reactor.outcome == Outcome::Arrived, does) << name << " " << i;
      EXPECT_EQ(reactor.steps, work.steps) << name << " " << i;
      EXPECT_NEAR(reactor.nextStep, rosenbrock.nextStep(), 1e-4 * rosenbrock.nextStep()) << name << " " << i;
      if (!does) continue;
      ++arrived;
      for (std::size_t k = 0; k <= n; ++k) {
        const double expected = scalar.states[i][k],
                     smallest = k == n ? 1.0 : kTolerance.absolute / kTolerance.relative;
        const double size = kTolerance.relative * (std::abs(expected) + smallest);
        worst = std::max(worst, std::abs(reactors.states[i][k] - expected) / size);
      }
    }
    EXPECT_GT(arrived, 20) << name;
    EXPECT_LT(left, 10) << name;
    EXPECT_LT(worst, 1e-3) << name;
    measured("reactors in lanes against one by one, of the tolerance", worst);
  }
}

// To the last bit, alone or among others, in any order, beside states that are none.
TEST_P(EveryKindOfLanes, DoNotFeelTheirNeighbours) {
  const auto mechanism = shipped("methane_drm19_21");
  Reactors together(mechanism, "CH4: 1, O2: 2, N2: 7.52", 29), apart(together), mixed(together);
  ReactorLanes lanes(mechanism, kLeastFraction, GetParam());
  lanes.advance(together.list, kTolerance);
  for (auto& reactor : apart.list) lanes.advance({&reactor, 1}, kTolerance);
  std::vector<std::vector<double>> bad(29, std::vector<double>(mechanism.numSpecies() + 1, std::nan("")));
  std::vector<ReactorLanes::Reactor> shuffled;
  for (std::size_t i = mixed.list.size(); i-- > 0;) {
    shuffled.push_back(mixed.list[i]);
    shuffled.push_back(mixed.list[i]);
    shuffled.back().state = bad[i];
    if (i % 2 == 0) std::fill(bad[i].begin(), bad[i].end(), i % 4 == 0 ? 0.0 : 1e300);
  }
  lanes.advance(shuffled, kTolerance);
  int several = 0;
  for (std::size_t i = 0; i < together.list.size(); ++i) {
    const auto& other = shuffled[2 * (together.list.size() - 1 - i)];
    EXPECT_EQ(shuffled[2 * i + 1].outcome, Outcome::Left);
    for (const ReactorLanes::Reactor* reactor : {&std::as_const(apart.list[i]), &other}) {
      EXPECT_EQ(reactor->outcome, together.list[i].outcome);
      EXPECT_EQ(reactor->steps, together.list[i].steps);
      EXPECT_EQ(reactor->rejected, together.list[i].rejected);
      EXPECT_EQ(reactor->nextStep, together.list[i].nextStep);
    }
    EXPECT_EQ(apart.states[i], together.states[i]);
    EXPECT_EQ(mixed.states[i], together.states[i]);
    several += together.list[i].steps > 1;
  }
  EXPECT_GT(several, 5);
}

// Too cold for products of rates: for the scalar method, with the state as it was.
TEST_P(EveryKindOfLanes, LeaveWhatTheyCannotDo) {
  const auto mechanism = shipped("silica_teos_29");
  Reactors reactors(mechanism, "H2O: 1, N2: 9", 3);
  reactors.states[1].back() = 300;
  const auto start = reactors.states[1];
  ReactorLanes lanes(mechanism, kLeastFraction, GetParam());
  lanes.advance(reactors.list, kTolerance);
  EXPECT_EQ(reactors.list[0].outcome, Outcome::Arrived);
  EXPECT_EQ(reactors.list[1].outcome, Outcome::Left);
  EXPECT_EQ(reactors.list[2].outcome, Outcome::Arrived);
  EXPECT_EQ(reactors.states[1], start);
}

TEST_P(EveryKindOfLanes, StopWhereTheStepsAreTooMany) {
  const auto mechanism = shipped("hydrogen_h2o2_10");
  Reactors reactors(mechanism, "H2: 2, O2: 1, N2: 3.76", 9);
  for (auto& reactor : reactors.list) {
    reactor.firstStep = 1e-8;
    reactor.source = {};
  }
  const auto start = reactors.states;
  ReactorLanes lanes(mechanism, kLeastFraction, GetParam());
  lanes.advance(reactors.list, {1e-6, 1e-12, 3});
  for (const auto& reactor : reactors.list) {
    EXPECT_EQ(reactor.outcome, Outcome::TooManySteps);
    EXPECT_EQ(reactor.steps + reactor.rejected, 3);
  }
  EXPECT_EQ(reactors.states, start);
}

TEST_P(EveryKindOfLanes, GiveTheLargestChemicalRate) {
  const auto mechanism = shipped("methane_drm19_21");
  const std::size_t n = mechanism.numSpecies();
  Reactors reactors(mechanism, "CH4: 1, O2: 2, N2: 7.52", 19);
  reactors.states[4].back() = 190;   // rates from logarithms
  reactors.states[7].back() = -1.0;  // none
  ReactorLanes lanes(mechanism, kLeastFraction, GetParam());
  std::vector<double> largest(19), f(n + 1);
  lanes.largestChemicalRates(reactors.list, largest);
  ReactorSystem system(mechanism, nullptr, kLeastFraction);
  for (std::size_t i = 0; i < 19; ++i) {
    system.setConditions(reactors.list[i].pressure, {});
    if (!system.chemicalRates(reactors.states[i].data(), f.data())) {
      EXPECT_TRUE(std::isnan(largest[i])) << i;
      continue;
    }
    double expected = 0;
    for (std::size_t k = 0; k < n; ++k) expected = std::max(expected, std::abs(f[k]));
    EXPECT_NEAR(largest[i], expected, 1e-10 * expected) << i;
  }
  EXPECT_TRUE(std::isnan(largest[7]));
}

}  // namespace
