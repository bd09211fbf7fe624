// Populations of particles of molecules, in law and to round-off.
#include <gtest/gtest.h>

#include <cmath>

#include "particles/molecules/molecule_ensemble.hpp"
#include "particles/population/monte_carlo/shipped_types.hpp"
#include "tests/effort.hpp"
#include "tests/particles/molecules/molecules_fixtures.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {
namespace {

using Inception = MoleculeOptions::Inception;

// Of all particles: mean C, mean H.
std::pair<Sample, Sample> meanAtoms(MoleculeOptions options, const MoleculeGas& gas, double until, int repeats,
                                    std::size_t molecules = 1, std::uint32_t mostRings = 1000) {
  std::vector<double> carbon, hydrogen;
  for (int r = 0; r < repeats; ++r) {
    options.owner = static_cast<std::uint64_t>(r);
    MoleculePopulation population(options);
    population.fill(std::vector(options.particles, population.ofGas(molecules)), 1e18);
    population.advance(gas.state, until);
    population.forEach([&](const MoleculeParticle& p, double) {
      if (p.mostRings > mostRings) return;
      carbon.push_back(p.carbon());
      hydrogen.push_back(p.hydrogen());
    });
  }
  return {summarise(carbon), summarise(hydrogen)};
}

// The master equation of all eleven processes, 1500 K, 5e-6 s, over molecules of seven rings or fewer: those that have
// had more and came back are too few to be seen.
TEST(MoleculePopulation, OfSingleMoleculesIsTheSingleMoleculesChain) {
  const auto [carbon, hydrogen] = meanAtoms(singlePyrene(), MoleculeGas(), 5e-6, fewOrMany(10, 40), 1, 7);
  EXPECT_LT(std::abs(carbon.z(18.329997)), zLimit) << carbon.mean;
  EXPECT_LT(std::abs(hydrogen.z(10.938212)), zLimit) << hydrogen.mean;
}

// G6R_AC alone on triphenylene: C = 18 + 6 (1 - exp(-g t)) of each molecule.
TEST(MoleculePopulation, MoleculesInPrimariesGrowByTheGrowthFactor) {
  MoleculeOptions o = onlyProcess(singlePyrene(), PahProcess::G6R_AC);
  o.rings = namedMolecule("triphenylene");
  o.growthFactor = 0.4;
  const double g = 4.21212476e4, t = 2e-5;
  const auto expected = [&](double factor) { return 18 + 6 * (1 - std::exp(-factor * g * t)); };
  const MoleculeGas gas;
  EXPECT_LT(std::abs(meanAtoms(o, gas, t, 4, 1).first.z(expected(1))), zLimit);
  EXPECT_LT(std::abs(meanAtoms(o, gas, t, 4, 2).first.z(2 * expected(0.4))), zLimit);
  o.growthFactorFrom = 3;
  EXPECT_LT(std::abs(meanAtoms(o, gas, t, 4, 2).first.z(2 * expected(1))), zLimit);
}

// All processes at once, and a sample that nothing is removed from.
TEST(MoleculePopulation, KeepsTheAtomsOfGasAndParticles) {
  for (const Inception inception : {Inception::pairs, Inception::asInGas}) {
    MoleculeOptions o = singlePyrene();
    o.inception = inception;
    o.coagulation = true;
    o.growthFactor = 0.3;
    o.particles = 300;
    o.fullAt = 1e22;
    o.atStart = 0;
    const MoleculeGas gas(1e-5, 1700, 0.01, 0.02);
    MoleculePopulation population(o);
    population.fill(std::vector(100, population.ofGas(3)), 100 * o.fullAt / 300);
    const auto atoms = [&] {
      const MoleculeTotals t = population.totals();
      return std::pair{t.carbon, t.hydrogen};
    };
    const auto before = atoms();
    population.advance(gas.state, 2e-5);
    EXPECT_EQ(population.counters().removals, 0u);
    EXPECT_EQ(population.counters().doublings, 0u);
    const MoleculeExchange e = population.takeExchange();
    const auto now = atoms();
    EXPECT_GT(e.coagulations, 0);
    EXPECT_GT(inception == Inception::pairs ? e.inceptions : e.came, 0);
    EXPECT_EQ(inception == Inception::pairs, e.condensations > 0);
    EXPECT_GT(e.events[static_cast<std::size_t>(PahProcess::O6R_FE_HACA)], 0);
    EXPECT_NEAR(now.first - before.first, e.carbon, 1e-12 * now.first);
    EXPECT_NEAR(now.second - before.second, e.hydrogen, 1e-12 * now.second);
    // H, H2, OH, H2O, O2, C2H2, CO, A4.
    const double carbonOf[] = {0, 0, 0, 0, 0, 2, 1, 16}, hydrogenOf[] = {1, 2, 1, 2, 0, 2, 0, 10},
                 oxygenOf[] = {0, 0, 1, 1, 2, 0, 1, 0};
    double carbon = 0, hydrogen = 0, oxygen = 0;
    for (std::size_t k = 0; k < e.gas.size(); ++k) {
      carbon += constants::avogadro * e.gas[k] * carbonOf[k];
      hydrogen += constants::avogadro * e.gas[k] * hydrogenOf[k];
      oxygen += constants::avogadro * e.gas[k] * oxygenOf[k];
    }
    EXPECT_NEAR(carbon, -e.carbon, 1e-12 * now.first);
    EXPECT_NEAR(hydrogen, -e.hydrogen, 1e-12 * now.first);
    EXPECT_NEAR(oxygen, 0, 1e-12 * now.first);
    population.forEach([&](const MoleculeParticle& p, double) { expectParticle(population.type(), p); });
  }
}

// Without growth particles collide as those of the population balance.
void expectAsBalance(const MoleculeOptions& options, const auto& other) {
  const double start = 1e18, until = 2e-4;
  const MoleculeGas gas;
  std::vector<double> number[2], squared[2];
  for (int r = 0; r < 30; ++r) {
    MoleculeOptions o = options;
    o.owner = static_cast<std::uint64_t>(r);
    MoleculePopulation population(o);
    // Large enough to collide as spheres.
    population.fill(std::vector(o.particles, population.ofGas(30)), start);
    population.advance(gas.state, until);
    const MoleculeTotals t = population.totals();
    number[0].push_back(t.number);
    squared[0].push_back(t.massSquared / (o.density * o.density));
    PopulationModel model;
    model.coagulation = o.kernel;
    model.coagulation->gas = gas.state;
    InitialPopulation initial;
    initial.distribution = InitialPopulation::Distribution::monodisperse;
    initial.number = start;
    initial.volume = population.type().volume(population.ofGas(30));
    MonteCarloOptions monteCarlo;
    monteCarlo.particles = o.particles;
    monteCarlo.repeat = o.owner;
    const auto solver = makeMonteCarlo(other, model, initial, monteCarlo);
    solver->advance(until);
    number[1].push_back(solver->moments()[0]);
    squared[1].push_back(solver->moments()[2]);
  }
  for (const auto& both : {number, squared}) {
    const Sample a = summarise(both[0]), b = summarise(both[1]);
    EXPECT_LT(std::abs(a.mean - b.mean) / std::hypot(a.standardError, b.standardError), zLimit)
        << a.mean << " " << b.mean;
  }
  EXPECT_LT(summarise(number[0]).mean, 0.8 * start);
}

TEST(MoleculePopulation, WithoutGrowthCoagulatesAsThePopulationBalance) {
  MoleculeOptions o = inert(singlePyrene());
  o.coagulation = true;
  o.spheres = true;
  expectAsBalance(o, Sphere(o.density));
  o.spheres = false;
  const double volume = MoleculePopulation(o).type().volume(MoleculePopulation(o).ofGas(30));
  expectAsBalance(o, FractalAggregate(o.density, sphereDiameter(volume), 1.8));
}

// Rates of a gas that stays as it is, with an efficiency each.
TEST(MoleculePopulation, InceptionAndCondensationAreByCollisions) {
  MoleculeOptions o = inert(singlePyrene());
  o.inception = Inception::pairs;
  o.inceptionEfficiency = 0.5;
  o.condensationEfficiency = 0.25;
  const MoleculeGas gas(1e-5);
  const double t = 2e-6;
  CollisionKernelOptions kernel = o.kernel;
  kernel.gas = gas.state;
  const CollisionKernel rate(kernel);
  MoleculePopulation population(o);
  const auto properties = [&](const MoleculeParticle& p) {
    return CollisionKernel::Properties{population.type().volume(p), population.type().mass(p), p.collision};
  };
  const MoleculeParticle one = population.ofGas(1), large = population.ofGas(400);
  population.fill(std::vector(o.particles, large), 1e18);
  population.advance(gas.state, t);
  const MoleculeExchange e = population.takeExchange();
  const double births = 0.25 * gas.number() * gas.number() * rate.value(properties(one), properties(one)) * t;
  const double uptake = 0.25 * gas.number() * rate.value(properties(large), properties(one)) * t;
  EXPECT_NEAR(e.inceptions, births, 2 * population.weight());
  // Of 500 particles; those that are born take up less.
  EXPECT_NEAR(e.condensations / 1e18, uptake, 3.3 * std::sqrt(uptake / 500) + 0.01 * uptake);
  EXPECT_GT(e.condensations, 0.1 * 1e18 * uptake);
  EXPECT_NEAR(e.gas.back() * constants::avogadro, -2 * e.inceptions - e.condensations, 1e-9 * e.condensations);
  o.condensationEfficiency = 0;
  MoleculePopulation without(o);
  without.advance(gas.state, t);
  EXPECT_EQ(without.takeExchange().condensations, 0);
}

TEST(MoleculePopulation, HasAsManySingleMoleculesAsTheGas) {
  MoleculeOptions o = inert(singlePyrene());
  o.inception = Inception::asInGas;
  o.atStart = 0;
  o.fullAt = 1e20;
  MoleculePopulation population(o);
  for (const double fraction : {5e-7, 2e-6, 1e-6, 5e-5}) {
    const MoleculeGas gas(fraction);
    population.advance(gas.state, 1e-6);
    EXPECT_NEAR(population.totals().single, gas.number(), 1.01 * population.weight());
    if (fraction > 2e-6) continue;
    const MoleculeExchange e = population.takeExchange();
    EXPECT_NEAR(-constants::avogadro * e.gas.back(), e.came - e.went, 1e-9 * gas.number());
    EXPECT_EQ(fraction == 1e-6, e.went > 0);
  }
  EXPECT_GT(population.counters().removals, 0u);  // it was full
}

// A rate that rises from 0.1 to 0.3 us and falls until 0.5 us, with steps that do not end there.
TEST(MoleculePopulation, EachMoleculeThatIsFormedIsAParticle) {
  MoleculeOptions o = inert(singlePyrene());
  o.inception = Inception::byFormation;
  o.atStart = 0;
  o.fullAt = 1e16;
  o.formation = {.source = NucleationOptions::Source::table, .times = {1e-7, 3e-7, 5e-7}, .rates = {0, 4e22, 0}};
  MoleculePopulation population(o);
  const MoleculeGas gas(1e-5);
  for (const auto& [dt, formed] : {std::pair{0.2e-6, 1e15}, {0.05e-6, 2.25e15}, {0.15e-6, 7e15}, {1e-6, 8e15}}) {
    population.advance(gas.state, dt);
    const MoleculeTotals totals = population.totals();
    EXPECT_NEAR(totals.number, formed, 1.01 * population.weight());
    EXPECT_DOUBLE_EQ(totals.single, totals.number);
  }
  const MoleculeExchange e = population.takeExchange();
  EXPECT_NEAR(e.inceptions, 8e15, 1.01 * population.weight());
  EXPECT_NEAR(e.gas.back() * constants::avogadro, -e.inceptions, 1e-9 * e.inceptions);
  EXPECT_EQ(e.condensations, 0);
  EXPECT_GT(population.counters().splitSteps, 12u);  // 400 are born, one in twenty of 500 a step
}

TEST(MoleculePopulation, SinteredPrimariesBecomeOne) {
  MoleculeOptions o = inert(singlePyrene());
  o.coagulation = true;
  o.sintering = {SinteringMechanism::constant, 3e-6, 0, 0};
  o.atStart = 1e20;
  MoleculePopulation population(o);
  const MoleculeGas gas;
  population.advance(gas.state, 3e-5);
  EXPECT_GT(population.fused(), 20u);
  EXPECT_GT(population.totals().primaries, 1.02 * population.totals().number);
  population.forEach([&](const MoleculeParticle& p, double) { expectParticle(population.type(), p); });
}

MoleculeOptions everything() {
  MoleculeOptions o = singlePyrene();
  o.inception = Inception::pairs;
  o.coagulation = true;
  o.particles = 100;
  o.fullAt = 1e18;
  o.atStart = 1e18;
  o.growthFactor = 0.3;
  o.sintering = {SinteringMechanism::constant, 1e-5, 0, 0};
  return o;
}

TEST(MoleculePopulation, GoesOnFromItsStateToTheLastBit) {
  MoleculePopulation population(everything());
  const MoleculeGas gas(1e-6);
  population.advance(gas.state, 1e-5);
  const auto state = population.save();
  population.advance(gas.state, 1e-5);
  const std::vector<double> once = population.pack();
  population.restore(state);
  population.advance(gas.state, 1e-5);
  EXPECT_EQ(population.pack(), once);
  // Wherever a packed one is advanced, the same comes of it.
  MoleculePopulation here(everything()), there(everything());
  there.advance(gas.state, 3e-5);
  for (MoleculePopulation* one : {&here, &there}) {
    one->unpack(once);
    EXPECT_EQ(one->pack(), once);
    one->advance(gas.state, 1e-5);
  }
  EXPECT_EQ(here.pack(), there.pack());
  MoleculeOptions others = everything();
  others.particles = 101;
  EXPECT_THROW(MoleculePopulation(others).unpack(once), InputError);
}

TEST(MoleculePopulation, SaysWhatIsMissing) {
  const auto refuses = [](auto change) {
    MoleculeOptions o = singlePyrene();
    change(o);
    EXPECT_THROW(MoleculePopulation{o}, InputError);
  };
  refuses([](MoleculeOptions& o) { o.growthFactor = 1.1; });
  refuses([](MoleculeOptions& o) { o.rings.clear(); });
  refuses([](MoleculeOptions& o) { o.particles = 7; });
  refuses([](MoleculeOptions& o) { o.splitTolerance = 0; });
  refuses([](MoleculeOptions& o) { o.inceptionEfficiency = -0.1; });
  refuses([](MoleculeOptions& o) { o.sticking.rule = MoleculeSticking::Rule::bySize; });
}

}  // namespace
}  // namespace lampblack::test
