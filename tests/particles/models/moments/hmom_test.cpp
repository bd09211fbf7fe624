#include "particles/models/moments/hmom.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "moment_model_fixtures.hpp"
#include "particles/models/two_equation/two_equation.hpp"
#include "tests/particles/models/soot_model_checks.hpp"

namespace lampblack::particles {
namespace {

using test::FlameGas;
using test::ModelGas;
using Scalars = std::vector<double>;

SootModelOptions nothing(SootModelOptions soot) {
  soot.coagulation = soot.inception = soot.condensation = soot.surfaceGrowth = soot.oxidation = false;
  return soot;
}

double sphereMass(double diameter) {
  return 1850 * constants::pi / 6 * std::pow(diameter, 3);
}
double sphereSurface(double mass) {
  return std::cbrt(constants::pi) * std::pow(6 * mass / 1850, 2.0 / 3);
}

// Nuclei of one mass, and large particles of one mass and a number of primaries; hydrogen is a tenth of the nuclei's
// mass and a hundredth of the others'.
Scalars twoModes(double nuclei, double nucleus, double number, double mass, double primaries) {
  return {nuclei,
          0.9 * nuclei * nucleus,
          0.1 * nuclei * nucleus,
          number,
          0.99 * number * mass,
          0.01 * number * mass,
          number * sphereSurface(mass) * std::cbrt(primaries)};
}

const FlameGas& sootingGas() {
  static const FlameGas gas(1700, 1e-3, 0.03, 2e-4, 0.08, 1e-4, 0.03, {2e-5});
  return gas;
}

constexpr double nucleusMass = (40 * 12.011e-3 + 32 * 1.008e-3) / constants::avogadro;  // of naphthalene

TEST(Hmom, RefusesDimensionsOfNoAggregate) {
  EXPECT_THROW(HmomSoot({test::naphthalene(), 1.0}), InputError);
  EXPECT_THROW(HmomSoot({test::naphthalene(), 3.1}), InputError);
  EXPECT_THROW(HmomSoot({test::naphthalene(), 1.8, -0.1}), InputError);
}

TEST(Hmom, ConservesCarbonHydrogenAndOxygenToRoundOff) {
  test::expectConserved(HmomSoot({test::naphthalene()}), 1);
  test::expectConserved(HmomSoot({test::threePah()}), 2);
  test::expectConserved(HmomSoot(HmomOptions{}), 3);
}

TEST(Hmom, TakesNothingFromZero) {
  test::expectNothingTakenFromZero(HmomSoot({test::threePah()}), 4);
}

TEST(Hmom, DifferencesAreTheDerivatives) {
  test::expectJacobian(HmomSoot({test::threePah()}), 5, 1e-5);
}

TEST(Hmom, NucleationMakesNucleiOfTwoDimers) {
  SootModelOptions soot = nothing(test::threePah());
  soot.inception = true;
  const HmomSoot model({soot});
  const FlameGas flame(1700, 1e-3, 0.03, 2e-4, 0.08, 1e-4, 0.03, {2e-5, 3e-6, 2e-6});
  const ModelGas gas(flame, soot);
  const Scalars rates = gas.rates(model, Scalars(7, 0.0));
  const DimerModel dimers(soot);
  const ParticleProcesses p = model.processes(gas.gas, Scalars(7, 0.0));
  EXPECT_NEAR(rates[0] / (p.dimerProduction / 2), 1, 1e-14);
  EXPECT_NEAR((rates[1] + rates[2]) / p.nucleation, 1, 1e-14);
  for (std::size_t i = 3; i < 7; ++i) EXPECT_EQ(rates[i], 0);
}

// Nuclei alone: what is left of them falls as N0/(1 + b N0 t) with the kernel of equal spheres, b. They coalesce to
// spheres of twice the volume.
TEST(Hmom, NucleiAloneCoagulateAsEqualSpheres) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.coagulation = true;
  const HmomSoot model({soot});
  const ModelGas gas(sootingGas(), soot);
  const double N0 = 1e18;
  const Scalars start = twoModes(N0, nucleusMass, 0, 0, 1);
  const Scalars rates = gas.rates(model, start);
  const auto equal = TwoEquationSoot(soot).sources(sootingGas().state, {N0, start[1], start[2]});
  EXPECT_NEAR(rates[0] / (2 * equal.number), 1, 1e-12);
  EXPECT_NEAR(rates[3] / -equal.number, 1, 1e-12);
  EXPECT_NEAR(rates[4] + rates[1], 0, 1e-14 * rates[4]);
  EXPECT_NEAR(rates[6] / (rates[3] * sphereSurface(2 * nucleusMass)), 1, 1e-12);
}

// Two large aggregates make one with the volume and the surface of both.
TEST(Hmom, AggregationKeepsVolumeAndSurface) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.coagulation = true;
  const HmomSoot model({soot});
  const ModelGas gas(sootingGas(), soot);
  const Scalars start = twoModes(0, 0, 1e17, sphereMass(15e-9), 1);
  const Scalars end = gas.integrate(model, start, 5e-3);
  EXPECT_LT(end[3], 0.25 * start[3]);
  for (std::size_t i : {4, 5, 6}) EXPECT_EQ(end[i], start[i]);
  // So primaries stay what they were, and there are as many as particles at the start.
  const ParticleProperties p = model.properties(gas.gas, end);
  EXPECT_NEAR(p.primaryDiameter / 15e-9, 1, 1e-12);
  EXPECT_NEAR(p.primariesPerAggregate * end[3] / start[3], 1, 1e-12);
  EXPECT_NEAR(p.mobilityDiameter / (15e-9 * std::pow(p.primariesPerAggregate, 0.45)), 1, 1e-12);
}

