#include "coupling/flame_ensemble.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "core/errors.hpp"

namespace lampblack::coupling {

std::vector<FlameEnsemblePath> runFlameEnsemble(MPI_Comm comm, const GasOfFlame& gas,
                                                const FlameEnsembleOptions& options) {
  collectively(comm, [&] {
    if (options.repeats < 2) throw InputError("stochastic particles: at least 2 repeats are needed");
  });
  std::vector<FlameEnsemblePath> results;
  for (std::size_t k = 0; k < options.paths.size(); ++k) {
    FlameEnsemblePath& result = results.emplace_back();
    result.options = options.paths[k];
    collectively(comm, [&] { result.path = flamePath(gas, result.options); });
    if (result.path.path.points.empty()) continue;
    static_cast<PathEnsemble&>(result) =
        runPathEnsemble(comm, result.path.path, options.make, static_cast<std::uint64_t>(k) << 32U, options.repeats,
                        options.march, fmt::format("stochastic particles, path {}", k));
  }
  return results;
}

}  // namespace lampblack::coupling
