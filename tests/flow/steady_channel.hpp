// A channel along which gas comes in, and dust that hot gas makes of itself, whose steady states are sought.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "flow_fixture.hpp"

namespace lampblack::test {

// Something that hot gas makes of itself and that decays: made * T, less itself by its lifetime.
class HotDust : public Operator {
 public:
  explicit HotDust(const Mesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] const char* name() const override { return "dust"; }
  void advance(State&, double, double) override {}
  void endSweep(State& state) override { addRates(state, state.balance); }
  void addRates(const State& state, State::Balance& rates) override {
    for (int c = 0; c < mesh_.owned; ++c)
      rates.carried[at(c)] += made * state.temperature[at(c)] - state.carried[at(c)] / lifetime;
  }
  [[nodiscard]] bool actsOnCarried() const override { return true; }
  void addSlopes(const State&, const Slopes& slopes) override {
    if (slopes.carried.empty()) return;
    for (int c = 0; c < mesh_.owned; ++c) slopes.carried[at(c)] -= 1.0 / lifetime;
  }

 private:
  static constexpr double made = 0.1, lifetime = 0.01;
  const Mesh& mesh_;
};

class SteadyChannel : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  std::vector<double> lean = gas.massFractions("H2: 0.25, O2: 0.15, N2: 0.6");

  std::vector<double> burnt = gas.massFractions("H2O: 0.25, O2: 0.025, N2: 0.6");

  // A channel, wider by the wall, along which gas comes in.
  [[nodiscard]] Box channel(const std::vector<double>& Y, double temperature, double speed,
                            MPI_Comm comm = MPI_COMM_WORLD) const {
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = false;
    const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), wall,
                                  opening(BoundaryKind::Inlet, 1, false, speed, temperature, Y),
                                  opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)};
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {gradedAxis(0.0, {{0.006, 6, 2.0}}), uniformAxis(0.012, 14), {}};
    std::vector<BoundaryCondition> conditions;
    for (const Side& s : sides) {
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
    return {spec, conditions, {}, comm};
  }
};

inline const std::vector<CarriedScalar> dust{{"dust", "1/m3", "", 0.55}};

}  // namespace lampblack::test