// One large sphere collides as the two-equation model's; an aggregate of n_p primaries with d_c = d_p n_p^(1/D_f).
TEST(Hmom, CollisionDiametersAreFractal) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.coagulation = true;
  const ModelGas gas(sootingGas(), soot);
  const double N = 1e17, mass = sphereMass(20e-9);
  const auto equal = TwoEquationSoot(soot).sources(sootingGas().state, {N, 0.99 * N * mass, 0.01 * N * mass});
  EXPECT_NEAR(gas.rates(HmomSoot({soot}), twoModes(0, 0, N, mass, 1))[3] / equal.number, 1, 1e-12);
  const double primaries = 64, dp = 20e-9 / 4;  // of a 64th of the volume
  for (double dimension : {1.8, 3.0}) {
    const double dc = dp * std::pow(primaries, 1 / dimension), path = 2 * meanFreePath(sootingGas().state);
    const double kernel =
        harmonicMean(freeMolecularKernel(freeMolecularPrefactor(1700, 2.2), mass, dc, mass, dc),
                     4 * continuumPrefactor(1700, sootingGas().state.viscosity) * slipCorrection(path / dc));
    const double rate = gas.rates(HmomSoot({soot, dimension}), twoModes(0, 0, N, mass, primaries))[3];
    EXPECT_NEAR(rate / (-0.5 * kernel * N * N), 1, 1e-12);
  }
}

// A nucleus on a large particle: volume moves over, the large number stays.
TEST(Hmom, NucleiAreTakenUpByLargeParticles) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.coagulation = true;
  const HmomSoot model({soot});
  const ModelGas gas(sootingGas(), soot);
  const double few = 1e5, N = 1e17, mass = sphereMass(20e-9);  // nuclei do not meet each other
  const Scalars with = gas.rates(model, twoModes(few, nucleusMass, N, mass, 1));
  const Scalars without = gas.rates(model, twoModes(0, 0, N, mass, 1));
  EXPECT_LT(with[0], 0);
  EXPECT_NEAR((with[3] - without[3]) / without[3], 0, 1e-15);
  EXPECT_NEAR(with[4] / -with[1], 1, 1e-15);
  // Of a sphere the surface grows as that of a sphere.
  const double volume = (with[4] + with[5]) / 1850;
  EXPECT_NEAR(with[6] / (volume * 4 / 20e-9), 1, 1e-9);
}

// Growth and condensation of spheres leave spheres: S^3 = 36 pi V^2 at any time, to the error of the integration.
TEST(Hmom, SpheresStaySpheresWhenTheyGrow) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.surfaceGrowth = soot.condensation = true;
  soot.alpha = 0.1;
  const HmomSoot model({soot});
  const ModelGas gas(sootingGas(), soot);
  const Scalars start = twoModes(0, 0, 1e16, sphereMass(10e-9), 1);
  const Scalars end = gas.integrate(model, start, 20e-3, 1e-9);
  const double mass = (end[4] + end[5]) / end[3];
  EXPECT_GT(mass, 8 * sphereMass(10e-9));
  EXPECT_EQ(end[3], start[3]);
  EXPECT_NEAR(end[6] / (end[3] * sphereSurface(mass)), 1, 1e-6);
}

