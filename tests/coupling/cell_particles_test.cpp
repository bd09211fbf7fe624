// Trees of primaries in the cells of a flow: silicon and heat of gas and particles together, ranks and work sharing do
// not show, and a restart goes on to the same bits.
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/state_backup.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "particles/models/element_enthalpies.hpp"
#include "particles/molecules/molecule_population.hpp"
#include "particles/trees/tree_ensemble.hpp"
#include "particles/trees/tree_population.hpp"
#include "tests/coupling/cell_vessel.hpp"
#include "tests/effort.hpp"

namespace lampblack::test {
namespace {

Gas& teos() {
  static Gas gas("methane_teos_29.yaml");
  return gas;
}

std::shared_ptr<CellParticles> inCellsOf(const Mechanism& mechanism, const TreeOptions& options) {
  return std::make_shared<CellParticles>(mechanism, std::make_shared<TreeEnsemble>(mechanism, options));
}

TreeOptions trees() {
  TreeOptions o;
  o.material = silica();
  o.material.sintering.critical = 0.6e-9;  // so that there are aggregates
  o.particles = 60;
  o.seed = 5;
  o.fullAt = 1e12;
  o.splitTolerance = 0.2;
  return o;
}

EnsembleOperator::Options inCells(double average) {
  EnsembleOperator::Options o;
  o.seed = 5;
  o.average = average;
  return o;
}

// Nitrogen with silicic acid, hotter and richer on one side.
struct Silica : CellVessel {
  explicit Silica(const EnsembleOperator::Options& o, MPI_Comm comm = MPI_COMM_WORLD, const TreeOptions& kind = trees())
      : CellVessel(
            teos(),
            [](const Vector3& x) {
              const double part = x[0] / 0.004;
              return Box::Local{
                  {},
                  1200.0 + 300.0 * part,
                  teos().massFractions(fmt::format("N2: 0.99, H2O: 0.01, H4O4SI: {:.17g}", 1e-5 + 2e-4 * part))};
            },
            inCellsOf(teos().mechanism, kind), o, comm) {
    // What came and went with numerical particles.
    ensembles.watchAmounts([this](std::span<const double> came, std::span<const double> gone) {
      for (std::size_t e = 0; e < particles->elements().size(); ++e) {
        resampled[e] += came[particles->amounts().element(e)];
        EXPECT_EQ(gone[particles->amounts().element(e)], 0.0);
      }
    });
  }
  [[nodiscard]] std::size_t elementAt(const std::string& name) const {
    const auto& all = particles->elements();
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin());
  }
  [[nodiscard]] double amount(std::size_t place) const {
    return integral(box.mesh, [&](int c) { return state.carried[at(c) * state.scalars.size() + place]; });
  }
  std::array<double, 3> resampled{};
};

class TreesInCells : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Averages, TreesInCells, testing::Values(0.0, 1e-4));

TEST_P(TreesInCells, KeepSiliconOxygenAndHydrogenOfGasAndParticles) {
  Silica v(inCells(GetParam()));
  std::vector<double> before;
  for (const std::string& name : v.particles->elements()) before.push_back(v.contentOf(name));
  for (int s = 0; s < 12; ++s) v.step();
  for (std::size_t e = 0; e < before.size(); ++e) {
    const double came = sumOverRanks(v.resampled[e]);
    EXPECT_NEAR((v.contentOf(v.particles->elements()[e]) - came) / before[e], 1.0, 1e-12) << e;
  }
  const std::size_t silicon = v.elementAt("Si");
  EXPECT_GT(v.amount(v.particles->amounts().element(silicon)), 0.05 * before[silicon]) << "silica has formed";
  EXPECT_GT(v.amount(v.particles->amounts().primaries()), 1.05 * v.amount(AmountPlaces::number)) << "and aggregates";
  EXPECT_NE(sumOverRanks(v.resampled[silicon]), 0.0);
}

// What a cell says of its trees: their number, surface and diameters, as their rows have them.
TEST(TreesInCells, AddUpToTheAmountsOfTheirCell) {
  Silica v(inCells(0.0));
  for (int s = 0; s < 8; ++s) v.step();
  const AmountPlaces places = v.particles->amounts();
  double trees = 0.0;
  for (int c = 0; c < v.box.mesh.owned; ++c) {
    double number = 0.0, surface = 0.0, diameters = 0.0;
    v.particles->rows().forEach(v.particles->rows().of(v.ensembles.populations()[at(c)]), [&](const double* row) {
      const GivenParticle p = particleAt(row);
      const double volume = p.carbon / silica().density;
      const double primary = std::cbrt(6.0 / constants::pi * volume / p.primaries);
      number += p.number;
      surface += p.number * p.primaries * constants::pi * primary * primary;
      diameters += p.number * primary * SootAggregate::mobilityFactor(p.primaries);
    });
    const double* amount = &v.state.carried[at(c) * v.state.scalars.size()];
    EXPECT_NEAR(amount[AmountPlaces::number], number, 1e-12 * number) << c;
    EXPECT_NEAR(amount[places.surface()], surface, 1e-9 * surface) << c;
    EXPECT_NEAR(amount[places.diameters()], diameters, 1e-9 * diameters) << c;
    trees += number;
  }
  EXPECT_GT(sumOverRanks(trees), 0.0);
}

