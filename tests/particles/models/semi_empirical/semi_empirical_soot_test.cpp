#include "particles/models/semi_empirical/semi_empirical_soot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/soot/soot_oxidation.hpp"
#include "tests/particles/models/soot_model_checks.hpp"

namespace lampblack::particles {
namespace {

using Oxygen = SemiEmpiricalOptions::Oxygen;

constexpr double carbonPerKmol = 12.011;    // kg/kmol
constexpr double avogadro = 6.02214076e26;  // 1/kmol
constexpr double boltzmann = 1.380649e-23;  // J/K

// Gas at 1700 K with C2H2, H2, O2, OH, H, CO in mol/m3, and soot of 1e17 particles and 1e-3 kg in a cubic metre.
struct Case {
  std::vector<double> concentrations{0.2, 0.1, 0.02, 1e-3, 1e-3, 0.3}, densities{1e17, 1e-3};
  ParticleGas gas;
  std::vector<double> rates{0, 0}, exchange{0, 0, 0, 0, 0, 0};
  ParticleProcesses processes;

  explicit Case(const SemiEmpiricalOptions& options) {
    const SemiEmpiricalSoot soot(options);
    gas.temperature = 1700;
    gas.pressure = 101325;
    gas.density = 0.2;
    gas.viscosity = 5.8e-5;
    gas.meanMolecularWeight = 0.028;
    gas.concentrations = concentrations;
    soot.sources(gas, densities, rates, exchange);
    processes = soot.processes(gas, densities);
  }
};

// Surface per volume of the case, m2/m3.
double surface(double density) {
  return std::cbrt(constants::pi * 1e17) * std::pow(6 * 1e-3 / density, 2.0 / 3);
}

TEST(LeungSoot, RatesAreThoseOfThePaperInKilomoles) {
  const Case at(leungSoot());
  const double c = 0.2e-3, o = 0.02e-3, S = surface(2000), T = 1700;  // kmol/m3
  const double R1 = 1.0e4 * std::exp(-21100 / T) * c;
  const double R2 = 6.0e3 * std::exp(-12100 / T) * c * std::sqrt(S);
  const double R3 = 1.0e4 * std::sqrt(T) * std::exp(-19680 / T) * S * o;
  EXPECT_NEAR(at.processes.nucleation / (2 * carbonPerKmol * R1), 1, 1e-12);
  EXPECT_NEAR(at.processes.nucleationNumber / (2 * avogadro / 100 * R1), 1, 1e-12);
  // The root of the surface (here 17 m2/m3) is bent at 1e-4: half of 1e-4 / 17.
  EXPECT_NEAR(at.processes.growth / (2 * carbonPerKmol * R2), 1, 4e-6);
  EXPECT_NEAR(at.processes.oxidationO2 / (-carbonPerKmol * R3), 1, 1e-12);
  EXPECT_EQ(at.processes.oxidationOH, 0);
  // Number, as printed: 2 Ca (6 M / (pi rho))^(1/6) (6 k T / rho)^(1/2) [C(s)]^(1/6) N^(11/6).
  const double agglomeration = 2 * 9 * std::pow(6 * carbonPerKmol / (constants::pi * 2000), 1.0 / 6) *
                               std::sqrt(6 * boltzmann * T / 2000) * std::pow(1e-3 / carbonPerKmol, 1.0 / 6) *
                               std::pow(1e17, 11.0 / 6);
  EXPECT_NEAR(at.processes.coagulationNumber / -agglomeration, 1, 1e-12);
}

TEST(LeungSoot, CoagulatesByTheFreeMolecularKernelOfEqualSpheresNineTimes) {
  const Case at(leungSoot());
  const double mass = 1e-20, d = std::cbrt(6 * mass / (constants::pi * 2000));
  const double kernel = freeMolecularKernel(freeMolecularPrefactor(1700, 9), mass, d, mass, d);
  EXPECT_NEAR(at.processes.coagulationNumber / (-0.5 * kernel * 1e34), 1, 1e-12);
}

TEST(MossBrookesSoot, RatesAreThoseOfThePaperInKilomoles) {
  const Case at(mossBrookesSoot());
  const double c = 0.2e-3, oh = 1e-6, S = surface(1800), T = 1700;  // kmol/m3
  const double nuclei = 54 * std::exp(-21000 / T) * c;
  // Twelve carbon atoms are 144.13 kg/kmol here, 144 in the paper.
  EXPECT_NEAR(at.processes.nucleationNumber / (avogadro * nuclei), 1, 1e-12);
  EXPECT_NEAR(at.processes.nucleation / (144 * nuclei), 1, 1e-3);
  EXPECT_NEAR(at.processes.growth / (11700 * std::exp(-12100 / T) * c * S), 1, 1e-12);
  // 105.8125 kg m/kmol/s/K^(1/2), from 12 kg/kmol of carbon and 17 of OH.
  EXPECT_NEAR(at.processes.oxidationOH / (-105.8125 * 0.04 * oh * std::sqrt(T) * S), 1, 2e-3);
  EXPECT_EQ(at.processes.oxidationO2, 0);
  const double d = std::cbrt(6 * 1e-20 / (constants::pi * 1800));
  EXPECT_NEAR(at.processes.coagulationNumber / (-std::sqrt(24 * boltzmann * T / 1800) * std::sqrt(d) * 1e34), 1, 1e-12);
}

TEST(SootOxidation, ByLeeIsThePublishedRate) {
  // 8903.51 T^(1/2) exp(-19778 / T) kg/m2/s to a kmol/m3 of O2 is the same rate in other units, to their rounding.
  for (double T : {1200.0, 1700.0, 2200.0}) {
    const double expected = 8903.51 * std::sqrt(T) * std::exp(-19778 / T) * 1e-3;
    EXPECT_NEAR(oxidationByLee(T, 1.0) * 12.011e-3 / expected, 1, 1e-3);
  }
}

TEST(SootOxidation, ByNagleAndStricklandConstableHasItsTwoLimits) {
  EXPECT_EQ(oxidationByNagle(1700, 0), 0);
  EXPECT_EQ(oxidationByNagle(1700, -1), 0);
  // Worked by hand at 1800 K and 0.1 atm: kA = 4.553e-3, kB = 6.363e-5, kT = 2.518e-7, kZ = 67.01;
  // chi = 6.363e-6 / (6.363e-6 + 2.518e-7) = 0.96194; 4.553e-4 / 7.701 chi + 6.363e-6 (1 - chi) = 5.711e-5 mol/cm2/s.
  const double concentration = 0.1 * 101325 / (constants::gasConstant * 1800);
  EXPECT_NEAR(oxidationByNagle(1800, concentration), 0.5711, 5e-4);
}

TEST(SootOxidation, HydroxylFluxIsAQuarterOfTheMeanSpeed) {
  const double speed = std::sqrt(8 * constants::gasConstant * 1700 / (constants::pi * 17.007e-3));
  EXPECT_NEAR(hydroxylFlux(1700, 2e-3) / (2e-3 * speed / 4), 1, 1e-14);
}

std::vector<SemiEmpiricalOptions> allModels() {
  std::vector<SemiEmpiricalOptions> list{leungSoot(), mossBrookesSoot()};
  for (Oxygen oxygen : {Oxygen::lee, Oxygen::nagle}) {
    list.push_back(mossBrookesSoot());
    list.back().oxygen = oxygen;
  }
  list.push_back(leungSoot());
  list.back().ohEfficiency = 0.13;
  list.back().growthByRootOfSurface = false;
  return list;
}

TEST(SemiEmpiricalSoot, ConservesCarbonHydrogenAndOxygenToRoundOff) {
  unsigned seed = 10;
  for (const SemiEmpiricalOptions& options : allModels()) test::expectConserved(SemiEmpiricalSoot(options), ++seed);
}

TEST(SemiEmpiricalSoot, TakesNothingFromZero) {
  unsigned seed = 20;
  for (const SemiEmpiricalOptions& options : allModels())
    test::expectNothingTakenFromZero(SemiEmpiricalSoot(options), ++seed);
}

TEST(SemiEmpiricalSoot, DifferencesAreTheDerivatives) {
  unsigned seed = 30;
  for (const SemiEmpiricalOptions& options : allModels())
    test::expectJacobian(SemiEmpiricalSoot(options), ++seed, 1e-5);
}

// Growth over mass, relative to that of nuclei, is bounded for every state, however little soot there is.
TEST(SemiEmpiricalSoot, GrowthHasABoundedSlopeAtNoSoot) {
  for (const SemiEmpiricalOptions& options : {leungSoot(), mossBrookesSoot()}) {
    const SemiEmpiricalSoot soot(options);
    Case at(options);
    const double nucleus = options.nucleusCarbon * 12.011e-3 / constants::avogadro;
    // Surface to mass of a nucleus, and the slope of S / sqrt(S + s) at most 1 / sqrt(s).
    const double d = std::cbrt(6 * nucleus / (constants::pi * options.density));
    const double k = options.growthFactor * std::exp(-options.growthTemperature / 1700) * 0.2 * 24.022e-3;
    const double bound = k * 6 / (options.density * d) * (options.growthByRootOfSurface ? 100 : 1);
    for (double mass = 1e-30; mass < 1; mass *= 10) {
      for (double number : {0.0, 1e-3, 1e10, 1e17, 1e25}) {
        const double growth = soot.processes(at.gas, std::vector<double>{number, mass}).growth;
        EXPECT_LE(growth, bound * mass * 1.0001);
      }
    }
  }
}

TEST(SemiEmpiricalSoot, NumberBurnsInProportionOnceParticlesAreNuclei) {
  SemiEmpiricalOptions options = leungSoot();
  options.inception = options.growth = options.coagulating = false;
  const SemiEmpiricalSoot soot(options);
  Case at(options);
  const double nucleus = 100 * 12.011e-3 / constants::avogadro;
  std::vector<double> rates(2), exchange(6);
  const std::vector<double> nuclei{1e-6 / nucleus, 1e-6}, large{1e-9 / nucleus, 1e-6};
  soot.sources(at.gas, nuclei, rates, exchange);
  EXPECT_NEAR(rates[0] / nuclei[0] / (rates[1] / nuclei[1]), 1, 1e-12);
  soot.sources(at.gas, large, rates, exchange);
  EXPECT_NEAR(rates[0] / large[0] / (rates[1] / large[1]), 1e-6, 1e-12);
}

TEST(SemiEmpiricalSoot, RefusesConstantsThatCannotBe) {
  SemiEmpiricalOptions options = leungSoot();
  options.density = 0;
  EXPECT_THROW(SemiEmpiricalSoot{options}, InputError);
  options = leungSoot();
  options.ohEfficiency = -1;
  EXPECT_THROW(SemiEmpiricalSoot{options}, InputError);
}

}  // namespace
}  // namespace lampblack::particles
