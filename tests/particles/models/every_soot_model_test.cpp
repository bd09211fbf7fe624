// What holds for every soot model, with its published constants.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "soot_model_checks.hpp"
#include "tests/particles/models/published_models.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

std::unique_ptr<SootModel> published(const std::string& name) {
  return test::publishedModel(name, test::threePah());
}

class EverySootModel : public testing::TestWithParam<std::string> {};

// Sums of up to 70 rounded terms in the models of many scalars.
TEST_P(EverySootModel, ConservesCarbonHydrogenAndOxygenToRoundOff) {
  const auto model = published(GetParam());
  test::expectConserved(*model, 100, 1e-15 * std::max<double>(10, static_cast<double>(model->scalars().size())));
}

TEST_P(EverySootModel, ExchangesWhatItsProcessesSay) {
  const auto model = published(GetParam());
  test::RandomStates states(200);
  std::vector<double> rates(model->scalars().size()), exchange(model->gasSpecies().size());
  for (int i = 0; i < 20; ++i) {
    test::ModelState s = states.next(*model);
    s.connect();
    model->sources(s.gas, s.densities, rates, exchange);
    double mass = 0;
    for (std::size_t k = 0; k < rates.size(); ++k)
      mass += rates[k] * (model->scalars()[k].massOf("C") + model->scalars()[k].massOf("H"));
    const ParticleProcesses p = model->processes(s.gas, s.densities);
    const double parts[] = {p.nucleation, p.condensation, p.growth, p.oxidationO2, p.oxidationOH, p.carbonisation};
    double sum = 0, moved = 0;
    for (double part : parts) {
      sum += part;
      moved += std::abs(part);
    }
    EXPECT_NEAR(mass, sum, 1e-12 * moved) << i;
  }
}

// Models that see soot as spheres: Stokes, Einstein and Cunningham for the mobility diameter (Wang 2025, eqs. 7-30 to
// 7-33).
TEST_P(EverySootModel, SpheresDiffuseByTheirMobility) {
  if (GetParam() == "sectional" || GetParam() == "hmom") GTEST_SKIP() << "several sizes diffuse, each by its own";
  const auto model = published(GetParam());
  test::RandomStates states(400);
  std::vector<double> D(model->scalars().size());
  for (int i = 0; i < 20; ++i) {
    test::ModelState s = states.next(*model);
    s.connect();
    model->diffusivities(s.gas, s.densities, D);
    const double d = model->properties(s.gas, s.densities).mobilityDiameter, T = s.gas.temperature;
    const double path = s.gas.viscosity / s.gas.pressure *
                        std::sqrt(constants::pi * constants::gasConstant * T / (2 * s.gas.meanMolecularWeight));
    const double knudsen = 2 * path / d, slip = 1 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
    const double expected = constants::boltzmann * T * slip / (3 * constants::pi * s.gas.viscosity * d);
    for (const double value : D) EXPECT_NEAR(value / expected, 1, 1e-12) << i;
  }
}

TEST_P(EverySootModel, BeginsWithSpheresOfGivenNumberAndVolume) {
  const auto model = published(GetParam());
  test::RandomStates states(600);
  test::ModelState s = states.next(*model);
  s.connect();
  std::fill(s.densities.begin(), s.densities.end(), 0.0);
  double number = 0, volume = 0, surface = 0;
  for (const auto& [much, diameter] : {std::pair{3e15, 12e-9}, std::pair{2e14, 47e-9}, std::pair{1e15, 20.5e-9}}) {
    const double one = constants::pi / 6 * std::pow(diameter, 3);
    model->addSpheres(much, one, s.densities);
    number += much;
    volume += much * one;
    surface += much * constants::pi * diameter * diameter;
  }
  const ParticleProperties found = model->properties(s.gas, s.densities);
  EXPECT_NEAR(found.numberDensity / number, 1, 1e-12);
  EXPECT_NEAR(found.volumeFraction / volume, 1, 1e-12);
  EXPECT_NEAR(found.primariesPerAggregate, 1, 1e-9);
  // Sections of fixed sizes, and the moments between those that are carried, have the surface of all; HMOM carries it,
  // and like other models of one size shows no less than that of equal spheres.
  const double equal = std::cbrt(36 * constants::pi * number * volume * volume);
  const bool hasSizes = GetParam() == "sectional" || GetParam() == "momic";
  EXPECT_NEAR(found.surfaceArea / (hasSizes ? surface : equal), 1, hasSizes ? 0.03 : 1e-9);
  if (GetParam() == "hmom") {
    EXPECT_NEAR(s.densities[HmomSoot::surface] / surface, 1, 1e-12);
  }
  if (GetParam() == "momic") {
    const double unit = dynamic_cast<const MomicSoot&>(*model).massUnit() / s.densities[MomicSoot::carbon] * volume;
    const double second = 3e15 * std::pow(12e-9, 6) + 2e14 * std::pow(47e-9, 6) + 1e15 * std::pow(20.5e-9, 6);
    EXPECT_NEAR(s.densities[MomicSoot::higher] * std::pow(6 / constants::pi * unit, 2) / second, 1, 1e-12);
  }
}

