// Carried scalars: conserved, never negative, stable at any diffusivity, and drifting from hot to cold.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/constants.hpp"
#include "flow/stepping/budget.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class Carried : public testing::TestWithParam<Geometry> {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");

  Box box(double speed) const {
    return {
        GetParam(),
        {gradedAxis(0.0, {{0.006, 10, 2.0}}), uniformAxis(0.012, 24)},
        {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
         speed > 0.0 ? opening(BoundaryKind::Inlet, 1, false, speed, 400.0, air) : side(BoundaryKind::Wall, 1, false),
         opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)}};
  }
  // A top hat of `value` in the lower half of the first axis and the middle third of the second.
  static void fill(Box& b, State& state, int scalar, double value) {
    for (int c = 0; c < b.mesh.cells; ++c) {
      const auto& x = b.mesh.centre[at(c)];
      const bool in = x[0] < 0.003 && x[1] > 0.004 && x[1] < 0.008;
      state.carried[at(c * state.carriedCount() + scalar)] = in ? value : 0.0;
    }
  }
};

TEST_P(Carried, ScalarsAreConservedAndStayNonNegative) {
  Box b = box(0.5);
  State state = b.state(
      [&](const auto& x) {
        return Box::Local{{0.0, 0.5}, 400.0 + 1e4 * x[0], air};
      },
      {{"number", "1/m3", "", 0.55}, {"passive", "1/m3", "", 0.0}});
  const double peak[2] = {1e18, 2.0};
  for (int s = 0; s < 2; ++s) fill(b, state, s, peak[s]);
  TransportOperator transport(b.context, state);
  const double dt = 2e-4;  // Courant number 0.2
  transport.initialise(state, dt);
  const auto total = [&](int s) { return integral(b.mesh, [&](int c) { return state.carried[at(2 * c + s)]; }); };
  const double start[2] = {total(0), total(1)};
  double left[2] = {0.0, 0.0};
  const int steps = 60;  // the top hat leaves through the outlet
  for (int i = 0; i < steps; ++i) {
    transport.advance(state, i * dt, dt);
    for (int s = 0; s < 2; ++s) {
      left[s] += sumOverRanks(transport.boundaryAmounts().carriedOut[at(s)]);
      // Without diffusivity the limited scheme alone acts, which cannot undershoot at this Courant number but by the
      // round-off of a face value.
      EXPECT_GE(-largest(b.mesh, [&](int c) { return -state.carried[at(2 * c + s)]; }), -epsilon * peak[s]);
      EXPECT_LE(sumOverRanks(transport.boundaryAmounts().carriedIn[at(s)]), epsilon * start[s]);
    }
  }
  for (int s = 0; s < 2; ++s) {
    EXPECT_NEAR(total(s) + left[s], start[s], 5.0 * steps * epsilon * start[s]) << "scalar " << s;
    EXPECT_GT(left[s], 0.3 * start[s]);
  }
}

// Sources of species, enthalpy and scalars that the balance holds come into the cells as they are, mass included, and
// make room for themselves: the pressure stays.
TEST_P(Carried, TheBalanceIsASource) {
  Box b = box(0.5);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 400.0, air}; }, {{"dust", "1/m3", "", 0.0}});
  TransportOperator transport(b.context, state);
  const double dt = 1e-4;
  transport.initialise(state, dt);
  const auto n = at(state.species), hydrogen = gas.mechanism.speciesIndex("H2");
  const auto where = [&](int c) { return std::exp(-std::pow((b.mesh.centre[at(c)][1] - 0.006) / 0.002, 2)); };
  const auto held = [&] {
    const auto sum = [&](const auto& value) { return integral(b.mesh, value); };
    return std::array<double, 3>{sum([&](int c) { return state.density[at(c)] * state.Y[at(c) * n + hydrogen]; }),
                                 sum([&](int c) { return state.density[at(c)] * state.enthalpy[at(c)]; }),
                                 sum([&](int c) { return state.carried[at(c)]; })};
  };
  const std::array<double, 3> rate{0.02, 5e6, 7.0}, start = held();
  std::array<double, 3> left{};
  const int steps = 20;
  for (int i = 0; i < steps; ++i) {
    for (int c = 0; c < b.mesh.owned; ++c) {
      state.balance.reactions[at(c) * n + hydrogen] = rate[0] * where(c);
      state.balance.enthalpy[at(c)] = rate[1] * where(c);
      state.balance.carried[at(c)] = rate[2] * where(c);
    }
    transport.advance(state, i * dt, dt);
    const auto& amounts = transport.boundaryAmounts();
    left[0] += sumOverRanks(amounts.speciesOut[hydrogen] - amounts.speciesIn[hydrogen]);
    left[1] += sumOverRanks(amounts.enthalpyOut - amounts.enthalpyIn);
    left[2] += sumOverRanks(amounts.carriedOut[0] - amounts.carriedIn[0]);
  }
  const double volume = integral(b.mesh, where);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR((held()[i] - start[i] + left[i]) / (steps * dt * rate[i] * volume), 1.0, 1e-9) << i;
  // In a step 1.4e-3 of the heat of a cell comes: half its square is left.
  EXPECT_LT(transport.pressureDrift(state), 1e-6);
  transport.endSweep(state);
  EXPECT_EQ(largest(b.mesh, [&](int c) { return std::abs(state.balance.carried[at(c)]); }), 0.0);
}

