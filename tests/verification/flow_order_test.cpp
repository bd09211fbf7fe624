// Order of the flow in time: the same flows with steps halved again and again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "../flow/flow_fixture.hpp"
#include "core/constants.hpp"
#include "flow/reaction_operator.hpp"
#include "flow/transport_operator.hpp"
#include "tests/every_room.hpp"

namespace lampblack::test {
namespace {

struct Quantities {
  std::vector<double> velocity, temperature, Y, pressure, carried;
};

struct Problem {
  std::string name;
  Box box;
  std::function<Box::Local(const std::array<double, 2>&)> start;
  double duration = 0.0;
  int steps = 0;  // of the longest step
  std::string species;
  bool reacts = false;
  double prelude = 0.0;  // s, after which the measured runs start from one state
  // Particles per m3 that the gas carries, with thermophoresis, and their diffusivity.
  std::function<double(const std::array<double, 2>&)> particles = {};
  double diffusivity = 0.0;

  State stateAtStart() {
    if (!particles) return box.state(start);
    State state = box.state(start, {{"particles", "1/m^3", "test", 0.55}});
    for (int c = 0; c < box.mesh.cells; ++c) state.carried[at(c)] = particles(box.mesh.centre[at(c)]);
    std::ranges::fill(state.carriedDiffusivity, diffusivity);
    return state;
  }
};

Quantities advance(Problem& problem, State& state, int sweeps, int steps, double duration) {
  Box& box = problem.box;
  TransportOperator transport(box.context, state, {0.5, sweeps});
  std::vector<Operator*> operators{&transport};
  ReactionOperator::Options options;
  options.reactor.relativeTolerance = 1e-9;
  options.reactor.absoluteTolerance = 1e-15;
  ReactionOperator chemistry(box.context, options);
  if (problem.reacts) operators.push_back(&chemistry);
  const double dt = duration / steps;
  transport.initialise(state, dt);
  const auto endSweep = [&] {
    for (Operator* op : operators) op->endSweep(state);
  };
  const auto endStep = [&] {
    for (Operator* op : operators) op->endStep(state);
  };
  endStep();
  endSweep();
  std::vector<double> velocity, pressure;
  for (int i = 0; i < steps; ++i) {
    velocity = state.velocity;
    pressure = state.pressure;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (Operator* op : operators) op->advance(state, i * dt, dt);
      if (sweep + 1 == sweeps) endStep();
      endSweep();
    }
  }
  // Velocities stand half a step before the gas, pressures a step.
  for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] += 1.5 * (state.velocity[i] - velocity[i]);
  for (std::size_t i = 0; i < pressure.size(); ++i) pressure[i] += 2.0 * (state.pressure[i] - pressure[i]);
  return {velocity, state.temperature, state.Y, pressure, state.carried};
}

// Mean of |a - b| over the owned cells, of component k of n.
double distance(const Box& box, const std::vector<double>& a, const std::vector<double>& b, std::size_t n,
                std::size_t k) {
  double sum = 0.0, count = 0.0;
  for (int c = 0; c < box.mesh.owned; ++c) sum += std::abs(a[at(c) * n + k] - b[at(c) * n + k]), count += 1.0;
  return sumOverRanks(sum) / sumOverRanks(count);
}

// Orders between the last two of three differences of runs whose steps are halved.
struct Orders {
  double u = 0.0, T = 0.0, Y = 0.0, p = 0.0, carried = 0.0;
};

Orders measure(Problem& problem, int sweeps) {
  const std::size_t n = problem.box.gas.mechanism.numSpecies();
  const std::size_t species = problem.box.gas.mechanism.speciesIndex(problem.species);
  State start = problem.stateAtStart();
  if (problem.prelude > 0.0) advance(problem, start, 2, 2 * problem.steps, problem.prelude);
  std::vector<Quantities> found;
  for (int level = 0; level < 4; ++level) {
    State state = start;
    found.push_back(advance(problem, state, sweeps, problem.steps << level, problem.duration));
  }
  const auto order = [&](const char* name, std::vector<double> Quantities::*field, std::size_t components,
                         std::size_t component) {
    std::array<double, 3> d{};
    for (std::size_t level = 0; level < 3; ++level)
      d[level] = distance(problem.box, found[level].*field, found[level + 1].*field, components, component);
    const double last = std::log2(d[1] / d[2]);
    report(fmt::format("{}, {} sweeps, {}: {:.2e} {:.2e} {:.2e}, orders {:.2f} {:.2f}", problem.name, sweeps, name,
                       d[0], d[1], d[2], std::log2(d[0] / d[1]), last));
    return last;
  };
  return {order("u", &Quantities::velocity, 2, 0), order("T", &Quantities::temperature, 1, 0),
          order("Y", &Quantities::Y, n, species), order("p", &Quantities::pressure, 1, 0),
          problem.particles ? order("particles", &Quantities::carried, 1, 0) : 0.0};
}

