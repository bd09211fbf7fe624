// Methods of the population balance that are compared on one problem: what the particles do, which methods, when and in
// which bins they are looked at, and how often.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/exact_solutions/exact_solution.hpp"
#include "particles/population/model/components.hpp"
#include "particles/population/model/fractal_aggregate.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/model/surface_volume.hpp"
#include "particles/population/moments/moment_options.hpp"
#include "particles/population/monte_carlo_options.hpp"
#include "particles/population/population_solver.hpp"
#include "particles/population/sectional/sectional_options.hpp"

namespace lampblack::particles {

// What a particle is.
using PopulationParticles = std::variant<Sphere, FractalAggregate, SurfaceVolume, Components>;

// One method of the deck. Monte Carlo methods are run `repeats` times, the others once.
struct PopulationMethod {
  std::string name;  // the deck's
  std::string type;  // "sammc"
  std::variant<MonteCarloOptions, SectionalOptions, MomentOptions> options;
  std::array<bool, 4> unbiased{true, true, true, true};  // of the moments M0 to M3, those that have to show no bias
  bool conservesMass = true;  // M1 claimed: to round-off where the processes conserve it; otherwise in the mean

  [[nodiscard]] bool deterministic() const { return !std::holds_alternative<MonteCarloOptions>(options); }
};

// Rows of the histories: at time zero and at `outputs` times up to the end.
struct PopulationTimes {
  double end = 0;  // s
  std::size_t outputs = 100;
  double first = 0;  // s, of logarithmic spacing; zero: linear

  [[nodiscard]] std::vector<double> rows() const;
};

// When and in which bins of volume the size distribution is wanted; no edges: not at all.
struct PopulationBins {
  std::vector<double> edges;  // m3, increasing
  std::vector<double> times;  // s, increasing
};

struct PopulationCase {
  std::string name;
  PopulationParticles particles{Sphere(1800)};
  PopulationModel model;
  InitialPopulation initial;
  std::vector<PopulationMethod> methods;
  PopulationTimes times;
  PopulationBins bins;
  std::uint64_t repeats = 1;
  std::uint64_t seed = 1;
  std::vector<std::string> warnings;  // of samples that miss moments of the initial distribution

  // Whether no process changes M1.
  [[nodiscard]] bool conservesMass() const;
};

// The exact solution of the case; null where none is known.
std::unique_ptr<ExactSolution> exactSolution(const PopulationCase& populationCase);

// The solver of a method and repeat. InputError.
std::unique_ptr<PopulationSolver> makeSolver(const PopulationCase& populationCase, const PopulationMethod& method,
                                             std::uint64_t repeat);

}  // namespace lampblack::particles
