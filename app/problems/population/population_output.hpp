// What a population balance run leaves: tables of the results file, table.csv, the record's results, and the summary on
// the console.
#pragma once

#include <filesystem>
#include <string>

#include "core/modules.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"
#include "particles/population/comparison/comparison.hpp"

namespace lampblack::app {

// Collective; rank 0 has the statistics. The groups /exact and /methods.
void writePopulation(ResultsWriter& results, const PopulationCase& populationCase,
                     const PopulationStatistics& statistics);

// table.csv: a row a method; cells are empty where there is nothing to say.
std::string populationTable(const PopulationStatistics& statistics);

// Fields of the record's object "results".
void recordPopulation(JsonWriter& json, const PopulationStatistics& statistics);

// The same for people.
std::string populationSummary(const PopulationCase& populationCase, const PopulationStatistics& statistics);

}  // namespace lampblack::app
