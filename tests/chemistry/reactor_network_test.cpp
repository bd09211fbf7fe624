// Stirred reactors, networks and plug flow against exact solutions; their Jacobians against finite differences.
#include "chemistry/reactor/reactor_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/reactor/network_solver.hpp"
#include "chemistry/reactor/plug_flow.hpp"
#include "chemistry/reactor/steady_state.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"
#include "tests/source_folder.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::hydrogen;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::readText;

constexpr double kAtm = constants::oneAtmosphere;
constexpr double kRate = 1000;  // 1/s

const NetworkStart kFresh{false};

// A => B of first order; both weigh the same, so that volumes stay.
const Mechanism& firstOrder() {
  static const Mechanism mechanism = readText(
      "species: [A, B]", "\n- {name: A, composition: {N: 2}, thermo: *t}\n- {name: B, composition: {N: 2}, thermo: *t}",
      "- {equation: A => B, rate-constant: {A: 1000, b: 0, Ea: 0}}");
  return mechanism;
}

GasState hydrogenAir(double T, const char* X = "H2: 2, O2: 1, N2: 3.76") {
  GasState state{T, kAtm, std::vector<double>(hydrogen().numSpecies())};
  Thermo(hydrogen()).moleToMass(parseComposition(hydrogen(), X), state.Y);
  return state;
}

StirredReactor vessel(std::string name, double volume) {
  StirredReactor reactor;
  reactor.name = std::move(name);
  reactor.volume = volume;
  return reactor;
}

// Three reactors with a recycle, heat loss, a given temperature and a given residence time.
ReactorNetwork recycling() {
  ReactorNetwork network{kAtm, {vessel("a", 1e-5), vessel("b", 3e-5), vessel("c", 0)}, {}, {}};
  network.reactors[1].conductance = 0.05;
  network.reactors[1].surroundings = 400;
  network.reactors[2].volume.reset();
  network.reactors[2].residenceTime = 2e-3;
  const GasState feed = hydrogenAir(600), air = hydrogenAir(300, "O2: 1, N2: 3.76");
  network.inflows = {{0, 1e-3, feed.temperature, feed.Y}, {1, 2e-4, air.temperature, air.Y}};
  network.streams = {{0, 1, 1.5e-3}, {1, 0, 5e-4}, {1, 2, 1.2e-3}};
  return network;
}

// Largest difference of an analytic Jacobian from central differences, in units of the row's scale.
double jacobianError(OdeSystem& system, const std::vector<double>& y, const std::vector<double>& steps) {
  const std::size_t n = system.size();
  std::vector<double> f(n), J(n * n), up(n), down(n);
  EXPECT_TRUE(system.jacobian(0.0, y.data(), f.data(), J.data(), n));
  double worst = 0;
  for (std::size_t j = 0; j < n; ++j) {
    auto moved = y;
    moved[j] = y[j] + steps[j];
    EXPECT_TRUE(system.rates(0.0, moved.data(), up.data()));
    moved[j] = y[j] - steps[j];
    EXPECT_TRUE(system.rates(0.0, moved.data(), down.data()));
    double scale = 1e-300;
    for (std::size_t i = 0; i < n; ++i) scale = std::max(scale, std::abs(J[i + j * n]));
    for (std::size_t i = 0; i < n; ++i) raise(worst, (J[i + j * n] - (up[i] - down[i]) / (2 * steps[j])) / scale);
  }
  return worst;
}

std::vector<double> burningState(const NetworkSystem& system) {
  std::vector<double> y;
  const double temperatures[] = {1500, 1900, 1100};
  for (std::size_t r = 0; r < system.network().reactors.size(); ++r) {
    GasState gas = hydrogenAir(temperatures[r], "H2: 1, O2: 1, N2: 3.76, H2O: 1, OH: 0.1, H: 0.1, O: 0.05, HO2: 0.01");
    y.insert(y.end(), gas.Y.begin(), gas.Y.end());
    y.push_back(gas.temperature);
  }
  return y;
}

