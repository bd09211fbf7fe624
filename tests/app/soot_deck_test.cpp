#include "app/deck/soot_deck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "app/deck/particles_deck.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "coupling/carried_particles.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/models/moments/hmom.hpp"
#include "particles/models/moments/momic_soot.hpp"
#include "particles/models/sectional/sectional_soot.hpp"
#include "particles/models/semi_empirical/semi_empirical_soot.hpp"
#include "particles/models/two_equation/dimer_soot.hpp"
#include "tests/flow/flame/streams.hpp"
#include "tests/messages.hpp"

namespace lampblack::app {
namespace {

Mechanism mechanismOf(const std::string& name) {
  return shippedMechanism(name + ".yaml");
}

const Mechanism& abf() {
  static const Mechanism mechanism = mechanismOf("ethylene_abf2000_101");
  return mechanism;
}

Deck deckOf(const std::string& text) {
  static const DeckSchema schema = [] {
    DeckSchema keys;
    addParticleKeys(keys, {.description = "Particles."});
    return keys;
  }();
  return Deck::parse(text, "deck.yaml", {}, schema);
}

std::string messageOf(const std::string& text, const Mechanism& mechanism = abf()) {
  return test::messageOf<InputError>([&] { const auto model = readSootModel(deckOf(text), mechanism); });
}

const SootModelOptions& optionsOf(const std::unique_ptr<ParticleModel>& model) {
  return dynamic_cast<const DimerSoot&>(*model).twoEquation().options();
}

TEST(SootDeck, WithoutASectionOrWithNoneThereIsNoSoot) {
  EXPECT_EQ(readSootModel(deckOf("{}"), abf()), nullptr);
  EXPECT_EQ(readSootModel(deckOf("particles: {description: none}"), abf()), nullptr);
}

TEST(SootDeck, DefaultsAreThePublishedConstants) {
  const auto model = readSootModel(deckOf("particles: {description: two_equation_dimer, pah: [A2, A3, A4]}"), abf());
  const SootModelOptions& o = optionsOf(model);
  ASSERT_EQ(o.pah.size(), 3U);
  EXPECT_EQ(o.pah[1].carbon, 14);
  EXPECT_EQ(o.pah[1].hydrogen, 10);
  EXPECT_EQ(o.pah[2].stickingCoefficient, 2.5e-2);
  EXPECT_EQ(o.sootDensity, 1850);
  EXPECT_EQ(o.siteDensity, 2.3e19);
  EXPECT_EQ(o.ohEfficiency, 0.13);
  EXPECT_EQ(o.vanDerWaals, 2.2);
  EXPECT_EQ(o.carbonWeight, abf().atomicWeight(abf().elementIndex("C")));
  EXPECT_FALSE(o.alpha || !o.alphaTable.empty());
}

TEST(SootDeck, EverythingCanBeSet) {
  const auto model = readSootModel(
      deckOf("particles: {description: two_equation_dimer, pah: [A2], sticking: [1.0e-3], density: 1.8 g/cm^3, "
             "site_density: 1.0e15 1/cm^2, oh_efficiency: 0.2, van_der_waals: 1.5, "
             "alpha_table: [{temperature: 1500 K, alpha: 0.9}, "
             "{temperature: 1700 K, alpha: 0.1}], growth: false}"),
      abf());
  const SootModelOptions& o = optionsOf(model);
  EXPECT_EQ(o.pah[0].stickingCoefficient, 1e-3);
  EXPECT_NEAR(o.sootDensity, 1800, 1e-9);
  EXPECT_NEAR(o.siteDensity, 1e19, 1e6);
  EXPECT_EQ(o.ohEfficiency, 0.2);
  EXPECT_EQ(o.vanDerWaals, 1.5);
  ASSERT_EQ(o.alphaTable.size(), 2U);
  EXPECT_EQ(o.alphaTable[1].temperature, 1700);
  EXPECT_FALSE(o.surfaceGrowth);
  EXPECT_TRUE(o.oxidation);
}

TEST(SootDeck, EveryModelOfTheListCanBeMade) {
  for (const SootModelEntry& entry : sootModels()) {
    const std::string& name = entry.name;
    const auto model = readSootModel(deckOf("particles: {pah: [A2, A3, A4], description: " + name + "}"), abf());
    ASSERT_NE(model, nullptr) << name;
    const CarriedParticles soot(abf(), readSootModel(deckOf("particles: {description: " + name + "}"), abf()));
    EXPECT_EQ(soot.scalars().size(), soot.model().scalars().size());
  }
}

TEST(SootDeck, SemiEmpiricalConstantsAreThePublishedOnesUntilSet) {
  const auto optionsOfDeck = [](const std::string& text) {
    return dynamic_cast<const SemiEmpiricalSoot&>(*readSootModel(deckOf(text), abf())).options();
  };
  const SemiEmpiricalOptions leung = optionsOfDeck("particles: {description: leung}");
  EXPECT_EQ(leung.coagulation, 9);
  EXPECT_EQ(leung.ohEfficiency, 0);
  EXPECT_EQ(leung.density, 2000);
  EXPECT_TRUE(leung.growthByRootOfSurface);
  EXPECT_EQ(optionsOfDeck("particles: {description: moss_brookes}").ohEfficiency, 0.04);
  const SemiEmpiricalOptions set = optionsOfDeck(
      "particles: {description: moss_brookes, oh_efficiency: 0.1, semi_empirical: {oxygen: lee, inception_factor: 100 "
      "1/s, "
      "inception_temperature: 2.0e4 K, nucleus_carbon: 60, growth_factor: 500, growth_surface: root, "
      "coagulation_factor: 3, oxidation_factor: 0.015}}");
  EXPECT_EQ(set.oxygen, SemiEmpiricalOptions::Oxygen::lee);
  EXPECT_EQ(set.ohEfficiency, 0.1);
  EXPECT_EQ(set.inceptionFactor, 100);
  EXPECT_EQ(set.inceptionTemperature, 2e4);
  EXPECT_EQ(set.nucleusCarbon, 60);
  EXPECT_EQ(set.growthFactor, 500);
  EXPECT_EQ(set.coagulation, 3);
  EXPECT_EQ(set.oxidationFactor, 0.015);
  EXPECT_TRUE(set.growthByRootOfSurface);
}

TEST(SootDeck, MistakesAreNamed) {
  using testing::HasSubstr;
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, pah: [A22]}"), HasSubstr("A22"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, pah: [CO]}"),
              HasSubstr("'CO' is not a hydrocarbon"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, pah: [A2, A3, A2]}"),
              HasSubstr("'A2' is named twice"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, pah: [CH4]}"),
              HasSubstr("'CH4' (C1H4) is not a polycyclic aromatic hydrocarbon"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, pah: [A2, A1]}"),
              HasSubstr("'A1' (C6H6) is not a polycyclic"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, pah: []}"), HasSubstr("no soot is ever formed"));
  EXPECT_THAT(messageOf("particles: {description: hmom, sectional: {sections: 20}}"), HasSubstr("particles.sectional"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, hmom: {fractal_dimension: 1.9}}"),
              HasSubstr("particles.hmom"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, moments: 5}"), HasSubstr("particles.moments"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, semi_empirical: {oxygen: lee}}"),
              HasSubstr("particles.semi_empirical"));
  EXPECT_THAT(messageOf("particles: {description: leung, alpha: 0.5}"),
              HasSubstr("the model leung does not use this key"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, pah: [A2], sticking: [0.1, 0.2]}"),
              HasSubstr("2 coefficients for 1 PAH"));
  EXPECT_THAT(
      messageOf(
          "particles: {description: two_equation_dimer, alpha: 0.5, alpha_table: [{temperature: 1500 K, alpha: 0.9}]}"),
      HasSubstr("either"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, alpha_table: [{temperature: 1500 K, alpha: 1}, "
                        "{temperature: 1400 K, alpha: 0}]}"),
              HasSubstr("rise"));
  EXPECT_THAT(messageOf("particles: {description: two_equation_dimer, pah: []}", mechanismOf("hydrogen_h2o2_10")),
              HasSubstr("carbon"));
}

