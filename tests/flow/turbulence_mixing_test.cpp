// What an eddy viscosity spreads in a flow.
#include <gtest/gtest.h>

#include <numbers>
#include <optional>

#include "flow/models/turbulence/turbulence_model.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "tests/every_module.hpp"
#include "turbulence_fixture.hpp"

namespace lampblack::test {
namespace {

// Eddies of one kinematic viscosity everywhere, or of none.
struct EvenEddies {
  static constexpr bool needsWallDistance = false, needsStrainGradient = true;
  double eddies = 0.0;  // m^2/s
  [[nodiscard]] std::string name() const { return "even"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return {{"even", "m^2/s", "", 1.0}}; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const { return {stream.eddyViscosity}; }
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    return {.eddyViscosity = eddies, .diffusivity = {cell.viscosity}};
  }
};

// A stream of fuel into warm air beside a wall, with a passive scalar that eddies spread.
State mixed(std::optional<double> eddies, int sweeps, std::optional<Split> split, EddyNumbers numbers = {}) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79"), fuel = gas.massFractions("H2: 1, N2: 4");
  std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
                          opening(BoundaryKind::Inlet, 1, false, 0.5, 400.0, air),
                          opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)};
  sides[1].condition.slip = false;
  sides[1].condition.isothermal = true;
  sides[1].condition.temperature = 350.0;
  Box box(Geometry::Planar, {uniformAxis(0.006, 6), uniformAxis(0.012, 12)}, sides, gas, split);
  box.context.eddies = numbers;
  std::vector<ScalarBlock> blocks{{"dust", {{"dust", "1/m^3", "", 0.55}}}};
  const auto model = std::make_shared<PointwiseModel<EvenEddies>>(EvenEddies{eddies.value_or(0.0)});
  if (eddies) blocks.push_back(TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4)));
  State state = box.stateWith(blocks, [&](const Vector3& x) {
    return Box::Local{{0.0, 0.5}, 400.0 + 1e4 * x[0], x[1] < 0.005 ? air : fuel};
  });
  const std::size_t n = state.scalars.size();
  for (int c = 0; c < box.mesh.cells; ++c) {
    state.carried[at(c) * n] = 1.0 + std::sin(700.0 * box.mesh.centre[at(c)][0]);
    state.carriedDiffusivity[at(c) * n] = 1e-5;
  }
  TransportOperator transport(box.context, state, {.sweeps = sweeps});
  std::optional<TurbulenceOperator> turbulence;
  if (eddies) turbulence.emplace(box.context, state, model, transport.properties());
  if (turbulence) turbulence->setStart(state, {ofMolecules, *eddies, 0.0});
  transport.initialise(state, 1e-4);
  if (turbulence) turbulence->endSweep(state);
  for (int i = 0; i < 4; ++i)
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      transport.advance(state, i * 1e-4, 1e-4);
      if (turbulence) turbulence->advance(state, i * 1e-4, 1e-4);
      transport.endSweep(state);
      if (turbulence) turbulence->endSweep(state);
    }
  return state;
}

TEST(Turbulence, NoEddyViscosityIsALaminarFlow) {
  for (const auto& split : {std::optional<Split>(), std::optional<Split>(Split{Cells::Triangles})})
    for (const int sweeps : {1, 2}) {
      SCOPED_TRACE(fmt::format("{} sweeps, {}", sweeps, split ? "triangles" : "rectangles"));
      const State laminar = mixed({}, sweeps, split), none = mixed(0.0, sweeps, split),
                  some = mixed(1e-4, sweeps, split);
      for (const auto field : {&State::velocity, &State::temperature, &State::Y, &State::massFlux}) {
        EXPECT_EQ(none.*field, laminar.*field);
        EXPECT_NE(some.*field, laminar.*field);
      }
      double moved = 0.0;
      for (std::size_t c = 0; c < laminar.density.size(); ++c) {
        EXPECT_EQ(none.carried[2 * c], laminar.carried[c]);
        moved = std::max(moved, std::abs(some.carried[2 * c] - laminar.carried[c]));
      }
      EXPECT_GT(moved, 1e-3);
    }
}

// Heat, species and a scalar between two walls or faces spread by molecules and eddies together. One dimension, one
// cosine of each: its amplitude decays at (D + nu_t/Sc_t) (pi/L)^2.
TEST(Turbulence, EddiesSpreadByTheirNumbers) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double length = 0.01, eddies = 1e-3, wave = std::numbers::pi / length;
  const EddyNumbers numbers{0.5, 0.8};
  std::vector<Side> sides{side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true),
                          side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  Box box(Geometry::Planar, {uniformAxis(length, 40), uniformAxis(1e-3, 2)}, sides, gas);
  box.context.eddies = numbers;
  const auto model = std::make_shared<PointwiseModel<EvenEddies>>(EvenEddies{eddies});
  State state = box.stateWith({{"dust", {{"dust", "1/m^3", ""}}},
                               TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
                              [&](const Vector3& x) {
                                std::vector<double> Y = air;
                                const double more = 1e-4 * std::cos(wave * x[0]);
                                Y[gas.mechanism.speciesIndex("O2")] += more;
                                Y[gas.mechanism.speciesIndex("N2")] -= more;
                                return Box::Local{{}, 300.0 + 0.1 * std::cos(wave * x[0]), Y};
                              });
  for (int c = 0; c < box.mesh.cells; ++c)
    state.carried[at(2 * c)] = state.density[at(c)] * (1.0 + 0.1 * std::cos(wave * box.mesh.centre[at(c)][0]));
  TransportOperator transport(box.context, state);
  TurbulenceOperator turbulence(box.context, state, model, transport.properties());
  const double dt = 1e-4;
  turbulence.setStart(state, {ofMolecules, eddies, 0.0});
  transport.initialise(state, dt);
  turbulence.endSweep(state);
  const std::size_t oxygen = gas.mechanism.speciesIndex("O2"), n = air.size();
  const auto amplitudes = [&] {
    std::array<double, 3> found{};
    for (int c = 0; c < box.mesh.owned; ++c) {
      const double weight = std::cos(wave * box.mesh.centre[at(c)][0]);
      found[0] += weight * state.temperature[at(c)];
      found[1] += weight * state.Y[at(c) * n + oxygen];
      found[2] += weight * state.carried[at(2 * c)] / state.density[at(c)];
    }
    MPI_Allreduce(MPI_IN_PLACE, found.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return found;
  };
  const auto before = amplitudes();
  const int steps = 40;
  for (int i = 0; i < steps; ++i) {
    transport.advance(state, i * dt, dt);
    turbulence.advance(state, i * dt, dt);
    transport.endSweep(state);
    turbulence.endSweep(state);
  }
  const auto after = amplitudes();
  const GasProperties& gasOf = transport.properties();
  const double density = state.density[0];
  const std::array<double, 3> diffusivities{
      gasOf.conductivity[0] / (density * gasOf.heatCapacity[0]) + eddies / numbers.prandtl,
      gasOf.massDiffusivity[oxygen] / density + eddies / numbers.schmidt, eddies / numbers.schmidt};
  for (std::size_t i = 0; i < 3; ++i) {
    // Of implicit steps of first order.
    const double exact = std::pow(1.0 + dt * diffusivities[i] * wave * wave, -steps);
    EXPECT_NEAR(std::log(after[i] / before[i]) / std::log(exact), 1.0, 5e-3) << i;
  }
}

}  // namespace
}  // namespace lampblack::test
