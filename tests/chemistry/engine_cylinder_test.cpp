// The gas of a cylinder against one zone by CVODE, orders, balances, ranks.
#include "chemistry/reactor/engine/engine_cylinder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "tests/chemistry/engine_particles.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::engineGas;
using lampblack::test::hydrogen;

constexpr double endTime = 4e-3;  // s
constexpr double startVolume = 2.6e-3;

// From the bottom to an eighth and back a third of the way.
double pistonVolume(double t) {
  return startVolume * (1 - 0.875 * 0.5 * (1 - std::cos(std::numbers::pi * t / (0.75 * endTime))));
}

EngineOptions cylinder(double step) {
  EngineOptions options;
  options.volume = pistonVolume;
  options.step = step;
  options.pressureTolerance = 10;
  options.bore = 0.1;
  options.displacement = startVolume * 0.875;
  options.clearance = startVolume * 0.125;
  options.endArea = 0.016;
  options.pistonSpeed = 20;
  options.wallTemperature = 400;
  options.mixingTime = {{0}, {2e-3}};
  options.reactions.relativeTolerance = 1e-9;
  options.reactions.absoluteTolerance = 1e-15;
  options.reactions.negligibleChange = 0;
  return options;
}

EngineHeatLaw constantHeat(double coefficient) {
  EngineHeatLaw law;
  law.model = EngineHeatLaw::Model::constant;
  law.factor = coefficient;
  return law;
}

constexpr const char* charge = "H2: 0.3, O2: 1, N2: 3.76";
constexpr const char* steam = "H2O: 1, O2: 1, N2: 2";

// One zone of given volume, (Y, T), that loses heat.
class OneZone : public OdeSystem {
 public:
  OneZone(double mass, double conductancePerArea) : mass_(mass), coefficient_(conductancePerArea) {}
  [[nodiscard]] std::size_t size() const override { return n_ + 1; }
  bool rates(double t, const double* y, double* f) override {
    const std::span<const double> Y(y, n_);
    const double T = y[n_], V = pistonVolume(t), density = mass_ / V;
    const double slope = (pistonVolume(t + 1e-8) - pistonVolume(t - 1e-8)) / 2e-8;
    std::vector<double> c(n_), wdot(n_), u(n_);
    for (std::size_t k = 0; k < n_; ++k) c[k] = std::max(0.0, density * Y[k] / hydrogen().species(k).molecularWeight);
    kinetics_.netProductionRates(T, c, wdot);
    thermo_.speciesInternalEnergies(T, u);
    const double p = density * constants::gasConstant * T / thermo_.meanMolecularWeight(Y);
    const double area = 0.016 + 4 * (V - startVolume * 0.125) / 0.1;
    double gain = -p * slope / mass_ - coefficient_ * area * (T - 400) / mass_;
    for (std::size_t k = 0; k < n_; ++k) {
      f[k] = wdot[k] * hydrogen().species(k).molecularWeight / density;
      gain -= u[k] * f[k];
    }
    f[n_] = gain / thermo_.cvMass(T, Y);
    return std::isfinite(f[n_]);
  }
  bool jacobian(double t, const double* y, double* f, double* J, std::size_t ld) override {
    std::vector<double> moved(y, y + n_ + 1), g(n_ + 1);
    if (!rates(t, y, f)) return false;
    for (std::size_t j = 0; j <= n_; ++j) {
      const double by = 1e-7 * std::max(std::abs(y[j]), 1e-3);
      moved[j] = y[j] + by;
      if (!rates(t, moved.data(), g.data())) return false;
      moved[j] = y[j];
      for (std::size_t i = 0; i <= n_; ++i) J[i + ld * j] = (g[i] - f[i]) / by;
    }
    return true;
  }
  [[nodiscard]] std::string describe(double /*t*/, const double* /*y*/) const override { return "one zone"; }

 private:
  std::size_t n_ = hydrogen().numSpecies();
  double mass_, coefficient_;
  Thermo thermo_{hydrogen()};
  Kinetics kinetics_{hydrogen()};
};

double oneZoneTemperature(const EngineGas& gas, double coefficient) {
  double mass = 0;
  for (const double m : gas.mass) mass += m;
  OneZone zone(mass, coefficient);
  StiffIntegrator integrator(zone, {1e-10, 1e-16, 0, 100000});
  std::vector<double> y(gas.Y(0).begin(), gas.Y(0).end());
  y.push_back(gas.temperature[0]);
  integrator.start(0, y, endTime);
  while (integrator.time() < endTime) integrator.step();
  return integrator.state().back();
}