// Central differences with steps of 1e-5: truncation and round-off below 1e-7 of the largest entry of a column.
TEST(NetworkSystem, JacobianIsTheDerivative) {
  for (const bool given : {false, true}) {
    ReactorNetwork network = recycling();
    if (given) network.reactors[0].temperature = 1500;
    NetworkSystem system(hydrogen(), network);
    const auto y = burningState(system);
    std::vector<double> steps;
    for (std::size_t i = 0; i < y.size(); ++i) steps.push_back((i + 1) % system.blockSize() == 0 ? 1e-2 : 1e-6);
    const double error = jacobianError(system, y, steps);
    measured("difference from central differences", error);
    EXPECT_LT(error, 1e-6);
  }
}

// W/m^3: of the rates by themselves, - sum h_k W_k wdot_k.
TEST(NetworkSystem, HeatReleaseIsThatOfTheRatesPerVolume) {
  NetworkSystem system(hydrogen(), recycling());
  const std::size_t n = hydrogen().numSpecies();
  const GasState gas = hydrogenAir(1500, "H2: 2, O2: 1, N2: 3.76, H: 0.01, OH: 0.01");
  std::vector<double> y;
  for (int r = 0; r < 3; ++r) {
    y.insert(y.end(), gas.Y.begin(), gas.Y.end());
    y.push_back(gas.temperature);
  }
  const Thermo thermo(hydrogen());
  const double density = thermo.density(gas.temperature, kAtm, gas.Y);
  std::vector<double> concentrations(n), wdot(n), h(n);
  for (std::size_t k = 0; k < n; ++k) concentrations[k] = density * gas.Y[k] / hydrogen().molecularWeights()[k];
  Kinetics(hydrogen()).netProductionRates(gas.temperature, concentrations, wdot);
  thermo.speciesEnthalpies(gas.temperature, h);
  double expected = 0;
  for (std::size_t k = 0; k < n; ++k) expected -= h[k] * hydrogen().molecularWeights()[k] * wdot[k];
  for (std::size_t r = 0; r < 3; ++r) EXPECT_NEAR(system.heatRelease(y.data(), r) / expected, 1.0, 1e-12) << r;
}

TEST(PlugFlow, JacobianIsTheDerivative) {
  for (const bool given : {false, true}) {
    std::optional<TemperatureProfile> profile;
    if (given) profile = TemperatureProfile({-1, 1}, {1000, 2000});
    const GasState gas = hydrogenAir(1500, "H2: 1, O2: 1, N2: 3.76, H2O: 1, OH: 0.1, H: 0.1, O: 0.05, HO2: 0.01");
    PlugFlow flow(hydrogen(), gas, 2.0, 0.1, profile);
    std::vector<double> steps(flow.size(), 1e-6);
    steps[flow.size() - 2] = 1e-2;
    const double error = jacobianError(flow, flow.initialState(), steps);
    measured("difference from central differences", error);
    EXPECT_LT(error, 1e-6);
  }
}

// 1/(1 + k tau), by volume and by residence time.
TEST(SteadyState, OfAStirredReactorOfFirstOrder) {
  const GasState feed{800, kAtm, {1, 0}};
  const double density = Thermo(firstOrder()).density(800, kAtm, feed.Y), massFlow = 1e-3;
  for (const double tau : {1e-5, 1e-3, 0.1}) {
    for (const bool byVolume : {true, false}) {
      ReactorNetwork network{kAtm, {vessel("r", tau * massFlow / density)}, {{0, massFlow, 800, feed.Y}}, {}};
      network.reactors[0].temperature = 800;
      if (!byVolume) {
        network.reactors[0].volume.reset();
        network.reactors[0].residenceTime = tau;
      }
      const auto result = solveNetwork(firstOrder(), network, kFresh);
      const double exact = 1 / (1 + kRate * tau);
      measured("relative error", result[0].state.Y[0] / exact - 1);
      EXPECT_NEAR(result[0].state.Y[0] / exact, 1, 1e-10);
      EXPECT_NEAR(result[0].residenceTime / tau, 1, 1e-10);
      EXPECT_NEAR(result[0].volume / (tau * massFlow / density), 1, 1e-10);
    }
  }
}

