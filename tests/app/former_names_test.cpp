// Whole decks with the names of version 0.1 are read as those of the present names.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "app/shell/problem.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "tests/every_module.hpp"

namespace lampblack::app {
namespace {

using Names = std::vector<std::pair<std::string, std::string>>;  // present, former

// `text` has the present names, each once.
void expectFormerNamesAreRead(const std::string& text, const Names& names) {
  std::string former = text;
  for (const auto& [present, before] : names) {
    const std::size_t at = former.find(present);
    ASSERT_NE(at, std::string::npos) << present;
    former.replace(at, present.size(), before);
  }
  const Deck now = Deck::parse(text, "deck.yaml", {}, deckKinds()),
             old = Deck::parse(former, "deck.yaml", {}, deckKinds());
  EXPECT_TRUE(now.notes().empty()) << now.notes().front();
  EXPECT_EQ(old.notes().size(), names.size());
  EXPECT_EQ(old.resolved(), now.resolved());
}

TEST(FormerNames, OfFlows) {
  expectFormerNamesAreRead(R"(problem: flow
mechanism: gas.yaml
mesh: {r: [{to: 1 mm, cells: 2}], z: [{to: 1 mm, cells: 2}]}
boundaries: {low: {type: outlet, side: z-min}}
initial: {layer: none, composition: 'N2: 1'}
time: {end: 1 s}
particles:
  description: ensemble
  number: 300
  averaging_time: 1 ms
  frozen_gas: 2 ms
  minimum_number_density: 1e9 1/m^3
  bundled_growth: 0.1
transport: {collision_integrals: wang_fits}
)",
                           {{"number: 300", "particles: 300"},
                            {"averaging_time", "average"},
                            {"frozen_gas", "hold_gas"},
                            {"minimum_number_density", "least_number"},
                            {"bundled_growth", "share_at_once"},
                            {"wang_fits", "thesis_fits"}});
}

TEST(FormerNames, OfAggregates) {
  expectFormerNamesAreRead(R"(problem: aggregates
spheres: {material: silica, radius: 10 nm}
build: {by: equal_pairs, doublings: 3, aggregates: 5}
gas: {temperature: 2200 K}
sintering: {step_error: 1e-3}
time: {end: 1 ms}
)",
                           {{"step_error", "tolerance"}});
}

TEST(FormerNames, OfPrescribedGases) {
  expectFormerNamesAreRead(R"(problem: prescribed_gas
mechanism: gas.yaml
gas: {flame: results.h5, minimum_velocity: 2 mm/s}
particles:
  material: silica
  description: trees
  van_der_waals: 2
  expected_number: 1e16 1/m^3
  sintering: {mechanism: constant, prefactor: 1, activation_temperature: 3 K}
)",
                           {{"prescribed_gas", "particles_along"},
                            {"minimum_velocity", "slowest"},
                            {"van_der_waals", "enhancement"},
                            {"expected_number", "full_at"},
                            {"activation_temperature", "temperature"}});
}

TEST(FormerNames, OfFlames) {
  expectFormerNamesAreRead(R"(problem: flame1d
mechanism: gas.yaml
flame: {type: burner}
inlet: {temperature: 300 K, velocity: 1 m/s, composition: 'N2: 1'}
particles: {description: ensemble, carried: two_equation_dimer, coupling: two_way, minimum_velocity: 2 mm/s, number: 50, iterations: 3}
)",
                           {{"two_equation_dimer", "two_equation"},
                            {"coupling", "coupled"},
                            {"minimum_velocity", "slowest"},
                            {"number: 50", "particles: 50"}});
}

TEST(FormerNames, OfPopulationBalances) {
  expectFormerNamesAreRead(R"(problem: population_balance
name: one
processes: {coagulation: {kernel: constant, rate: 1 m^3/s}}
initial: {distribution: monodisperse, number: 1 1/m^3, volume: 1 m^3}
methods: {one: {type: dsmc, unbiased_moments: [M0]}}
time: {end: 1 s}
distribution: {minimum: 0 m^3, maximum: 1 m^3, spacing: linear}
)",
                           {{"unbiased_moments", "claims"}});
}

}  // namespace
}  // namespace lampblack::app
