// Flows whose order in time is measured, and how they are advanced.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "../flow/flow_fixture.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

struct Quantities {
  std::vector<double> velocity, temperature, Y, pressure, carried;
};

struct Problem {
  std::string name;
  Box box;
  std::function<Box::Local(const Vector3&)> start;
  double duration = 0.0;
  int steps = 0;  // of the longest step
  std::string species;
  bool reacts = false;
  double prelude = 0.0;  // s, after which the measured runs start from one state
  // Particles per m3 that the gas carries, with thermophoresis, and their diffusivity.
  std::function<double(const Vector3&)> particles = {};
  double diffusivity = 0.0;

  State stateAtStart() {
    if (!particles) return box.state(start);
    State state = box.state(start, {{"particles", "1/m^3", "test", 0.55}});
    for (int c = 0; c < box.mesh.cells; ++c) state.carried[at(c)] = particles(box.mesh.centre[at(c)]);
    std::ranges::fill(state.carriedDiffusivity, diffusivity);
    return state;
  }
};

// `afterStep` is told the state at the end of each step.
using AfterStep = std::function<void(TransportOperator&, const State&)>;
inline Quantities advance(Problem& problem, State& state, int sweeps, int steps, double duration,
                          const AfterStep& afterStep = {}) {
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
    if (afterStep) afterStep(transport, state);
  }
  // Velocities stand half a step before the gas, pressures a step.
  for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] += 1.5 * (state.velocity[i] - velocity[i]);
  for (std::size_t i = 0; i < pressure.size(); ++i) pressure[i] += 2.0 * (state.pressure[i] - pressure[i]);
  return {velocity, state.temperature, state.Y, pressure, state.carried};
}

// 2400 K in a stream of 300 K, with particles.
inline Problem hotSpotInAStream() {
  Gas& gas = Gas::hydrogen();
  const auto air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double size = 4e-3;
  const double speed = 1.0;
  const int cells = fewOrMany(20, 32);
  const std::vector<Side> sides{opening(BoundaryKind::Inlet, 0, false, speed, 300.0, air),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, air),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  return {"hot spot",
          Box(Geometry::Planar, {uniformAxis(size, cells), uniformAxis(size, cells)}, sides),
          [=](const Vector3& x) {
            const double r2 = std::pow(x[0] - 0.4 * size, 2) + std::pow(x[1] - 0.45 * size, 2);
            return Box::Local{{speed, 0.0}, 300.0 + 2100.0 * std::exp(-r2 / std::pow(0.8e-3, 2)), air};
          },
          4e-4,
          16,
          "O2",
          false,
          0.0,
          [=](const Vector3& x) {
            return 1e15 *
                   (1.0 + 0.5 * std::cos(std::numbers::pi * x[0] / size) * std::cos(std::numbers::pi * x[1] / size));
          },
          3e-5};
}

// From 95 % of hydrogen to none: ln W changes as much as the mass fractions.
inline Problem layerRichInHydrogen() {
  Gas& gas = Gas::hydrogen();
  const double size = 4e-3;
  const auto nitrogen = gas.massFractions("N2: 1");
  const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, nitrogen),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  return {"layer",
          Box(Geometry::Planar, {uniformAxis(size, 48), uniformAxis(1e-3, 1)}, sides),
          [=, &gas](const Vector3& x) {
            const double X = 0.475 * (1.0 - std::tanh((x[0] - 0.4 * size) / 0.4e-3));
            return Box::Local{{0.0, 0.0}, 300.0, gas.massFractions(fmt::format("H2: {}, N2: {}", X, 1.0 - X))};
          },
          4e-3,
          40,
          "H2"};
}

// A flat flame of methane and air, DRM19.
inline Problem premixedFlame(Gas& gas) {
  const double size = 6e-3, speed = 0.6;
  const auto fresh = gas.massFractions("CH4: 1, O2: 2, N2: 7.52");
  const auto burnt = gas.massFractions("CO2: 0.9, H2O: 1.95, N2: 7.52, CO: 0.1, H2: 0.05, O2: 0.075");
  const std::vector<Side> sides{opening(BoundaryKind::Inlet, 0, false, speed, 300.0, fresh),
                                opening(BoundaryKind::Outlet, 0, true, 0.0, 2200.0, burnt),
                                side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  return {"premixed",
          Box(Geometry::Planar, {uniformAxis(size, 60), uniformAxis(1e-3, 1)}, sides, gas),
          [=](const Vector3& x) {
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
}

}  // namespace lampblack::test
