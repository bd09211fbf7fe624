// What is told of trees: of spheres and of two in contact by hand, distributions and classes that add up, and rates
// against sums over all pairs.
#include "particles/trees/tree_functionals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "particles/trees/tree_ensemble.hpp"
#include "particles/trees/tree_population.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/trees/tree_fixtures.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::particles {
namespace {

using Which = TreeFunctionals;

constexpr double functionalNm = 1e-9;

// Trees of one to some tens of primaries of silica that has sintered hardly, in a gas with precursor.
struct Sample {
  Sample() {
    options.material = silica();
    options.material.sintering.prefactor = 1e-10;
    options.particles = 400;
    options.owner = 3;
    trees = std::make_unique<TreeEnsemble>(mechanism(), options, std::vector<TreeStart>{{{2107, 3960, 398}, 1e17}});
    trees->advance(gas(3e-8), 0.02);
    trees->applyDeferred();
  }
  static const Mechanism& mechanism() {
    static const Mechanism one = Mechanism::fromFile(test::sourcePath("cases/mechanisms/silica_teos_29.yaml"));
    return one;
  }
  ParticleGas gas(double precursor) {
    concentrations = {precursor, 0};
    CarrierGas carrier{1173, 101325, 0.29, 4.6e-5, 0.028014};
    return {carrier, concentrations};
  }
  std::array<double, 2> concentrations{};
  TreeOptions options;
  std::unique_ptr<TreeEnsemble> trees;
};

// The ratio is the last functional, and there where a material has two elements.
TEST(TreeFunctionals, OfOneElementHaveNoRatio) {
  TreeMaterial carbon = silica();
  for (TreeComponent& component : carbon.components) component.elements = {{"C", 1.0}};
  EXPECT_EQ(TreeFunctionals(carbon).size(), static_cast<std::size_t>(Which::elementRatio));
  EXPECT_EQ(TreeFunctionals(silica()).size(), Which::elementRatio + 1u);
}

TEST(TreeFunctionals, OfASphereAreItsDiameterAndAtoms) {
  const TreeMaterial material = silica();
  const TreeFunctionals functionals(material);
  const PrimaryTrees type(material, CollisionSize::primaries);
  const Tree sphere = type.make(TreeUnits{10, 15, 6});
  const double d = treeDiameter(material.volume({10, 15, 6}));
  for (const auto which :
       {Which::collisionDiameter, Which::sphereDiameter, Which::mobilityDiameter, Which::primaryDiameter})
    EXPECT_NEAR(functionals.of(sphere.head(), which) / d, 1, 1e-12) << functionals.all()[which].name;
  EXPECT_EQ(functionals.of(sphere.head(), Which::primaries), 1);
  EXPECT_EQ(functionals.of(sphere.head(), Which::sinteringLevel), 1);
  EXPECT_NEAR(functionals.of(sphere.head(), Which::elementRatio), 10.0 / 21, 1e-15);
  EXPECT_EQ(functionals.all()[Which::elementRatio].name, "Si_to_O");
}

TEST(TreeFunctionals, OfTwoEqualSpheresInContact) {
  const TreeMaterial material = silica();
  const TreeFunctionals functionals(material);
  const PrimaryTrees type(material, CollisionSize::primaries);
  RandomStream random(1, 1, 1);
  const Tree two = test::joinedTree(type, {8 * functionalNm, 8 * functionalNm}, random);
  // S = 2 s and V = 2 v: n_r = S^3/(36 pi V^2) = 2, and 6V/S = d.
  EXPECT_NEAR(functionals.of(two.head(), Which::mobilityDiameter) / (8 * functionalNm), std::pow(2, 0.45), 1e-9);
  EXPECT_NEAR(functionals.of(two.head(), Which::sphereDiameter) / (8 * functionalNm), std::cbrt(2.0), 1e-9);
  EXPECT_EQ(functionals.of(two.head(), Which::primaries), 2);
  EXPECT_NEAR(functionals.of(two.head(), Which::sinteringLevel), 0, 1e-12);
}

TEST(TreeFunctionals, DistributionsHaveAllParticlesOrPrimaries) {
  Sample sample;
  const TreeTotals totals = sample.trees->trees().totals();
  const auto sizes = sample.trees->distributions();
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const auto density = sample.trees->distribution(k, {-9.4, -6.4, 60});
    const double number = 0.05 * std::accumulate(density.begin(), density.end(), 0.0);
    const bool ofPrimaries = sizes[k].name == "primary_";
    EXPECT_NEAR(number / (ofPrimaries ? totals.primaries : totals.number), 1, 1e-12) << sizes[k].name;
  }
  for (std::size_t k = 0; k < sample.trees->shares().size(); ++k) {
    const auto density = sample.trees->shareDistribution(k, 40);
    const double number = std::accumulate(density.begin(), density.end(), 0.0) / 40;
    EXPECT_NEAR(number / totals.number, 1, 1e-12) << sample.trees->shares()[k].name;
  }
}

