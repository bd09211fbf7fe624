// The rates of a state: none of a uniform flow, those by which small steps change it, and what is left of them where a
// flow has become steady.
#include "flow/equations/flow_residual.hpp"

#include <gtest/gtest.h>

#include "core/constants.hpp"
#include "flow/models/radiation_operator.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/steady/residual_norms.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// A channel, open at both ends, with its operators.
class ResidualOfChannel : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  std::vector<double> fuel = gas.massFractions("H2: 0.3, O2: 0.15, N2: 0.5, H2O: 0.05");

  static MeshSpec spec(const std::vector<Side>& sides) {
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {gradedAxis(0.0, {{0.006, 8, 2.0}}), uniformAxis(0.012, 16), {}};
    for (const Side& side : sides) spec.patches.push_back(side.patch);
    return spec;
  }
  static std::vector<BoundaryCondition> conditions(const std::vector<Side>& sides) {
    std::vector<BoundaryCondition> all;
    for (const Side& side : sides) all.push_back(side.condition);
    return all;
  }
  [[nodiscard]] std::vector<Side> sides(const std::vector<double>& Y, double temperature, bool slips) const {
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = slips;
    return {side(BoundaryKind::Symmetry, 0, false), wall, opening(BoundaryKind::Inlet, 1, false, 0.5, temperature, Y),
            opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)};
  }
  [[nodiscard]] Box box(const std::vector<double>& Y, double temperature, bool slips = false,
                        MPI_Comm comm = MPI_COMM_WORLD) const {
    const std::vector<Side> all = sides(Y, temperature, slips);
    return {spec(all), conditions(all), {}, comm};
  }
  // Burning gas with something dispersed in it.
  State burning(Box& b) const {
    State state = b.state(
        [&](const auto& x) {
          const double hot = std::exp(-std::pow((x[1] - 0.005) / 0.003, 2) - std::pow((x[0] - 0.002) / 0.003, 2));
          std::vector<double> Y = fuel;
          for (std::size_t k = 0; k < Y.size(); ++k) Y[k] += (air[k] - fuel[k]) * 0.3 * std::cos(300.0 * x[1]);
          return Box::Local{{0.05 * std::sin(500.0 * x[0]), 0.5 + 20.0 * x[0], 0.0}, 900.0 + 500.0 * hot, Y};
        },
        {{"dust", "1/m3", "", 0.55}, {"still", "1/m3", "", 0.0, false}});
    for (int c = 0; c < b.mesh.cells; ++c) {
      state.carried[at(2 * c)] = 1.0 + std::sin(400.0 * b.mesh.centre[at(c)][0] + 300.0 * b.mesh.centre[at(c)][1]);
      state.carried[at(2 * c + 1)] = 3.0;
      state.carriedDiffusivity[at(2 * c)] = 1e-5;
    }
    return state;
  }
};

// Transport, reactions and radiation, in steps of one sweep.
struct Steps {
  Steps(Box& box, const State& state)
      : transport(box.context, state), chemistry(box.context, {}), radiation(box.context, 298.0, nullptr) {}
  std::vector<Operator*> all() { return {&transport, &chemistry, &radiation}; }
  void end(State& state) {
    for (Operator* op : all()) op->endStep(state);
    for (Operator* op : all()) op->endSweep(state);
  }
  void take(State& state, double time, double dt) {
    for (Operator* op : all()) op->advance(state, time, dt);
    end(state);
  }
  TransportOperator transport;
  ReactionOperator chemistry;
  RadiationOperator radiation;
};

TEST_F(ResidualOfChannel, OfAUniformFlowIsRoundOff) {
  Box b = box(air, 300.0, true);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, air}; }, {{"dust", "1/m3", "", 0.55}});
  Steps steps(b, state);
  steps.transport.initialise(state, 1e-5);
  FlowResidual residual(b.context, state, VelocityScheme::Limited, steps.all());
  residual.evaluate(state);
  const double flow = 0.5 * 0.006 * state.density[0];  // kg/s
  const FlowResidual::Rates& rates = residual.rates();
  EXPECT_LT(largest(b.mesh, [&](int c) { return std::abs(rates.mass[at(c)]); }), 1e-9 * flow);
  for (const ResidualNorm& norm : residualNorms(b.context, state, residual, 0.012 / 0.5))
    // The gas that cold reactions make of air, over the least range of a mass fraction.
    EXPECT_LT(norm.value, 1e-7) << norm.equation;
}