// A gas that has the volume of the start.
EngineGas full(EngineGas gas) {
  const double volume = volumeOf(Thermo(hydrogen()), gas);
  for (double& m : gas.mass) m *= startVolume / volume;
  return gas;
}

double meanTemperature(const EngineCylinder& run) {
  double mass = 0, sum = 0;
  for (std::size_t i = 0; i < run.gas().count(); ++i) {
    mass += run.gas().mass[i];
    sum += run.gas().mass[i] * run.gas().temperature[i];
  }
  return sum / mass;
}

double endTemperature(const EngineOptions& options, const EngineGas& gas) {
  const Thermo thermo(hydrogen());
  EngineCylinder run(MPI_COMM_WORLD, hydrogen(), thermo, options);
  run.start(gas, 0);
  run.advanceTo(endTime);
  EXPECT_LT(run.energyError(), 1e-12);
  EXPECT_LT(run.elementError(), 1e-12);
  return meanTemperature(run);
}

// Equal particles, the mean loss: that of one zone, of second order in the step; hot steam that comes apart and
// together as the piston moves.
TEST(EngineCylinder, EqualParticlesAreOneZone) {
  const EngineGas gas = full(engineGas({{1700, steam}, {1700, steam}}));
  const double exact = oneZoneTemperature(gas, 2000);
  EngineOptions options = cylinder(endTime);
  options.heat = constantHeat(2000);
  options.reacts = false;
  EXPECT_GT(std::abs(endTemperature(options, gas) - exact), 20);
  options.reacts = true;
  options.mixing = EngineMixingModel::iem;
  std::vector<double> errors;
  for (const double steps : {40.0, 80.0, 160.0}) {
    options.step = endTime / steps;
    errors.push_back(std::abs(endTemperature(options, gas) - exact));
  }
  printf("one zone: %g K; errors %g %g %g\n", exact, errors[0], errors[1], errors[2]);
  EXPECT_GT(errors[0] / errors[1], 3.4);
  EXPECT_GT(errors[1] / errors[2], 3.4);
  EXPECT_LT(errors[2], 0.1);
}

// Through an ignition, whose time says what is lost to the walls.
TEST(EngineCylinder, IgnitesAsOneZone) {
  const EngineGas gas = full(engineGas({{700, charge}}));
  const double exact = oneZoneTemperature(gas, 2000);
  EngineOptions options = cylinder(endTime / 400);
  options.heat = constantHeat(2000);
  options.pressureTolerance = 0.02;
  EXPECT_GT(exact, 1200);
  EXPECT_NEAR(endTemperature(options, gas), exact, 5);
}

// The gas without reactions against the same ODE without them.
TEST(EngineCylinder, MotoredWithHeatLoss) {
  const EngineGas gas = full(engineGas({{450, "N2: 1"}}));
  const double exact = oneZoneTemperature(gas, 3000);
  std::vector<double> errors;
  for (const double steps : {40.0, 80.0}) {
    EngineOptions options = cylinder(endTime / steps);
    options.heat = constantHeat(3000);
    options.reacts = false;
    errors.push_back(std::abs(endTemperature(options, gas) - exact));
  }
  printf("motored: %g K; errors %g %g\n", exact, errors[0], errors[1]);
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.5);
  EXPECT_LT(errors[1], 0.5);
}

// Particles that differ: as tau goes to zero and jumps become many, one zone of their mixture.
TEST(EngineCylinder, QuickMixingAndSmallJumpsAreOneZone) {
  const EngineGas gas = full(engineGas({{1600, steam}, {1700, steam}, {1750, steam}, {1800, "N2: 1"}}));
  EngineOptions options = cylinder(endTime / 200);
  options.mixing = EngineMixingModel::iem;
  options.mixingTime = {{0}, {1e-6}};
  options.heat = constantHeat(2000);
  options.jumpConstant = 1e5;
  const Thermo thermo(hydrogen());
  EngineGas mixed = gas;
  RandomStream random(1, 0, 0);
  EngineMixing(thermo, EngineMixingModel::iem, 2).advance(1, 1e-3, random, mixed);
  EXPECT_NEAR(endTemperature(options, gas), oneZoneTemperature(mixed, 2000), 0.5);
}

