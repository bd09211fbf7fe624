// What a run of aggregates writes: rows of means over the repeats, and the spheres of some aggregates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/problems/aggregates/aggregates_case.hpp"
#include "core/modules.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"
#include "io/table.hpp"

namespace lampblack::app {

// Of the rows of all repeats, one behind the other; of rank 0, the others have none. A mean is NaN where one of the
// repeats has none.
[[nodiscard]] Table aggregateHistory(const AggregatesCase& made, std::span<const double> repeats);

// Collective; those of rank 0.
void writeAggregates(ResultsWriter& results, const std::vector<SphereAggregate>& aggregates);

}  // namespace lampblack::app
