#include "particles/population/monte_carlo/hybrid_solver.hpp"

#include <cmath>

namespace lampblack::particles::hybrid {

Unit unitOf(const PopulationModel& model, const InitialPopulation& initial) {
  const bool grows = model.growth.active();
  if (grows && model.growth.treatment != GrowthOptions::Treatment::jumps) {
    throw InputError(
        "the hybrid method keeps small particles as numbers of each size, which do not grow continuously: use growth "
        "by jumps of a monomer (treatment: jumps)");
  }
  double nucleus = 0;
  if (model.nucleation) {
    nucleus = model.nucleation->volume;
  } else if (initial.distribution == InitialPopulation::Distribution::monodisperse) {
    nucleus = initial.volume;
  } else if (grows) {
    nucleus = model.growth.monomer;
  } else {
    throw InputError(
        "the hybrid method needs a unit of volume: nucleation, growth by jumps or a monodisperse initial population");
  }
  if (!grows) return {nucleus, 1};
  const double units = nucleus / model.growth.monomer, whole = std::round(units);
  if (!(whole >= 1) || std::abs(units - whole) > 1e-9 * whole) {
    throw InputError(fmt::format(
        "the hybrid method needs nuclei of a whole number of the monomers they grow by; {:.6g} m3 is {:.6g} "
        "of {:.6g} m3",
        nucleus, units, model.growth.monomer));
  }
  return {model.growth.monomer, whole};
}

}  // namespace lampblack::particles::hybrid