// What carried scalars weigh stands in the budgets, also when it has left.
TEST_P(Carried, StaysInTheBudgetsWhenItLeaves) {
  Box b = box(0.5);
  State state = b.state(
      [&](const auto& x) {
        return Box::Local{{0.0, 0.5}, 400.0 + 1e4 * x[0], air};
      },
      {{"carbon", "kg/m3", "", 0.55}});
  fill(b, state, 0, 2.0);  // more than there is of the gas
  TransportOperator transport(b.context, state);
  const double dt = 2e-4;
  transport.initialise(state, dt);
  std::vector<double> elements(gas.mechanism.numElements(), 0.0);
  elements[0] = 1.0;
  Budget budget(b.context, massAndElements(gas.mechanism, {elements}), state);
  const double before = integral(b.mesh, [&](int c) { return state.carried[at(c)]; });
  for (int i = 0; i < 60; ++i) {
    transport.advance(state, i * dt, dt);
    budget.addStep(transport.boundaryAmounts());
  }
  EXPECT_LT(integral(b.mesh, [&](int c) { return state.carried[at(c)]; }), 0.7 * before);
  for (const Budget::Line& line : budget.lines(state)) EXPECT_LT(line.error, 1e-11) << line.name;
}

// A cosine along the box is an eigenvector of the scheme: of its amplitude 1/(1 + D lambda dt) is left, lambda = 2 (1 -
// cos(pi/n)) / h^2.
TEST_P(Carried, AWaveDecaysAtTheRateOfItsDiffusivity) {
  Box b = box(0.0);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; }, {{"wave", "1/m3", "", 0.0}});
  constexpr double length = 0.012, cells = 24, spacing = length / cells, D = 2e-3, dt = 5e-3;
  const auto cosine = [&](int c) { return std::cos(constants::pi * b.mesh.centre[at(c)][1] / length); };
  for (int c = 0; c < b.mesh.cells; ++c) state.carried[at(c)] = 1 + 0.5 * cosine(c);
  std::fill(state.carriedDiffusivity.begin(), state.carriedDiffusivity.end(), D);
  TransportOperator transport(b.context, state);
  transport.initialise(state, dt);
  const auto amplitude = [&] {
    return integral(b.mesh, [&](int c) { return state.carried[at(c)] * cosine(c); }) /
           integral(b.mesh, [&](int c) { return cosine(c) * cosine(c); });
  };
  ASSERT_NEAR(amplitude(), 0.5, 1e-12);
  transport.advance(state, 0.0, dt);
  const double eigenvalue = 2 * (1 - std::cos(constants::pi / cells)) / (spacing * spacing);
  EXPECT_NEAR(amplitude() / (0.5 / (1 + D * eigenvalue * dt)), 1, 1e-6);
}

// A scalar that is everywhere the same per mass of gas leaves in proportion to the gas.
TEST_P(Carried, LeavesWithTheGas) {
  Box b = box(0.5);
  State state = b.state(
      [&](const auto& x) {
        return Box::Local{{0.0, 0.5}, 400.0 + 1e4 * x[0], air};
      },
      {{"passive", "1/m3", "", 0.0}});
  const double perMass = 3.0;
  for (int c = 0; c < b.mesh.cells; ++c) state.carried[at(c)] = perMass * state.density[at(c)];
  TransportOperator transport(b.context, state);
  const double dt = 1e-4;
  transport.initialise(state, dt);
  for (int i = 0; i < 3; ++i) {
    transport.advance(state, i * dt, dt);
    double leaving = 0.0;
    for (double species : transport.boundaryAmounts().speciesOut) leaving += species;
    const double out = sumOverRanks(transport.boundaryAmounts().carriedOut[0]);
    EXPECT_GT(out, 0.0);
    // The last cells see nothing yet of the gas from the inlet, which has none.
    EXPECT_NEAR(out / (perMass * sumOverRanks(leaving)), 1.0, 1e-3);
  }
}

