// Stochastic soot populations: atoms, closed solutions, and the three methods against each other.
#include "particles/ensemble/ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../statistics.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/soot/soot_medium.hpp"
#include "particles/soot/surface_chemistry.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

constexpr double rho = 1850;

double massOf(double d) {
  return rho * constants::pi / 6 * d * d * d;
}

class EnsembleMethods : public testing::TestWithParam<EnsembleMethod> {
 protected:
  [[nodiscard]] EnsembleOptions options(SootModelOptions soot) const {
    EnsembleOptions o;
    o.method = GetParam();
    o.particles = 400;
    o.soot = std::move(soot);
    return o;
  }
};

std::string nameOf(const testing::TestParamInfo<EnsembleMethod>& info) {
  if (info.param == EnsembleMethod::dsmc) return "dsmc";
  if (info.param == EnsembleMethod::pairs) return "pairs";
  return info.param == EnsembleMethod::sammc ? "sammc" : "swa";
}

INSTANTIATE_TEST_SUITE_P(All, EnsembleMethods,
                         testing::Values(EnsembleMethod::dsmc, EnsembleMethod::sammc, EnsembleMethod::swa,
                                         EnsembleMethod::pairs),
                         nameOf);

// The gas as a population sees it, in kg of carbon: two atoms an event with C2H2 or O2, one with OH, two dimers a
// nucleus.
TEST(SootMedium, FluxesAndInceptionAreThoseOfTheSurfaceAndTheDimers) {
  const test::FlameGas gas(1650, 1e-3, 0.03, 1e-4, 0.08, 1e-3, 0.03, {1e-6, 4e-7, 3e-7});
  const SootModelOptions options = test::threePah();
  const DimerModel dimers(options);
  const SootMedium medium(options, dimers, gas.state, true);
  const SurfaceRates all = SurfaceChemistry(options, 1650).rates(gas.concentrations, 1);
  const SootFluxes fluxes = medium.fluxes();
  const double W = options.carbonWeight;
  EXPECT_NEAR(fluxes.growth / (2 * W * all.growth * gas[SootSpecies::C2H2]), 1, 1e-14);
  EXPECT_NEAR(fluxes.O2 / (2 * W * all.oxidationO2 * gas[SootSpecies::O2]), 1, 1e-14);
  EXPECT_NEAR(fluxes.OH / (W * all.oxidationOH * gas[SootSpecies::OH]), 1, 1e-14);
  // Without particles to condense on, all dimers end in nuclei; a little of them do where particles take most.
  EXPECT_NEAR(medium.inception(0) / (0.5 * medium.dimer().rate), 1, 1e-14);
  const double most = 1e3 * medium.dimer().rate / medium.dimers(0);
  const double few = medium.dimers(most);
  EXPECT_NEAR((2 * medium.inception(most) + most * few) / medium.dimer().rate, 1, 1e-14);
}