// What a step changes differs from the rates times its length by the square of that: half of the length, half of the
// difference of the two rates. The mass flux, and with it all else, is that of the step's end.
TEST_F(ResidualOfChannel, IsWhatAShortStepChanges) {
  Box b = box(fuel, 900.0);
  const auto n = gas.mechanism.numSpecies();
  const std::vector<std::string> names{"species", "enthalpy", "carried", "momentum"};
  // Differences of the rates by equation, over the largest rate in any cell.
  const auto differences = [&](int count) {
    const double dt = 8e-6 / count;
    State state = burning(b);
    Steps steps(b, state);
    steps.transport.initialise(state, dt);
    steps.end(state);
    for (int i = 0; i < count; ++i) steps.take(state, i * dt, dt);
    const State before = state;
    steps.take(state, count * dt, dt);
    FlowResidual residual(b.context, state, VelocityScheme::Limited, steps.all());
    // Pressures are found with the velocities that they lead to.
    State present = before;
    present.pressure = state.pressure;
    present.massFlux = state.massFlux;
    const FlowResidual::Rates rates = residual.evaluate(present);
    std::array<double, 4> most{}, differs{};
    const auto compare = [&](std::size_t equation, double rate, double change) {
      most[equation] = std::max(most[equation], std::abs(rate));
      differs[equation] = std::max(differs[equation], std::abs(change / dt - rate));
    };
    for (int c = 0; c < b.mesh.owned; ++c) {
      const double V = b.mesh.volume[at(c)];
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = at(c) * n + k;
        compare(0, rates.species[i] / V, state.density[at(c)] * state.Y[i] - before.density[at(c)] * before.Y[i]);
      }
      compare(1, rates.enthalpy[at(c)] / V,
              state.density[at(c)] * state.enthalpy[at(c)] - before.density[at(c)] * before.enthalpy[at(c)]);
      compare(2, rates.carried[at(2 * c)] / V, state.carried[at(2 * c)] - before.carried[at(2 * c)]);
      EXPECT_EQ(rates.carried[at(2 * c + 1)], 0.0);
      for (int i = 0; i < 2; ++i)
        compare(3, rates.momentum[at(2 * c + i)] / (V * before.density[at(c)]),
                state.velocity[at(2 * c + i)] - before.velocity[at(2 * c + i)]);
    }
    std::array<double, 4> relative{};
    for (std::size_t e = 0; e < relative.size(); ++e) relative[e] = maxOverRanks(differs[e]) / maxOverRanks(most[e]);
    return relative;
  };
  const auto whole = differences(20), half = differences(40);
  for (std::size_t e = 0; e < whole.size(); ++e) {
    report(fmt::format("{}: {:.3g}, with half of the step {:.3g}", names[e], whole[e], half[e]));
    EXPECT_LT(half[e], 0.06) << names[e];
    EXPECT_NEAR(whole[e] / half[e], 2.0, 0.4) << names[e];
  }
}

// Faces feel pressures that alternate from cell to cell, of which the cells feel nothing (Rhie and Chow 1983).
TEST_F(ResidualOfChannel, DrivesGasFromHighToLowPressureAtEachFace) {
  Box b = box(air, 300.0, true);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, air}; }, {});
  Steps steps(b, state);
  steps.transport.initialise(state, 1e-5);
  for (int c = 0; c < b.mesh.cells; ++c)
    state.pressure[at(c)] = std::lround(b.mesh.centre[at(c)][1] / 0.00075 - 0.5) % 2 == 0 ? 1.0 : -1.0;
  FlowResidual residual(b.context, state, VelocityScheme::Limited, steps.all());
  const FlowResidual::Rates& rates = residual.evaluate(state);
  int found = 0;
  for (int face = 0; face < b.mesh.interiorFaces; ++face) {
    const double step = state.pressure[at(b.mesh.low[at(face)])] - state.pressure[at(b.mesh.high[at(face)])];
    if (step == 0.0) continue;
    EXPECT_GT(rates.massFlux[at(face)] / step, 1e-3 * std::abs(state.massFlux[at(face)])) << face;
    ++found;
  }
  EXPECT_GT(found, 0);
}

// Where the flow through a face turns round next to nothing changes, however unlike the gas on both sides: what is
// carried diffuses and drifts as before. With a jump a flow with such a face need not have a steady state.
TEST_F(ResidualOfChannel, DoesNotJumpWhereTheFlowThroughAFaceTurnsRound) {
  Box b = box(fuel, 900.0);
  State state = burning(b);
  Steps steps(b, state);
  steps.transport.initialise(state, 1e-6);
  FlowResidual residual(b.context, state, VelocityScheme::Limited, steps.all());
  const auto ratesWith = [&](double flux) {
    for (int face = 0; face < b.mesh.interiorFaces; ++face) state.massFlux[at(face)] = flux;
    return residual.evaluate(state);
  };
  const FlowResidual::Rates forth = ratesWith(1e-18), back = ratesWith(-1e-18);
  const auto same = [&](const char* what, const std::vector<double>& one, const std::vector<double>& other) {
    double most = 0.0, apart = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
      most = std::max(most, std::abs(one[i]));
      apart = std::max(apart, std::abs(one[i] - other[i]));
    }
    EXPECT_GT(maxOverRanks(most), 0.0) << what;
    EXPECT_LT(maxOverRanks(apart), 1e-9 * maxOverRanks(most)) << what;
  };
  same("carried", forth.carried, back.carried);
  same("species", forth.species, back.species);
  same("enthalpy", forth.enthalpy, back.enthalpy);
  same("momentum", forth.momentum, back.momentum);
}

