// What the tests of the method that draws pairs begin from.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "particles/population/monte_carlo/shipped_types.hpp"
#include "particles/population/monte_carlo_options.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {

using Distribution = InitialPopulation::Distribution;

inline PopulationModel colliding(CollisionKernelType type, double rate) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->rate = rate;
  model.coagulation->gas = {1500, 101325, 0.2, 5e-5, 0.029};
  return model;
}

inline InitialPopulation startOf(Distribution distribution, double number = 1, double volume = 1) {
  InitialPopulation initial;
  initial.distribution = distribution;
  initial.number = number;
  initial.volume = volume;
  return initial;
}

inline MonteCarloOptions pairsOf(std::size_t particles, std::uint64_t repeat = 0) {
  MonteCarloOptions options;
  options.method = MonteCarloMethod::pairs;
  options.particles = particles;
  options.seed = 36;
  options.repeat = repeat;
  return options;
}

// M_0 to M_3 at `end` (s), all repeats.
inline std::array<std::vector<double>, 4> momentsAt(double end, const PopulationModel& model,
                                                    const InitialPopulation& initial, MonteCarloOptions options,
                                                    std::uint64_t repeats) {
  std::array<std::vector<double>, 4> result;
  for (options.repeat = 0; options.repeat < repeats; ++options.repeat) {
    const auto solver = makeMonteCarlo(Sphere(model.density), model, initial, options);
    solver->advance(end);
    const auto moments = solver->moments();
    for (std::size_t k = 0; k < 4; ++k) result[k].push_back(moments[k]);
    EXPECT_LE(solver->particles(), options.particles);
  }
  return result;
}

inline void expectMoment(const std::array<std::vector<double>, 4>& moments, std::size_t k, double exact) {
  const Sample sample = summarise(moments[k]);
  EXPECT_LT(std::abs(sample.z(exact)), zLimit) << "M" << k << " " << sample.mean << " exact " << exact;
}

}  // namespace lampblack::test
