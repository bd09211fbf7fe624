// Soot that the particles of an engine's gas carry: against closed reactors, balances, ranks, restarts.
#include "coupling/engine_soot.hpp"

#include <gtest/gtest.h>

#include "chemistry/reactor/engine/engine_cylinder.hpp"
#include "core/state_backup.hpp"
#include "tests/coupling/ethylene_models.hpp"
#include "tests/coupling/toy_particles.hpp"
#include "tests/every_module.hpp"

namespace lampblack::coupling {
namespace {

using test::ethylene;
using test::gasOf;
using test::integrated;

const ConstantPressureReactor::Options tight{.relativeTolerance = 1e-8, .absoluteTolerance = 1e-14};

// The gas of an engine at rest, whose particles carry soot.
EngineOptions vesselAtRest(double volume, double step) {
  EngineOptions options;
  options.volume = [volume](double) { return volume; };
  options.step = step;
  options.pressureTolerance = 10;
  options.reactions = tight;
  return options;
}

EngineGas engineGasOf(const std::vector<GasState>& states) {
  EngineGas gas;
  gas.species = ethylene().numSpecies();
  gas.pressure = states[0].pressure;
  for (const GasState& state : states) gas.add(1e-4, state.temperature, state.Y);
  return gas;
}

class EngineWithModel : public ::testing::TestWithParam<std::string> {
 protected:
  CarriedParticles soot{ethylene(), test::modelOf(GetParam())};
  ReactorParticles particles{ethylene(), soot};
  std::size_t n = ethylene().numSpecies();
};

// One particle comes to a closed reactor as the square of the step: over 0.1 ms, whose steps are short enough for the
// radicals' first reactions.
TEST_P(EngineWithModel, OneParticleOfAnEngineIsAClosedReactor) {
  const GasState start = gasOf(ethylene(), 1900, "C2H2: 0.06, A1: 0.01, N2: 0.93");
  constexpr double end = 1e-4;
  ClosedReactor reactor(ethylene(), start, ReactorSystem::Held::Density, std::nullopt, &particles);
  const auto exact = integrated(reactor, reactor.initialState(), end, 1e-9);
  std::vector<double> amounts(particles.size());
  particles.densities(1, std::span(exact).subspan(n + 1, particles.size()), amounts);
  const auto sootIn = [&](std::span<const double> some) {
    double mass = 0;
    for (std::size_t s = 0; s < some.size(); ++s)
      for (const double element : soot.scalars()[s].elements) mass += some[s] * element;
    return mass;
  };
  const Thermo thermo(ethylene());
  const EngineGas gas = engineGasOf({start});
  // J, by enthalpies of formation, of gas and soot.
  const auto heatOf = [&](const EngineGas& after, const EngineGas& before) {
    std::vector<double> h(n), ofSoot(soot.scalars().size()), slope(ofSoot.size());
    thermo.speciesEnthalpies(298.15, h);
    soot.enthalpies(298.15, ofSoot, slope);
    double heat = 0;
    for (std::size_t k = 0; k < n; ++k)
      heat += h[k] * (before.mass[0] * before.Y(0)[k] - after.mass[0] * after.Y(0)[k]);
    for (std::size_t s = 0; s < ofSoot.size(); ++s) heat -= ofSoot[s] * after.mass[0] * after.amounts(0)[s];
    return heat;
  };
  std::vector<double> errors;
  for (const double steps : {10.0, 40.0}) {
    EngineSoot carried(MPI_COMM_WORLD, ethylene(), thermo, soot, tight);
    EngineCylinder run(MPI_COMM_WORLD, ethylene(), thermo, vesselAtRest(volumeOf(thermo, gas), end / steps));
    run.carry(carried);
    run.start(gas, 0);
    run.advanceTo(end);
    EXPECT_LT(run.energyError(), 1e-12);
    EXPECT_LT(run.elementError(), 1e-12);
    EXPECT_NEAR(run.gas().temperature[0], exact[n], 4);
    EXPECT_LT(run.gas().mass[0], 1e-4);  // what the soot has is no gas
    EXPECT_NEAR(run.ledger().chemical / heatOf(run.gas(), gas), 1, 1e-12);
    errors.push_back(std::abs(run.gas().mass[0] / 1e-4 * sootIn(run.gas().amounts(0)) / sootIn(amounts) - 1));
  }
  EXPECT_LT(errors[0], 1e-3);
  EXPECT_LT(errors[1], 0.1 * errors[0]);                // of first order 0.25
  EXPECT_GT(errors[1], 100 * tight.relativeTolerance);  // it is the step's
}

// Mixed and sprayed into, on any number of ranks the same; what a checkpoint has goes on to the last bit.
TEST(EngineSoot, BalancesWithMixingAndInjection) {
  CarriedParticles soot(ethylene(), test::modelOf("hmom"));
  const Thermo thermo(ethylene());
  const GasState rich = gasOf(ethylene(), 2000, "C2H2: 0.06, A1: 0.01, N2: 0.93"),
                 poor = gasOf(ethylene(), 1700, "C2H2: 0.01, O2: 0.05, N2: 0.94");
  const EngineGas gas = engineGasOf({rich, poor, rich, poor, rich});
  constexpr double end = 4e-4;
  EngineOptions options = vesselAtRest(volumeOf(thermo, gas), end / 8);
  options.mixing = EngineMixingModel::modifiedCurl;
  options.mixingTime = {{0}, {1e-4}};
  EngineInjection::Options spray;
  spray.massFractions.assign(ethylene().numSpecies(), 0);
  spray.massFractions[ethylene().speciesIndex("C2H4")] = 1;
  spray.enthalpy = thermo.enthalpyMass(300, spray.massFractions);
  spray.dilution = 5;
  spray.mostParticles = 6;
  options.injection = spray;
  options.injectionRate = {{0, 1e-4, 3e-4, 4e-4}, {0, 0.05, 0.05, 0}};
  std::vector<EngineGas> ends;
  StateBackup backup(0, 0);
  for (const int run : {0, 1, 2}) {
    EngineSoot carried(run == 1 ? MPI_COMM_WORLD : MPI_COMM_SELF, ethylene(), thermo, soot, tight);
    EngineCylinder cylinder(run == 1 ? MPI_COMM_WORLD : MPI_COMM_SELF, ethylene(), thermo, options);
    cylinder.carry(carried);
    const auto owners = [&](StateArchive& archive) { cylinder.saveOrLoad(archive); };
    cylinder.start(gas, 0);
    if (run < 2) cylinder.advanceTo(0.5 * end);
    if (run == 0) backup.save(owners);
    if (run == 2) backup.restore(owners);
    cylinder.advanceTo(end);
    EXPECT_LT(cylinder.energyError(), 1e-12);
    EXPECT_LT(cylinder.elementError(), 1e-12);
    EXPECT_EQ(cylinder.gas().count(), 6U);
    EXPECT_NE(cylinder.ledger().carriedEnthalpy, 0);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_GT(cylinder.gas().amounts(i)[1], 0) << i;
    ends.push_back(cylinder.gas());
  }
  for (const EngineGas& other : {ends[1], ends[2]}) {
    EXPECT_EQ(ends[0].temperature, other.temperature);
    EXPECT_EQ(ends[0].massFractions, other.massFractions);
    EXPECT_EQ(ends[0].mass, other.mass);
    EXPECT_EQ(ends[0].carried, other.carried);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, EngineWithModel, ::testing::Values("moss_brookes", "hmom", "sectional"));

}  // namespace
}  // namespace lampblack::coupling