// The rates of spheres are those of the two-equation model: the same surface chemistry, the same dimers.
TEST(Hmom, LargeSpheresGrowCondenseAndOxidiseAsTheTwoEquationModelDoes) {
  const SootModelOptions soot = test::naphthalene();
  const HmomSoot model({soot});
  const ModelGas gas(sootingGas(), soot);
  const Scalars y = twoModes(0, 0, 1e17, sphereMass(20e-9), 1);
  const auto two = TwoEquationSoot(soot).sources(sootingGas().state, {y[3], y[4], y[5]});
  const ParticleProcesses p = model.processes(gas.gas, y);
  EXPECT_NEAR(p.growth / two.growth, 1, 1e-12);
  EXPECT_NEAR(p.oxidationO2 / two.oxidationO2, 1, 1e-12);
  EXPECT_NEAR(p.oxidationOH / two.oxidationOH, 1, 1e-12);
  EXPECT_NEAR(p.condensation / two.condensation, 1, 1e-12);
  EXPECT_NEAR(p.nucleation / two.nucleation, 1, 1e-12);
  EXPECT_NEAR(p.nucleationNumber / two.nucleationNumber, 1, 1e-12);
  EXPECT_NEAR(p.coagulationNumber / two.coagulationNumber, 1, 1e-12);
  const Scalars rates = gas.rates(model, y);
  EXPECT_NEAR((rates[1] + rates[4]) / two.carbon, 1, 1e-12);
  EXPECT_NEAR((rates[2] + rates[5]) / two.hydrogen, 1, 1e-11);
}

// Growth of an aggregate's surface falls with n_p^-0.2043 (Mueller, Blanquart and Pitsch 2009).
TEST(Hmom, SurfacesOfAggregatesGrowSlower) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.surfaceGrowth = true;
  soot.alpha = 0.1;
  const HmomSoot model({soot});
  const ModelGas gas(sootingGas(), soot);
  for (double primaries : {1.0, 10.0, 300.0}) {
    const Scalars y = twoModes(0, 0, 1e16, sphereMass(50e-9), primaries);
    const Scalars rates = gas.rates(model, y);
    EXPECT_NEAR(rates[6] / y[6] / ((rates[4] + rates[5]) / (y[4] + y[5])), 2.0 / 3 * std::pow(primaries, -0.2043),
                1e-12);
  }
}

// Oxidised, an aggregate keeps its shape: S goes with V^(2/3), whatever its primaries. What goes as a whole is a share
// (nucleus/mean)^2, of 1e-9 here.
TEST(Hmom, SurfacesOfAggregatesShrinkLikeThoseOfSpheres) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.oxidation = true;
  soot.alpha = 0.1;
  const HmomSoot model({soot});
  const ModelGas gas(FlameGas(1900, 1e-4, 1e-3, 3e-3, 0.1, 0.02, 0, {0}), soot);
  for (double primaries : {1.0, 10.0, 300.0}) {
    const Scalars y = twoModes(0, 0, 1e16, sphereMass(50e-9), primaries);
    const Scalars rates = gas.rates(model, y);
    EXPECT_LT(rates[4], 0);
    EXPECT_NEAR(rates[6] / y[6] / ((rates[4] + rates[5]) / (y[4] + y[5])), 2.0 / 3, 1e-8);
  }
}

// A nucleus hit by acetylene is a large particle of its own volume and two carbon atoms more.
TEST(Hmom, NucleiThatGrowLeaveTheirMode) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.surfaceGrowth = true;
  soot.alpha = 0.1;
  const HmomSoot model({soot});
  const ModelGas gas(sootingGas(), soot);
  const Scalars y = twoModes(1e16, nucleusMass, 0, 0, 1);
  const Scalars rates = gas.rates(model, y);
  const double atoms = 2 * 12.011e-3 / constants::avogadro;
  EXPECT_NEAR(rates[3] / -rates[0], 1, 1e-15);
  EXPECT_NEAR((rates[1] + rates[2]) / (rates[0] * nucleusMass), 1, 1e-13);
  EXPECT_NEAR((rates[4] + rates[5]) / (rates[3] * (nucleusMass + atoms)), 1, 1e-13);
  EXPECT_NEAR(rates[6] / (rates[3] * sphereSurface(nucleusMass + atoms)), 1, 1e-13);
  const double events = -gas.exchange(model, y)[5] * constants::avogadro;
  EXPECT_NEAR(events / rates[3], 1, 1e-13);
}

