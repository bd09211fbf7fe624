// run.json: what was run, with what, how it went and what it cost. Written at the start (status "running"), and again
// at the end; a file that still says "running" after its process is gone belongs to a run that died.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/report.hpp"

namespace lampblack::io {

enum class RunStatus { running, done, failed, stopped };

struct RunRecord {
  RunStatus status = RunStatus::running;
  std::string message;                 // why it failed, or what is kept of a run that was stopped
  std::string deckPath;                // absolute
  std::string deckJson;                // Deck::resolvedJson()
  std::vector<std::string> overrides;  // --set
  std::string restartedFrom;           // the checkpoint that the run went on from; may be empty
  std::string version;                 // Lampblack's
  std::string gitHash;
  std::map<std::string, std::string> libraries;  // "PETSc": "3.18.5"
  int ranks = 1;
  std::uint64_t seed = 0;
  std::string started;                       // ISO 8601, UTC
  std::string finished;                      // empty while running
  double wallTime = 0.0;                     // s
  double simulatedTime = 0.0;                // s
  std::int64_t steps = 0;                    // since the start, those before a restart among them
  std::int64_t earlierSteps = 0;             // of these, before the restart
  std::optional<std::int64_t> retriedSteps;  // of a problem that can
  std::int64_t cells = 0;
  std::string meshJson;            // how good the mesh is, one object; may be empty
  double peakMemoryPerRank = 0.0;  // bytes, the largest
  std::vector<StageTime> stages;
  std::string resultsJson;  // what came out, one object; may be empty
};

// The record as JSON text.
std::string toJson(const RunRecord& record);

// Writes it with writeFileAtomically(). Call on rank 0 only.
void writeRunRecord(const std::filesystem::path& path, const RunRecord& record);

// The time now, UTC, as "2024-05-01T12:00:00Z".
std::string utcNow();

}  // namespace lampblack::io