TEST(TreeFunctionals, SinglePrimariesAreInTheLastBinOfLevels) {
  Sample sample;
  double single = 0;
  sample.trees->trees().forEachTree([&](const Tree& t, double number) { single += t.count() == 1 ? number : 0; });
  ASSERT_GT(single, 0);
  EXPECT_GE(sample.trees->shareDistribution(0, 40).back() / 40, single * (1 - 1e-12));
}

TEST(TreeFunctionals, ClassesAddUpToTheMeansOfAll) {
  Sample sample;
  const TreeTotals totals = sample.trees->trees().totals();
  const std::vector<std::vector<double>> edges{{9 * functionalNm, 20 * functionalNm}, {2, 5, 1000}};
  const std::size_t width = 1 + sample.trees->functionals().size();
  for (std::size_t by = 0; by < edges.size(); ++by) {
    const std::vector<double> sums = sample.trees->classSums(by, edges[by]);
    ASSERT_EQ(sums.size(), (edges[by].size() + 1) * width);
    std::vector<double> all(width, 0.0);
    for (std::size_t n = 0; n < sums.size(); ++n) all[n % width] += sums[n];
    EXPECT_NEAR(all[0] / totals.number, 1, 1e-12);
    EXPECT_NEAR(all[1 + Which::collisionDiameter] / totals.number / totals.collisionDiameter, 1, 1e-12);
    EXPECT_NEAR(all[1 + Which::primaries] / totals.primaries, 1, 1e-12);
    EXPECT_NEAR(all[1 + Which::sinteringLevel] / totals.number / totals.sinteringLevel, 1, 1e-12);
    // Each average lies in its class.
    for (std::size_t c = 0; c <= edges[by].size(); ++c) {
      const double number = sums[c * width],
                   sum = sums[c * width + 1 + (by == 0 ? Which::collisionDiameter : Which::primaries)];
      if (number == 0) continue;
      const double lower = c > 0 ? edges[by][c - 1] : 0, upper = c < edges[by].size() ? edges[by][c] : 1e9;
      EXPECT_GE(sum / number, lower * (1 - 1e-12));
      EXPECT_LT(sum / number, upper);
    }
  }
  // Single primaries are below two, and whoever has as many as an edge is above it.
  const std::vector<double> byPrimaries = sample.trees->classSums(1, std::array{2.0});
  double single = 0;
  sample.trees->trees().forEachTree([&](const Tree& t, double number) { single += t.count() == 1 ? number : 0; });
  EXPECT_GT(single, 0);
  EXPECT_NEAR(byPrimaries[0] / single, 1, 1e-12);
}

// Soot may have lost all its hydrogen: its ratio is over carbon.
TEST(TreeFunctionals, TheRatioOfSootIsFinite) {
  const TreeMaterial soot = sootMaterial({});
  const TreeFunctionals functionals(soot);
  EXPECT_EQ(functionals.all()[TreeFunctionals::elementRatio].name, "H_to_C");
  const PrimaryTrees type(soot, CollisionSize::volumeToSurface);
  EXPECT_EQ(functionals.of(type.make(TreeUnits{100, 0, 0}).head(), TreeFunctionals::elementRatio), 0);
  EXPECT_NEAR(functionals.of(type.make(TreeUnits{100, 25, 0}).head(), TreeFunctionals::elementRatio), 0.25, 1e-15);
}

TEST(TreeRates, AreThoseOfTheLawsSummedOverTreesAndPairs) {
  Sample sample;
  const ParticleGas gas = sample.gas(3e-8);
  const TreePopulation& population = sample.trees->trees();
  const TreeMaterial& m = sample.options.material;
  const TreeRates rates = population.rates(gas, 200000);
  const double molecules = 3e-8 * constants::avogadro;
  CollisionKernelOptions options = sample.options.kernel;
  options.gas = gas;
  const CollisionKernel kernel(options);
  const CollisionKernel::Properties molecule{m.sites()->moleculeMass / m.density, m.sites()->moleculeMass,
                                             m.sites()->moleculeDiameter};
  EXPECT_NEAR(rates.inceptions / (0.5 * kernel.value(molecule, molecule) * molecules * molecules), 1, 1e-12);
  double reactions = 0, condensations = 0, pairs = 0;
  std::vector<CollisionKernel::Properties> all;
  population.forEachTree([&](const Tree& tree, double number) {
    const TreeHead& head = tree.head();
    const double sites = head.units[m.sites()->site], perSite = m.sites()->growthRate(1173, 3e-8);
    reactions += number * perSite * sites;
    condensations += number * std::max(0.0, perSite * sites - 0.5 * sites / head.surface * head.sintering);
    all.push_back({head.volume, head.volume * m.density, head.collision});
  });
  EXPECT_NEAR(rates.reactions / reactions, 1, 1e-12);
  EXPECT_GT(condensations, 0);
  EXPECT_LT(condensations, 0.999 * reactions) << "that sintering counts";
  EXPECT_NEAR(rates.condensations / condensations, 1, 1e-12);
  double squares = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      pairs += kernel.value(all[i], all[j]);
      squares += std::pow(kernel.value(all[i], all[j]), 2);
    }
  const double count = 0.5 * static_cast<double>(all.size() * (all.size() - 1)), mean = pairs / count;
  const double error = std::sqrt((squares / count - mean * mean) / 200000) / mean;
  EXPECT_NEAR(rates.coagulations / (pairs * population.weight() * population.weight()), 1, 3.3 * error);
  EXPECT_LT(error, 0.02);
  // To look changes nothing.
  EXPECT_EQ(population.rates(gas, 100).coagulations, population.rates(gas, 100).coagulations);
}

