#include "core/errors.hpp"
#include "particles/population/sectional/sectional_options.hpp"

namespace lampblack {

std::unique_ptr<PopulationSolver> makeSectional(const PopulationModel&, const InitialPopulation&,
                                                const SectionalOptions&) {
  throw InputError("this method is not available yet");
}

}  // namespace lampblack
