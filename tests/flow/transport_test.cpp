// The transport step: uniform states, balance sheets, and mixing without spurious temperatures.
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/state_backup.hpp"
#include "flow/stepping/budget.hpp"
#include "flow/stepping/time_step.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class Channel : public testing::TestWithParam<Geometry> {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> fuel = gas.massFractions("H2: 0.5, H2O: 0.5");
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  Axes axes{gradedAxis(0.0, {{0.006, 12, 2.0}}), gradedAxis(0.0, {{0.012, 16, 1.5}})};

  // Flow along the second axis: an inner stream of fuel within `half` of the axis, an outer one of air.
  std::vector<Side> sides(double fuelSpeed, double fuelT, double airSpeed, double airT, bool fixedComposition) const {
    Side inner = opening(BoundaryKind::Inlet, 1, false, fuelSpeed, fuelT, fuel);
    inner.patch.name = inner.condition.name = "inner";
    inner.patch.to = 0.003;
    inner.condition.fixedComposition = fixedComposition;
    return {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true), inner,
            opening(BoundaryKind::Inlet, 1, false, airSpeed, airT, air),
            opening(BoundaryKind::Outlet, 1, true, 0.0, airT, air)};
  }
};

TEST_P(Channel, UniformStateStaysUniformToRoundOff) {
  fuel = air;
  Box box(GetParam(), axes, sides(0.4, 500.0, 0.4, 500.0, true));
  const Box::Local uniform{{0.0, 0.4}, 500.0, air};
  State state = box.state([&](const auto&) { return uniform; });
  const State start = state;
  TransportOperator transport(box.context, state);
  const double dt = 1e-4;
  const int steps = 10;
  transport.initialise(state, dt);
  for (int i = 0; i < steps; ++i) transport.advance(state, i * dt, dt);
  // An update sums six fluxes, each up to a Courant number below one: some ten roundings a step.
  const double tolerance = 10.0 * steps * epsilon;
  const Mesh& m = box.mesh;
  const auto expectSame = [&](const std::vector<double>& now, const std::vector<double>& before, int components,
                              double scale, const char* what) {
    EXPECT_LE(largest(m,
                      [&](int c) {
                        double most = 0.0;
                        for (int k = 0; k < components; ++k)
                          most = std::max(most, std::abs(now[at(c * components + k)] - before[at(c * components + k)]));
                        return most / scale;
                      }),
              tolerance)
        << what;
  };
  expectSame(state.temperature, start.temperature, 1, 500.0, "temperature");
  expectSame(state.density, start.density, 1, start.density[0], "density");
  expectSame(state.Y, start.Y, state.species, 1.0, "mass fractions");
  expectSame(state.velocity, start.velocity, 2, 0.4, "velocity");
}

// Contents, with the scale that round-off has.
struct Contents {
  std::vector<double> species;
  double enthalpy, enthalpyScale;
};
Contents contentsOf(const Mesh& m, const State& state) {
  Contents all;
  for (int k = 0; k < state.species; ++k)
    all.species.push_back(
        integral(m, [&](int c) { return state.density[at(c)] * state.Y[at(c * state.species + k)]; }));
  all.enthalpy = integral(m, [&](int c) { return state.density[at(c)] * state.enthalpy[at(c)]; });
  all.enthalpyScale = integral(m, [&](int c) { return state.density[at(c)] * std::abs(state.enthalpy[at(c)]); });
  return all;
}

