#include "coupling/flame_ensemble.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace lampblack::coupling {

std::vector<FlameEnsemblePath> runFlameEnsemble(MPI_Comm comm, const FlameSootGas& gas,
                                                const FlameEnsembleOptions& options) {
  collectively(comm, [&] {
    if (options.repeats < 2) throw InputError("stochastic soot: at least 2 repeats are needed");
  });
  std::vector<FlameEnsemblePath> results;
  for (std::size_t k = 0; k < options.paths.size(); ++k) {
    FlameEnsemblePath& result = results.emplace_back();
    result.options = options.paths[k];
    collectively(comm, [&] { result.path = flamePath(gas, result.options); });
    if (result.path.path.points.empty()) continue;
    EnsembleOptions soot = options.soot;
    soot.owner = static_cast<std::uint64_t>(k) << 32U;
    static_cast<PathEnsemble&>(result) = runPathEnsemble(comm, result.path.path, soot, options.repeats, options.march,
                                                         fmt::format("stochastic soot, path {}", k));
  }
  return results;
}

}  // namespace lampblack::coupling