// Growth, condensation, oxidation by O2 and OH, inception and coagulation together, with dilution.
TEST_P(EnsembleMethods, TakesFromTheGasTheAtomsThatTheSootGains) {
  const test::FlameGas gas(1650, 1e-3, 0.03, 1e-5, 0.08, 1e-5, 0.03, {1e-6, 4e-7, 3e-7});
  const SootModelOptions soot = test::threePah();
  for (const SootShape shape : {SootShape::spheres, SootShape::aggregates, SootShape::surfaceVolume}) {
    EnsembleOptions o = options(soot);
    o.shape = shape;
    o.keepsHydrogen = shape != SootShape::aggregates;
    const auto population = makeEnsemble(o);
    EnsembleExchange sum;
    for (int step = 0; step < 40; ++step) {
      const auto before = population->totals();
      population->advance(gas.state, 60, 2e-4);
      const auto after = population->totals();
      const EnsembleExchange x = population->takeExchange();
      const double scale = after.mass() + 1e-12;
      // The soot's own account.
      EXPECT_NEAR(after.carbon - before.carbon, x.carbon - x.dilutedCarbon + x.resampledCarbon, 1e-12 * scale);
      EXPECT_NEAR(after.hydrogen - before.hydrogen, x.hydrogen - x.dilutedHydrogen + x.resampledHydrogen,
                  1e-12 * scale);
      EXPECT_NEAR(x.carbon + x.hydrogen, x.nucleated + x.condensed + x.grown - x.oxidisedO2 - x.oxidisedOH,
                  1e-12 * scale);
      if (o.method != EnsembleMethod::dsmc) {
        EXPECT_NEAR(x.resampledCarbon + x.resampledHydrogen, 0, 1e-12 * scale);
      }
      if (o.method == EnsembleMethod::sammc) {
        EXPECT_NEAR(x.resampledHydrogen, 0, 1e-12 * scale);
      }
      // Atoms, mol/m3.
      using S = SootSpecies;
      const auto& g = x.gas;
      double C = g[S::CO] + 2 * g[S::C2H2], H = g[S::H] + 2 * g[S::H2] + g[S::OH] + 2 * g[S::C2H2];
      for (std::size_t k = 0; k < soot.pah.size(); ++k) {
        C += soot.pah[k].carbon * g[S::fixed + k];
        H += soot.pah[k].hydrogen * g[S::fixed + k];
      }
      EXPECT_NEAR(C, -x.carbon / soot.carbonWeight, 1e-12 * scale / soot.carbonWeight);
      EXPECT_NEAR(H, -x.hydrogen / soot.hydrogenWeight, 1e-12 * scale / soot.hydrogenWeight);
      EXPECT_NEAR(g[S::CO] + 2 * g[S::O2] + g[S::OH], 0, 1e-13 * (g[S::CO] - g[S::OH]));
      EXPECT_EQ(g[S::H2O], 0);
      for (const auto part : {&EnsembleExchange::nucleated, &EnsembleExchange::condensed, &EnsembleExchange::grown,
                              &EnsembleExchange::oxidisedO2, &EnsembleExchange::oxidisedOH})
        sum.*part += x.*part;
    }
    EXPECT_GT(population->counters().coagulations, 400u);
    if (!o.keepsHydrogen) {
      EXPECT_EQ(population->totals().hydrogen, 0);
    }
    for (const auto part : {&EnsembleExchange::nucleated, &EnsembleExchange::condensed, &EnsembleExchange::grown,
                            &EnsembleExchange::oxidisedO2, &EnsembleExchange::oxidisedOH})
      EXPECT_GT(sum.*part, 1e-5 * population->totals().mass());
  }
}

// A gas in which particles only grow, by `flux`, kg/(m2 s).
struct GrowthAlone {
  test::FlameGas gas{1700, 1e-3, 0.03, 0, 0.08, 0, 0.03, {}};
  SootModelOptions soot;
  double flux = 0.0;

  GrowthAlone() {
    soot.alpha = 0.7;
    soot.coagulation = soot.inception = false;
    flux = 2 * soot.carbonWeight * SurfaceChemistry(soot, 1700).rates(gas.concentrations, 0.7).growth *
           gas[SootSpecies::C2H2];
  }
};

TEST_P(EnsembleMethods, SurfaceGrowthIsLinearInTheDiameterOfPrimaries) {
  const GrowthAlone growth;
  const auto& [gas, soot, flux] = growth;
  EnsembleOptions o = options(soot);
  o.shape = SootShape::aggregates;
  const auto population = makeEnsemble(o);
  const double n = 8, start = 6e-9;
  population->initialise(std::vector<GivenParticle>{{0.95 * n * massOf(start), 0.05 * n * massOf(start), n, 1e14}});
  population->advance(gas.state, 0, 5e-9 * rho / (2 * flux));  // by 5 nm
  const auto totals = population->totals();
  EXPECT_NEAR(totals.mass() / (1e14 * n * massOf(11e-9)), 1, 1e-11);
  EXPECT_NEAR(totals.hydrogen / (1e14 * 0.05 * n * massOf(start)), 1, 1e-11);
  EXPECT_NEAR(totals.primaries / (1e14 * n), 1, 1e-12);
  EXPECT_NEAR(totals.diameters / (1e14 * 11e-9 * std::pow(8, 0.45)), 1, 1e-11);
}

// By volume and surface: the sphere of the surface, of diameter sqrt(S/pi), grows as any other sphere does, and the
// volume gained is its; dV/dt = w S and dS/dt = 2 dV/dt / sqrt(S/4 pi) have that solution. Of second order.
TEST_P(EnsembleMethods, ByVolumeAndSurfaceGrowthIsThatOfTheSphereOfTheSurface) {
  const GrowthAlone growth;
  const auto& [gas, soot, flux] = growth;
  const double n = 8, primary = 6e-9, start = std::sqrt(n) * primary, end = start + 5e-9;
  const auto error = [&](double tolerance) {
    EnsembleOptions o = options(soot);
    o.shape = SootShape::surfaceVolume;
    o.splitTolerance = tolerance;
    const auto population = makeEnsemble(o);
    population->initialise(std::vector<GivenParticle>{{n * massOf(primary), 0, n, 1e14}});
    population->advance(gas.state, 0, 5e-9 * rho / (2 * flux));
    const auto totals = population->totals();
    EXPECT_NEAR(totals.surface / (1e14 * constants::pi * end * end), 1, 0.1 * tolerance);
    return totals.mass() / (1e14 * (n * massOf(primary) + massOf(end) - massOf(start))) - 1;
  };
  const double coarse = error(0.04), fine = error(0.01);
  EXPECT_LT(std::abs(fine), 2e-4);
  EXPECT_NEAR(coarse / fine, 16, 5);
}

