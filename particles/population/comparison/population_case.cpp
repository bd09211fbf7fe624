#include "particles/population/comparison/population_case.hpp"

#include <cmath>

#include "particles/population/model/collision_kernel.hpp"
#include "particles/population/monte_carlo/shipped_types.hpp"

namespace lampblack::particles {

std::vector<double> PopulationTimes::rows() const {
  std::vector<double> rows{0};
  for (std::size_t k = 1; k < outputs; ++k) {
    if (first > 0)
      rows.push_back(first * std::pow(end / first, static_cast<double>(k - 1) / static_cast<double>(outputs - 1)));
    else
      rows.push_back(end * static_cast<double>(k) / static_cast<double>(outputs));
  }
  rows.push_back(end);
  return rows;
}

bool PopulationCase::conservesMass() const {
  const GrowthOptions& growth = model.growth;
  const bool grows = growth.condensation != 0 || growth.surfaceGrowth != 0 || growth.oxidation != 0;
  return !model.nucleation && !model.deposition && !grows && model.dilution == 0;
}

std::unique_ptr<ExactSolution> exactSolution(const PopulationCase& populationCase) {
  const PopulationModel& model = populationCase.model;
  // The solutions of kernels and growth that see a diameter or a surface are those of spheres; sintering changes no
  // volume.
  const bool sees =
      model.growth.surface() != 0 || (model.coagulation && CollisionKernel(*model.coagulation).needsDiameter());
  if (sees && !std::holds_alternative<Sphere>(populationCase.particles)) return nullptr;
  PopulationModel volumes = model;
  volumes.growth.always = false;
  return exactSolution(volumes, populationCase.initial);
}

std::unique_ptr<PopulationSolver> makeSolver(const PopulationCase& populationCase, const PopulationMethod& method,
                                             std::uint64_t repeat) {
  const PopulationModel& model = populationCase.model;
  const InitialPopulation& initial = populationCase.initial;
  if (const auto* sections = std::get_if<SectionalOptions>(&method.options))
    return makeSectional(model, initial, *sections);
  if (const auto* moments = std::get_if<MomentOptions>(&method.options)) return makeMoments(model, initial, *moments);
  MonteCarloOptions options = std::get<MonteCarloOptions>(method.options);
  options.seed = populationCase.seed;
  options.repeat = repeat;
  return std::visit([&](const auto& type) { return makeMonteCarlo(type, model, initial, options); },
                    populationCase.particles);
}

}  // namespace lampblack::particles