TEST_P(Carried, HugeDiffusivityIsStableConservedAndBounded) {
  Box b = box(0.0);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; }, {{"small", "1/m3", "", 0.0}});
  fill(b, state, 0, 1.0);
  // Fourier number D dt/dx^2 = 4e5 dt: 400 in the first step, then 4e5; explicit diffusion is unstable above 1/4.
  std::fill(state.carriedDiffusivity.begin(), state.carriedDiffusivity.end(), 0.1);
  TransportOperator transport(b.context, state);
  transport.initialise(state, 1e-3);
  const double start = integral(b.mesh, [&](int c) { return state.carried[at(c)]; });
  const double volume = integral(b.mesh, [](int) { return 1.0; });
  // Each solve ends at a residual of 1e-7 of its source at most (2-norm over the cells, volumes of equal order).
  double norm = 0.0;
  double smallest = 1e300;
  for (int c = 0; c < b.mesh.owned; ++c) {
    norm += std::pow(b.mesh.volume[at(c)] * state.carried[at(c)], 2);
    smallest = std::min(smallest, b.mesh.volume[at(c)]);
  }
  const double slack = 1e-7 * std::sqrt(sumOverRanks(norm)) / minOverRanks(smallest);
  int step = 0;
  double left = 0.0;
  for (const double dt : {1e-3, 1.0, 1.0}) {
    transport.advance(state, 0.0, dt);
    ++step;
    EXPECT_LE(largest(b.mesh, [&](int c) { return state.carried[at(c)]; }), 1.0 + step * slack);
    EXPECT_GE(-largest(b.mesh, [&](int c) { return -state.carried[at(c)]; }), -step * slack);
    left += sumOverRanks(transport.boundaryAmounts().carriedOut[0]);
    EXPECT_NEAR(integral(b.mesh, [&](int c) { return state.carried[at(c)]; }) + left, start,
                20.0 * step * epsilon * start);
  }
  // After 1 s, ten thousand diffusion times, it is uniform up to the solver's tolerance and its condition number, the
  // Fourier number times the square of the cells along the box.
  const double mean = start / volume;
  EXPECT_LE(largest(b.mesh, [&](int c) { return std::abs(state.carried[at(c)] - mean); }), 1e-3 * mean);
}

// At a face between particles that diffuse and others that do not, both sides count, whichever is the lower one: two
// scalars that are mirror images of each other stay so.
TEST_P(Carried, DiffusivityOfAFaceIsThatOfBothCells) {
  Box b = box(0.0);
  State state = b.state(
      [&](const auto&) {
        return Box::Local{{0.0, 0.0}, 300.0, air};
      },
      {{"upwards", "1/m3", "", 0.0}, {"downwards", "1/m3", "", 0.0}});
  const auto isBelow = [&](int c) { return b.mesh.centre[at(c)][1] < 0.006; };
  for (int c = 0; c < b.mesh.cells; ++c)
    for (int s = 0; s < 2; ++s) {
      const bool full = isBelow(c) == (s == 0);
      state.carried[at(2 * c + s)] = full ? 1.0 : 0.0;
      state.carriedDiffusivity[at(2 * c + s)] = full ? 1e-4 : 0.0;
    }
  TransportOperator transport(b.context, state);
  transport.initialise(state, 1e-3);
  transport.advance(state, 0.0, 1e-3);
  const auto crossed = [&](int s) {
    return integral(b.mesh, [&](int c) { return isBelow(c) == (s == 0) ? 0.0 : state.carried[at(2 * c + s)]; });
  };
  EXPECT_GT(crossed(0), 0.0);
  EXPECT_NEAR(crossed(1) / crossed(0), 1.0, 1e-6) << "the tolerance of the solver is 1e-9";
}

