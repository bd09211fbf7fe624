// Ignition delays against Cantera, their independence of the steps, and their sensitivities against repeated runs and
// an exact sum.
#include "chemistry/reactor/ignition.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/ignition_sensitivity.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::hydrogen;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::readText;
using lampblack::test::sourcePath;
using Held = ReactorSystem::Held;
using Kind = IgnitionCriterion::Kind;

const StiffIntegrator::Options kDefault{};

GasState mixture(const Mechanism& mechanism, const char* X, double T) {
  GasState state{T, constants::oneAtmosphere, std::vector<double>(mechanism.numSpecies())};
  Thermo(mechanism).moleToMass(parseComposition(mechanism, X), state.Y);
  return state;
}

std::vector<IgnitionCriterion> allCriteria(const Mechanism& mechanism) {
  const std::size_t OH = mechanism.speciesIndex("OH");
  return {{Kind::TemperatureRate, 0, 0.0, "max_dTdt"},
          {Kind::MoleFraction, OH, 0.0, "max_X_OH"},
          {Kind::MassFraction, OH, 0.0, "max_Y_OH"},
          {Kind::TemperatureRise, 0, 400.0, "rise_400K"},
          {Kind::PressureRate, 0, 0.0, "max_dpdt"}};
}

struct Run {
  std::vector<std::optional<IgnitionEvent>> events;
  double endTemperature = 0;
};

Run ignite(const Mechanism& mechanism, const GasState& state, double end, Held held = Held::Pressure,
           const StiffIntegrator::Options& options = kDefault, std::vector<IgnitionCriterion> criteria = {}) {
  ClosedReactor reactor(mechanism, state, held);
  StiffIntegrator integrator(reactor, options);
  if (criteria.empty()) criteria = allCriteria(mechanism);
  IgnitionMonitor monitor(mechanism, reactor, criteria);
  const auto start = reactor.initialState();
  integrator.start(0.0, start, end);
  monitor.begin(0.0, start.data());
  while (integrator.time() < end) {
    integrator.step();
    monitor.observe(integrator);
  }
  return {monitor.events(), integrator.state().back()};
}

// Cantera 3.2.0 at rtol 1e-10, atol 1e-18. Its delays by dT/dt and by OH are those of a step's end, so that at the flat
// maximum of OH they are as far off as the steps are apart; the rise is interpolated.
struct IgnitionRow {
  const char* mechanism;
  const char* mixture;
  double T, end;
  double dTdt, rise, largestY, endTemperature;
  double resolution;  // of largestY
};

class IgnitionReference : public ::testing::TestWithParam<IgnitionRow> {};

