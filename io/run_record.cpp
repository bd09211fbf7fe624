#include "io/run_record.hpp"

#include <ctime>

#include "io/json.hpp"
#include "io/run_folder.hpp"

namespace lampblack::io {
namespace {

const char* nameOf(RunStatus status) {
  switch (status) {
    case RunStatus::running:
      return "running";
    case RunStatus::done:
      return "done";
    case RunStatus::failed:
      return "failed";
    case RunStatus::stopped:
      return "stopped";
  }
  return "unknown";
}

}  // namespace

std::string toJson(const RunRecord& record) {
  JsonWriter json;
  json.beginObject();
  json.field("file_type", "lampblack run").field("format_version", 1);
  json.field("status", nameOf(record.status)).field("message", record.message);
  json.field("lampblack_version", record.version).field("git_hash", record.gitHash);
  json.key("libraries").beginObject();
  for (const auto& [name, version] : record.libraries) json.field(name, version);
  json.endObject();
  json.field("started", record.started).field("finished", record.finished);
  json.field("ranks", record.ranks).field("seed", record.seed);
  json.field("cells", record.cells).field("steps", record.steps);
  if (!record.meshJson.empty()) json.key("mesh").raw(record.meshJson);
  if (record.retriedSteps) json.field("retried_steps", *record.retriedSteps);
  json.field("simulated_time_s", record.simulatedTime).field("wall_time_s", record.wallTime);
  json.field("peak_memory_per_rank_bytes", record.peakMemoryPerRank);
  json.key("stages").beginArray();
  for (const StageTime& stage : record.stages) {
    json.beginObject().field("name", stage.name).field("minimum_s", stage.minimum);
    json.field("average_s", stage.average).field("maximum_s", stage.maximum).endObject();
  }
  json.endArray();
  if (!record.resultsJson.empty()) json.key("results").raw(record.resultsJson);
  json.field("deck_path", record.deckPath);
  json.key("overrides").beginArray();
  for (const std::string& override : record.overrides) json.value(override);
  json.endArray();
  if (!record.restartedFrom.empty())
    json.field("restarted_from", record.restartedFrom).field("steps_before_restart", record.earlierSteps);
  json.key("deck");
  if (record.deckJson.empty()) {
    json.null();
  } else {
    json.raw(record.deckJson);
  }
  json.endObject();
  return json.text() + "\n";
}

void writeRunRecord(const std::filesystem::path& path, const RunRecord& record) {
  writeFileAtomically(path, toJson(record));
}

std::string utcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  const std::size_t size = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return {text, size};
}

}  // namespace lampblack::io
