// Particles in the equations of reactors: derivatives, closed solutions, what is kept, for a toy and for every model.
#include "coupling/reactor_particles.hpp"

#include <gtest/gtest.h>

#include "chemistry/reactor/network_solver.hpp"
#include "chemistry/reactor/plug_flow.hpp"
#include "coupling/reactor_balance.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/coupling/ethylene_models.hpp"
#include "tests/coupling/toy_particles.hpp"
#include "tests/every_module.hpp"

namespace lampblack::coupling {
namespace {

using test::ethylene;
using test::gasOf;
using test::integrated;
using test::Toy;
using test::ToyPhase;

using Held = ReactorSystem::Held;

// A gas that does not react: acetylene in nitrogen.
const Mechanism& inert() {
  static const Mechanism mechanism = test::readFileText(test::mechanismText(
      "species: [C2H2, N2]",
      "\n- {name: C2H2, composition: {C: 2, H: 2}, thermo: *t}\n- {name: N2, composition: {N: 2}, thermo: *t}", "[]"));
  return mechanism;
}

// The analytic Jacobian against central differences, relative to the largest entry of a row.
void expectDerivative(OdeSystem& system, const std::vector<double>& y) {
  const std::size_t n = system.size();
  std::vector<double> J(n * n), f(n), up(n), down(n), rates(n);
  ASSERT_TRUE(system.jacobian(0, y.data(), f.data(), J.data(), n));
  ASSERT_TRUE(system.rates(0, y.data(), rates.data()));
  std::vector<double> numeric(n * n), scale(n);
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> moved = y;
    const double step = 1e-5 * std::max(std::abs(y[j]), 1e-3);
    moved[j] = y[j] + step;
    ASSERT_TRUE(system.rates(0, moved.data(), up.data()));
    moved[j] = y[j] - step;
    ASSERT_TRUE(system.rates(0, moved.data(), down.data()));
    for (std::size_t i = 0; i < n; ++i) {
      numeric[i + j * n] = (up[i] - down[i]) / (2 * step);
      scale[i] = std::max(scale[i], std::abs(numeric[i + j * n]));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(f[i], rates[i], 1e-9 * (std::abs(rates[i]) + scale[i] * 1e-6)) << i;
    // The slope of the particles' heat capacity, which the temperature's own column is without, is below 1e-4 of it.
    for (std::size_t j = 0; j < n; ++j)
      EXPECT_NEAR(J[i + j * n], numeric[i + j * n], 1e-4 * scale[i] + 1e-12) << "row " << i << ", column " << j;
  }
}

class ReactorWithToy : public ::testing::Test {
 protected:
  Toy toy{ethylene(), 4e6, 15000, 2000};
  ToyPhase phase{toy};
  GasState gas = gasOf(ethylene(), 1900, "C2H2: 0.1, A1: 0.02, H2: 0.02, N2: 0.86");
};

TEST_F(ReactorWithToy, JacobianOfClosedReactorsIsTheDerivative) {
  for (const Held held : {Held::Pressure, Held::Density}) {
    ClosedReactor reactor(ethylene(), gas, held, std::nullopt, &phase);
    expectDerivative(reactor, integrated(reactor, reactor.initialState(), 3e-4, 1e-8));
  }
}

TEST_F(ReactorWithToy, JacobianOfPlugFlowIsTheDerivative) {
  PlugFlow flow(ethylene(), gas, 2.0, 0.1, std::nullopt, &phase);
  expectDerivative(flow, integrated(flow, flow.initialState(), 0.01, 1e-8));
}

TEST_F(ReactorWithToy, JacobianOfANetworkIsTheDerivative) {
  StirredReactor first{"a", 1e-4, {}, {}, 0.5, 300}, second{"b", {}, 1e-3, {}, 0, 0};
  const ReactorNetwork network{gas.pressure, {first, second}, {{0, 1e-2, 1900, gas.Y}}, {{0, 1, 1.2e-2}, {1, 0, 2e-3}}};
  NetworkSystem system(ethylene(), network, &phase);
  const auto start = startUnknowns(ethylene(), network, {false, gas}, system.numCarried());
  expectDerivative(system, integrated(system, start, 5e-4, 1e-8));
}

// Without reactions and at one temperature the acetylene falls as exp(-k t); what it loses the particles have.
TEST(ReactorParticles, ClosedAndPlugFlowHaveTheClosedSolution) {
  const Toy toy(inert(), 500, 0, 0);
  ToyPhase phase(toy);
  const GasState gas = gasOf(inert(), 1500, "C2H2: 0.2, N2: 0.8");
  const double end = 2e-3, left = std::exp(-500 * end), carbon = 2 * toy.carbonWeight / inert().molecularWeights()[0];
  for (const Held held : {Held::Pressure, Held::Density}) {
    ClosedReactor reactor(inert(), gas, held, TemperatureProfile(1500), &phase);
    const auto y = integrated(reactor, reactor.initialState(), end, 1e-11);
    EXPECT_NEAR(y[0] / (gas.Y[0] * left), 1, 1e-8);
    EXPECT_NEAR(y[3] * ToyPhase::unit / (gas.Y[0] * (1 - left) * carbon), 1, 1e-8);
  }
  // The duct is as long as it takes; its mass flux is that of gas and particles.
  PlugFlow flow(inert(), gas, 2.0, 1e-2, TemperatureProfile(1500), &phase);
  const auto y = integrated(flow, flow.initialState(), 1e-2, 1e-11);
  const double time = flow.residenceTime(y.data());
  EXPECT_NEAR(y[0] / (gas.Y[0] * std::exp(-500 * time)), 1, 1e-8);
  EXPECT_NEAR(y[0] + y[1] + ToyPhase::unit * (y[3] + y[4]), 1, 1e-13);
}

// Of first order in each of two stirred reactors, with the particles travelling along.
TEST(ReactorParticles, StirredReactorsInARowHaveTheClosedSolution) {
  const Toy toy(inert(), 500, 0, 0);
  ToyPhase phase(toy);
  const GasState gas = gasOf(inert(), 1500, "C2H2: 0.2, N2: 0.8");
  const StirredReactor vessel{"r", {}, 2e-3, 1500, 0, 0};
  const ReactorNetwork network{gas.pressure, {vessel, vessel}, {{0, 1e-3, 1500, gas.Y}}, {{0, 1, 1e-3}}};
  const auto states = solveNetwork(inert(), network, {false}, &phase);
  for (const std::size_t r : {0u, 1u}) {
    const double left = std::pow(1 / (1 + 500 * 2e-3), static_cast<double>(r + 1));
    EXPECT_NEAR(states[r].state.Y[0] / (gas.Y[0] * left), 1, 1e-9);
    const double taken = gas.Y[0] * (1 - left);
    EXPECT_NEAR(ToyPhase::unit * (states[r].state.carried[0] + states[r].state.carried[1]) / taken, 1, 1e-9);
  }
}

class EveryModel : public ::testing::TestWithParam<std::string> {
 protected:
  CarriedParticles soot{ethylene(), test::modelOf(GetParam())};
  ReactorParticles particles{ethylene(), soot};
  ReactorBalance balance{ethylene(), particles, particles.unitElements()};
  std::size_t n = ethylene().numSpecies();