// Without mixing each is a reactor of its own at the common pressure: one that cannot react stays on its isentrope.
TEST(EngineCylinder, WithoutMixingParticlesShareThePressureAlone) {
  const EngineGas gas = full(engineGas({{700, charge}, {500, "N2: 1"}}));
  const Thermo thermo(hydrogen());
  EngineCylinder run(MPI_COMM_WORLD, hydrogen(), thermo, cylinder(endTime / 100));
  run.start(gas, 0);
  run.advanceTo(endTime);
  const double before = thermo.entropyMass(500, constants::oneAtmosphere, gas.Y(1));
  EXPECT_NEAR(thermo.entropyMass(run.gas().temperature[1], run.gas().pressure, run.gas().Y(1)), before, 1e-6 * before);
  EXPECT_GT(run.gas().temperature[0], 1400);
  EXPECT_NEAR(volumeOf(thermo, run.gas()) / pistonVolume(endTime), 1, 1e-13);
}

// All at once, with fuel sprayed in: energy, elements and mass to round-off, the number of particles as said; and the
// same bits on any number of ranks and in any repeat of the run.
TEST(EngineCylinder, BalancesWithInjectionOnAnyRanks) {
  const Thermo thermo(hydrogen());
  std::vector<std::pair<double, std::string>> particles;
  for (int i = 0; i < 12; ++i) particles.emplace_back(640 + 10 * i, "O2: 1, N2: 3.76, H2O: 0.2");
  const EngineGas gas = full(engineGas(particles));
  EngineOptions options = cylinder(endTime / 80);
  options.mixing = EngineMixingModel::modifiedCurl;
  options.heat = woschniLaw();
  options.jumpConstant = 15;
  options.pressureTolerance = 0.1;
  options.reactions = {};
  EngineInjection::Options spray;
  spray.massFractions.assign(hydrogen().numSpecies(), 0);
  spray.massFractions[hydrogen().speciesIndex("H2")] = 1;
  spray.enthalpy = thermo.enthalpyMass(300, spray.massFractions) - 4.5e5;
  spray.dilution = 5;
  spray.mostParticles = 16;
  options.injection = spray;
  options.injectionRate = {{0.5e-3, 0.6e-3, 1.5e-3, 1.6e-3}, {0, 0.02, 0.02, 0}};
  std::vector<EngineGas> ends;
  for (MPI_Comm comm : {MPI_COMM_SELF, MPI_COMM_WORLD}) {
    EngineCylinder run(comm, hydrogen(), thermo, options);
    run.start(gas, 0);
    run.advanceTo(0.5 * endTime);
    run.advanceTo(endTime);
    EXPECT_NEAR(run.ledger().injectedMass, 0.02e-3, 1e-14);
    EXPECT_LT(run.energyError(), 1e-13);
    EXPECT_LT(run.elementError(), 1e-13);
    EXPECT_NEAR(totalsOf(thermo, run.gas()).mass, totalsOf(thermo, gas).mass + 0.02e-3, 1e-15);
    EXPECT_EQ(run.gas().count(), 16U);
    EXPECT_GT(run.ledger().heat, 0);
    EXPECT_GT(run.ledger().chemical, 500);
    ends.push_back(run.gas());
  }
  EXPECT_EQ(ends[0].temperature, ends[1].temperature);
  EXPECT_EQ(ends[0].massFractions, ends[1].massFractions);
  EXPECT_EQ(ends[0].mass, ends[1].mass);
}

// Heat of burning 0.02 g of hydrogen at its lower value, 120 MJ/kg, where all of it burns.
TEST(EngineCylinder, StepsThatChangeTooMuchAreHalved) {
  const EngineGas gas = full(engineGas({{700, charge}}));
  const Thermo thermo(hydrogen());
  EngineOptions options = cylinder(endTime / 40);
  options.pressureTolerance = 0.05;
  EngineCylinder run(MPI_COMM_SELF, hydrogen(), thermo, options);
  run.start(gas, 0);
  run.advanceTo(endTime);
  EXPECT_GT(run.ledger().rejected, 0);
  EXPECT_GT(run.ledger().steps, 45);
  const double hydrogenMass = gas.mass[0] * gas.Y(0)[hydrogen().speciesIndex("H2")];
  EXPECT_NEAR(run.ledger().chemical / hydrogenMass, 1.2e8, 0.03e8);
}