// Surface that burns away leaves as many spheres of 6V/S.
TEST_P(EnsembleMethods, ByVolumeAndSurfaceOxidationKeepsThePrimaries) {
  const test::FlameGas gas(1800, 0, 0, 2e-3, 0.1, 0, 0, {0});
  SootModelOptions soot = test::naphthalene();
  soot.coagulation = false;
  const double flux = soot.carbonWeight * SurfaceChemistry(soot, 1800).rates(gas.concentrations, 0.0).oxidationOH *
                      gas[SootSpecies::OH];
  EnsembleOptions o = options(soot);
  o.shape = SootShape::surfaceVolume;
  const auto population = makeEnsemble(o);
  population->initialise(std::vector<GivenParticle>{{5.5 * massOf(20e-9), 0, 5.5, 1e14}});
  population->advance(gas.state, 0, 4e-9 * rho / (2 * flux));
  const auto totals = population->totals();
  EXPECT_NEAR(totals.mass() / (1e14 * 5.5 * massOf(16e-9)), 1, 1e-11);
  EXPECT_NEAR(totals.surface / (1e14 * 5.5 * constants::pi * 16e-9 * 16e-9), 1, 1e-11);
}

TEST_P(EnsembleMethods, OxidationKeepsCompositionAndGivesBackAllOfWhatFallsBelowANucleus) {
  const test::FlameGas gas(1800, 0, 0, 2e-3, 0.1, 0, 0, {0});
  SootModelOptions soot = test::naphthalene();
  soot.coagulation = false;
  const double fraction = 0.05;
  const double carbonFlux = soot.carbonWeight *
                            SurfaceChemistry(soot, 1800).rates(gas.concentrations, 0.0).oxidationOH *
                            gas[SootSpecies::OH];
  const auto population = makeEnsemble(options(soot));
  const auto given = [&](double d) { return GivenParticle{(1 - fraction) * massOf(d), fraction * massOf(d), 1, 1e14}; };
  population->initialise(std::vector{given(3e-9), given(20e-9)});
  population->advance(gas.state, 0, 4e-9 * rho * (1 - fraction) / (2 * carbonFlux));  // 4 nm: all of the small one
  const auto totals = population->totals();
  EXPECT_NEAR(totals.number / 1e14, 1, 1e-12);
  EXPECT_NEAR(totals.mass() / (1e14 * massOf(16e-9)), 1, 1e-11);
  EXPECT_NEAR(totals.hydrogen / totals.mass(), fraction, 1e-12);
  const EnsembleExchange x = population->takeExchange();
  EXPECT_NEAR(x.oxidisedNumber / 1e14, 1, 1e-12);
  EXPECT_NEAR(x.oxidisedOH / (1e14 * (massOf(3e-9) + massOf(20e-9) - massOf(16e-9))), 1, 1e-11);
  if (GetParam() == EnsembleMethod::pairs) {
    EXPECT_EQ(population->size(), 2U) << "the other one is halved";
  }
}

TEST_P(EnsembleMethods, TakesInAShareOfAnotherPopulation) {
  const std::vector<GivenParticle> there(20, {massOf(10e-9), 0, 1, 1e13});
  std::vector<GivenParticle> coming;
  for (int k = 0; k < 7; ++k) coming.push_back({massOf(5e-9 + 2e-9 * k), 0, 1, 1e13 * (1 + k)});
  const double share = 0.3;
  double number = 20e13, carbon = 20e13 * massOf(10e-9);
  for (const GivenParticle& p : coming) {
    number += share * p.number;
    carbon += share * p.number * p.carbon;
  }
  std::vector<double> numbers, carbons;
  for (std::uint64_t owner = 0; owner < 100; ++owner) {
    EnsembleOptions o = options({});
    o.owner = owner;
    const auto population = makeEnsemble(o);
    population->initialise(there);
    population->join(coming, share);
    numbers.push_back(population->totals().number);
    carbons.push_back(population->totals().carbon);
  }
  EXPECT_LT(std::abs(test::summarise(numbers).z(number)), test::zLimit);
  EXPECT_LT(std::abs(test::summarise(carbons).z(carbon)), test::zLimit);
}