// Oxidation: nuclei go as a whole; large particles shrink, and go as a whole once they are nuclei.
TEST(Hmom, BurnsOut) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.oxidation = true;
  soot.alpha = 0.1;
  const FlameGas flame(1900, 1e-4, 1e-3, 3e-3, 0.1, 0.02, 0, {0});
  const HmomSoot model({soot});
  const ModelGas gas(flame, soot);
  const Scalars onlyNuclei = twoModes(1e16, nucleusMass, 0, 0, 1);
  const Scalars burning = gas.rates(model, onlyNuclei);
  for (std::size_t i : {1, 2})
    EXPECT_NEAR(burning[i] / onlyNuclei[i], burning[0] / onlyNuclei[0], -1e-13 * burning[0] / onlyNuclei[0]);
  const double d0 = 20e-9;
  const Scalars start = twoModes(0, 0, 1e16, sphereMass(d0), 1);
  const Scalars rates = gas.rates(model, start);
  const double speed = -(rates[4] + rates[5]) / (1850 * start[6]);
  Scalars end = gas.integrate(model, start, 0.3 * d0 / speed);
  // At most (nucleus/mean)^2 = (1/500)^2 of the relative loss of mass, ln(1/0.064) = 2.7, has gone by number.
  EXPECT_NEAR(end[3] / start[3], 1, 1.2e-5);
  EXPECT_NEAR((end[4] + end[5]) / (end[3] * sphereMass(0.4 * d0)), 1, 2e-3);
  end = gas.integrate(model, end, 0.4 * d0 / speed);
  EXPECT_GT(end[3], 0);
  EXPECT_LT(end[3], 1e-3 * start[3]);
  EXPECT_GT(end[4] / end[3], 0.9 * 40 * 12.011e-3 / constants::avogadro);
}

// Primaries that burn below the size of nuclei leave no surface behind. With the rates' 2/3 for what there is mass for,
// and 3 for the rest, that rest tends to (1 - 2/3)/(3 - 1) of it.
TEST(Hmom, SurfaceBurnsOutWithTheMass) {
  SootModelOptions soot = nothing(test::naphthalene());
  soot.oxidation = true;
  soot.alpha = 0.1;
  const HmomSoot model({soot});
  const ModelGas gas(FlameGas(1900, 1e-4, 1e-3, 3e-3, 0.1, 0.02, 0, {0}), soot);
  const double primary = 3e-9, inOne = 1000, smallest = 40 * 12.011e-3 / constants::avogadro;
  const Scalars start = twoModes(0, 0, 1e14, inOne * sphereMass(primary), inOne);
  const Scalars rates = gas.rates(model, start);
  const double life = 0.5 * primary * 1850 * start[6] / -(rates[4] + rates[5]);  // s, of a primary
  const Scalars end = gas.integrate(model, start, 1.15 * life, 1e-9);
  const double mass = end[4] + end[5], most = mass / smallest * sphereSurface(smallest);
  EXPECT_LT(mass, 1e-2 * (start[4] + start[5]));
  EXPECT_GT(mass / end[3], 2 * smallest);
  EXPECT_NEAR(end[6] / most, 1 + 1.0 / 6, 3e-3);
  // It goes, too, where there is next to no mass for it; what there is mass for is at rest with that.
  Scalars bare = end;
  for (std::size_t i : {3, 4, 5}) bare[i] *= 1e-9;
  EXPECT_NEAR(gas.rates(model, bare)[6] / bare[6] / (gas.rates(model, bare)[4] / bare[4]), 3, 1e-6);
}

TEST(Hmom, StaysBoundedInStatesOfNoPopulation) {
  const HmomSoot model({test::naphthalene()});
  const ModelGas gas(sootingGas(), model.options().soot);
  const Scalars base = twoModes(1e15, nucleusMass, 1e16, sphereMass(20e-9), 4);
  const double nucleus = 40 * 12.011e-3 / constants::avogadro;
  for (std::size_t i = 0; i < 7; ++i) {
    for (double factor : {0.0, 1e-40, 1e-5, 1e5, 1e30}) {
      Scalars y = base;
      y[i] *= factor;
      const double mass = y[1] + y[2] + y[4] + y[5];
      EXPECT_LE(model.properties(gas.gas, y).surfaceArea, mass * sphereSurface(nucleus) / nucleus * (1 + 1e-12));
      for (double r : gas.rates(model, y)) EXPECT_TRUE(std::isfinite(r));
    }
  }
}

}  // namespace
}  // namespace lampblack::particles
