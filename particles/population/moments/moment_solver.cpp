#include "core/errors.hpp"
#include "particles/population/moments/moment_options.hpp"

namespace lampblack {

std::unique_ptr<PopulationSolver> makeMoments(const PopulationModel&, const InitialPopulation&, const MomentOptions&) {
  throw InputError("this method is not available yet");
}

}  // namespace lampblack
