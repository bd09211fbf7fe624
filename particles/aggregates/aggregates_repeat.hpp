// One repeat of a run of aggregates, and what is said of its aggregates at each row.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/aggregates/aggregate_numbers.hpp"
#include "particles/aggregates/aggregates_case.hpp"

namespace lampblack::particles {

// Fills rows() times as many numbers; NaN behind where the run is asked to stop. `last`, where given, becomes some
// aggregates of the end, drawn at random. NumericsError.
void runAggregates(const AggregatesCase& made, std::uint64_t repeat, std::span<double> rows,
                   std::vector<SphereAggregate>* last);

}  // namespace lampblack::particles