// The gas gets the heat that its atoms had where they go: in a still vessel, of one gas each cell.
TEST(TreesInCells, KeepTheEnthalpyOfGasAndParticles) {
  EnsembleOperator::Options o = inCells(0.0);
  o.diffusion = false;
  Silica v(o);
  const auto enthalpy = [&](int c) { return v.state.density[at(c)] * v.state.enthalpy[at(c)]; };
  std::vector<double> gas, gained(at(v.box.mesh.owned)), T(v.state.temperature);
  for (int c = 0; c < v.box.mesh.owned; ++c) gas.push_back(enthalpy(c));
  const std::vector<double> Y = v.state.Y, density = v.state.density;
  v.step(false);
  const std::size_t acid = teos().mechanism.speciesIndex("H4O4SI"), water = teos().mechanism.speciesIndex("H2O");
  const std::size_t n = teos().mechanism.numSpecies();
  const auto W = teos().mechanism.molecularWeights();
  const auto of = elementEnthalpies(std::vector<std::string>{"Si", "H"}).value();
  double changed = 0.0;
  for (int c = 0; c < v.box.mesh.owned; ++c) {
    const auto moles = [&](std::size_t k) {
      return (v.state.density[at(c)] * v.state.Y[at(c) * n + k] - density[at(c)] * Y[at(c) * n + k]) / W[k];
    };
    // Si of every Si(OH)4 that went, and the hydrogen that did not come back as water.
    const double silicon = -moles(acid), hydrogen = -4.0 * moles(acid) - 2.0 * moles(water);
    const double heat = silicon * 28.085e-3 * of[0](T[at(c)]).first + hydrogen * 1.008e-3 * of[1](T[at(c)]).first;
    changed = std::max(changed, std::abs(heat / gas[at(c)]));
    EXPECT_NEAR(enthalpy(c) + heat, gas[at(c)], 1e-3 * std::abs(heat) + 1e-12 * std::abs(gas[at(c)])) << c;
  }
  EXPECT_GT(maxOverRanks(changed), 1e-6);
}

TEST(TreesInCells, DoNotDependOnRanksNorSharing) {
  EnsembleOperator::Options shared = inCells(0.0), own = shared;
  shared.exchange = own.exchange = EnsembleOperator::Exchange::OneWay;
  own.shareWork = false;
  Silica alone(own, MPI_COMM_SELF), together(shared), apart(own);
  for (Silica* v : {&alone, &together, &apart})
    for (int s = 0; s < 10; ++s) v->step(false);
  const ParticleRows& rows = together.particles->rows();
  double several = 0.0;
  for (int c = 0; c < together.box.mesh.owned; ++c) {
    const int same = alone.box.mesh.findOwned(together.box.mesh.naturalCell[at(c)]);
    const auto& population = alone.ensembles.populations()[at(same)];
    EXPECT_EQ(together.ensembles.populations()[at(c)], population) << c;
    EXPECT_EQ(apart.ensembles.populations()[at(c)], population) << c;
    rows.forEach(rows.of(population),
                 [&](const double* row) { several += particleAt(row).primaries > 1.5 ? 1.0 : 0.0; });
  }
  EXPECT_GT(sumOverRanks(several), 5.0) << "rows of several lengths have travelled";
}

TEST(TreesInCells, GoOnToTheSameBits) {
  Silica v(inCells(1e-4));
  for (int s = 0; s < 5; ++s) v.step();
  StateBackup kept(v.box.mesh.owned, v.box.mesh.faces);
  const double time = v.time;
  kept.save([&](StateArchive& archive) { v.saveOrLoad(archive); });
  for (int s = 0; s < 3; ++s) v.step();
  const auto populations = v.ensembles.populations();
  const std::vector<double> carried = v.state.carried;
  kept.restore([&](StateArchive& archive) { v.saveOrLoad(archive); });
  v.state.updateHalo(v.box.halo);
  v.time = time;
  v.begin();
  for (int s = 0; s < 3; ++s) v.step();
  EXPECT_EQ(v.ensembles.populations(), populations);
  EXPECT_EQ(v.state.carried, carried);
}

