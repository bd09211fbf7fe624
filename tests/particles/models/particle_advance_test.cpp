// Particles and gas advanced together over a time, for every model: elements, order of events, steady states, and what
// a supply from outside may do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/modules.hpp"
#include "soot_model_checks.hpp"
#include "tests/particles/models/published_models.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

// A model in a strongly sooting gas.
class EveryAdvance : public testing::TestWithParam<std::string> {
 protected:
  EveryAdvance() : model_(test::publishedModel(GetParam(), test::threePah())) {
    state_ = test::RandomStates(7).next(*model_);
    state_.gas.temperature = 1700;
    state_.gas.pressure = constants::oneAtmosphere;
    const double total = state_.gas.pressure / (constants::gasConstant * 1700);
    state_.gas.density = total * state_.gas.meanMolecularWeight;
    for (std::size_t i = 0; i < state_.concentrations.size(); ++i)
      state_.concentrations[i] = total * fractionOf(model_->gasSpecies()[i]);
    std::fill(state_.densities.begin(), state_.densities.end(), 0.0);
    advance(3e-3);  // soot that grew in this gas
    state_.connect();
  }

  static double fractionOf(const std::string& species) {
    const std::map<std::string, double> fractions{
        {"H", 1e-3},    {"H2", 0.03},   {"OH", 1e-4}, {"H2O", 0.08}, {"O2", 1e-4}, {"O", 1e-5}, {"CO", 0.05},
        {"C2H2", 0.03}, {"C6H6", 1e-4}, {"A1", 1e-4}, {"A2", 2e-5},  {"A3", 3e-6}, {"A4", 2e-6}};
    return fractions.at(species);
  }

  [[nodiscard]] std::size_t scalars() const { return model_->scalars().size(); }

  ParticleAdvance advance(double dt, std::span<const double> supply = {}) {
    return model_->advance(state_.gas, dt, state_.densities, state_.concentrations, supply);
  }

  // A gas that soot burns in.
  void burn() {
    const double total = state_.gas.pressure / (constants::gasConstant * state_.gas.temperature);
    for (std::size_t i = 0; i < state_.concentrations.size(); ++i) {
      const std::string& species = model_->gasSpecies()[i];
      if (species == "O2" || species == "OH") state_.concentrations[i] = 0.05 * total;
      if (species == "C2H2" || species.starts_with("A") || species == "C6H6") state_.concentrations[i] = 0;
    }
  }

  // Takes a share of the particles away, evenly over the time.
  void carryAway(double share, double dt) {
    std::vector<double> supply(values().size());
    for (std::size_t i = 0; i < scalars(); ++i) supply[i] = -share * state_.densities[i] / dt;
    advance(dt, supply);
  }

  [[nodiscard]] std::vector<double> values() const {
    std::vector<double> all = state_.densities;
    all.insert(all.end(), state_.concentrations.begin(), state_.concentrations.end());
    return all;
  }

  [[nodiscard]] std::vector<double> rates() {
    state_.connect();
    std::vector<double> all(values().size());
    model_->sources(state_.gas, state_.densities, std::span(all).first(scalars()), std::span(all).subspan(scalars()));
    return all;
  }

  // mol/m3 of C, H, O in soot and gas.
  [[nodiscard]] test::Atoms atoms(const std::vector<double>& of) const {
    const test::ModelWeights weights;
    test::Atoms sum{};
    for (std::size_t i = 0; i < scalars(); ++i) {
      sum[0] += of[i] * model_->scalars()[i].massOf("C") / weights.carbon;
      sum[1] += of[i] * model_->scalars()[i].massOf("H") / weights.hydrogen;
    }
    for (std::size_t i = scalars(); i < of.size(); ++i)
      for (std::size_t e = 0; e < 3; ++e)
        sum[e] += test::atomsOfSpecies().at(model_->gasSpecies()[i - scalars()])[e] * of[i];
    return sum;
  }

  // Below which errors do not matter, of every value.
  [[nodiscard]] std::vector<double> smallest() const {
    std::vector<double> all;
    for (const ParticleScalar& scalar : model_->scalars())
      all.push_back(ParticleModel::smallestShare * scalar.scale * state_.gas.density);
    all.resize(values().size(), 1e-10 * state_.gas.pressure / (constants::gasConstant * state_.gas.temperature));
    return all;
  }

  std::unique_ptr<SootModel> model_;
  test::ModelState state_;
};

// Rounding of the differences that some Jacobians are made of takes part: 1e-9 of what is moved.
TEST_P(EveryAdvance, KeepsElementsOfSootGasAndSupply) {
  for (const double dt : {1e-6, 1e-4, 1e-2}) {
    for (const double share : {0.0, 0.5, -0.9}) {
      const std::vector<double> before = values();
      std::vector<double> supply = before;
      for (double& s : supply) s *= share / dt;
      advance(dt, supply);
      const test::Atoms start = atoms(before), brought = atoms(supply), end = atoms(values());
      for (std::size_t e = 0; e < 3; ++e)
        EXPECT_NEAR(end[e], start[e] + dt * brought[e], 1e-10 * start[e]) << dt << " " << share << " " << e;
    }
  }
}

TEST_P(EveryAdvance, OverAShortTimeIsTheSourcesAndTheSupply) {
  const std::vector<double> before = values(), rate = rates();
  const double dt = 1e-8;
  std::vector<double> supply = before;
  for (double& s : supply) s *= 200;  // 1/s
  advance(dt, supply);
  const std::vector<double> after = values();
  // Rates change by 1e-4 of themselves over this time at most; the rest is rounding.
  for (std::size_t i = 0; i < after.size(); ++i)
    EXPECT_NEAR(after[i] - before[i], dt * (rate[i] + supply[i]),
                2e-4 * dt * (std::abs(rate[i]) + std::abs(supply[i])) + 1e-15 * std::abs(before[i]))
        << i;
}