// 2400 K in a stream of 300 K. Its pressure is not looked at: it feels the moments at which a cell's limiter sets in.
TEST(FlowOrder, HotSpotInAStream) {
  Gas& gas = Gas::hydrogen();
  const auto air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double size = 4e-3;
  const double speed = 1.0;
  const std::vector<Side> sides{opening(BoundaryKind::Inlet, 0, false, speed, 300.0, air),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, air),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  Problem problem{"hot spot",
                  Box(Geometry::Planar, {uniformAxis(size, 32), uniformAxis(size, 32)}, sides),
                  [&](const std::array<double, 2>& x) {
                    const double r2 = std::pow(x[0] - 0.4 * size, 2) + std::pow(x[1] - 0.45 * size, 2);
                    return Box::Local{{speed, 0.0}, 300.0 + 2100.0 * std::exp(-r2 / std::pow(0.8e-3, 2)), air};
                  },
                  4e-4,
                  16,
                  "O2"};
  problem.particles = [&](const std::array<double, 2>& x) {
    return 1e15 * (1.0 + 0.5 * std::cos(std::numbers::pi * x[0] / size) * std::cos(std::numbers::pi * x[1] / size));
  };
  problem.diffusivity = 3e-5;
  const Orders one = measure(problem, 1), two = measure(problem, 2), four = measure(problem, 4);
  EXPECT_NEAR(one.u, 1.0, 0.1);
  EXPECT_NEAR(one.T, 1.0, 0.1);
  EXPECT_GT(two.T, 1.8);
  EXPECT_GT(four.u, 1.9);
  EXPECT_GT(four.T, 1.9);
  EXPECT_GT(four.carried, 1.9);
}

// From 95 % of hydrogen to none: ln W changes as much as the mass fractions.
TEST(FlowOrder, LayerRichInHydrogen) {
  Gas& gas = Gas::hydrogen();
  const double size = 4e-3;
  const auto nitrogen = gas.massFractions("N2: 1");
  const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, nitrogen),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  Problem problem{"layer",
                  Box(Geometry::Planar, {uniformAxis(size, 48), uniformAxis(1e-3, 1)}, sides),
                  [&](const std::array<double, 2>& x) {
                    const double X = 0.475 * (1.0 - std::tanh((x[0] - 0.4 * size) / 0.4e-3));
                    return Box::Local{{0.0, 0.0}, 300.0, gas.massFractions(fmt::format("H2: {}, N2: {}", X, 1.0 - X))};
                  },
                  4e-3,
                  40,
                  "H2"};
  const Orders two = measure(problem, 2), three = measure(problem, 3);
  EXPECT_GT(two.u, 1.6);
  EXPECT_GT(two.Y, 1.7);
  EXPECT_GT(three.u, 1.9);
  EXPECT_GT(three.Y, 1.9);
  EXPECT_GT(three.p, 1.5);
}

// A wave of 95 % of hydrogen over two of its diffusion times in 16 steps: what is left of it, against 512 steps.
// Steps of first order in which all of the diffusion is implicit would leave 12.5 % too much.
TEST(FlowOrder, WaveOfHydrogenDecays) {
  Gas& gas = Gas::hydrogen();
  const double size = 4e-3;
  const auto mixture = gas.massFractions("H2: 0.95, N2: 0.05");
  const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, mixture),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  Problem problem{"wave",
                  Box(Geometry::Planar, {uniformAxis(size, 32), uniformAxis(1e-3, 1)}, sides),
                  [&](const std::array<double, 2>& x) {
                    const double X = 0.95 + 0.01 * std::cos(std::numbers::pi * x[0] / size);
                    return Box::Local{{0.0, 0.0}, 300.0, gas.massFractions(fmt::format("H2: {}, N2: {}", X, 1.0 - X))};
                  },
                  0.0,
                  16,
                  "H2"};
  std::vector<double> X(gas.mechanism.numSpecies()), D(X.size());
  gas.thermo.massToMole(mixture, X);
  const std::size_t hydrogen = gas.mechanism.speciesIndex("H2"), other = gas.mechanism.speciesIndex("N2");
  gas.transport.mixture(300.0, constants::oneAtmosphere, X, D);
  const double diffusivity = D[other] * X[hydrogen] / (1.0 - mixture[other]);  // of the pair
  problem.duration = 2.0 * size * size / (std::numbers::pi * std::numbers::pi * diffusivity);
  const auto left = [&](int sweeps, int steps) {
    State state = problem.box.state(problem.start);
    const Quantities end = advance(problem, state, sweeps, steps, problem.duration);
    return 2.0 / (size * 1e-3) * integral(problem.box.mesh, [&](int c) {
             std::vector<double> moles(X.size());
             gas.thermo.massToMole({&end.Y[at(c) * X.size()], X.size()}, moles);
             return moles[hydrogen] * std::cos(std::numbers::pi * problem.box.mesh.centre[at(c)][0] / size);
           });
  };
  const double exact = left(3, 512);
  for (const auto& [sweeps, allowed] : {std::pair{1, 1.0}, {2, 0.125}, {3, 0.03}}) {
    const double error = left(sweeps, 16) / exact - 1.0;
    report(fmt::format("wave of hydrogen, {} sweeps: {:+.2e} of what is left of it ({:.3f} of its start)", sweeps,
                       error, exact / 0.01));
    EXPECT_LT(std::abs(error), allowed);
  }
}