// N reactors in a row: (1 + k tau/N)^-N.
TEST(SteadyState, OfReactorsInARow) {
  const std::size_t count = 10;
  ReactorNetwork network{kAtm, {}, {{0, 1.0, 700, {1, 0}}}, {}};
  const double tau = 3e-3;
  for (std::size_t i = 0; i < count; ++i) {
    StirredReactor reactor;
    reactor.name = std::to_string(i);
    reactor.residenceTime = tau / count;
    network.reactors.push_back(reactor);
    if (i > 0) network.streams.push_back({i - 1, i, 1.0});
  }
  EXPECT_EQ(solutionOrder(network).size(), count);
  const auto result = solveNetwork(firstOrder(), network, kFresh);
  const double exact = std::pow(1 + kRate * tau / count, -static_cast<double>(count));
  measured("relative error", result.back().state.Y[0] / exact - 1);
  EXPECT_NEAR(result.back().state.Y[0] / exact, 1, 1e-9);
  // Both species have the same enthalpy: the adiabatic reactors keep the temperature.
  EXPECT_NEAR(result.back().state.temperature, 700, 1e-8);
}

// Two reactors, R of the outflow of the second back to the first: Y1 = (1 + R Y2)/(1 + R + Da), Y2 = (1 + R) Y1/(1 + R
// + Da), Da = k V rho/M.
TEST(SteadyState, OfARecycle) {
  const double R = 0.7, tau = 1e-3;
  ReactorNetwork network{kAtm, {vessel("a", 1), vessel("b", 1)}, {{0, 1.0, 900, {1, 0}}}, {{0, 1, 1 + R}, {1, 0, R}}};
  for (auto& reactor : network.reactors) {
    reactor.volume = tau / Thermo(firstOrder()).density(900, kAtm, std::vector<double>{1, 0});
    reactor.temperature = 900;
  }
  EXPECT_EQ(solutionOrder(network).size(), 1U);
  const auto result = solveNetwork(firstOrder(), network, kFresh);
  const double Da = kRate * tau, a = 1 + R + Da;
  const double first = 1 / (a - R * (1 + R) / a), second = (1 + R) * first / a;
  measured("relative error", result[1].state.Y[0] / second - 1);
  EXPECT_NEAR(result[0].state.Y[0] / first, 1, 1e-10);
  EXPECT_NEAR(result[1].state.Y[0] / second, 1, 1e-10);
}

// Burning hydrogen in the network with recycle and heat loss: elements and energy that come in go out.
TEST(SteadyState, ConservesElementsAndEnergy) {
  const ReactorNetwork network = recycling();
  const auto result = solveNetwork(hydrogen(), network, NetworkStart{});
  const Thermo thermo(hydrogen());
  EXPECT_GT(result[0].state.temperature, 1500);
  double heat = network.reactors[1].conductance * (result[1].state.temperature - network.reactors[1].surroundings);
  double inflowHeat = 0, outflow = 1.2e-3;
  std::vector<double> balance(hydrogen().numElements(), 0.0);
  const auto addElements = [&](double flow, const std::vector<double>& Y) {
    for (std::size_t i = 0; i < balance.size(); ++i)
      for (std::size_t k = 0; k < Y.size(); ++k)
        balance[i] +=
            flow * Y[k] / hydrogen().molecularWeights()[k] * hydrogen().atoms(k, i) * hydrogen().atomicWeight(i);
  };
  for (const auto& stream : network.inflows) {
    inflowHeat += stream.massFlow * thermo.enthalpyMass(stream.temperature, stream.Y);
    addElements(stream.massFlow, stream.Y);
  }
  const auto& last = result[2].state;
  addElements(-outflow, last.Y);
  heat += outflow * thermo.enthalpyMass(last.temperature, last.Y) - inflowHeat;
  measured("energy, of cp T of the outflow",
           heat / (outflow * thermo.cpMass(last.temperature, last.Y) * last.temperature));
  EXPECT_NEAR(heat, 0, 1e-9 * outflow * thermo.cpMass(last.temperature, last.Y) * last.temperature);
  double worst = 0;
  for (const double element : balance) raise(worst, element / outflow);
  measured("elements, mass fraction", worst);
  EXPECT_LT(worst, 1e-10);
}

