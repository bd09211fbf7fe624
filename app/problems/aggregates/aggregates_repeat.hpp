// One repeat of a run of aggregates, and what is said of its aggregates at each row.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/problems/aggregates/aggregates_case.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"

namespace lampblack::app {

// What a row has, in this order; NaN where a population does not have it.
[[nodiscard]] const std::vector<Quantity>& aggregateQuantities();

// Fills rows() times as many numbers; NaN behind where the run is asked to stop. `last`, where given, becomes some
// aggregates of the end, drawn at random. NumericsError.
void runAggregates(const AggregatesCase& made, std::uint64_t repeat, std::span<double> rows,
                   std::vector<SphereAggregate>* last);

}  // namespace lampblack::app