// What the particles of a steady flame see: the supply makes up for their sources, and nothing changes, whatever the
// step.
TEST_P(EveryAdvance, StaysWhereTheSupplyBalancesTheSources) {
  const std::vector<double> before = values(), floor = smallest();
  std::vector<double> supply = rates();
  for (double& s : supply) s = -s;
  for (const double dt : {1e-6, 1e-5, 1e-4}) {
    const ParticleAdvance done = advance(dt, supply);
    EXPECT_EQ(done.steps, 1) << dt;
    const std::vector<double> after = values();
    for (std::size_t i = 0; i < after.size(); ++i)
      EXPECT_NEAR(after[i], before[i], 1e-9 * (std::abs(before[i]) + floor[i])) << dt << " " << i;
  }
}

// In the root mean square over all values. A step is allowed the tolerance, by an estimate that kinks of rates mislead.
TEST_P(EveryAdvance, ErrorFollowsTheTolerance) {
  const test::ModelState start = state_;
  const std::vector<double> floor = smallest();
  std::vector<double> supply = values();
  for (double& s : supply) s *= 1000;
  const auto run = [&](double tolerance, double dt) {
    state_ = start;
    model_->setAdvanceTolerance(tolerance);
    const ParticleAdvance done = advance(dt, supply);
    return std::pair{values(), done};
  };
  for (const double dt : {1e-5, 1e-4, 1e-3}) {
    const std::vector<double> exact = run(1e-6, dt).first;
    for (const double tolerance : {1e-3, 1e-4}) {
      const auto [got, done] = run(tolerance, dt);
      double sum = 0;
      for (std::size_t i = 0; i < got.size(); ++i)
        sum += std::pow((got[i] - exact[i]) / (std::abs(exact[i]) + floor[i]), 2);
      EXPECT_LT(std::sqrt(sum / static_cast<double>(got.size())), 5 * done.steps * tolerance) << dt << " " << tolerance;
    }
  }
}

// A flow that carries all soot away, from a place where it burns: no more than there was of it, and as though it had
// gone at once.
// From steps in which little burns to those that nothing is left of.
TEST_P(EveryAdvance, WhatIsCarriedAwayWhileItBurnsIsNotOverdrawn) {
  burn();
  const test::ModelState start = state_;
  const std::vector<double> floor = smallest();
  for (const double dt : {3e-6, 1e-5, 3e-5, 1e-4, 3e-4, 3e-3}) {
    state_ = start;
    carryAway(0.9, dt);
    const std::vector<double> left = values();
    for (std::size_t i = 0; i < left.size(); ++i) EXPECT_GE(left[i], -floor[i]) << dt << " " << i;
  }
}

// Soot that burns within a small part of the step leaves the same gas whether its rest goes during the step or before
// it. The last of HMOM's soot burns in steps that rounding decides: between two builds OH differs by 1.5 %.
TEST_P(EveryAdvance, WhatIsCarriedAwayDuringALongStepIsAsIfAtItsStart) {
  burn();
  const test::ModelState start = state_;
  carryAway(0.9, 3e-3);
  const std::vector<double> during = values();
  state_ = start;
  for (double& density : state_.densities) density *= 0.1;
  advance(3e-3);
  const std::vector<double> before = values(), floor = smallest();
  for (std::size_t i = 0; i < during.size(); ++i)
    EXPECT_NEAR(during[i], before[i], (GetParam() == "hmom" ? 0.03 : 1e-6) * std::abs(before[i]) + floor[i]) << i;
}

// Soot that burns away takes its number with it.
TEST_P(EveryAdvance, SootThatBurnsAwayIsGone) {
  for (std::size_t i = 0; i < state_.concentrations.size(); ++i) {
    const std::string& species = model_->gasSpecies()[i];
    const double total = state_.gas.pressure / (constants::gasConstant * state_.gas.temperature);
    if (species == "O2" || species == "OH" || species == "O") state_.concentrations[i] = 0.05 * total;
    if (species == "C2H2" || species.starts_with("A") || species == "C6H6") state_.concentrations[i] = 0;
  }
  state_.connect();
  const double volume = model_->volumeFraction(state_.densities);
  const double number = model_->properties(state_.gas, state_.densities).numberDensity;
  for (int k = 0; k < 500; ++k) advance(1e-4);
  state_.connect();
  EXPECT_LT(model_->volumeFraction(state_.densities), 1e-4 * volume);
  EXPECT_LT(model_->properties(state_.gas, state_.densities).numberDensity, 1e-2 * number);
}

TEST_P(EveryAdvance, WhereThereIsNothingNothingChanges) {
  std::fill(state_.densities.begin(), state_.densities.end(), 0.0);
  std::fill(state_.concentrations.begin(), state_.concentrations.end(), 0.0);
  const std::vector<double> before = values();
  EXPECT_EQ(advance(1e-4).steps, 1);
  EXPECT_EQ(values(), before);
}

TEST_P(EveryAdvance, ASupplyOfAnotherSizeIsAnErrorOfTheProgram) {
  const std::vector<double> supply(scalars());
  EXPECT_THROW(advance(1e-6, supply), std::logic_error);
}

INSTANTIATE_TEST_SUITE_P(Published, EveryAdvance, testing::ValuesIn(test::publishedModels),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace lampblack::particles
