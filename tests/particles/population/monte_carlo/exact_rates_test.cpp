// rates: exact and rates: majorant have the same law, for methods with equal and with different weights.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "core/modules.hpp"
#include "particles/population/monte_carlo_options.hpp"
#include "same_law.hpp"

namespace lampblack::particles {
namespace {

using Method = MonteCarloMethod;
using Distribution = InitialPopulation::Distribution;

// The nuclei of soot, 2 nm wide, at 1800 K; a collision time of the order of a second.
constexpr double nucleus = 4e-27, number = 2e15;

struct Setting {
  PopulationModel model;
  InitialPopulation initial;
  std::vector<double> edges;
};

Setting additive() {
  Setting setting;
  setting.model.coagulation.emplace();
  setting.model.coagulation->type = CollisionKernelType::additive;
  setting.model.coagulation->rate = 1;
  setting.initial = {Distribution::exponential, 1.0, 1.0, 1};
  setting.edges = {0, 0.2, 0.5, 1, 2, 5, 15, 50};
  return setting;
}

Setting freeMolecular() {
  Setting setting;
  setting.model.coagulation.emplace();
  setting.model.coagulation->type = CollisionKernelType::freeMolecular;
  setting.model.coagulation->gas.temperature = 1800;
  setting.initial = {Distribution::lognormal, number, nucleus, 1.3};
  setting.edges = {0, 0.5 * nucleus, nucleus, 2 * nucleus, 4 * nucleus, 8 * nucleus, 30 * nucleus};
  return setting;
}

// Small particles break from large ones while nuclei appear.
Setting everything() {
  Setting setting = freeMolecular();
  setting.model.nucleation.emplace();
  setting.model.nucleation->rate = number;
  setting.model.nucleation->volume = nucleus;
  setting.model.breakage = BreakageOptions{1 / nucleus, 1, 2, BreakageOptions::Daughters::uniform};
  setting.model.deposition = DepositionOptions{0.2, 0};
  return setting;
}

using Case = std::tuple<Method, std::pair<const char*, Setting (*)()>>;

std::string nameOf(const testing::TestParamInfo<Case>& info) {
  static const std::map<Method, std::string> names = {
      {Method::dsmc, "Dsmc"}, {Method::sammc, "Sammc"}, {Method::samwfmc, "Samwfmc"}, {Method::swa, "Swa"}};
  return names.at(std::get<0>(info.param)) + std::get<1>(info.param).first;
}

class ExactRates : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Methods, ExactRates,
                         testing::Combine(testing::Values(Method::dsmc, Method::sammc, Method::swa),
                                          testing::Values(std::pair("Additive", &additive),
                                                          std::pair("FreeMolecular", &freeMolecular),
                                                          std::pair("Everything", &everything))),
                         nameOf);

TEST_P(ExactRates, HaveTheLawOfMajorants) {
  const auto& [method, chosen] = GetParam();
  const Setting setting = chosen.second();
  const auto run = [&, chosenMethod = method](EventRates rates, std::uint64_t seed) {
    return test::outcomes(
        [&](std::uint64_t repeat) {
          MonteCarloOptions options;
          options.method = chosenMethod;
          options.particles = 30;  // whatever their number is, both are to have the same law
          options.rates = rates;
          options.seed = seed;
          options.repeat = repeat;
          return makeMonteCarlo(setting.model, setting.initial, options);
        },
        400, 0.7, setting.edges);
  };
  test::expectSameLaw(run(EventRates::majorant, 1), run(EventRates::exact, 2));
}

// The mean waiting time to the first event of three particles against their three rates.
TEST(ExactRates, WaitAsLongAsTheEnumeratedRateSays) {
  Setting setting = additive();
  setting.initial = {Distribution::monodisperse, 3.0, 1.0, 1};
  // Three particles in 1 m3, each pair with the rate 2; two remain after the first event.
  const double rate = 3 * 2, step = 0.02;
  for (const EventRates rates : {EventRates::majorant, EventRates::exact}) {
    std::vector<double> survived;
    for (std::uint64_t repeat = 0; repeat < 4000; ++repeat) {
      MonteCarloOptions options;
      options.particles = 3;
      options.rates = rates;
      options.repeat = repeat;
      const auto solver = makeMonteCarlo(setting.model, setting.initial, options);
      solver->advance(step);
      survived.push_back(solver->counters().coagulations == 0 ? 1 : 0);
      EXPECT_EQ(rates == EventRates::exact ? solver->counters().fictitious : 0, 0u);
    }
    EXPECT_LT(std::abs(test::summarise(survived).z(std::exp(-rate * step))), test::zLimit);
  }
}

}  // namespace
}  // namespace lampblack::particles