// With hardly any time the burnt start blows out; with more and more it comes to the equilibrium at the enthalpy of the
// inflow, the distance falling with the residence time.
TEST(SteadyState, BlowsOutOrComesToEquilibrium) {
  const GasState feed = hydrogenAir(300);
  const GasState burnt = startOf(hydrogen(), {kAtm, {}, {{0, 1.0, 300, feed.Y}}, {}}, NetworkStart{});
  const auto temperatureAt = [&](double tau) {
    StirredReactor reactor;
    reactor.residenceTime = tau;
    return solveNetwork(hydrogen(), {kAtm, {reactor}, {{0, 1.0, 300, feed.Y}}, {}}, NetworkStart{})[0]
        .state.temperature;
  };
  EXPECT_NEAR(temperatureAt(1e-6), 300, 1e-6);
  double previous = 0;
  for (const double tau : {10.0, 1e3, 1e5}) {
    const double distance = burnt.temperature - temperatureAt(tau);
    measured("K short of equilibrium", distance);
    EXPECT_GT(distance, 0);
    if (previous > 0) {
      EXPECT_NEAR(previous / distance, 100, 2);
    }
    previous = distance;
  }
  EXPECT_LT(previous, 1e-5);
}

// Stoichiometric methane and air at 300 K and 1 atm. The temperatures are those of transients over 200 residence times,
// each from the state of the next longer time, of the residuals of which the rates of `lampblack gas` leave 1e-12; from
// the equilibrium of the inflow transients go out at 0.2 ms and less.
class MethaneReactor : public ::testing::Test {
 protected:
  static const Mechanism& methane() {
    static const Mechanism mechanism =
        Mechanism::fromFile(lampblack::test::sourcePath("cases/mechanisms/methane_gri30_53.yaml"));
    return mechanism;
  }
  static InflowStream feedTo(std::size_t reactor, const char* X = "CH4: 1, O2: 2, N2: 7.52", double T = 300) {
    InflowStream feed{reactor, 1.0, T, std::vector<double>(methane().numSpecies())};
    Thermo(methane()).moleToMass(parseComposition(methane(), X), feed.Y);
    return feed;
  }
  static StirredReactor lasting(double residenceTime) {
    StirredReactor reactor;
    reactor.residenceTime = residenceTime;
    return reactor;
  }
  static ReactorSteadyState alone(double residenceTime, const NetworkStart& start = {}) {
    return solveNetwork(methane(), {kAtm, {lasting(residenceTime)}, {feedTo(0)}, {}}, start)[0];
  }
  static constexpr double end_ = 7.93e-5;  // s, of the burning branch
};

TEST_F(MethaneReactor, BurnsAsLongAsThereIsABurningState) {
  for (const auto& [tau, T] : {std::pair{2e-4, 1857.25}, {1e-4, 1777.65}, {8e-5, 1724.58}}) {
    const ReactorSteadyState reactor = alone(tau);
    EXPECT_NEAR(reactor.state.temperature, T, 0.01);
    EXPECT_FALSE(reactor.out);
    EXPECT_FALSE(reactor.lastBurningTime);
  }
  // By its volume as by its residence time.
  const ReactorSteadyState given = alone(1e-4);
  const auto byVolume = solveNetwork(methane(), {kAtm, {vessel("", given.volume)}, {feedTo(0)}, {}}, {})[0];
  EXPECT_NEAR(byVolume.state.temperature, given.state.temperature, 1e-6);
}