TEST_P(Channel, MassSpeciesAndEnthalpyAreConservedToRoundOffInMixing) {
  for (const bool fixedComposition : {true, false}) {
    // Hot wet hydrogen into cold air: density ratio 6, cp ratio 3, inflow, outflow, diffusion through the inlet.
    Box box(GetParam(), axes, sides(0.8, 900.0, 0.3, 300.0, fixedComposition));
    State state = box.state([&](const auto& x) { return Box::Local{{0.0, 0.3}, x[0] < 0.002 ? 600.0 : 300.0, air}; });
    TransportOperator transport(box.context, state);
    double dt = 1e-4;
    transport.initialise(state, dt);
    const Contents start = contentsOf(box.mesh, state);
    Budget budget(box.context, massAndElements(gas.mechanism, {}), state);
    std::vector<double> net(at(state.species), 0.0);
    std::vector<double> gross(at(state.species), 0.0);
    double heatNet = 0.0;
    double heatGross = 0.0;
    const int steps = 20;
    for (int i = 0; i < steps; ++i) {
      dt = std::min(1e-4, convectiveTimeStep(box.mesh, state, 0.4));
      transport.advance(state, 0.0, dt);
      const auto& b = transport.boundaryAmounts();
      for (std::size_t k = 0; k < net.size(); ++k) {
        net[k] += sumOverRanks(b.speciesIn[k] - b.speciesOut[k]);
        gross[k] += sumOverRanks(b.speciesIn[k] + b.speciesOut[k]);
      }
      heatNet += sumOverRanks(b.enthalpyIn - b.enthalpyOut);
      heatGross += sumOverRanks(b.enthalpyIn + b.enthalpyOut);
      budget.addStep(b);
    }
    const Contents end = contentsOf(box.mesh, state);
    // Content is multiplied out of rho, Y and V and divided back in every step: some five roundings, here allowed to
    // add up all in one direction.
    const double roundOff = 5.0 * steps * epsilon;
    double moved = 0.0;
    for (std::size_t k = 0; k < net.size(); ++k) {
      EXPECT_NEAR(end.species[k] - start.species[k], net[k], roundOff * (start.species[k] + gross[k]))
          << gas.mechanism.speciesName(k);
      moved += gross[k];
    }
    EXPECT_GT(moved, 0.0);
    EXPECT_NEAR(end.enthalpy - start.enthalpy, heatNet,
                roundOff * (end.enthalpyScale + start.enthalpyScale + heatGross));
    for (const auto& line : budget.lines(state)) EXPECT_LE(line.error, 2.0 * roundOff) << line.name;
    const auto extremes = extremesOf(box.context, state);
    EXPECT_LE(extremes.massFractionSumError, 4.0 * 10.0 * epsilon);
    EXPECT_GT(extremes.maximumTemperature, 600.0);
    EXPECT_LE(extremes.maximumTemperature, 901.0);
  }
}

// Ideal gases of one temperature mix without change of it, whatever their heat capacities.
TEST_P(Channel, IsothermalMixingOfDifferentHeatCapacitiesStaysAtTemperatureAndPressure) {
  Box box(GetParam(), axes, sides(0.8, 400.0, 0.3, 400.0, true));
  State state = box.state([&](const auto& x) { return Box::Local{{0.0, 0.3}, 400.0, x[0] < 0.003 ? fuel : air}; });
  TransportOperator transport(box.context, state);
  transport.initialise(state, 1e-4);
  const int steps = 20;
  double left = 0.0;  // of the volume, by the projection's tolerance
  for (int i = 0; i < steps; ++i) {
    const double dt = std::min(1e-4, convectiveTimeStep(box.mesh, state, 0.4));
    transport.advance(state, 0.0, dt);
    left += dt * transport.diagnostics().continuityError;
  }
  // At one temperature moles are linear in the species' masses: the divergence is exact, and p_eos = p0 remains but for
  // what the projection leaves.
  EXPECT_LE(transport.pressureDrift(state), left + 20.0 * steps * epsilon);
  const double noise = largest(box.mesh, [&](int c) { return std::abs(state.temperature[at(c)] - 400.0); });
  // Round-off of the enthalpy (|h| up to 1.2e7 J/kg with the formation of H2O) over cp of air, 1e3 J/kg/K.
  EXPECT_LE(noise, 5.0 * steps * epsilon * 1.2e7 / 1e3);
}

INSTANTIATE_TEST_SUITE_P(Geometries, Channel, testing::Values(Geometry::Planar, Geometry::Axisymmetric));

