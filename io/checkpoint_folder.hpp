// The checkpoints of a run, in the folder `checkpoint` of its own: step_<number>.h5 (checkpoint_file.hpp), the last two
// of them, and beside them outputs_<number>.h5, the steps of the results that they need (ResultsWriter::saveSteps).
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::io {

class CheckpointFolder {
 public:
  explicit CheckpointFolder(const std::filesystem::path& runFolder);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path checkpoint(std::int64_t step) const;
  [[nodiscard]] std::filesystem::path outputs(std::int64_t step) const;
  // A file by which a user asks for a checkpoint.
  [[nodiscard]] const std::filesystem::path& request() const { return request_; }

  // Not collective; InputError where the file system refuses, SystemError where it is full.
  void make() const;
  // Removes what a run has put here, but for these files; the folder too where it is empty then.
  void removeAllBut(const std::vector<std::filesystem::path>& kept) const;
  // Checkpoints, the newest first.
  [[nodiscard]] std::vector<std::filesystem::path> checkpoints() const;

 private:
  std::filesystem::path path_, request_;
};

// A checkpoint of which every byte is as it was written, with the outputs that it needs.
struct WholeCheckpoint {
  std::filesystem::path file;
  std::vector<std::filesystem::path> outputs;
  std::vector<std::string> damaged;  // newer ones that are not whole: what is wrong with each
};

// Collective. InputError where this one is not whole.
WholeCheckpoint wholeCheckpoint(MPI_Comm comm, const std::filesystem::path& file);
// Collective. The newest of a run; InputError where there is none.
WholeCheckpoint newestCheckpoint(MPI_Comm comm, const std::filesystem::path& runFolder);

}  // namespace lampblack::io
