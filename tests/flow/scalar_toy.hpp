// A passive scalar that an owner carries, and a channel for it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "flow/operator.hpp"
#include "flow/scalar_block.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flow_fixture.hpp"

namespace lampblack::test {

// A passive scalar with values at boundaries, by their names, and a source: all that a new owner has to bring.
struct ScalarToy : Operator {
  std::map<std::string, ScalarBoundary> given;
  double diffusivity = 0.0, source = 0.0;  // m^2/s; per kg of gas and s
  double held = 0.0, sink = 0.0;           // in every other cell: a value, and how fast it is held, 1/s

  [[nodiscard]] ScalarBlock block(const FlowContext& context) const {
    CarriedScalar scalar{.name = "toy", .unit = "1/m^3", .description = "nothing"};
    for (const BoundaryCondition& boundary : context.boundaries)
      scalar.boundaries.push_back(given.contains(boundary.name) ? given.at(boundary.name) : ScalarBoundary{});
    return {name(), {scalar}};
  }
  [[nodiscard]] const char* name() const override { return "toy"; }
  void advance(State&, double, double) override {}
  void endSweep(State& state) override {
    const auto first = at(state.block(name()).first), all = state.scalars.size();
    for (std::size_t c = 0; c < state.density.size(); ++c) state.carriedDiffusivity[c * all + first] = diffusivity;
    for (std::size_t c = 0; c < state.balance.enthalpy.size(); ++c)
      state.balance.carried[c * all + first] += state.density[c] * source;
    for (std::size_t c = 0; c < state.balance.enthalpy.size(); c += 2) {
      state.balance.carried[c * all + first] += state.density[c] * sink * held;
      state.balance.carriedSink[c * all + first] += sink;
    }
  }
};

struct ScalarChannel {
  static constexpr double speed = 0.1, temperature = 300.0;
  Gas& gas = Gas::hydrogen();
  std::vector<double> N2 = gas.massFractions("N2: 1");
  Box box;
  double density = gas.thermo.density(temperature, 101325.0, N2);

  ScalarChannel(double half, int across, double length, int along)
      : box(Geometry::Planar, {uniformAxis(half, across), uniformAxis(length, along)},
            {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
             opening(BoundaryKind::Inlet, 1, false, speed, temperature, N2),
             opening(BoundaryKind::Outlet, 1, true, 0.0, temperature, N2)}) {}
  State stateOf(const std::vector<ScalarBlock>& blocks) {
    return box.stateWith(blocks, [&](const auto&) { return Box::Local{{0.0, speed}, temperature, N2}; });
  }
};

}  // namespace lampblack::test
