#include "particles/population/model/population_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"

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

// Sums over fine slices in place of closed forms.
TEST(InitialPopulations, OfTablesAndModesHaveTheMomentsOfTheirParts) {
  using Distribution = InitialPopulation::Distribution;
  const InitialPopulation table = tabulated({{1, 2, 3}, {2, 8, 1}, {10, 10.001, 0.5}});
  EXPECT_DOUBLE_EQ(table.number, 4.5);
  for (const double order : {-0.5, 0.0, 1.0 / 3, 1.0, 2.0, 3.0}) {
    double sum = 0;
    for (const auto& [from, to, number] : table.intervals)
      for (int slice = 0; slice < 2000; ++slice)
        sum += number / 2000 * std::pow(from * std::pow(to / from, (slice + 0.5) / 2000), order);
    EXPECT_NEAR(initialMoment(table, order) / sum, 1, 1e-6) << order;
    EXPECT_NEAR(initialIntegral(table, 0, HUGE_VAL, [&](double v) { return std::pow(v, order); }) / sum, 1, 1e-6)
        << order;
  }
  EXPECT_NEAR(table.volume, initialMoment(table, 1) / 4.5, 1e-11);
  EXPECT_NEAR(initialNumber(table, 4, 10.0005), 0.5 + 0.25, 1e-5);
  EXPECT_NEAR(initialIntegral(table, 4, 9, [](double) { return 1.0; }), 0.5, 1e-12);

  const InitialPopulation equal{Distribution::monodisperse, 7, 3, 1}, wide{Distribution::lognormal, 2, 5, 1.4};
  const InitialPopulation sum = sumOf({equal, InitialPopulation{}, sumOf({wide, table})});
  ASSERT_EQ(sum.modes.size(), 3U) << "a sum of sums is one sum";
  EXPECT_DOUBLE_EQ(sum.number, 13.5);
  for (const double order : {0.0, 1.0, 2.5})
    EXPECT_NEAR(initialMoment(sum, order),
                initialMoment(equal, order) + initialMoment(wide, order) + initialMoment(table, order),
                1e-12 * initialMoment(sum, order));
  EXPECT_NEAR(sum.volume * 13.5, initialMoment(sum, 1), 1e-10);
  EXPECT_NEAR(initialNumber(sum, 0, 5), 7 + 1 + 3 + std::log(5.0 / 2) / std::log(4), 1e-12) << "half of the wide one";
  EXPECT_EQ(sumOf({equal}).distribution, Distribution::monodisperse);
  EXPECT_EQ(sumOf({}).distribution, Distribution::none);
}

TEST(InitialPopulations, RefuseTablesThatAreNone) {
  const auto problem = [](std::vector<SizeInterval> intervals) -> std::string {
    try {
      static_cast<void>(tabulated(std::move(intervals)));
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  };
  using testing::HasSubstr;
  EXPECT_THAT(problem({{1, 2, 1}, {1.5, 3, 1}}), HasSubstr("rise without overlap"));
  EXPECT_THAT(problem({{2, 1, 1}}), HasSubstr("an upper end above 2"));
  EXPECT_THAT(problem({{0, 1, 1}}), HasSubstr("each lower end needs to be above zero"));
  EXPECT_THAT(problem({{1, 2, -1}}), HasSubstr("each number needs to be zero or above"));
  EXPECT_THAT(problem({{1, 2, 0}}), HasSubstr("holds no particles"));
  EXPECT_EQ(problem({{1, 2, 1}, {2 * (1 - 1e-12), 3, 1}}), "nothing") << "but for rounding";
}

}  // namespace
}  // namespace lampblack::particles