TEST_P(EnsembleMethods, CoagulationOfAggregatesKeepsMassPrimariesAndSurface) {
  const test::FlameGas gas(1600, 0, 0, 0, 0, 0, 0, {});
  EnsembleOptions o = options({});
  for (const SootShape shape : {SootShape::aggregates, SootShape::surfaceVolume}) {
    o.shape = shape;
    const auto population = makeEnsemble(o);
    std::vector<GivenParticle> start;
    for (int k = 0; k < 400; ++k) start.push_back({massOf(10e-9 + 1e-11 * k), 0, 1, 5e13});
    population->initialise(start);
    const auto before = population->totals();
    for (int k = 0; k < 4; ++k) population->advance(gas.state, 0, 5e-3);
    const auto after = population->totals();
    EXPECT_LT(after.number, 0.7 * before.number);
    EXPECT_NEAR(after.mass() / before.mass(), 1, 1e-12);
    if (GetParam() == EnsembleMethod::swa) return;  // primaries and surfaces of unlike particles in the mean only
    if (shape == SootShape::aggregates) {
      EXPECT_NEAR(after.primaries / before.primaries, 1, 1e-12);
    } else {
      EXPECT_NEAR(after.surface / before.surface, 1, 1e-12);
    }
  }
}

// The processes of a soot-forming zone from nothing, with dilution: moments of all methods are those of equal weights.
// SectionalEvolution.SectionsLieOnResolvedParticles holds these against sections.
TEST_P(EnsembleMethods, HasTheMomentsOfEqualWeights) {
  if (GetParam() == EnsembleMethod::dsmc) GTEST_SKIP() << "the reference";
  const test::FlameGas gas(1650, 1e-3, 0.03, 1e-5, 0.08, 0, 0.03, {1e-6, 4e-7, 3e-7});
  const double dt = 4e-4;
  const int steps = 10, repeats = 80;
  const std::vector<double> orders = {0, 1.0 / 3, 2.0 / 3, 1, 4.0 / 3};
  std::vector<std::vector<double>> here(orders.size()), there(orders.size());
  for (int r = 0; r < repeats; ++r) {
    EnsembleOptions o = options(test::threePah());
    o.owner = static_cast<std::uint64_t>(r);
    o.particles = 250;
    o.splitTolerance = 0.03;
    const auto population = makeEnsemble(o);
    o.method = EnsembleMethod::dsmc;
    o.seed = 7;
    const auto equal = makeEnsemble(o);
    for (int k = 0; k < steps; ++k) {
      population->advance(gas.state, 40, dt);
      equal->advance(gas.state, 40, dt);
    }
    for (std::size_t m = 0; m < orders.size(); ++m) {
      here[m].push_back(population->moment(orders[m]));
      there[m].push_back(equal->moment(orders[m]));
    }
  }
  for (std::size_t m = 0; m < orders.size(); ++m) {
    const test::Sample a = test::summarise(here[m]), b = test::summarise(there[m]);
    const double z = (a.mean - b.mean) / std::hypot(a.standardError, b.standardError);
    EXPECT_LT(std::abs(z), test::zLimit) << "moment " << orders[m] << ": " << a.mean << " +- " << a.standardError
                                         << ", equal weights " << b.mean << " +- " << b.standardError;
  }
}

TEST_P(EnsembleMethods, RepeatsDependOnSeedAndOwnerOnly) {
  const test::FlameGas gas(1650, 1e-3, 0.03, 0, 0.08, 0, 0.03, {1e-6});
  const auto run = [&](std::uint64_t owner) {
    EnsembleOptions o = options(test::naphthalene());
    o.owner = owner;
    const auto population = makeEnsemble(o);
    for (int k = 0; k < 5; ++k) population->advance(gas.state, 0, 1e-3);
    return population->moment(2);
  };
  EXPECT_EQ(run(3), run(3));
  EXPECT_NE(run(3), run(4));
}

TEST(Ensemble, RefusesWhatHasNoMeaning) {
  EnsembleOptions o;
  o.particles = 2;
  EXPECT_THROW((void)makeEnsemble(o), InputError);
  o.particles = 100;
  const auto population = makeEnsemble(o);
  EXPECT_THROW(population->initialise({}), InputError);
  EXPECT_THROW(population->initialise(std::vector<GivenParticle>{{0, 0, 1, 1}}), InputError);
  EXPECT_THROW(population->initialise(std::vector<GivenParticle>{{1e-21, 0, 1, 1}, {1e-21, 0, 1, 2}}), InputError);
  const std::vector<double> none(SootSpecies::fixed);
  EXPECT_THROW(population->advance({{}, none}, 0, 1e-3), NumericsError);
}

}  // namespace
}  // namespace lampblack::particles
