// What a run of particles along a given gas writes: rows of the history, rates between them, size distributions.
#pragma once

#include <vector>

#include "app/problems/prescribed_gas/prescribed_gas_case.hpp"
#include "core/modules.hpp"
#include "coupling/model_along.hpp"
#include "coupling/path_ensemble.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"
#include "io/table.hpp"

namespace lampblack::app {

// Of an ensemble: means of the repeats, each with its standard error and the half widths of its intervals of 95 % and
// 99.9 % (Student's t), which overlap the truth in so many of a hundred cases.
[[nodiscard]] Table historyOf(const PrescribedGasCase& along, const PathEnsemble& ensemble);
[[nodiscard]] Table historyOf(const PrescribedGasCase& along, const ModelAlong& model);
// A row between each two rows of the history: what processes did there per m3 and time.
[[nodiscard]] Table ratesOf(const PrescribedGasCase& along, const PathEnsemble& ensemble);

// Collective.
void writeDistributions(ResultsWriter& results, const PrescribedGasCase& along, const PathEnsemble& ensemble);
// Of a model that has sizes.
void writeDistributions(ResultsWriter& results, const ModelAlong& model);

void recordCounts(JsonWriter& json, const PathEnsemble& ensemble);

}  // namespace lampblack::app