  void expectKept(const std::vector<double>& start, const std::vector<double>& end, bool isPressureHeld) {
    const std::span<const double> y(end), y0(start);
    const auto count = particles.size();
    const auto amounts = y.subspan(n + 1, count), amounts0 = y0.subspan(n + 1, count);
    EXPECT_LT(largestImbalance(balance.elements(y0.first(n), amounts0), balance.elements(y.first(n), amounts)), 1e-13);
    const double change =
        isPressureHeld
            ? balance.enthalpy(y[n], y.first(n), amounts) - balance.enthalpy(y0[n], y0.first(n), amounts0)
            : balance.internalEnergy(y[n], y.first(n), amounts) - balance.internalEnergy(y0[n], y0.first(n), amounts0);
    // Within the tolerance of the stiff solver, 1e-9.
    EXPECT_LT(std::abs(change) / (Thermo(ethylene()).cpMass(y[n], y.first(n)) * y[n]), 1e-9);
    std::vector<double> densities(count);
    particles.densities(0.2, amounts, densities);
    EXPECT_GT(soot.volumeFraction(densities), 1e-9);  // there is soot
  }
};

TEST_P(EveryModel, KeepsElementsAndEnergyInClosedReactors) {
  const GasState gas = gasOf(ethylene(), 1900, "C2H2: 0.06, A1: 0.01, N2: 0.93");
  for (const Held held : {Held::Pressure, Held::Density}) {
    ClosedReactor reactor(ethylene(), gas, held, std::nullopt, &particles);
    expectKept(reactor.initialState(), integrated(reactor, reactor.initialState(), 3e-3, 1e-9), held == Held::Pressure);
  }
}

TEST_P(EveryModel, KeepsElementsAndEnergyInPlugFlow) {
  const GasState gas = gasOf(ethylene(), 1900, "C2H2: 0.06, A1: 0.01, N2: 0.93");
  PlugFlow flow(ethylene(), gas, 3.0, 0.06, std::nullopt, &particles);
  expectKept(flow.initialState(), integrated(flow, flow.initialState(), 0.06, 1e-9), true);
}

TEST_P(EveryModel, BalancesInASteadyStirredReactor) {
  const GasState gas = gasOf(ethylene(), 300, "C2H4: 0.11, O2: 0.17, N2: 0.72");
  const StirredReactor vessel{"r", {}, 2e-3, {}, 0, 0};
  const ReactorNetwork network{gas.pressure, {vessel}, {{0, 1e-3, gas.temperature, gas.Y}}, {}};
  const auto states = solveNetwork(ethylene(), network, {true}, &particles);
  const auto sums = steadyBalances(ethylene(), particles, network, states);
  EXPECT_LT(sums[0].elements, 1e-13);
  EXPECT_LT(std::abs(sums[0].energy), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Models, EveryModel,
                         ::testing::Values("two_equation_dimer", "leung", "moss_brookes", "hmom", "momic",
                                           "sectional"));

TEST(ReactorBalance, TracesOfWhatIsNotThereDoNotCount) {
  const std::vector<double> first{0.7, 1e-5, 1e-25, 0};
  EXPECT_NEAR(largestImbalance(first, std::vector<double>{0.7, 1.001e-5, 1e-17, 1e-20}), 1e-3, 1e-9);
  EXPECT_EQ(largestImbalance(first, first), 0);
}

}  // namespace
}  // namespace lampblack::coupling
