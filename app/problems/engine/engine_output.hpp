// What a run of an engine writes, from its repeats: means, and with several their errors and intervals.
#pragma once

#include <span>
#include <vector>

#include "app/problems/engine/engine_repeat.hpp"
#include "core/modules.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

// Quantities as columns: of several repeats with their intervals.
[[nodiscard]] std::vector<Quantity> engineColumns(const std::vector<Quantity>& quantities, std::uint64_t repeats);
// Values of repeats (repeat-major, `width` a repeat) as such columns, one after the other.
[[nodiscard]] std::vector<double> engineMeans(std::span<const double> repeats, std::size_t width, std::uint64_t count);

// Angle, time, and the columns of each row.
[[nodiscard]] std::vector<Quantity> engineHistoryColumns(const EngineCase& made);
[[nodiscard]] std::vector<double> engineHistory(const EngineCase& made, std::span<const double> repeats);

void recordEngine(JsonWriter& json, const EngineCase& made, std::span<const double> summaries, bool isConverged);

}  // namespace lampblack::app
