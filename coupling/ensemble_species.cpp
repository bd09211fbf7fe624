#include "coupling/ensemble_species.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace lampblack::coupling {

std::vector<std::size_t> indicesOfSootSpecies(const Mechanism& mechanism, const SootModelOptions& options) {
  std::vector<std::size_t> indices;
  for (const std::string& name : sootSpecies(options)) {
    const auto k = mechanism.findSpecies(name);
    if (!k)
      throw InputError(fmt::format(
          "ensembles need the species '{}', but the mechanism has no species of this name; choose another mechanism",
          name));
    indices.push_back(*k);
  }
  return indices;
}

}  // namespace lampblack::coupling
