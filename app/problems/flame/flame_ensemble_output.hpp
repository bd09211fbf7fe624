// Stochastic particles of a flame in results.h5, under /stochastic.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "coupling/flame_ensemble.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

// Collective. `heights` (m): where distributions are written, at the nearest point of each path.
void writeFlameEnsemble(ResultsWriter& results, const std::vector<FlameEnsemblePath>& paths,
                        const FlameEnsembleOptions& options, std::span<const double> heights);

}  // namespace lampblack::app