TEST(CarriedParticles, SpeciesBecomeIndicesAndScalarsElements) {
  CarriedParticles soot(abf(),
                        readSootModel(deckOf("particles: {description: two_equation_dimer, pah: [A2, A4]}"), abf()));
  ASSERT_EQ(soot.exchanged().size(), soot.model().gasSpecies().size());
  for (std::size_t i = 0; i < soot.exchanged().size(); ++i)
    EXPECT_EQ(abf().speciesName(soot.exchanged()[i]), soot.model().gasSpecies()[i]);
  EXPECT_EQ(soot.scalars()[DimerSoot::carbon].elements[abf().elementIndex("C")], 1);
  EXPECT_EQ(soot.scalars()[DimerSoot::number].elements[abf().elementIndex("C")], 0);
  EXPECT_EQ(soot.scalars()[DimerSoot::hydrogen].elements[abf().elementIndex("H")], 1);
  EXPECT_EQ(soot.scalars()[0].thermophoresis, waldmannThermophoresis());
}

TEST(CarriedParticles, ExchangeConservesTheElementsOfTheMechanism) {
  CarriedParticles soot(abf(),
                        readSootModel(deckOf("particles: {description: two_equation_dimer, pah: [A2, A3]}"), abf()));
  const std::size_t n = soot.scalars().size(), m = soot.exchanged().size();
  std::vector<double> concentrations(m), rates(n), exchange(m);
  for (std::size_t i = 0; i < m; ++i) concentrations[i] = 0.01 / static_cast<double>(i + 1);
  const ParticleGas gas{1700, 101325, 0.2, 5e-5, 0.028, concentrations};
  const std::vector<double> densities{1e17, 1e-3, 1e-5};
  soot.sources(gas, densities, rates, exchange);
  for (std::size_t e = 0; e < abf().numElements(); ++e) {
    double sum = 0, moved = 0;
    const auto add = [&](double amount) {
      sum += amount;
      moved += std::abs(amount);
    };
    for (std::size_t i = 0; i < n; ++i) add(rates[i] * soot.scalars()[i].elements[e]);
    for (std::size_t i = 0; i < m; ++i) add(exchange[i] * abf().atoms(soot.exchanged()[i], e) * abf().atomicWeight(e));
    EXPECT_LE(std::abs(sum), 1e-14 * moved) << abf().elementName(e);
  }
  std::vector<double> J((n + m) * (n + m + 1));
  soot.jacobian(gas, densities, {J, n + m + 1});
  EXPECT_THAT(J, testing::Contains(testing::Gt(0.0)));
}