TEST(FlowOrder, PremixedFlame) {
  Gas gas("methane_drm19_21.yaml");
  const double size = 6e-3, speed = 0.6;
  const auto fresh = gas.massFractions("CH4: 1, O2: 2, N2: 7.52");
  const auto burnt = gas.massFractions("CO2: 0.9, H2O: 1.95, N2: 7.52, CO: 0.1, H2: 0.05, O2: 0.075");
  const std::vector<Side> sides{opening(BoundaryKind::Inlet, 0, false, speed, 300.0, fresh),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, 2200.0, burnt),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  Problem problem{"premixed",
                  Box(Geometry::Planar, {uniformAxis(size, 60), uniformAxis(1e-3, 1)}, sides, gas),
                  [&](const std::array<double, 2>& x) {
                    const double share = 0.5 * (1.0 + std::tanh((x[0] - 0.4 * size) / 0.3e-3));
                    Box::Local local{{speed, 0.0}, 300.0 + 1900.0 * share, {}};
                    for (std::size_t k = 0; k < fresh.size(); ++k)
                      local.Y.push_back((1.0 - share) * fresh[k] + share * burnt[k]);
                    return local;
                  },
                  1.5e-4,
                  10,
                  "CH4",
                  true,
                  5e-4};
  for (const int sweeps : {2, 3}) {
    const Orders found = measure(problem, sweeps);
    EXPECT_GT(found.u, 1.9);
    EXPECT_GT(found.T, 1.9);
    EXPECT_GT(found.Y, 1.9);
    EXPECT_GT(found.p, 1.5);
  }
}

// An even mixture in an open box ignites as in a reactor of constant pressure while most of it leaves.
TEST(FlowOrder, EvenMixtureIgnitesAsAReactor) {
  Gas& gas = Gas::hydrogen();
  const double size = 1e-3, T0 = 1200.0, duration = 4e-5;
  const auto mixture = gas.massFractions("H2: 2, O2: 1, N2: 3.76, H: 0.01");
  const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, T0, mixture),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  Problem problem{"ignition",
                  Box(Geometry::Planar, {uniformAxis(size, 4), uniformAxis(size, 1)}, sides),
                  [&](const std::array<double, 2>&) {
                    return Box::Local{{0.0, 0.0}, T0, mixture};
                  },
                  duration,
                  0,
                  "H2",
                  true};
  std::vector<double> Y = mixture;
  ConstantPressureReactor reactor(gas.mechanism, {1e-10, 1e-16});
  ConstantPressureReactor::Cell cell{T0, constants::oneAtmosphere, Y, {}, 0.0};
  reactor.advance(cell, duration);
  ASSERT_GT(cell.temperature, T0 + 300.0);
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < error.size(); ++level) {
    State state = problem.stateAtStart();
    const Quantities end = advance(problem, state, 2, 40 << level, duration);
    error[level] =
        largest(problem.box.mesh, [&](int c) { return std::abs(end.temperature[at(c)] - cell.temperature); });
  }
  report(fmt::format("ignition, 2 sweeps, T against {:.1f} K: {:.2e} {:.2e} {:.2e}, orders {:.2f} {:.2f}",
                     cell.temperature, error[0], error[1], error[2], std::log2(error[0] / error[1]),
                     std::log2(error[1] / error[2])));
  EXPECT_GT(std::log2(error[1] / error[2]), 1.8);
}

}  // namespace
}  // namespace lampblack::test