TEST_P(Carried, ThermophoresisDriftsToTheCold) {
  const double K = 0.55;
  Box b = box(0.0);
  State state = b.state(
      [&](const auto& x) {
        return Box::Local{{0.0, 0.0}, 600.0 + 2e4 * x[1], air};
      },
      {{"drifting", "1/m3", "", K}, {"passive", "1/m3", "", 0.0}});
  fill(b, state, 0, 1.0);
  fill(b, state, 1, 1.0);
  TransportOperator transport(b.context, state);
  const double dt = 1e-5;
  transport.initialise(state, dt);
  // Who moves particles in a gas that stays as it is needs it before the first step.
  const std::vector<double> atStart(transport.driftFlux().begin(), transport.driftFlux().end());
  // As carried scalars, particles diffuse by the density between the cells, whichever way the gas flows.
  for (int face = 0; face < b.mesh.interiorFaces; ++face) {
    const double w = b.mesh.lowWeight[at(face)];
    const double between =
        w * state.density[at(b.mesh.low[at(face)])] + (1.0 - w) * state.density[at(b.mesh.high[at(face)])];
    EXPECT_NEAR(transport.faceDensity()[at(face)], between, 1e-12) << face;
  }
  const auto moment = [&](int s, double power) {
    return integral(b.mesh,
                    [&](int c) { return state.carried[at(2 * c + s)] * std::pow(b.mesh.centre[at(c)][1], power); });
  };
  transport.advance(state, 0.0, dt);
  for (int face = 0; face < b.mesh.interiorFaces; ++face) {
    const double drift = transport.driftFlux()[at(face)];
    EXPECT_NEAR(atStart[at(face)], drift, 0.01 * std::abs(drift) + 1e-12) << face;
  }
  // Mean velocity of the drifting against the passive scalar. The gas expands alike under both.
  const double relative = (moment(0, 1.0) / moment(0, 0.0) - moment(1, 1.0) / moment(1, 0.0)) / dt;
  // -K (mu/rho) (dT/dy)/T at the middle of the top hat.
  GasProperties properties;
  properties.update(b.context, state);
  const double content = integral(b.mesh, [&](int c) { return state.carried[at(2 * c)]; });
  const double exact = integral(b.mesh,
                                [&](int c) {
                                  return -K * state.carried[at(2 * c)] * properties.viscosity[at(c)] /
                                         state.density[at(c)] * 2e4 / state.temperature[at(c)];
                                }) /
                       content;
  // The top hat's upwind edges sit half a cell off: half a cell's variation of nu/T, 0.7 dx (dT/dy)/(2T) = 0.5 %, and
  // the two signs of the velocity differ in it by as much again.
  EXPECT_NEAR(relative / exact, 1.0, 0.02);
  EXPECT_LT(relative, 0.0);
}

// Still gas between a warm wall at 0 and a cold one at L, both of which take particles, and as many particles coming
// into every volume: J = w c - rho D c' rises by S L from one wall to the other. With P = w L/(rho D) the part 1/P -
// 1/(e^P - 1) of them goes to the warm wall, and c = (J0 + S y)/w + S rho D/w^2 - S L/w e^(P y/L)/(e^P - 1), J0 = -S L
// times that part. The warm wall is so little warmer, and the coefficient so large, that nothing else varies.
struct Slab {
  double toWarm = 0.0, toCold = 0.0, error = 0.0, unbooked = 0.0, least = 0.0;  // shares; mean error of c over its mean
};
Slab slabBetweenWalls(int cells, double peclet, int sweeps, bool diffuses = true, bool warmTakes = true) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double length = 0.01, cold = 300.0, warmer = 0.03, v = peclet > 0.0 ? 0.02 : 0.0, source = 3.0;
  std::vector<double> X(air.size()), D(air.size());
  gas.thermo.massToMole(air, X);
  const double density = gas.thermo.density(cold, 101325.0, air);
  const double viscosity = gas.transport.mixture(cold, 101325.0, X, D).viscosity;
  const double diffusivity = !diffuses ? 0.0 : peclet > 0.0 ? v * length / peclet : 5e-5;
  std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
                          side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)};
  for (const std::size_t i : {2, 3}) {
    sides[i].condition.isothermal = true;
    sides[i].condition.temperature = i == 2 ? cold + warmer : cold;
    sides[i].condition.takesParticles = i == 3 || warmTakes;
  }
  // Each rank has all of it.
  MeshSpec spec;
  spec.vertices = {uniformAxis(1e-3, 2), uniformAxis(length, cells), {}};
  std::vector<BoundaryCondition> conditions;
  for (const Side& s : sides) {
    spec.patches.push_back(s.patch);
    conditions.push_back(s.condition);
  }
  Box b(spec, conditions, {}, MPI_COMM_SELF);
  const auto sum = [&](const auto& perVolume) {
    double all = 0.0;
    for (int c = 0; c < b.mesh.owned; ++c) all += b.mesh.volume[at(c)] * perVolume(c);
    return all;
  };
  State state = b.state(
      [&](const auto& x) {
        return Box::Local{{}, cold + warmer * (1.0 - x[1] / length), air};
      },
      {{"dust", "1/m3", "", v * density * cold * length / (viscosity * warmer)}});
  std::fill(state.carriedDiffusivity.begin(), state.carriedDiffusivity.end(), diffusivity);
  TransportOperator transport(b.context, state, {.sweeps = sweeps});
  const double dt = v > 0.0 ? 0.4 * length / cells / v : 0.2;
  transport.initialise(state, dt);
  for (int c = 0; c < b.mesh.owned; ++c) state.balance.carried[at(c)] = source;
  double through[2] = {0.0, 0.0}, taken = 0.0;
  const double came = source * sum([](int) { return 1.0; }) * dt;
  int steps = 0;
  Slab found;
  for (const int enough = v > 0.0 ? 8 * cells : 30; steps < enough; ++steps) {
    for (int sweep = 0; sweep < sweeps; ++sweep) transport.advance(state, steps * dt, dt);
    taken += transport.boundaryAmounts().carriedOut[0];
  }
  for (int face = b.mesh.interiorFaces; face < b.mesh.faces; ++face)
    if (b.mesh.patch[at(face - b.mesh.interiorFaces)] >= 2)
      through[b.mesh.patch[at(face - b.mesh.interiorFaces)] - 2] += transport.carriedFlux()[at(face)] * dt;
  found.toWarm = through[0] / came;
  found.toCold = through[1] / came;
  const double content = sum([&](int c) { return state.carried[at(c)]; });
  found.unbooked = std::abs(content + taken - steps * came) / (steps * came);
  const double w = v * density, g = density * diffusivity;
  const auto exact = [&](double y) {  // c
    if (!(w > 0.0)) return 0.5 * source * y * (length - y) / g;
    if (!(g > 0.0)) return source * y / w;
    const double J0 = -source * length * (1.0 / peclet - 1.0 / std::expm1(peclet));
    return (J0 + source * y) / w + source * g / (w * w) -
           source * length / w * std::exp(peclet * (y / length - 1.0)) / -std::expm1(-peclet);
  };
  found.error = sum([&](int c) { return std::abs(state.carried[at(c)] / density - exact(b.mesh.centre[at(c)][1])); }) /
                sum([&](int c) { return exact(b.mesh.centre[at(c)][1]); });
  found.least = *std::ranges::min_element(state.carried);
  return found;
}