// What is carried diffuses through a face of unequal cells as the density is there.
TEST_F(ResidualOfChannel, DiffusesByTheDensityAtTheFace) {
  Box b = box(fuel, 900.0);
  State state = burning(b);
  const auto densityAt = [](const Vector3& place) { return 0.2 + 80.0 * place[0] + 10.0 * place[1]; };
  for (int c = 0; c < b.mesh.cells; ++c) {
    state.density[at(c)] = densityAt(b.mesh.centre[at(c)]);
    state.carriedDiffusivity[at(2 * c)] = 1e-5;
  }
  Steps steps(b, state);
  FlowResidual residual(b.context, state, VelocityScheme::Limited, steps.all());
  residual.evaluate(state);
  std::vector<double> conductance(at(2 * b.mesh.faces)), flux(conductance.size());
  residual.carried().diffusiveFlux(state, residual.faces(), residual.properties(), conductance, flux);
  for (int face = 0; face < b.mesh.interiorFaces; ++face) {
    const double metric = 1e-5 * b.mesh.area[at(face)] / b.mesh.distance[at(face)];
    EXPECT_NEAR(conductance[at(2 * face)], metric * densityAt(b.mesh.faceCentre[at(face)]), 1e-12 * metric) << face;
  }
}

// What mass is left over counts in its own equation alone.
TEST_F(ResidualOfChannel, CountsMassOnce) {
  Box b = box(air, 300.0, true);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, air}; }, {{"dust", "1/m3", ""}});
  std::ranges::fill(state.carried, 2.0);
  Steps steps(b, state);
  steps.transport.initialise(state, 1e-5);
  for (int face = 0; face < b.mesh.interiorFaces; ++face)
    state.massFlux[at(face)] *= 1.0 + 0.1 * std::sin(700.0 * b.mesh.faceCentre[at(face)][1]);
  FlowResidual residual(b.context, state, VelocityScheme::Limited, steps.all());
  residual.evaluate(state);
  for (const ResidualNorm& norm : residualNorms(b.context, state, residual, 0.012 / 0.5)) {
    if (norm.equation == "mass") {
      EXPECT_GT(norm.value, 0.1);
    } else if (norm.equation == "enthalpy" || norm.kind == ResidualNorm::Kind::Species) {
      EXPECT_LT(norm.value, 1e-6) << norm.equation;
    }
  }
}

// So does what species are left over: gases that mix at one temperature carry enthalpies of formation of a hundred
// times the heat that is in the gas, and heat nothing.
TEST_F(ResidualOfChannel, CountsSpeciesOnce) {
  Box b = box(air, 300.0);
  State state = b.state([&](const Vector3& place) {
    std::vector<double> Y = air;
    const double share = 0.5 + 0.4 * std::sin(700.0 * place[1]);
    for (std::size_t k = 0; k < Y.size(); ++k) Y[k] += share * (fuel[k] - Y[k]);
    return Box::Local{{0.0, 0.5}, 300.0, Y};
  });
  Steps steps(b, state);
  steps.transport.initialise(state, 1e-5);
  FlowResidual residual(b.context, state, VelocityScheme::Limited, {&steps.transport});
  residual.evaluate(state);
  double species = 0.0;
  for (const ResidualNorm& norm : residualNorms(b.context, state, residual, 0.012 / 0.5)) {
    if (norm.kind == ResidualNorm::Kind::Species) species = std::max(species, norm.value);
    if (norm.equation == "enthalpy") {
      EXPECT_LT(norm.value, 1e-7);
    }
  }
  EXPECT_GT(species, 0.1);
}