TEST_P(EverySootModel, DensitiesOfGasAloneMakeSootOnlyByNucleation) {
  const auto model = published(GetParam());
  test::RandomStates states(300);
  test::ModelState s = states.next(*model);
  s.connect();
  s.gas.temperature = 1600;
  std::fill(s.densities.begin(), s.densities.end(), 0.0);
  const ParticleProcesses p = model->processes(s.gas, s.densities);
  EXPECT_GT(p.nucleation, 0);
  EXPECT_GT(p.nucleationNumber, 0);
  for (double other : {p.condensation, p.growth, p.oxidationO2, p.oxidationOH, p.coagulationNumber})
    EXPECT_EQ(other, 0);
  EXPECT_EQ(model->volumeFraction(s.densities), 0);
}

// Where a solver has left a trace of mass and no particles to speak of, there is no size to tell: a two-equation
// model's ratio of them would be some 10 um, the largest that counts.
TEST_P(EverySootModel, ResultsHaveNoSizesOfTraces) {
  const auto model = published(GetParam());
  test::RandomStates states(600);
  test::ModelState s = states.next(*model);
  for (std::size_t k = 0; k < s.densities.size(); ++k) s.densities[k] = model->scalars()[k].scale;
  s.connect();
  const auto sizes = {&ParticleProperties::meanDiameter, &ParticleProperties::primaryDiameter,
                      &ParticleProperties::mobilityDiameter, &ParticleProperties::gyrationDiameter,
                      &ParticleProperties::primariesPerAggregate};
  const ParticleProperties as = model->properties(s.gas, s.densities),
                           results = model->propertiesForResults(s.gas, s.densities);
  for (const auto size : sizes) EXPECT_EQ(results.*size, as.*size);
  EXPECT_GT(results.meanDiameter, 0);
  for (double& density : s.densities) density *= 5e5 / as.numberDensity;
  const ParticleProperties trace = model->propertiesForResults(s.gas, s.densities);
  ASSERT_FALSE(model->isNegligible(s.densities));
  EXPECT_GT(trace.volumeFraction, 0);
  EXPECT_NEAR(trace.numberDensity / 5e5, 1, 1e-9);
  for (const auto size : sizes) EXPECT_EQ(trace.*size, 0);
  std::fill(s.densities.begin(), s.densities.end(), 0.0);
  EXPECT_EQ(model->propertiesForResults(s.gas, s.densities).volumeFraction, 0);
}

// Tables of distributions have a row for every place, with and without soot.
TEST_P(EverySootModel, SizeDistributionsHaveTheSameDiametersForAllDensities) {
  const auto model = published(GetParam());
  test::RandomStates states(500);
  const test::ModelState s = states.next(*model);
  const std::vector<double> none(s.densities.size(), 0.0);
  const SizeDistribution some = model->sizeDistribution(s.densities), empty = model->sizeDistribution(none);
  EXPECT_EQ(some.diameter, empty.diameter);
  EXPECT_EQ(some.density.size(), some.diameter.size());
  EXPECT_EQ(empty.density, std::vector<double>(some.diameter.size(), 0.0));
}

// A population beside one that transport has taken the last of its mass from, as it does, has the rates of that: a jump
// would be a derivative without bounds.
TEST(EqualSpheres, RatesDoNotJumpWhereTheLastMassGoes) {
  for (const std::string name : {"two_equation_dimer", "leung", "moss_brookes"}) {
    const auto model = published(name);
    std::vector<double> none(model->scalars().size()), trace(none), exchange(model->gasSpecies().size());
    test::RandomStates states(500);
    bool burns = false;
    for (int i = 0; i < 20; ++i) {
      test::ModelState s = states.next(*model);
      s.connect();
      std::fill(s.densities.begin() + 1, s.densities.end(), 0.0);
      for (const double mass : {0.0, -1e-12}) {
        s.densities[1] = mass;
        model->sources(s.gas, s.densities, none, exchange);
        s.densities[1] = 1e-45;
        model->sources(s.gas, s.densities, trace, exchange);
        for (std::size_t k = 0; k < none.size(); ++k)
          EXPECT_NEAR(none[k], trace[k], 1e-9 * std::abs(trace[k]) + 1e-30) << name << i << " " << k;
      }
      burns = burns || model->processes(s.gas, s.densities).oxidationNumber < -1e-3 * s.densities[0];
    }
    EXPECT_TRUE(burns) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Published, EverySootModel, testing::ValuesIn(test::publishedModels),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace lampblack::particles
