// A turbulent flow that tests of steady states share.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Particles that are born all over the gas and coagulate: beside turbulence they are what soot is in a flame.
class Dust : public Operator {
 public:
  [[nodiscard]] static ScalarBlock block(const FlowContext& context) {
    CarriedScalar scalar{.name = "dust", .unit = "1/m^3", .description = "particles"};
    scalar.boundaries.resize(context.boundaries.size());
    return {"dust", {scalar}};
  }
  [[nodiscard]] const char* name() const override { return "dust"; }
  void advance(State&, double, double) override {}
  [[nodiscard]] bool actsOnCarried() const override { return true; }
  void addRates(const State& state, State::Balance& rates) override {
    forEach(state, [&](std::size_t i, double amount) { rates.carried[i] += born - coagulates * amount * amount; });
  }
  void addSlopes(const State& state, const Slopes& slopes) override {
    const std::size_t all = state.scalars.size();
    if (slopes.carried.empty()) return;
    forEach(state,
            [&](std::size_t i, double amount) { slopes.carried[i * all + i % all] -= 2.0 * coagulates * amount; });
  }

 private:
  static constexpr double born = 1e18, coagulates = 1e-12;  // 1/m^3/s, m^3/s
  static void forEach(const State& state, const std::function<void(std::size_t, double)>& take) {
    const std::size_t all = state.scalars.size(), own = at(state.block("dust").first);
    for (std::size_t c = 0; c < state.balance.enthalpy.size(); ++c) take(c * all + own, state.carried[c * all + own]);
  }
};

// Air along a wall, with eddies by a model of two equations; with dust in it or without.
struct StirredChannel {
  static constexpr double ofMolecules = 1.57e-5, speed = 20.0;  // m^2/s, m/s
  explicit StirredChannel(bool isDusty = false) {
    const std::vector<double> air = Gas::hydrogen().massFractions("O2: 0.21, N2: 0.79");
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = false;
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {uniformAxis(0.004, 8), uniformAxis(0.02, 8), {}};
    std::vector<BoundaryCondition> conditions;
    for (const Side& s :
         {side(BoundaryKind::Symmetry, 0, false), wall, opening(BoundaryKind::Inlet, 1, false, speed, 300.0, air),
          opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)}) {
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
    const FreeStream stream{ofMolecules, 20.0 * ofMolecules, 2.0};
    box.emplace(spec, conditions, std::nullopt, MPI_COMM_WORLD);
    std::vector<ScalarBlock> blocks{
        TurbulenceOperator::blockOf(*model, box->context.boundaries, std::vector<FreeStream>(4, stream))};
    if (isDusty) blocks.push_back(Dust::block(box->context));
    state.emplace(box->stateWith(blocks, [&](const auto&) { return Box::Local{{0.0, speed}, 300.0, air}; }));
    transport.emplace(box->context, *state);
    turbulence.emplace(box->context, *state, model, transport->properties());
    turbulence->setStart(*state, stream);
    transport->initialise(*state, 1e-5);
    turbulence->setDiffusivities(*state);
    state->updateHalo(box->halo);
    operators = {&*transport, &*turbulence};
    if (isDusty) operators.push_back(&dust);
  }
  std::shared_ptr<const TurbulenceModel> model = turbulenceModel("k_omega");
  std::optional<Box> box;
  std::optional<State> state;
  std::optional<TransportOperator> transport;
  std::optional<TurbulenceOperator> turbulence;
  Dust dust;
  std::vector<Operator*> operators;
};

}  // namespace lampblack::test