// Before they move on, all have sintered to the end of the step, though by this law they might wait for many.
TEST(TreesInCells, AreUpToDateAfterAStep) {
  TreeOptions slow = trees();
  slow.material.sintering = {SinteringMechanism::constant, 10.0, 0, 0};  // s
  Silica v(inCells(0.0), MPI_COMM_WORLD, slow);
  const int steps = fewOrMany(5, 12);
  for (int s = 0; s < steps; ++s) v.step();
  double aggregates = 0.0;
  for (int c = 0; c < v.box.mesh.owned; ++c) {
    const std::vector<double>& population = v.ensembles.populations()[at(c)];
    if (v.particles->rows().isEmpty(population)) continue;
    const auto own = std::make_unique<TreePopulation>(slow);
    own->unpack(population);
    const double now = steps * CellVessel::dt;
    own->forEachTree([&](const Tree& tree, double) {
      if (tree.count() < 2) return;
      EXPECT_NEAR(tree.head().time, now, 1e-9 * now) << c;
      aggregates += 1.0;
    });
  }
  EXPECT_GT(sumOverRanks(aggregates), 100.0);
}

// Soot, whose trees exchange oxygen that they do not hold.
TEST(TreesInCells, OfSootKeepCarbonHydrogenAndOxygen) {
  SootReactions reactions;
  reactions.soot.pah = {{"A2", 10, 8, 2e-3}};
  const Mechanism& mechanism = ethylene().mechanism;
  reactions.soot.carbonWeight = mechanism.atomicWeight(mechanism.elementIndex("C"));
  reactions.soot.hydrogenWeight = mechanism.atomicWeight(mechanism.elementIndex("H"));
  reactions.fragmentation = {true, 1e7};
  TreeOptions o = trees();
  o.material = sootMaterial(reactions);
  CellVessel v(
      ethylene(),
      [](const Vector3& x) {
        return Box::Local{{},
                          1500.0 + 200.0 * x[0] / 0.004,
                          ethylene().massFractions("N2: 0.8, C2H2: 0.08, H2: 0.06, H: 5e-4, OH: 1e-5, H2O: 0.04, CO: "
                                                   "0.02, A2: 2e-4")};
      },
      inCellsOf(mechanism, o), inCells(1e-4));
  const std::vector<std::string>& held = v.particles->elements();
  ASSERT_EQ(held.size(), 2U) << "carbon and hydrogen";
  std::array<double, 2> resampled{};
  v.ensembles.watchAmounts([&](std::span<const double> came, std::span<const double>) {
    for (std::size_t e = 0; e < 2; ++e) resampled[e] += came[v.particles->amounts().element(e)];
  });
  std::vector<double> before;
  for (const std::string& name : {held[0], held[1], std::string("O")}) before.push_back(v.contentOf(name));
  for (int s = 0; s < 8; ++s) v.step();
  for (std::size_t e = 0; e < 2; ++e)
    EXPECT_NEAR((v.contentOf(held[e]) - sumOverRanks(resampled[e])) / before[e], 1.0, 1e-12) << held[e];
  EXPECT_NEAR(v.contentOf("O") / before[2], 1.0, 1e-12);
  for (std::size_t e = 0; e < 2; ++e) {
    const double inParticles = integral(v.box.mesh, [&](int c) {
      return v.state.carried[at(c) * v.state.scalars.size() + v.particles->amounts().element(e)];
    });
    EXPECT_GT(inParticles, 1e-6 * before[e]) << held[e];
  }
  EXPECT_GT(v.particles->population().absorption(1500.0, 1e-6), 0.0);
}

// What moves particles leaves none in part of a population of one weight.
TEST(CellParticles, SayWhereAllStandForAsMany) {
  EXPECT_TRUE(inCellsOf(teos().mechanism, trees())->rows().haveEqualNumbers);
  EXPECT_TRUE(moleculeRows.haveEqualNumbers);
  for (const auto method : {EnsembleMethod::dsmc, EnsembleMethod::sammc, EnsembleMethod::swa, EnsembleMethod::pairs}) {
    EnsembleOptions o;
    o.method = method;
    o.soot.pah = {{"A2", 10, 8, 2e-3}};
    EXPECT_EQ(SootEnsemble(ethylene().mechanism, o).rows().haveEqualNumbers, method == EnsembleMethod::dsmc);
  }
}

TEST(TreesInCells, AreRefusedWhereTheirHeatIsNotKnown) {
  TreeOptions o = trees();
  o.material.name = "snow";
  o.material.components = {{"N", 14e-3, {{"N", 1}}}, {"hole", 1e-6, {}}};
  SiteReactions& r = o.material.siteReactions();
  r.precursor = r.product = "N2";
  r.nucleus = {4, 0, 0};
  r.growth = {2, 0, 0};
  r.nucleusProducts = r.growthProducts = 0;
  r.site = 0;
  r.bridge = 1;
  try {
    static_cast<void>(inCellsOf(teos().mechanism, o));
    FAIL() << "its heat is not known";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the heat of particles of snow"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lampblack::test