TEST(TreeRates, ThePrecursorGoesToNucleiAndSurfaces) {
  Sample sample;
  const ParticleGas gas = sample.gas(3e-6);
  const TreeRates rates = sample.trees->trees().rates(gas, 0);
  ASSERT_GT(rates.inceptions, 0);
  ASSERT_GT(rates.reactions, 0);
  const auto rate = sample.trees->rateOf(0, gas);
  ASSERT_TRUE(rate);
  EXPECT_NEAR(*rate / (-(2 * rates.inceptions + rates.reactions) / constants::avogadro), 1, 1e-12);
  EXPECT_FALSE(sample.trees->rateOf(1, gas)) << "what sintering gives back is not known beforehand";
}

TEST(TreeRates, InceptionWithoutEnhancementIsThatOfTheFreeMolecularKernel) {
  TreeOptions options;
  options.material = silica();
  options.material.siteReactions().freeMolecularInception = true;
  Sample sample;
  const double molecules = 1e-4 * constants::avogadro, m = options.material.sites()->moleculeMass,
               d = options.material.sites()->moleculeDiameter;
  const double k = 4 * std::sqrt(constants::pi * constants::boltzmann * 1173 / m) * d * d;
  EXPECT_NEAR(std::make_unique<TreePopulation>(options)->rates(sample.gas(1e-4), 0).inceptions /
                  (0.5 * k * molecules * molecules),
              1, 1e-12);
  // The transition kernel of molecules is the free-molecular one but for some thousandths.
  options.material.siteReactions().freeMolecularInception = false;
  options.kernel.enhancement = 1;
  EXPECT_NEAR(std::make_unique<TreePopulation>(options)->rates(sample.gas(1e-4), 0).inceptions /
                  (0.5 * k * molecules * molecules),
              1, 0.02);
}

TEST(TreeRates, EventsOfTheSampleAreThoseOfTheGasByItsWeight) {
  Sample sample;
  // Born of the gas, too few to fill the sample: it is neither doubled nor contracted.
  sample.options.particles = 4000;
  sample.options.fullAt = 4e18;
  sample.trees = std::make_unique<TreeEnsemble>(Sample::mechanism(), sample.options);
  sample.trees->advance(sample.gas(1e-5), 1e-4);
  static_cast<void>(sample.trees->takeExchange());
  const TreeCounters counters = sample.trees->trees().counters();
  ASSERT_EQ(counters.doublings + counters.removals, 0U);
  const auto columns = sample.trees->columns();
  const std::vector<double> values = sample.trees->values(sample.gas(1e-5));
  ASSERT_EQ(columns.size(), values.size());
  // A step that is taken back leaves no trace, not in what was counted from the beginning either.
  const auto saved = sample.trees->save();
  sample.trees->advance(sample.gas(1e-5), 1e-4);
  static_cast<void>(sample.trees->takeExchange());
  EXPECT_NE(sample.trees->values(sample.gas(1e-5)), values);
  sample.trees->restore(*saved);
  EXPECT_EQ(sample.trees->values(sample.gas(1e-5)), values);
  const auto value = [&](const std::string& name) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].name == "silica_" + name) return values[c];
    ADD_FAILURE() << name;
    return 0.0;
  };
  for (const char* process : {"inception", "coagulation", "surface_reaction", "condensation"}) {
    const double events = value(std::string(process) + "_events");
    EXPECT_GT(events, 0) << process;
    EXPECT_NEAR(value(std::string(process) + "s") / (events * sample.trees->trees().weight()), 1, 1e-9) << process;
  }
  EXPECT_GT(value("mass_cubed") * value("mass"), value("mass_squared") * value("mass_squared"));
}

}  // namespace
}  // namespace lampblack::particles
