#include "app/deck/molecules_deck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/deck/particles_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "app/problems/prescribed_gas/prescribed_gas_case.hpp"
#include "app/problems/reactor/reactor_case.hpp"
#include "particles/molecules/molecule_ensemble.hpp"
#include "particles/pah/molecule.hpp"
#include "tests/flow/flame/streams.hpp"
#include "tests/messages.hpp"
#include "tests/scratch.hpp"

namespace lampblack::app {
namespace {

constexpr const char* mechanismOfMolecules = "ethylene_abf2000_101.yaml";

Deck moleculesDeck(const std::string& particles) {
  const std::string text =
      "problem: reactor\nmechanism: m.yaml\nreactor: {type: constant_pressure}\ntime: {end: 1 s}\n"
      "particles:\n  description: molecules\n  pah: [A4]\n" +
      particles;
  return Deck::parse(text, "deck.yaml", {}, reactorSchema());
}

TEST(MoleculesDeck, SaysAllOfTheOptions) {
  const Deck deck = moleculesDeck(R"(
  molecules:
    inception_efficiency: 0.5
    condensation_efficiency: 0.25
    sticks: reduced
    sticking_rings: 2.5
    growth_factor: 0.05
    growth_factor_from: 3
    shape: spheres
    processes: [G6R_AC, O6R_FE3]
    at_start: 1e10 1/cm^3
    rates: {ways_armchair: 1}
  oxidation: false
  density: 1.6 g/cm^3
  kernel: free_molecular
  van_der_waals: 1.5
  number: 99
  split_tolerance: 0.02
  expected_number: 1e19 1/m^3
  repeats: 3
  seed: 7
  classes: {primaries: [2, 5]}
)");
  const auto mechanism = std::make_shared<const Mechanism>(shippedMechanism(mechanismOfMolecules));
  const MoleculeOptions o = readMoleculeOptions(deck, *mechanism);
  EXPECT_EQ(o.precursor, "A4");
  EXPECT_EQ(Molecule(o.rings).carbon(), 16U);
  EXPECT_EQ(o.inception, MoleculeOptions::Inception::pairs);
  EXPECT_EQ(o.inceptionEfficiency, 0.5);
  EXPECT_EQ(o.condensationEfficiency, 0.25);
  EXPECT_EQ(o.sticking.rule, MoleculeSticking::Rule::reduced);
  EXPECT_EQ(o.sticking.rings, 2.5);
  EXPECT_EQ(o.growthFactor, 0.05);
  EXPECT_EQ(o.growthFactorFrom, 3U);
  EXPECT_TRUE(o.spheres);
  EXPECT_EQ(o.rates.waysArmchair, 1);
  for (std::size_t p = 0; p < pahProcessCount; ++p)
    EXPECT_EQ(o.active[p], static_cast<PahProcess>(p) == PahProcess::G6R_AC) << pahProcesses[p].name;
  EXPECT_DOUBLE_EQ(o.atStart, 1e16);
  EXPECT_NEAR(o.density, 1600, 1e-9);
  EXPECT_EQ(o.kernel.type, CollisionKernelType::freeMolecular);
  EXPECT_EQ(o.kernel.enhancement, 1.5);
  EXPECT_EQ(o.particles, 99U);
  EXPECT_EQ(o.splitTolerance, 0.02);
  const PopulationRequest request = readPopulation(deck, mechanism);
  EXPECT_EQ(request.repeats, 3U);
  EXPECT_TRUE(request.hasStart);
  EXPECT_EQ(request.material, "soot");
  EXPECT_THAT(request.elements, testing::ElementsAre("C", "H"));
  ASSERT_EQ(request.classes.size(), 1U);
  const auto population = request.make(5);
  EXPECT_EQ(population->size(), 99U);
  EXPECT_EQ(population->classedBy()[request.classes[0].by].name, "primaries");
  EXPECT_EQ(ownerOf({population->pack()[packedOwnerAt], population->pack()[packedOwnerAt + 1]}), 5U);
}

TEST(MoleculesDeck, TheSpeciesIsFoundByTheMolecule) {
  const auto mechanism = shippedMechanism(mechanismOfMolecules);
  const auto precursor = [&](const std::string& molecule) {
    const std::string text =
        "problem: reactor\nmechanism: m.yaml\nreactor: {type: constant_pressure}\ntime: {end: 1 s}\n"
        "particles: {description: molecules, molecules: {molecule: " +
        molecule + "}}\n";
    return readMoleculeOptions(Deck::parse(text, "deck.yaml", {}, reactorSchema()), mechanism).precursor;
  };
  EXPECT_EQ(precursor("pyrene"), "A4");
  EXPECT_EQ(precursor("naphthalene"), "A2");
  EXPECT_THAT(test::messageOf<InputError>([&] { (void)precursor("coronene"); }),
              testing::HasSubstr("which species of the mechanism is coronene (C24H12)?"));
}

TEST(MoleculesDeck, PrimariesHaveALawOfSinteringAndAFractalDimension) {
  const MoleculeOptions o = readMoleculeOptions(
      moleculesDeck("  fractal_dimension: 1.7\n  sintering: {mechanism: constant, prefactor: 1e-3}\n"),
      shippedMechanism(mechanismOfMolecules));
  EXPECT_EQ(o.fractalDimension, 1.7);
  EXPECT_EQ(o.sintering.mechanism, SinteringMechanism::constant);
}

TEST(MoleculesDeck, HasTheDefaultsOfThePage) {
  const MoleculeOptions o = readMoleculeOptions(moleculesDeck(""), shippedMechanism(mechanismOfMolecules)), page;
  EXPECT_EQ(o.growthFactor, page.growthFactor);
  EXPECT_EQ(o.growthFactorFrom, page.growthFactorFrom);
  EXPECT_EQ(o.density, page.density);
  EXPECT_EQ(o.fractalDimension, page.fractalDimension);
  EXPECT_EQ(o.spheres, page.spheres);
  EXPECT_EQ(o.splitTolerance, page.splitTolerance);
  EXPECT_EQ(o.active, page.active);
  EXPECT_EQ(o.sticking.rule, page.sticking.rule);
  EXPECT_FALSE(o.sintering.active());
}

// Rows in any order, with units.
TEST(MoleculesDeck, TablesOfStickingAndBandGap) {
  const test::ScratchFolder folder;
  (void)folder.file("sticking.csv",
                    "carbon,temperature [K],probability\n20,1000,0.5\n10,2000,0\n10,1000,0.25\n20,2000,0.125\n");
  (void)folder.file("gap.csv", "carbon, band_gap\n10, 4\n50, 1\n");
  const std::string tables = fmt::format(
      "  molecules: {{sticks: by_table, sticking_table: {0}/sticking.csv, "
      "band_gap: {0}/gap.csv}}\n",
      folder.path().string());
  const Mechanism mechanism = shippedMechanism(mechanismOfMolecules);
  const MoleculeOptions o = readMoleculeOptions(moleculesDeck(tables), mechanism);
  EXPECT_THAT(o.sticking.temperatures, testing::ElementsAre(1000, 2000));
  EXPECT_THAT(o.sticking.carbons, testing::ElementsAre(10, 20));
  EXPECT_THAT(o.sticking.probabilities, testing::ElementsAre(0.25, 0.5, 0, 0.125));
  EXPECT_DOUBLE_EQ(o.bandGap(30), 2.5);
  (void)folder.file("sticking.csv", "carbon,temperature [K],probability\n20,1000,0.5\n10,2000,0\n10,1000,0.25\n");
  EXPECT_THAT(test::messageOf<InputError>([&] { (void)readMoleculeOptions(moleculesDeck(tables), mechanism); }),
              testing::HasSubstr("found 3"));
}

TEST(MoleculesDeck, FormationIsATableOverTime) {
  const test::ScratchFolder folder;
  const std::string table = folder.file("formed.csv", "time [ms], formation [mol/cm^3/s]\n0, -1e-9\n2, 3e-9\n");
  const std::string text =
      "problem: prescribed_gas\nmechanism: m.yaml\ngas: {file: gas.csv, exchange: one_way}\n"
      "particles: {description: molecules, pah: [A4], molecules: {inception: by_formation, formation: " +
      table + "}}\n";
  const MoleculeOptions o = readMoleculeOptions(Deck::parse(text, "deck.yaml", {}, prescribedGasSchema()),
                                                shippedMechanism(mechanismOfMolecules));
  EXPECT_EQ(o.inception, MoleculeOptions::Inception::byFormation);
  EXPECT_THAT(o.formation.times, testing::ElementsAre(0, testing::DoubleNear(0.5e-3, 1e-15), 2e-3));
  ASSERT_EQ(o.formation.rates.size(), 3U);
  EXPECT_EQ(o.formation.rates[0], 0);
  EXPECT_EQ(o.formation.rates[1], 0);
  EXPECT_NEAR(o.formation.rates[2] / (3e-3 * constants::avogadro), 1, 1e-12);
}

TEST(MoleculesDeck, MistakesAreTold) {
  const auto mechanism = std::make_shared<const Mechanism>(shippedMechanism(mechanismOfMolecules));
  const auto message = [&](const std::string& particles) {
    return test::messageOf<InputError>([&] { (void)readPopulation(moleculesDeck(particles), mechanism); });
  };
  EXPECT_THAT(message("  molecules: {inception: as_in_gas}\n"), testing::HasSubstr("prescribed_gas"));
  EXPECT_THAT(message("  molecules: {inception: by_formation}\n"), testing::HasSubstr("prescribed_gas"));
  EXPECT_THAT(message("  molecules: {sticks: by_table}\n"), testing::HasSubstr("sticking_table"));
  EXPECT_THAT(message("  dimer_equilibrium: [1, 0, -10]\n"), testing::HasSubstr("leave it out"));
  EXPECT_THAT(message("  molecules: {molecule: coronene}\n"), testing::HasSubstr("the molecule it is taken for"));
  EXPECT_THAT(message("  oh_efficiency: 0.1\n"), testing::HasSubstr("leave it out"));
  EXPECT_THAT(message("  surface: {bounded: true}\n"), testing::HasSubstr("has no meaning"));
  EXPECT_THAT(message("  molecules: {processes: [G7R]}\n"), testing::HasSubstr("G6R_AC"));
  EXPECT_THAT(message("  sintering: {tolerance: 1e-2}\n"), testing::HasSubstr("nothing sinters without 'mechanism'"));
  for (const char* ofPrimaries :
       {"  fractal_dimension: 1.7\n", "  sintering: {mechanism: constant, prefactor: 1e-3}\n"})
    EXPECT_THAT(message(std::string("  molecules: {shape: spheres}\n") + ofPrimaries),
                testing::HasSubstr("have one primary"));
  EXPECT_THAT(message("  molecules: {sticks: by_size, sticking_constants: [1, 0, 1]}\n"),
              testing::HasSubstr("B above zero"));
}

}  // namespace
}  // namespace lampblack::app