TEST(Walls, TakeWhatDriftsAndDiffusesToThem) {
  struct Case {
    const char* name;
    double peclet;
    bool diffuses;
    double share, error;  // most that are allowed on 20 cells
  };
  // A layer of a twentieth of a cell at the warm wall takes what comes into it: that is not resolved.
  for (const Case& one :
       {Case{"diffusion", 0.0, true, 2e-5, 4e-3}, Case{"both", 4.0, true, 1.6e-3, 2.7e-3},
        Case{"a thin layer at the wall", 400.0, true, 2.6e-3, 6e-3}, Case{"drift", 1.0, false, 0.0, 1e-4}}) {
    SCOPED_TRACE(one.name);
    const double exact = !one.diffuses       ? 0.0
                         : one.peclet == 0.0 ? 0.5
                                             : 1.0 / one.peclet - 1.0 / std::expm1(one.peclet);
    const int sweeps = one.peclet == 4.0 ? 2 : 1;
    const Slab coarse = slabBetweenWalls(10, one.peclet, 1, one.diffuses);
    const Slab fine = slabBetweenWalls(20, one.peclet, sweeps, one.diffuses);
    report(fmt::format("{}: to the warm wall {:.5f} and {:.5f}, exact {:.5f}; error of c {:.2e} and {:.2e}", one.name,
                       coarse.toWarm, fine.toWarm, exact, coarse.error, fine.error));
    EXPECT_LE(std::abs(fine.toWarm - exact), one.share);
    EXPECT_NEAR(fine.toWarm + fine.toCold, 1.0, 1e-4) << "not steady";
    EXPECT_LT(fine.error, one.error);
    EXPECT_LT(fine.unbooked, 1e-12);
    EXPECT_GE(fine.least, 0.0);
  }
}

// A wall that reflects has none, and one that is told to takes all.
TEST(Walls, TakeNoneWhereTheyReflect) {
  const Slab one = slabBetweenWalls(10, 4.0, 1, true, false);
  EXPECT_EQ(one.toWarm, 0.0);
  EXPECT_GT(one.toCold, 0.99);
}

INSTANTIATE_TEST_SUITE_P(Geometries, Carried, testing::Values(Geometry::Planar, Geometry::Axisymmetric));

}  // namespace
}  // namespace lampblack::test
