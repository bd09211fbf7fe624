#include "coupling/ensemble_species.hpp"

#include "chemistry/mechanism/known_species.hpp"

namespace lampblack::coupling {

std::vector<std::size_t> indicesOfSootSpecies(const Mechanism& mechanism, const SootModelOptions& options) {
  return knownSpecies(mechanism, sootSpecies(options), "ensembles need");
}

}  // namespace lampblack::coupling