TEST_F(MethaneReactor, IsOutWithTheLastBurningTimeBehindTheEndOfTheBranch) {
  for (const double tau : {7e-5, 1e-6}) {
    const ReactorSteadyState reactor = alone(tau);
    EXPECT_NEAR(reactor.state.temperature, 300, 0.01);
    EXPECT_TRUE(reactor.out);
    ASSERT_TRUE(reactor.lastBurningTime);
    EXPECT_NEAR(*reactor.lastBurningTime, end_, 0.01 * end_);
  }
}

// The branch of hydrogen ends below half the way to the equilibrium, where the transient from there arrives by itself.
TEST(HydrogenReactor, BurnsToTheSameEndFromEverywhere) {
  const GasState feed = hydrogenAir(300);
  const auto at = [&](double tau) {
    StirredReactor reactor;
    reactor.residenceTime = tau;
    return solveNetwork(hydrogen(), {kAtm, {reactor}, {{0, 1.0, 300, feed.Y}}, {}}, NetworkStart{})[0];
  };
  const ReactorSteadyState burning = at(1.6e-5), out = at(1.5e-5);
  EXPECT_NEAR(burning.state.temperature, 1303.48, 0.05);
  EXPECT_FALSE(burning.out);
  EXPECT_NEAR(out.state.temperature, 300, 0.01);
  EXPECT_TRUE(out.out);
  ASSERT_TRUE(out.lastBurningTime);
  EXPECT_GT(*out.lastBurningTime, 1.5e-5);
  EXPECT_LT(*out.lastBurningTime, 1.6e-5);
}

TEST_F(MethaneReactor, WhatIsAskedToStartOtherwiseDoes) {
  for (const NetworkStart& start : {NetworkStart{false}, NetworkStart{true, GasState{300, kAtm, feedTo(0).Y}}}) {
    const ReactorSteadyState reactor = alone(1e-3, start);
    EXPECT_NEAR(reactor.state.temperature, 300, 0.01);
    EXPECT_FALSE(reactor.out);
  }
}

TEST_F(MethaneReactor, WithNothingToGoOutIsNotOut) {
  EXPECT_FALSE(solveNetwork(methane(), {kAtm, {lasting(1e-8)}, {feedTo(0, "O2: 1, N2: 3.76")}, {}}, {})[0].out)
      << "air";
  StirredReactor cold = lasting(1e-4);
  cold.temperature = 400;
  EXPECT_FALSE(solveNetwork(methane(), {kAtm, {cold}, {feedTo(0)}, {}}, {})[0].out);
}

// A reaction of first order that sets heat free is the less complete the shorter the time is, without a jump.
TEST(SteadyState, ColdIsNotOutWhereNothingJumps) {
  const Mechanism mechanism = readText(
      "species: [A, B]",
      "\n- {name: A, composition: {N: 2}, thermo: *t}\n- {name: B, composition: {N: 2}, thermo: {model: NASA7, "
      "temperature-ranges: [200, 6000], data: [[3.5, 1e-4, 0, 0, 0, -2900, 4]]}}",
      "- {equation: A => B, rate-constant: {A: 1000, b: 0, Ea: 0}}");
  StirredReactor reactor;
  reactor.residenceTime = 1e-4;
  const ReactorNetwork network{kAtm, {reactor}, {{0, 1.0, 400, {1, 0}}}, {}};
  const ReactorSteadyState state = solveNetwork(mechanism, network, {})[0];
  EXPECT_FALSE(state.out);
  EXPECT_FALSE(state.lastBurningTime);
  EXPECT_NEAR(state.state.Y[1], 0.1 / 1.1, 1e-10);
  EXPECT_GT(state.state.temperature, 430);
}

