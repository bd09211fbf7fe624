// What a run of aggregates writes: rows of means over the repeats, and the spheres of some aggregates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/problems/aggregates/aggregates_case.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

[[nodiscard]] std::vector<Quantity> aggregateColumns();
// Of the rows of all repeats, one behind the other; of rank 0. A mean is NaN where one of the repeats has none.
[[nodiscard]] std::vector<double> aggregateHistory(const AggregatesCase& made, std::span<const double> repeats);

// Collective; those of rank 0.
void writeAggregates(ResultsWriter& results, const std::vector<SphereAggregate>& aggregates);

void recordAggregates(JsonWriter& json, const AggregatesCase& made, std::span<const double> history);

}  // namespace lampblack::app