// Steam that comes apart in a volume at rest against a closed reactor: without the growth that is foreseen the
// reactions would be at a pressure without their own half, of first order.
TEST(EngineCylinder, TheGrowthOfReactionsIsForeseen) {
  const EngineGas gas = full(engineGas({{2600, steam}}));
  const Thermo thermo(hydrogen());
  constexpr double end = 2e-5;
  const GasState start{2600, gas.pressure, {gas.Y(0).begin(), gas.Y(0).end()}};
  ClosedReactor closed(hydrogen(), start, ReactorSystem::Held::Density);
  StiffIntegrator integrator(closed, {1e-11, 1e-16, 0, 100000});
  integrator.start(0, closed.initialState(), end);
  while (integrator.time() < end) integrator.step();
  const double exact = integrator.state()[hydrogen().numSpecies()];
  std::vector<double> errors;
  for (const double steps : {10.0, 20.0, 40.0}) {
    EngineOptions options = cylinder(end / steps);
    options.volume = [](double) { return startVolume; };
    EngineCylinder run(MPI_COMM_SELF, hydrogen(), thermo, options);
    run.start(gas, 0);
    run.advanceTo(end);
    errors.push_back(std::abs(run.gas().temperature[0] - exact));
  }
  printf("steam at rest: 2600 to %g K; errors %g %g %g\n", exact, errors[0], errors[1], errors[2]);
  EXPECT_GT(errors[0] / errors[1], 3);
  EXPECT_GT(errors[1] / errors[2], 3);
}

// A step that is taken back leaves nothing: its halves are those of a run with steps of half the length.
TEST(EngineCylinder, AStepTakenBackLeavesNothing) {
  const EngineGas gas = full(engineGas({{2600, steam}}));
  const Thermo thermo(hydrogen());
  constexpr double end = 1e-5;
  const auto after = [&](double step, double tolerance) {
    EngineOptions options = cylinder(step);
    options.volume = [](double) { return startVolume; };
    options.pressureTolerance = tolerance;
    EngineCylinder run(MPI_COMM_SELF, hydrogen(), thermo, options);
    run.start(gas, 0);
    run.advanceTo(end);
    return std::pair(run.gas().temperature[0], run.ledger());
  };
  const auto [plain, whole] = after(end, 10);
  const auto [halved, back] = after(end, 0.9 * whole.largestDefect);
  const auto [exact, halves] = after(0.5 * end, 10);
  EXPECT_EQ(back.rejected, 1);
  EXPECT_EQ(halves.steps, 2);
  EXPECT_EQ(halved, exact);
  EXPECT_NE(halved, plain);
}

TEST(EngineInjection, MergesTheNearestAndRefusesVapourThatIsTooCold) {
  const Thermo thermo(hydrogen());
  EngineGas gas = engineGas({{600, "O2: 1"}, {605, "O2: 1"}, {900, "O2: 1"}, {600, "H2: 1"}});
  EngineInjection::Options options;
  options.massFractions.assign(hydrogen().numSpecies(), 0);
  options.massFractions[hydrogen().speciesIndex("H2")] = 1;
  options.enthalpy = thermo.enthalpyMass(300, options.massFractions) - 4e6;
  options.dilution = 0.5;
  options.mostParticles = 4;
  const EngineInjection injection(hydrogen(), thermo, options);
  const double enthalpy = enthalpyOf(thermo, gas), mass = gas.mass[0];
  injection.mergeNearest(gas);
  ASSERT_EQ(gas.count(), 3U);
  EXPECT_NEAR(gas.temperature[0], 602.5, 0.1);
  EXPECT_EQ(gas.mass[0], 2 * mass);
  EXPECT_NEAR(enthalpyOf(thermo, gas), enthalpy, 1e-12 * std::abs(enthalpy));
  EXPECT_THROW((void)injection.inject(1e-6, gas), NumericsError);
}

TEST(EngineInjection, EquivalenceRatioIsThatOfTheElements) {
  std::vector<double> Y(hydrogen().numSpecies());
  Thermo(hydrogen()).moleToMass(parseComposition(hydrogen(), "H2: 1.4, O2: 1, N2: 3.76"), Y);
  EXPECT_NEAR(equivalenceRatioOf(hydrogen(), Y), 0.7, 1e-12);
}

TEST(EngineTable, IntegratesItsLines) {
  const EngineTable table{{1, 2, 4}, {0, 2, 0}};
  EXPECT_NEAR(table.integral(0, 5), 3, 1e-14);
  EXPECT_NEAR(table.integral(1.5, 3), 0.75 + 1.5, 1e-14);
  EXPECT_NEAR(table.at(1.25), 0.5, 1e-14);
}

}  // namespace
