#include "particles/population/model/population_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {
namespace {

// Everything on, and nothing wrong.
PopulationModel everything() {
  PopulationModel model;
  model.coagulation.emplace().rate = 1;
  model.nucleation.emplace().rate = 1;
  model.breakage.emplace().rate = 1;
  model.deposition.emplace().rate = 1;
  model.growth.condensation = -1;
  model.growth.surfaceGrowth = 1;
  model.dilution = -1;
  return model;
}

const InitialPopulation someParticles{InitialPopulation::Distribution::lognormal, 10, 1, 1.5};

std::string complaint(const std::function<void(PopulationModel&, InitialPopulation&)>& change) {
  PopulationModel model = everything();
  InitialPopulation initial = someParticles;
  change(model, initial);
  try {
    check(model, initial);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(PopulationModelCheck, AcceptsAModelWithEveryProcess) {
  EXPECT_EQ(complaint([](auto&, auto&) {}), "nothing");
}

TEST(PopulationModelCheck, NamesWhatIsWrong) {
  using testing::HasSubstr;
  using Source = NucleationOptions::Source;
  EXPECT_EQ(complaint([](auto& m, auto&) { m.nucleation->rate = -3; }),
            "nucleation.rate needs to be zero or above, not -3");
  EXPECT_THAT(complaint([](auto& m, auto&) { m.nucleation->volume = 0; }), HasSubstr("nucleation.volume"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.nucleation->source = Source::precursor; }),
              HasSubstr("nucleation.rate_constant"));
  EXPECT_THAT(complaint([](auto& m, auto&) {
                m.nucleation->source = Source::table;
                m.nucleation->times = {0, 2, 1};
                m.nucleation->rates = {1, 1, 1};
              }),
              HasSubstr("increase"));
  EXPECT_THAT(complaint([](auto& m, auto&) {
                m.nucleation->source = Source::table;
                m.nucleation->times = {0, 1};
                m.nucleation->rates = {1, -1};
              }),
              HasSubstr("nucleation.rates"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.breakage->rate = -1; }), HasSubstr("breakage.rate"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.breakage->fragments = 1; }), HasSubstr("at least 2, not 1"));
  EXPECT_THAT(complaint([](auto& m, auto&) {
                m.breakage->fragments = 3;
                m.breakage->daughters = BreakageOptions::Daughters::uniform;
              }),
              HasSubstr("2 where the daughters are uniform, not 3"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.deposition->rate = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("deposition.rate"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.growth.oxidation = -1; }), HasSubstr("growth.oxidation"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.growth.treatment = GrowthOptions::Treatment::jumps; }),
              HasSubstr("growth.monomer"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.growth.always = true; }), HasSubstr("growth.step"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.dilution = std::numeric_limits<double>::infinity(); }),
              HasSubstr("dilution"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.density = 0; }), HasSubstr("density needs to be above zero"));
  EXPECT_THAT(complaint([](auto& m, auto&) { m.coagulation->type = CollisionKernelType::freeMolecular; }),
              HasSubstr("the free-molecular kernel needs a temperature"));
  EXPECT_THAT(complaint([](auto&, auto& i) { i.number = 0; }), HasSubstr("initial.number"));
  EXPECT_THAT(complaint([](auto&, auto& i) { i.volume = -1; }), HasSubstr("initial.volume"));
  EXPECT_THAT(complaint([](auto&, auto& i) { i.geometricDeviation = 0.9; }), HasSubstr("initial.geometric_deviation"));
}

TEST(PopulationModelCheck, LooksAtNoInitialPopulationWhereThereIsNone) {
  EXPECT_EQ(complaint([](auto&, auto& i) { i = InitialPopulation{}; }), "nothing");
}

}  // namespace
}  // namespace lampblack::particles