TEST(CarriedParticles, AbsorbsAndHasTheEnthalpyOfGraphiteAndHydrogen) {
  CarriedParticles soot(abf(), readSootModel(deckOf("particles: {description: two_equation_dimer}"), abf()));
  const std::vector<double> densities{1e17, 1.85e-3 - 1e-5, 1e-5};
  EXPECT_NEAR(soot.absorption(1600, densities), 700 * 1e-6 * 1600, 1e-12);
  std::vector<double> h(3), slope(3);
  soot.enthalpies(1200, h, slope);
  EXPECT_EQ(h[0], 0);
  EXPECT_EQ(h[1], sootCarbonEnthalpy(1200).first);
  EXPECT_EQ(slope[2], sootHydrogenEnthalpy(1200).second);
}

TEST(CarriedParticles, DiffusesUnlessToldNotTo) {
  for (const bool diffusion : {true, false}) {
    CarriedParticles soot(abf(), readSootModel(deckOf("particles: {description: two_equation_dimer}"), abf()),
                          diffusion);
    const std::vector<double> concentrations(soot.exchanged().size(), 1e-3), densities{1e17, 1.85e-3 - 1e-5, 1e-5};
    std::vector<double> D(3, -1.0);
    soot.diffusivities({1700, 101325, 0.2, 5e-5, 0.028, concentrations}, densities, D);
    EXPECT_THAT(D, testing::Each(diffusion ? testing::Matcher<double>(testing::Gt(0.0)) : testing::Eq(0.0)));
  }
}

TEST(SootDeck, MomentModels) {
  const auto momic = readSootModel(deckOf("particles: {description: momic, moments: 4}"), abf());
  EXPECT_EQ(dynamic_cast<const MomicSoot&>(*momic).options().moments, 4U);
  EXPECT_EQ(momic->scalars().size(), 5U);
  const auto hmom = readSootModel(deckOf("particles: {description: hmom, alpha: 0.2}"), abf());
  EXPECT_EQ(dynamic_cast<const HmomSoot&>(*hmom).options().soot.alpha, 0.2);
}

}  // namespace
}  // namespace lampblack::app