// Of a gas that is as it was, only what has moved is found anew: to the last bit what all of it would be.
TEST_F(ResidualOfChannel, OfTheSameGasIsThatOfAllAnew) {
  Box b = box(fuel, 900.0);
  State state = burning(b);
  Steps steps(b, state);
  steps.transport.initialise(state, 1e-6);
  FlowResidual some(b.context, state, VelocityScheme::Limited, steps.all());
  FlowResidual all(b.context, state, VelocityScheme::Limited, steps.all());
  const auto same = [&](const char* what) {
    SCOPED_TRACE(what);
    const FlowResidual::Rates& rates = some.evaluateFlow(state, FlowResidual::Gas::Same);
    const FlowResidual::Rates& anew = all.evaluateFlow(state);
    EXPECT_EQ(rates.mass, anew.mass);
    EXPECT_EQ(rates.massFlux, anew.massFlux);
    EXPECT_EQ(rates.momentum, anew.momentum);
    EXPECT_EQ(some.faces().density, all.faces().density);
    EXPECT_EQ(some.faces().enthalpy, all.faces().enthalpy);
    EXPECT_TRUE(std::ranges::equal(some.faces().temperatureGradient(), all.faces().temperatureGradient()));
  };
  some.evaluate(state);
  all.evaluate(state);
  for (double& velocity : state.velocity) velocity *= 1.1;
  same("faster");
  for (int face = 0; face < b.mesh.interiorFaces; ++face)
    if (b.mesh.faceCentre[at(face)][1] > 0.006) state.massFlux[at(face)] *= -1.0;
  same("back inside");
  for (int face = b.mesh.interiorFaces; face < b.mesh.faces; ++face)
    if (b.context.boundaryOf(face).kind == BoundaryKind::Outlet) state.massFlux[at(face)] *= -1.0;
  same("in through the outlet");
  for (double& carried : state.carried) carried *= 1.0 + carried;
  const std::vector<double> carried = some.evaluateCarried(state, FlowResidual::Gas::Same).carried;
  EXPECT_EQ(carried, all.evaluateCarried(state).carried);
}

TEST_F(ResidualOfChannel, IsTakenOfWhatIsBroughtAndWhatIsMade) {
  Box b = box(fuel, 900.0);
  State state = burning(b);
  Steps steps(b, state);
  steps.transport.initialise(state, 1e-6);
  FlowResidual residual(b.context, state, VelocityScheme::Limited, steps.all());
  const FlowResidual::Rates& rates = residual.evaluate(state);
  const std::size_t n = gas.mechanism.numSpecies(), species = gas.mechanism.speciesIndex("HO2");
  const auto whole = [&](const auto& of) {
    double sum = 0.0;
    for (int c = 0; c < b.mesh.owned; ++c) sum += b.mesh.volume[at(c)] * of(at(c));
    return sumOverRanks(sum);
  };
  const double made = whole([&](std::size_t c) { return std::max(rates.made.reactions[c * n + species], 0.0); });
  // Little differs in the domain: the least range counts. As much is brought as is made.
  const double time = 1e-6 * whole([&](std::size_t c) { return state.density[c]; }) / made;
  const double left = whole([&](std::size_t c) {
    return std::abs(rates.species[c * n + species] - state.Y[c * n + species] * rates.mass[c]) / b.mesh.volume[c];
  });
  ASSERT_GT(made, 0.0);
  const auto norms = residualNorms(b.context, state, residual, time);
  const auto found = std::ranges::find(norms, "HO2", &ResidualNorm::equation);
  ASSERT_NE(found, norms.end());
  EXPECT_NEAR(found->value * 2.0 * made / left, 1.0, 1e-10);
}

// A flow that has been marched until nothing changes has none left, on any number of ranks; one that has been marched
// for a while has.
TEST_F(ResidualOfChannel, IsGoneWhereAFlowIsSteady) {
  const auto march = [&](int count, MPI_Comm comm) {
    Box b = box(air, 400.0, false, comm);
    State state = b.state(
        [&](const auto&) {
          return Box::Local{{0.0, 0.5}, 300.0, air};
        },
        {{"dust", "1/m3", "", 0.55}});
    Steps steps(b, state);
    const double dt = 5e-4;  // Courant number 0.33, and 0.5 where it is fastest
    steps.transport.initialise(state, dt);
    steps.end(state);
    for (int i = 0; i < count; ++i) steps.take(state, i * dt, dt);
    FlowResidual residual(b.context, state, VelocityScheme::Limited, steps.all());
    residual.evaluate(state);
    return residualNorms(b.context, state, residual, 0.012 / 0.5);
  };
  const auto early = march(20, MPI_COMM_WORLD), late = march(300, MPI_COMM_WORLD), alone = march(20, MPI_COMM_SELF);
  ASSERT_EQ(early.size(), 4 + gas.mechanism.numSpecies() + 1);
  for (std::size_t e = 0; e < early.size(); ++e) {
    report(fmt::format("{}: {:.3g}, in the end {:.3g}", early[e].equation, early[e].value, late[e].value));
    EXPECT_LT(late[e].value, 1e-6) << early[e].equation;
    EXPECT_NEAR(early[e].value, alone[e].value, 1e-6 * alone[e].value + 1e-9) << early[e].equation;
  }
  for (std::size_t e = 0; e < 4; ++e) EXPECT_GT(early[e].value, 1e-5) << early[e].equation;
}

}  // namespace
}  // namespace lampblack::test