// In a row each reactor is followed by itself; those of a recycle together, and two equal ones that feed each other are
// a single one.
TEST_F(MethaneReactor, BurnsInNetworks) {
  const auto row = solveNetwork(
      methane(), {kAtm, {lasting(1e-4), lasting(1e-3), lasting(1e-5)}, {feedTo(0)}, {{0, 1, 1.0}, {1, 2, 1.0}}}, {});
  EXPECT_NEAR(row[0].state.temperature, 1777.65, 0.01);
  EXPECT_GT(row[1].state.temperature, 2000);
  EXPECT_GT(row[2].state.temperature, 2000);
  const auto coldFirst =
      solveNetwork(methane(), {kAtm, {lasting(5e-5), lasting(1e-4)}, {feedTo(0)}, {{0, 1, 1.0}}}, {});
  EXPECT_TRUE(coldFirst[0].out);
  EXPECT_NEAR(*coldFirst[0].lastBurningTime, end_, 0.01 * end_);
  EXPECT_FALSE(coldFirst[1].out);
  EXPECT_NEAR(coldFirst[1].state.temperature, 1777.65, 0.1);
  // Of a recycle in which the first has too little time the second burns, with 5 % of what leaves it going back; in
  // four times larger reactors the first is out, or burns, too.
  for (const auto& [first, second] : {std::pair{2.5e-5, 1.2e-4}, {6e-5, 9e-5}}) {
    const ReactorNetwork recycle{kAtm, {lasting(first), lasting(second)}, {feedTo(0)}, {{0, 1, 1.05}, {1, 0, 0.05}}};
    const auto part = solveNetwork(methane(), recycle, {});
    EXPECT_TRUE(part[0].out);
    EXPECT_TRUE(part[0].lastBurningTime);
    EXPECT_LT(part[0].state.temperature, 600);
    EXPECT_FALSE(part[1].out);
    EXPECT_GT(part[1].state.temperature, 1700);
  }
  // 1 kg/s through each from outside and 1 kg/s to the other: twice the mass flow, half the time in each.
  const ReactorNetwork equal{kAtm, {lasting(5e-5), lasting(5e-5)}, {feedTo(0), feedTo(1)}, {{0, 1, 1.0}, {1, 0, 1.0}}};
  for (const ReactorSteadyState& reactor : solveNetwork(methane(), equal, {})) {
    EXPECT_NEAR(reactor.state.temperature, 1777.65, 0.01);
    EXPECT_FALSE(reactor.out);
  }
}

// exp(-k z/u) and the time z/u.
TEST(PlugFlow, FirstOrderIsExponential) {
  const GasState inlet{800, kAtm, {1, 0}};
  const double length = 0.2, velocity = 40;
  const double massFlux = velocity * Thermo(firstOrder()).density(800, kAtm, inlet.Y);
  PlugFlow flow(firstOrder(), inlet, massFlux, length);
  StiffIntegrator integrator(flow, {});
  integrator.start(0.0, flow.initialState(), length);
  while (integrator.time() < length) integrator.step();
  const double* y = integrator.state().data();
  measured("relative error", y[0] / std::exp(-kRate * length / velocity) - 1);
  EXPECT_NEAR(y[0] / std::exp(-kRate * length / velocity), 1, 1e-7);
  EXPECT_NEAR(flow.residenceTime(y) / (length / velocity), 1, 1e-9);
  EXPECT_NEAR(flow.velocity(y), velocity, 1e-9);
}

// Burning hydrogen: the flow reaches at its residence time what the closed reactor reaches at that time.
TEST(PlugFlow, IsTheClosedReactorOnItsWay) {
  const GasState inlet = hydrogenAir(1200);
  PlugFlow flow(hydrogen(), inlet, 5.0, 0.01);
  StiffIntegrator along(flow, {});
  along.start(0.0, flow.initialState(), 0.01);
  while (along.time() < 0.01) along.step();
  const double time = flow.residenceTime(along.state().data());
  ClosedReactor closed(hydrogen(), inlet, ReactorSystem::Held::Pressure);
  StiffIntegrator inTime(closed, {});
  inTime.start(0.0, closed.initialState(), time);
  while (inTime.time() < time) inTime.step();
  EXPECT_GT(inTime.state().back(), 1900);
  double worst = 0;
  for (std::size_t i = 0; i < inTime.state().size(); ++i)
    raise(worst, (along.state()[i] - inTime.state()[i]) / (i + 1 == inTime.state().size() ? inTime.state()[i] : 1.0));
  measured("largest difference", worst);
  EXPECT_LT(worst, 1e-6);
}

}  // namespace
