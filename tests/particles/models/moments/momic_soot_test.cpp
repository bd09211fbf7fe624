#include "particles/models/moments/momic_soot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "moment_model_fixtures.hpp"
#include "particles/population/moments/moment_options.hpp"
#include "particles/population/sectional/sectional_options.hpp"
#include "tests/particles/models/soot_model_checks.hpp"

namespace lampblack::particles {
namespace {

using test::FlameGas;
using test::ModelGas;

enum Process { coagulation = 1, nucleation = 2, condensation = 4, growth = 8, oxidation = 16 };

MomicOptions with(int processes, SootModelOptions soot = test::naphthalene(), std::size_t moments = 6) {
  soot.coagulation = (processes & coagulation) != 0;
  soot.inception = (processes & nucleation) != 0;
  soot.condensation = (processes & condensation) != 0;
  soot.surfaceGrowth = (processes & growth) != 0;
  soot.oxidation = (processes & oxidation) != 0;
  return {soot, moments};
}

// Scalars of a log-normal population without hydrogen; `deviation` is the geometric one of the diameter.
std::vector<double> logNormal(const MomicSoot& model, double number, double meanMass, double deviation) {
  const double variance = 9 * std::pow(std::log(deviation), 2), unit = model.massUnit();
  std::vector<double> y{number, number * meanMass, 0};
  for (std::size_t k = 2; k < model.options().moments; ++k) {
    const double order = static_cast<double>(k);
    y.push_back(number * std::pow(meanMass / unit, order) * std::exp(0.5 * variance * order * (order - 1)));
  }
  return y;
}

double sphereMass(double diameter) {
  return 1850 * constants::pi / 6 * std::pow(diameter, 3);
}

const FlameGas& sootingGas() {
  static const FlameGas gas(1700, 1e-3, 0.03, 2e-4, 0.08, 1e-4, 0.03, {2e-5});
  return gas;
}

TEST(MomicSoot, RefusesWrongNumbersOfMoments) {
  EXPECT_THROW(MomicSoot({test::naphthalene(), 2}), InputError);
  EXPECT_THROW(MomicSoot({test::naphthalene(), 7}), InputError);
}

TEST(MomicSoot, ConservesCarbonHydrogenAndOxygenToRoundOff) {
  for (std::size_t moments = 3; moments <= 6; ++moments) {
    test::expectConserved(MomicSoot({test::threePah(), moments}), static_cast<unsigned>(moments));
  }
  test::expectConserved(MomicSoot(MomicOptions{}), 1);
}

TEST(MomicSoot, TakesNothingFromZero) {
  test::expectNothingTakenFromZero(MomicSoot({test::threePah(), 6}), 4);
}

TEST(MomicSoot, DifferencesAreTheDerivatives) {
  test::expectJacobian(MomicSoot({test::threePah(), 6}), 5, 1e-5);
}

TEST(MomicSoot, NucleationIsExact) {
  const MomicSoot model(with(nucleation));
  const ModelGas gas(sootingGas(), model.options().soot);
  const std::vector<double> rates = gas.rates(model, std::vector<double>(7, 0.0));
  // Half the dimers' number: two naphthalenes to a dimer, two dimers to a nucleus.
  const double nucleus = (40 * 12.011e-3 + 32 * 1.008e-3) / constants::avogadro;
  EXPECT_NEAR((rates[1] + rates[2]) / (rates[0] * nucleus), 1, 1e-14);
  for (std::size_t k = 2; k < 6; ++k) {
    EXPECT_NEAR(rates[k + 1] / (rates[0] * std::pow(nucleus / model.massUnit(), k)), 1, 1e-13);
  }
}

// Equal spheres grow at one speed: d = d0 + 2 u t, and remain equal up to the graininess of two carbon atoms at a time.
TEST(MomicSoot, SpheresGrowAtOneSpeed) {
  MomicOptions options = with(growth);
  options.soot.alpha = 0.1;
  const MomicSoot model(options);
  const ModelGas gas(sootingGas(), options.soot);
  const double d0 = 10e-9, number = 1e17;
  const std::vector<double> start = logNormal(model, number, sphereMass(d0), 1);
  const double area = number * constants::pi * d0 * d0;
  const double speed = gas.rates(model, start)[1] / (1850 * area);  // m/s
  const double time = 0.5 * d0 / speed;
  const std::vector<double> end = gas.integrate(model, start, time, 1e-9);
  EXPECT_EQ(end[0], number);
  // Of 4.9e4 carbon atoms in steps of two: a relative variance of the mass of some 2/5e4, which changes M_(2/3) by
  // -(2/3)(1/3)/2 of it, 5e-6.
  EXPECT_NEAR(end[1] / (number * sphereMass(2 * d0)), 1, 1e-5);
  EXPECT_NEAR(end[3] * number / std::pow(end[1] / model.massUnit(), 2), 1, 1e-4);
}

// Log-normal populations: at the start the rates of all moments are exact; later the distribution is a shifted one.
// M_1 is that of (d + 2 u t)^3, known from the moments of d.
TEST(MomicSoot, LogNormalPopulationsGrowWithinTheErrorOfTheInterpolation) {
  const double number = 1e17, deviation = 1.5, d0 = 10e-9;  // median
  const double s = std::log(deviation);
  double errors[7];
  for (std::size_t moments = 3; moments <= 6; ++moments) {
    MomicOptions options = with(growth, test::naphthalene(), moments);
    options.soot.alpha = 0.1;
    const MomicSoot model(options);
    const ModelGas gas(sootingGas(), options.soot);
    const std::vector<double> start = logNormal(model, number, sphereMass(d0) * std::exp(4.5 * s * s), deviation);
    const double area = number * constants::pi * d0 * d0 * std::exp(2 * s * s);
    const std::vector<double> rates = gas.rates(model, start);
    const double speed = rates[1] / (1850 * area);
    EXPECT_NEAR(model.properties(gas.gas, start).surfaceArea / area, 1, 1e-12);
    // d(m^2)/dt = 2 m rho pi d^2 u, plus the square of a step of two atoms.
    const double second = 2 * number * 1850 * constants::pi * speed * sphereMass(d0) * std::pow(d0, 2) *
                          std::exp(12.5 * s * s) / std::pow(model.massUnit(), 2);
    const double step = 2 * 12.011e-3 / constants::avogadro;
    EXPECT_NEAR(rates[3] / (second + rates[1] * step / std::pow(model.massUnit(), 2)), 1, 1e-12);
    const double shift = 1.0 * d0;
    const std::vector<double> end = gas.integrate(model, start, 0.5 * shift / speed);
    const auto ofDiameter = [&](double k) { return std::pow(d0, k) * std::exp(0.5 * k * k * s * s); };
    const double exact =
        number * 1850 * constants::pi / 6 *
        (ofDiameter(3) + 3 * shift * ofDiameter(2) + 3 * shift * shift * ofDiameter(1) + std::pow(shift, 3));
    EXPECT_EQ(end[0], number);
    errors[moments] = std::abs(end[1] / exact - 1);
  }
  EXPECT_LT(errors[6], 1e-3);
  EXPECT_LT(errors[6], errors[3]);
}

CollisionKernelOptions kernelIn(const ParticleGas& gas) {
  CollisionKernelOptions kernel;
  kernel.type = CollisionKernelType::transition;
  kernel.gas = gas;
  kernel.enhancement = 2.2;
  return kernel;
}

// The same closure in the population balance; sections with a spacing of 2^0.2 as the truth. From a log-normal start to
// 7 % of the number. In that code MOMIC is known to be off by up to 1.2 % in M_0 and M_2 against sections (docs/theory/
// population_balance/moments.md), and the sections by up to 0.7 % in M_2.
TEST(MomicSoot, CoagulatesAsThePopulationBalanceDoes) {
  const MomicSoot model(with(coagulation));
  const ModelGas gas(sootingGas(), model.options().soot);
  const double number = 1e18, d0 = 5e-9, deviation = 1.3, s = std::log(deviation), time = 3e-3;
  PopulationModel population;
  population.coagulation = kernelIn(gas.gas);
  population.density = 1850;
  const InitialPopulation initial{InitialPopulation::Distribution::lognormal, number, sphereMass(d0) / 1850, deviation};
  const auto momic = makeMoments(population, initial, {MomentMethod::momic, 6, QuadratureInversion::wheeler, 1e-9});
  momic->advance(time);
  SectionalOptions options;
  options.sections = 110;
  options.smallest = sphereMass(1e-9) / 1850;
  options.spacing = std::pow(2, 0.2);
  const auto sections = makeSectional(population, initial, options);
  sections->advance(time);
  const std::vector<double> start = logNormal(model, number, sphereMass(d0) * std::exp(4.5 * s * s), deviation);
  const std::vector<double> end = gas.integrate(model, start, time, 1e-8);
  const double unit = model.massUnit() / 1850;
  EXPECT_LT(end[0], 0.08 * number);
  EXPECT_EQ(end[1], start[1]);
  EXPECT_NEAR(end[0] / momic->moments()[0], 1, 1e-5);
  EXPECT_NEAR(end[3] * unit * unit / momic->moments()[2], 1, 1e-5);
  EXPECT_NEAR(end[0] / sections->moments()[0], 1, 0.012);
  EXPECT_NEAR(end[3] * unit * unit / sections->moments()[2], 1, 0.019);
}

// In states of no population the closure stays bounded: no more surface than that of the smallest nuclei, no more
// coagulation than of the number squared.
TEST(MomicSoot, StaysBoundedInStatesOfNoPopulation) {
  const MomicSoot model({test::naphthalene(), 6});
  const ModelGas gas(sootingGas(), model.options().soot);
  const double mass = 1e-3, nucleus = 40 * 12.011e-3 / constants::avogadro;
  std::vector<double> exchange(model.gasSpecies().size());
  const double nucleusDiameter = std::cbrt(6 / constants::pi * nucleus / 1850);
  const double mostArea = 6 / nucleusDiameter * mass / 1850;
  for (double number : {0.0, 1e5, 1e15, 1e21, 1e30}) {
    for (double factor : {0.0, 1e-30, 1e-5, 1.0, 1e5, 1e30}) {
      for (std::size_t which = 3; which < 7; ++which) {
        std::vector<double> y = logNormal(model, 1e15, mass / 1e15, 1.5);
        y[0] = number;
        y[which] *= factor;
        EXPECT_LE(model.properties(gas.gas, y).surfaceArea, mostArea * (1 + 1e-12));
        const std::vector<double> rates = gas.rates(model, y);
        for (double r : rates) EXPECT_TRUE(std::isfinite(r)) << number << ' ' << factor;
      }
    }
  }
}

// Oxidation of a cloud of equal spheres: as long as they are large their number stays and their diameter falls at one
// speed; in the end number and mass go together, and nothing turns negative or gets smaller than a nucleus.
TEST(MomicSoot, BurnsOut) {
  const FlameGas flame(1900, 1e-4, 1e-3, 3e-3, 0.1, 0.02, 0, {0});
  MomicOptions options = with(oxidation);
  options.soot.alpha = 0.1;
  const MomicSoot model(options);
  const ModelGas gas(flame, model.options().soot);
  const double d0 = 20e-9, number = 1e16;
  const std::vector<double> start = logNormal(model, number, sphereMass(d0), 1);
  const double speed = -gas.rates(model, start)[1] / (1850 * number * constants::pi * d0 * d0);
  std::vector<double> end = gas.integrate(model, start, 0.3 * d0 / speed);
  EXPECT_NEAR(end[0] / number, 1, 1e-6);  // d = 0.4 d0 is 500 nuclei: share of whole particles below 1e-50
  // One or two of 400 atoms at a time: a relative variance of the mass of 1.5/3e3, 1e-3 in M_1.
  EXPECT_NEAR(end[1] / (number * sphereMass(0.4 * d0)), 1, 1e-3);
  // Another 0.4 d0: twice the time that the diameter left takes.
  const double nucleus = 40 * 12.011e-3 / constants::avogadro;
  for (int i = 0; i < 20; ++i) {
    end = gas.integrate(model, end, 0.02 * d0 / speed);
    EXPECT_GT(end[0], 0);
    EXPECT_GT(end[1] / end[0], nucleus);
  }
  EXPECT_LT(end[0], 1e-3 * number);
  const double burnt = gas.rates(model, end)[0] / end[0];
  EXPECT_NEAR(burnt / (gas.rates(model, end)[1] / end[1]), 1, 0.01);
}

}  // namespace
}  // namespace lampblack::particles