TEST(ConvectiveTimeStep, IsExactOnAUniformFlow) {
  const auto air = Gas::hydrogen().massFractions("O2: 0.21, N2: 0.79");
  Box box(Geometry::Planar, {uniformAxis(0.01, 5), gradedAxis(0.0, {{0.02, 8, 4.0}})},
          {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
           opening(BoundaryKind::Inlet, 1, false, 0.7, 300.0, air),
           opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)});
  State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.7}, 300.0, air}; });
  EXPECT_EQ(convectiveTimeStep(box.mesh, state, 0.5), std::numeric_limits<double>::infinity());
  EXPECT_EQ(residenceTime(box.mesh, state), std::numeric_limits<double>::infinity());
  TransportOperator transport(box.context, state);
  transport.initialise(state, 1e-4);
  const auto& y = box.mesh.box->vertices[1];
  EXPECT_NEAR(convectiveTimeStep(box.mesh, state, 0.5) / (0.5 * (y[1] - y[0]) / 0.7), 1.0, 20.0 * epsilon);
  EXPECT_NEAR(residenceTime(box.mesh, state) / (0.02 / 0.7), 1.0, 20.0 * epsilon);
}

TEST(TransportOperator, TemperatureOutsideTheDataIsANumericsErrorOnAllRanks) {
  const auto air = Gas::hydrogen().massFractions("O2: 0.21, N2: 0.79");
  Box box(Geometry::Planar, {uniformAxis(0.01, 6), uniformAxis(0.01, 6)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)});
  State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; });
  TransportOperator transport(box.context, state);
  transport.initialise(state, 1e-4);
  const int broken = box.mesh.findOwned(7);
  if (broken >= 0) state.temperature[at(broken)] = 5000.0;  // beyond the transport data
  EXPECT_THROW(transport.advance(state, 0.0, 1e-4), NumericsError);
}

// A hot gas at rest, and what the expansion makes of it in steps of one sweep, or in one more, without diffusion.
struct Expanding {
  Expanding() {
    properties.update(box.context, state);
    const auto faces = at(box.mesh.faces);
    none = {std::vector<double>(faces, 0.0), std::vector<double>(faces, 0.0)};
    contents.assign(at(box.mesh.owned) * air.size(), 0.0);
  }
  double step(double now, double last, Expansion::Sweep sweep = Expansion::Sweep::Only) {
    expansion.begin(state, properties, sweep, now, last);
    expansion.beforeDiffusion(state, properties, contents);
    return expansion.complete(state, properties, contents, none, sweep != Expansion::Sweep::Later)[0];
  }
  // Of the equation of state, above that of the gas as a whole.
  void setPressure(double excess) {
    for (double& density : state.density) density = atRest * (1.0 + excess);
  }
  std::vector<double> air = Gas::hydrogen().massFractions("O2: 0.21, N2: 0.79");
  Box box{Geometry::Planar,
          {uniformAxis(0.01, 2), uniformAxis(0.01, 2)},
          {side(BoundaryKind::Wall, 0, false), opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, air),
           side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)}};
  State state = box.state([&](const auto&) { return Box::Local{{}, 600.0, air}; });
  double atRest = state.density[0];
  GasProperties properties;
  HeatFluxes none;
  std::vector<double> contents;
  Expansion expansion{box.context};
};

// What the expansion has found to be missing goes on at the same rate in steps of another length.
TEST(Expansions, CorrectAtARateWhateverTheStep) {
  const double dt = 1e-4;
  const auto divergenceAfter = [&](double lastStep) {
    Expanding gas;
    gas.step(dt, 0.0);
    gas.setPressure(0.01);
    EXPECT_NEAR(gas.step(dt, dt), 1.1 * 0.01 / dt, 1e-9 / dt);
    gas.setPressure(0.0);
    return gas.step(lastStep, dt);
  };
  const double same = divergenceAfter(dt);
  EXPECT_NEAR(same, 0.1 * 0.01 / dt, 1e-9 / dt);
  EXPECT_NEAR(divergenceAfter(0.1 * dt), same, 1e-9 / dt);
}

