// Particles of molecules as a kind of stochastic population.
#include "particles/molecules/molecule_ensemble.hpp"

#include <gtest/gtest.h>

#include "tests/flow/flame/streams.hpp"
#include "tests/particles/molecules/molecules_fixtures.hpp"

namespace lampblack::test {
namespace {

const Mechanism& ofMolecules() {
  static const Mechanism mechanism = shippedMechanism("ethylene_abf2000_101.yaml");
  return mechanism;
}

MoleculeOptions lively() {
  MoleculeOptions o = singlePyrene();
  o.inception = MoleculeOptions::Inception::pairs;
  o.coagulation = true;
  o.particles = 200;
  o.fullAt = 1e21;
  o.atStart = 0;
  return o;
}

TEST(MoleculeEnsemble, ExchangesTheAtomsItGains) {
  const Mechanism& mechanism = ofMolecules();
  MoleculeEnsemble ensemble(mechanism, lively());
  const MoleculeGas gas(1e-4, 1700, 0.01, 0.02);
  ensemble.unpack(ensemble.pack());
  ensemble.advance(gas.state, 1e-6);
  const auto exchange = ensemble.takeExchange();
  ASSERT_EQ(exchange.gas.size(), ensemble.species().size());
  double scale = 0;
  for (const double kg : exchange.elements) scale += std::abs(kg);
  EXPECT_GT(scale, 0);
  for (std::size_t e = 0; e < mechanism.numElements(); ++e) {
    double gained = 0;
    for (std::size_t k = 0; k < exchange.gas.size(); ++k)
      gained += exchange.gas[k] * mechanism.atoms(ensemble.species()[k], e) * mechanism.atomicWeight(e);
    for (std::size_t i = 0; i < ensemble.elements().size(); ++i)
      if (ensemble.elements()[i] == mechanism.elementName(e)) gained += exchange.elements[i];
    EXPECT_NEAR(gained, 0, 1e-12 * scale) << mechanism.elementName(e);
  }
  for (const double kg : ensemble.resampled()) EXPECT_NEAR(kg, 0, 1e-12 * scale);
  EXPECT_EQ(ensemble.processes().size(), ensemble.amountsOfProcesses().size());
}

// By a table over carbon atoms: pyrene has 16.
TEST(MoleculeEnsemble, SaysTheBandGapOfTheLargestMolecule) {
  MoleculeOptions o = inert(singlePyrene());
  o.bandGapCarbons = {10, 20, 30};
  o.bandGaps = {4, 2, 1.5};
  MoleculeEnsemble ensemble(ofMolecules(), o);
  const auto columns = ensemble.columns();
  const std::vector<double> values = ensemble.values(MoleculeGas().state);
  ASSERT_EQ(columns.size(), values.size());
  EXPECT_EQ(columns.back().name, "soot_band_gap");
  EXPECT_NEAR(values.back(), 2.8, 1e-12);
  const auto functionals = ensemble.functionals();
  ensemble.forEachRow(
      [&](const double* row) { EXPECT_NEAR(ensemble.functional(functionals.size() - 1, row), 2.8, 1e-12); });
  const auto& type = ensemble.molecules().type();
  const auto coronene = std::make_shared<const Molecule>(namedMolecule("coronene"));
  const auto pyrene = std::make_shared<const Molecule>(namedMolecule("pyrene"));
  ensemble.molecules().fill({type.made({pyrene, coronene}), type.made({pyrene})}, 2e18);
  EXPECT_NEAR(ensemble.values(MoleculeGas().state).back(), 0.5 * (1.8 + 2.8), 1e-12);
}

TEST(MoleculeEnsemble, SaysOfRowsWhatItHolds) {
  MoleculeEnsemble ensemble(ofMolecules(), lively());
  const MoleculeGas gas(1e-4);
  ensemble.advance(gas.state, 1e-6);
  (void)ensemble.takeExchange();
  const MoleculeTotals totals = ensemble.molecules().totals();
  const AmountsOfParticles at{2};
  std::vector<double> amounts(4 + at.held);
  double molecules = 0, rings = 0;
  const std::size_t moleculesAt = ensemble.functionals().size() - 2;
  EXPECT_EQ(ensemble.functionals()[moleculesAt].name, "molecules");
  ensemble.forEachRow([&](const double* row) {
    ensemble.addAmounts(row, row[packedNumberAt], amounts);
    molecules += row[packedNumberAt] * ensemble.functional(moleculesAt, row);
    rings += row[packedNumberAt] * ensemble.functional(moleculesAt, row) * ensemble.functional(moleculesAt + 1, row);
    EXPECT_GT(ensemble.functional(0, row), 0);
  });
  EXPECT_GT(totals.number, 0);
  EXPECT_NEAR(amounts[AmountsOfParticles::number] / totals.number, 1, 1e-12);
  EXPECT_NEAR((amounts[at.element(0)] + amounts[at.element(1)]) / totals.mass, 1, 1e-12);
  EXPECT_NEAR(amounts[at.primaries()] / totals.primaries, 1, 1e-12);
  EXPECT_NEAR(amounts[at.surface()] / totals.surface, 1, 1e-12);
  EXPECT_NEAR(molecules / totals.molecules, 1, 1e-12);
  EXPECT_NEAR(rings / totals.rings, 1, 1e-12);
  const auto columns = ensemble.columns();
  const std::vector<double> values = ensemble.values(gas.state);
  ASSERT_EQ(columns.size(), values.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k].name == "soot_molecules") {
      EXPECT_DOUBLE_EQ(values[k], totals.molecules / totals.number);
    }
  const auto tables = ensemble.tables();
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(std::get<0>(tables[0].columns[0].values).size(), ensemble.size());
  double widths = 0;
  const SizeBins bins;
  for (const double density : ensemble.primarySizes(bins)) widths += density * bins.width();
  EXPECT_NEAR(widths / totals.primaries, 1, 1e-12);
}

// What leaves one population comes to another.
TEST(MoleculeEnsemble, JoinsParticlesOfAnother) {
  MoleculeEnsemble one(ofMolecules(), lively()), other(ofMolecules(), lively());
  const MoleculeGas gas(1e-4);
  one.advance(gas.state, 1e-6);
  other.advance(gas.state, 5e-7);
  const double before = other.molecules().totals().carbon, comes = one.molecules().totals().carbon;
  other.unpack(other.pack());
  other.join(one.content(), 1);
  EXPECT_NEAR(other.molecules().totals().carbon / (before + comes), 1, 1e-9);
  for (const double kg : other.resampled()) EXPECT_NEAR(kg, 0, 1e-9 * other.molecules().totals().mass);
}

TEST(MoleculeEnsemble, NeedsTheMoleculeOfItsSpecies) {
  MoleculeOptions o = lively();
  o.precursor = "A2";
  EXPECT_THROW(MoleculeEnsemble(ofMolecules(), o), InputError);
  o.precursor = "A9";
  EXPECT_THROW(MoleculeEnsemble(ofMolecules(), o), InputError);
}

}  // namespace
}  // namespace lampblack::test
