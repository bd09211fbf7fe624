// The hybrid particle-number and particle method as a solver; the method itself is in hybrid_method.hpp. The unit of
// volume is the monomer of growth by jumps, or else the nucleus, or else a particle of the monodisperse initial
// population; the threshold of the options is in nuclei.
#pragma once

#include <fmt/format.h>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/hybrid_method.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/population/monte_carlo/jump_process.hpp"
#include "particles/population/monte_carlo/make_monte_carlo.hpp"

namespace lampblack::particles {

namespace hybrid {

// Volumes of the unit and of what the threshold counts. Throws InputError.
struct Unit {
  double volume = 0;   // m3
  double nucleus = 1;  // units
};
[[nodiscard]] Unit unitOf(const PopulationModel& model, const InitialPopulation& initial);

}  // namespace hybrid

template <ParticleType Type>
std::unique_ptr<PopulationSolver> makeHybrid(const Type& type, const PopulationModel& model,
                                             const InitialPopulation& initial, const MonteCarloOptions& options) {
  if (moreThanVolume<Type>()) {
    throw InputError(
        "the hybrid method keeps small particles as numbers of one volume: it cannot have particles with a surface or "
        "components of their own");
  }
  if (options.threshold == 0) throw InputError("the hybrid method needs a threshold of at least one nucleus");
  if (options.rates == EventRates::exact) {
    throw InputError("the hybrid method has majorant rates only; compare with method: dsmc, rates: exact");
  }
  const hybrid::Unit unit = hybrid::unitOf(model, initial);
  typename HybridMethod<Type>::Options settings;
  settings.capacity = options.particles;
  settings.threshold = static_cast<std::size_t>(std::llround(static_cast<double>(options.threshold) * unit.nucleus));
  settings.unit = unit.volume;
  settings.weight = initialWeight(initial, options);
  HybridMethod<Type> method(type, model, settings);
  using Process = JumpProcess<HybridMethod<Type>>;
  RandomStream random(options.seed, options.repeat, Process::streamPurpose);
  method.start(initialVolumes(initial, options.particles, random), random);
  return std::make_unique<Process>(std::move(method), model, options, random);
}

}  // namespace lampblack::particles
