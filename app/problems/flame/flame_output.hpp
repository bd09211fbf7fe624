// What a one-dimensional flame leaves: fields over z, the numbers that name it, the way to the solution and its
// budgets; in results.h5, profile.csv, the record of the run and on the console.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/problems/flame/flame_case.hpp"
#include "app/problems/flame/flame_soot_output.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_fields.hpp"
#include "flow/flame/flame_state.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

struct FlameResult {
  FlameSolution solution;
  FlameFields fields;
  FlameSummary summary;
  std::optional<FlameSootFields> soot;
  FlameState state = FlameState::Burning;
  // Where the flame went out: the load at which the branch of burning flames ends, if it was found below 1.
  std::optional<double> extinctionLoad;
  bool converged = true;
};

// The same on all ranks for the same solution. Fields stay empty where the properties of an unconverged profile cannot
// be evaluated.
FlameResult flameResult(const FlameCase& flame, FlameSolution solution, bool converged);

std::vector<NamedNumber> namedNumbers(const FlameCase& flame, const FlameResult& result);

// Collective: /flame, /stages, /budgets.
void writeFlame(ResultsWriter& results, const FlameCase& flame, const FlameResult& result);
// profile.csv: a row a point.
std::string flameTable(const FlameCase& flame, const FlameResult& result);
// Fields of the record's object "results".
void recordFlame(JsonWriter& json, const FlameCase& flame, const FlameResult& result);
// Numbers as fields "name_unit" of an object, and as lines for the console.
void recordNumbers(JsonWriter& json, const std::vector<NamedNumber>& numbers);
std::string numbersText(const std::vector<NamedNumber>& numbers);
// A line for each stage while it goes on, and what came out.
std::string stageLine(const FlameStage& stage);
std::string flameReport(const FlameCase& flame, const FlameResult& result);

}  // namespace lampblack::app
