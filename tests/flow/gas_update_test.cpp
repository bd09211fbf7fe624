// What iterations do in cells whose gas reacts by itself faster than it is carried away.
#include "flow/steady/gas_update.hpp"

#include <gtest/gtest.h>

#include "flow/steady/steady_iteration.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Nitrogen turns into argon: a little by itself, and the faster the more argon there is, until there is enough. Without
// any the linear system knows of the growth alone, and leads to where it would be nothing: to less than no argon.
class Igniting : public Operator {
 public:
  Igniting(const Mesh& mesh, std::size_t argon, std::size_t nitrogen)
      : mesh_(mesh), argon_(argon), nitrogen_(nitrogen) {}
  [[nodiscard]] const char* name() const override { return "igniting"; }
  void advance(State&, double, double) override {}
  void addRates(const State& state, State::Balance& rates) override {
    const auto n = static_cast<std::size_t>(state.species);
    for (std::size_t c = 0; c < at(mesh_.owned); ++c) {
      const double Y = state.Y[c * n + argon_], rate = state.density[c] * (seed + growth * Y * (1.0 - Y / goal));
      rates.reactions[c * n + argon_] += rate;
      rates.reactions[c * n + nitrogen_] -= rate;
    }
  }
  void addSlopes(const State& state, const Slopes& slopes) override {
    if (slopes.gas.empty()) return;
    const auto n = static_cast<std::size_t>(state.species), width = n + 1;
    for (std::size_t c = 0; c < at(mesh_.owned); ++c) {
      const double slope = state.density[c] * growth * (1.0 - 2.0 * state.Y[c * n + argon_] / goal);
      double* column = &slopes.gas[c * width * width + argon_ * width];
      column[argon_] += slope;
      column[nitrogen_] -= slope;
    }
  }
  static constexpr double goal = 1e-3, seed = 1e-2, growth = 1e7;  // 1, 1/s, 1/s

 private:
  const Mesh& mesh_;
  std::size_t argon_, nitrogen_;
};

TEST(GasUpdates, LetIgniteWhatIgnites) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const std::size_t argon = gas.mechanism.speciesIndex("AR"), nitrogen = gas.mechanism.speciesIndex("N2");
  MeshSpec spec;
  spec.geometry = Geometry::Planar;
  spec.vertices = {uniformAxis(0.006, 2), uniformAxis(0.012, 6), {}};
  std::vector<BoundaryCondition> conditions;
  for (const Side& s : {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
                        opening(BoundaryKind::Inlet, 1, false, 0.5, 300.0, air),
                        opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)}) {
    spec.patches.push_back(s.patch);
    conditions.push_back(s.condition);
  }
  Box b(spec, conditions, {}, MPI_COMM_WORLD);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, air}; });
  TransportOperator transport(b.context, state);
  Igniting igniting(b.mesh, argon, nitrogen);
  transport.initialise(state, 1e-4);
  SteadyIteration iteration(b.context, state, {}, {&transport, &igniting});
  SteadyIteration::Outcome outcome;
  for (int i = 0; i < 100; ++i) outcome = iteration.iterate(state);
  const double lacks =
      largest(b.mesh, [&](int c) { return std::abs(state.Y[at(c * state.species) + argon] / Igniting::goal - 1.0); });
  report(fmt::format("lacks {:.2g}, left {:.2g}", lacks, outcome.measure));
  EXPECT_LT(lacks, 1e-3);
  EXPECT_EQ(outcome.limited, 0) << "cells go on as fast as others once they have ignited";
}

}  // namespace
}  // namespace lampblack::test