TEST_P(IgnitionReference, DelaysAndEndTemperatureAreCanteras) {
  const IgnitionRow& reference = GetParam();
  const auto mechanism = Mechanism::fromFile(sourcePath(std::string("cases/mechanisms/") + reference.mechanism));
  const auto run = ignite(mechanism, mixture(mechanism, reference.mixture, reference.T), reference.end);
  for (const auto& event : run.events) ASSERT_TRUE(event);
  measured("largest dT/dt, relative", run.events[0]->time / reference.dTdt - 1);
  measured("largest mass fraction of OH, relative", run.events[2]->time / reference.largestY - 1);
  measured("rise by 400 K, relative", run.events[3]->time / reference.rise - 1);
  measured("end temperature, K", run.endTemperature - reference.endTemperature);
  EXPECT_NEAR(run.events[0]->time / reference.dTdt, 1, 2e-6);
  EXPECT_NEAR(run.events[2]->time / reference.largestY, 1, reference.resolution);
  EXPECT_NEAR(run.events[3]->time / reference.rise, 1, 2e-6);
  EXPECT_NEAR(run.endTemperature, reference.endTemperature, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Cantera, IgnitionReference,
                         ::testing::Values(IgnitionRow{"hydrogen_h2o2_10.yaml", "H2: 2, O2: 1, N2: 3.76", 1200,
                                                       2.128889684e-3, 4.533140061231591e-05, 4.670195131454844e-05,
                                                       9.830949901908176e-05, 2763.319735151931, 1e-4},
                                           IgnitionRow{"methane_gri30_53.yaml", "CH4: 1, O2: 2, N2: 7.52", 1400,
                                                       0.105422582554969, 0.003437526306525981, 0.003424685936341753,
                                                       0.003464835657555304, 2697.8832325, 1e-5}),
                         [](const auto& test) { return std::string(test.param.mechanism).substr(0, 7); });

// The delay is found inside the steps: loose and tight steps agree to their tolerances, and a step that is a hundredth
// of the default changes nothing.
TEST(Ignition, DelayDoesNotDependOnTheSteps) {
  const GasState state = mixture(hydrogen(), "H2: 2, O2: 1, N2: 3.76", 1200);
  const auto free = ignite(hydrogen(), state, 2e-4);
  const auto fine = ignite(hydrogen(), state, 2e-4, Held::Pressure, {1e-9, 1e-15, 2e-8, 1000000});
  for (std::size_t i = 0; i < free.events.size(); ++i) {
    measured(allCriteria(hydrogen())[i].name, free.events[i]->time / fine.events[i]->time - 1);
    EXPECT_NEAR(free.events[i]->time / fine.events[i]->time, 1, 1e-6) << i;
  }
}

// The largest rate of the reactor's own pressure, by a parabola through differences.
TEST(Ignition, ThePressureRisesFastestWhereItIsSaid) {
  const GasState state = mixture(hydrogen(), "H2: 2, O2: 1, N2: 3.76", 1200);
  ClosedReactor reactor(hydrogen(), state, Held::Density);
  const double scale = reactor.density(0, reactor.initialState().data()) * constants::gasConstant;
  const auto run = ignite(hydrogen(), state, 2e-4, Held::Density, kDefault,
                          {{.kind = Kind::PressureRate, .name = "max_dpdt", .scale = scale}});
  ASSERT_TRUE(run.events[0]);
  const double tau = run.events[0]->time, spacing = 0.02 * run.events[0]->width;
  StiffIntegrator integrator(reactor, {1e-10, 1e-18, 0.0, 1000000});
  integrator.start(0.0, reactor.initialState(), 2e-4);
  std::vector<double> pressure, y(reactor.size());
  for (int i = -2; i <= 2; ++i) {
    while (integrator.time() < tau + i * spacing) integrator.step();
    integrator.interpolate(tau + i * spacing, y);
    pressure.push_back(reactor.pressure(0, y.data()));
  }
  const double before = (pressure[1] - pressure[0]) / spacing, after = (pressure[4] - pressure[3]) / spacing;
  const double middle = (pressure[3] - pressure[1]) / (2 * spacing);
  EXPECT_NEAR(run.events[0]->value / middle, 1, 1e-3);
  EXPECT_GT(middle, before);
  EXPECT_GT(middle, after);
  const double place = 1.5 * spacing * 0.5 * (before - after) / (before - 2 * middle + after);
  EXPECT_NEAR(place / run.events[0]->width, 0, 2e-3) << "away from the top of the parabola";
}

// Two autocatalytic reactions of constant rate, the slower one with more heat: each is fastest when half of it is done,
// at ln(A/P)/(k (A + P)) with the first concentrations.
TEST(Ignition, TheFirstStageIsTheEarlierMaximum) {
  const auto species = [](const char* name, int heat) {
    return fmt::format(
        "\n- {{name: {}, composition: {{N: 2}}, thermo: {{model: NASA7, temperature-ranges: [200, 6000], "
        "data: [[3.5, 0, 0, 0, 0, {}, 4]]}}}}",
        name, -900 - heat);
  };
  const Mechanism mechanism =
      readText("species: [I, A, P, C, Q]",
               species("I", 0) + species("A", 0) + species("P", 2000) + species("C", 0) + species("Q", 8000),
               "- {equation: A + P => 2 P, rate-constant: {A: 9e9, b: 0, Ea: 0}}\n"
               "  - {equation: C + Q => 2 Q, rate-constant: {A: 4.5e8, b: 0, Ea: 0}}");
  const std::vector<IgnitionCriterion> criteria{
      {.kind = Kind::TemperatureRate, .name = "first_stage", .firstStage = true},
      {.kind = Kind::TemperatureRate, .name = "max_dTdt"}};
  const GasState both = mixture(mechanism, "I: 0.75, A: 0.05, P: 5e-5, C: 0.2, Q: 2e-4", 800);
  const double concentration = constants::oneAtmosphere / (constants::gasConstant * 800);
  const auto run = ignite(mechanism, both, 0.02, Held::Density, kDefault, criteria);
  ASSERT_TRUE(run.events[0] && run.events[1]);
  const double total = 1.00025;  // of the amounts above
  // The second, which has begun, moves the top of the sum by 0.3 %.
  EXPECT_NEAR(run.events[0]->time, std::log(1000) / (9e3 * concentration * 0.05005 / total),
              5e-3 * run.events[0]->time);
  EXPECT_NEAR(run.events[1]->time, std::log(1000) / (450 * concentration * 0.2002 / total), 1e-3 * run.events[1]->time);
  EXPECT_LT(run.events[0]->value, run.events[1]->value);
  // A single stage, or one that is followed by a lower one, is the ignition itself.
  for (const char* one : {"I: 0.8, C: 0.2, Q: 2e-4", "I: 0.95, A: 0.5, P: 5e-4, C: 0.02, Q: 2e-5"}) {
    const auto single = ignite(mechanism, mixture(mechanism, one, 800), 0.1, Held::Density, kDefault, criteria);
    EXPECT_FALSE(single.events[0]) << one;
    EXPECT_TRUE(single.events[1]) << one;
  }
}

TEST(Ignition, AMixtureThatDoesNotIgniteHasNoDelay) {
  const auto run = ignite(hydrogen(), mixture(hydrogen(), "H2: 2, O2: 1, N2: 3.76", 700), 1e-4);
  for (const auto& event : run.events) EXPECT_FALSE(event);
}

Mechanism withFasterReaction(const Mechanism& mechanism, std::size_t r, double factor) {
  std::vector<Element> elements;
  for (std::size_t i = 0; i < mechanism.numElements(); ++i)
    elements.push_back({mechanism.elementName(i), mechanism.atomicWeight(i)});
  std::vector<Reaction> reactions(mechanism.reactions().begin(), mechanism.reactions().end());
  reactions[r].rate.A *= factor;
  reactions[r].lowPressureRate.A *= factor;
  return {
      mechanism.fileName(), "", elements, {mechanism.allSpecies().begin(), mechanism.allSpecies().end()}, reactions};
}

class IgnitionSensitivity : public ::testing::TestWithParam<Held> {};

// Central differences of delays with a rate constant 0.5 % up and down: their own error is of the square of that, and
// 1e-8 of the delays over 1e-2.
TEST_P(IgnitionSensitivity, MatchesRepeatedRuns) {
  const GasState state = mixture(hydrogen(), "H2: 2, O2: 1, N2: 3.76", 1200);
  const auto criteria = allCriteria(hydrogen());
  const auto run = ignite(hydrogen(), state, 4e-4, GetParam());
  ClosedReactor reactor(hydrogen(), state, GetParam());
  const std::vector<std::size_t> reactions{2, 5, 7, 10, 14, 16, 20, 21};  // fall-off, third bodies, chain branching
  reactor.setParameters(reactions);
  const auto sensitivities = ignitionSensitivities(hydrogen(), reactor, kDefault, criteria, run.events);
  double worst = 0;
  for (std::size_t p = 0; p < reactions.size(); ++p) {
    const double factor = 1.005;
    const auto up = ignite(withFasterReaction(hydrogen(), reactions[p], factor), state, 4e-4, GetParam());
    const auto down = ignite(withFasterReaction(hydrogen(), reactions[p], 1 / factor), state, 4e-4, GetParam());
    for (std::size_t i = 0; i < criteria.size(); ++i) {
      const double difference = std::log(up.events[i]->time / down.events[i]->time) / (2 * std::log(factor));
      raise(worst, sensitivities.values[i][p] - difference);
      EXPECT_NEAR(sensitivities.values[i][p], difference, 0.002 * std::abs(difference) + 2e-4)
          << criteria[i].name << " " << hydrogen().reaction(reactions[p]).equation;
    }
  }
  measured("largest difference of d ln tau/d ln k", worst);
}

// All reactions slowed down alike stretch time: the sensitivities add up to -1.
// A run that is asked to stop does not wait until the sensitivities are complete.
TEST(IgnitionSensitivities, EndWhereTheyAreToldTo) {
  const GasState state = mixture(hydrogen(), "H2: 2, O2: 1, N2: 3.76", 1200);
  const auto criteria = allCriteria(hydrogen());
  const auto run = ignite(hydrogen(), state, 4e-4, Held::Pressure);
  ClosedReactor reactor(hydrogen(), state, Held::Pressure);
  reactor.setParameters({2, 5});
  int steps = 0;
  const auto sensitivities =
      ignitionSensitivities(hydrogen(), reactor, kDefault, criteria, run.events, [&](double time, double end) {
        EXPECT_LT(time, end);
        return ++steps < 10;
      });
  EXPECT_EQ(steps, 10);
  for (const auto& values : sensitivities.values) EXPECT_TRUE(values.empty());
}

TEST_P(IgnitionSensitivity, AddsUpToMinusOne) {
  const GasState state = mixture(hydrogen(), "H2: 1, O2: 1, N2: 3.76", 1100);
  const auto criteria = allCriteria(hydrogen());
  const auto run = ignite(hydrogen(), state, 1e-3, GetParam());
  ClosedReactor reactor(hydrogen(), state, GetParam());
  std::vector<std::size_t> reactions;
  for (std::size_t r = 0; r < hydrogen().numReactions(); ++r) reactions.push_back(r);
  reactor.setParameters(reactions);
  const auto sensitivities = ignitionSensitivities(hydrogen(), reactor, kDefault, criteria, run.events);
  for (std::size_t i = 0; i < criteria.size(); ++i) {
    ASSERT_TRUE(run.events[i]) << criteria[i].name;
    double sum = 0;
    for (const double value : sensitivities.values[i]) sum += value;
    measured(criteria[i].name + ", sum + 1", sum + 1);
    EXPECT_NEAR(sum, -1, 2e-3) << criteria[i].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Held, IgnitionSensitivity, ::testing::Values(Held::Pressure, Held::Density),
                         [](const auto& test) { return test.param == Held::Pressure ? "Pressure" : "Volume"; });

}  // namespace