// Of a pressure that has changed its sign what is more than it was; all where it has not. The correction is a tenth of
// the sum of all since the first step.
TEST(Expansions, TakeAwayWhatDoesNotGoToAndFro) {
  const double dt = 1e-4;
  const auto second = [&](double first, double then, Expansion::Sweep sweep = Expansion::Sweep::Only) {
    Expanding gas;
    gas.setPressure(first);
    EXPECT_NEAR(gas.step(dt, 0.0, sweep), first / dt, 1e-9 / dt);
    gas.setPressure(then);
    return gas.step(dt, dt, sweep) * dt - 0.1 * then;
  };
  EXPECT_NEAR(second(0.01, -0.004), 0.0, 1e-9);
  EXPECT_NEAR(second(0.01, -0.03), -0.02, 1e-9);
  EXPECT_NEAR(second(-0.01, 0.03), 0.02, 1e-9);
  EXPECT_NEAR(second(0.01, 0.004), 0.004, 1e-9);
  // A second sweep takes away what the first has left.
  EXPECT_NEAR(second(0.01, -0.004, Expansion::Sweep::First), -0.004, 1e-9);
}

// The pressure before is that at the start of the last step, whatever its further sweeps have found; of steps that
// begin anew there is none.
TEST(Expansions, KnowThePressureAtTheStartOfTheLastStep) {
  const double dt = 1e-4;
  Expanding gas, anew;
  for (Expanding* one : {&gas, &anew}) {
    one->setPressure(0.01);
    one->step(dt, 0.0);
  }
  gas.setPressure(-0.002);
  EXPECT_NEAR(gas.step(dt, 0.0, Expansion::Sweep::Later) * dt, 0.01 - 0.002, 1e-9);
  for (Expanding* one : {&gas, &anew}) one->setPressure(-0.004);
  EXPECT_NEAR(gas.step(dt, dt) * dt, 0.1 * (-0.002 - 0.004), 1e-9);
  EXPECT_NEAR(anew.step(dt, 0.0) * dt, -0.004, 1e-9);
}

// What it has found, and the pressure before, are of what is saved.
TEST(Expansions, GoOnFromWhatWasSavedWithTheSameBits) {
  const double dt = 1e-4;
  Expanding one, other;
  for (Expanding* gas : {&one, &other}) std::ranges::fill(gas->state.balance.enthalpy, 1e6);
  for (const double pressure : {0.02, 0.01}) {
    one.setPressure(pressure);
    one.step(dt, pressure < 0.02 ? dt : 0.0);
  }
  StateBackup kept(one.box.mesh.owned, one.box.mesh.faces);
  kept.save([&](StateArchive& archive) { one.expansion.saveOrLoad(archive); });
  kept.restore([&](StateArchive& archive) { other.expansion.saveOrLoad(archive); });
  const auto next = [&](Expanding& gas) {
    std::ranges::fill(gas.state.balance.enthalpy, 2e6);
    gas.setPressure(-0.004);
    return gas.step(dt, dt);
  };
  EXPECT_EQ(next(one), next(other));
}

// Heat that goes to and fro from step to step, of which a step knows that of the one before, and with the pressure what
// that lacked. With all of the pressure taken away in one step the velocity would answer three times as much; the
// correction, of a tenth, adds 0.05 at most.
TEST(Expansions, AnswerHeatThatGoesToAndFroByNoMoreThanIt) {
  const double dt = 1e-6, heat = 1e8;
  Expanding one;
  std::ranges::fill(one.state.balance.enthalpy, heat);
  const double expands = one.step(dt, 0.0);
  Expanding gas;
  double pressure = 0.0, sign = 1.0, last = 0.0, answer = 0.0;
  for (int i = 0; i < 200; ++i) {
    gas.setPressure(pressure);
    std::ranges::fill(gas.state.balance.enthalpy, last * heat);
    answer = gas.step(dt, i > 0 ? dt : 0.0);
    pressure += dt * (sign * expands - answer);
    last = sign;
    sign = -sign;
  }
  EXPECT_GT(expands * dt, 1e-5);
  EXPECT_NEAR(std::abs(answer) / expands, 1.0, 0.06);
}

}  // namespace
}  // namespace lampblack::test
