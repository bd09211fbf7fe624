// The folder a run writes to. A missing folder is made. A folder that already holds a run - finished, failed or still
// going - is refused, so that nothing is overwritten unless the user says so. A run that is still going keeps its
// folder locked: nobody can replace it.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "io/folder_lock.hpp"

namespace lampblack::io {

class RunFolder {
 public:
  // Collective: rank 0 looks and makes, all ranks raise the same InputError. With `force` the files of the earlier run
  // (those named below and no others) are removed.
  static RunFolder prepare(const std::filesystem::path& path, bool force, MPI_Comm comm);
  // Collective. The same for a run that goes on from a checkpoint of this folder, and keeps the checkpoints.
  static RunFolder resume(const std::filesystem::path& path, MPI_Comm comm);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path results() const { return path_ / "results.h5"; }
  // While the run goes on, and of one that does not reach its end.
  [[nodiscard]] std::filesystem::path partialResults() const { return path_ / "results.h5.part"; }
  [[nodiscard]] std::filesystem::path runRecord() const { return path_ / "run.json"; }
  [[nodiscard]] std::filesystem::path history() const { return path_ / "history.csv"; }
  // What a cell that could not be advanced leaves, by its number.
  static constexpr const char* failedCellPrefix = "failed_cell_";
  [[nodiscard]] std::filesystem::path failedCell(std::int64_t cell) const {
    return path_ / (failedCellPrefix + std::to_string(cell) + ".yaml");
  }
  // Of a run on a coarser mesh before this one, 1 the finest: a folder of a run below this one.
  static std::string coarser(int level) { return "coarser_" + std::to_string(level); }
  // Tables that a deck asks for, by what they are of; the folder is there while there are any.
  static constexpr const char* tableFolder = "tables";
  [[nodiscard]] std::filesystem::path table(const std::string& name) const {
    return path_ / tableFolder / (name + ".csv");
  }
  void makeTableFolder() const;  // not collective; InputError or SystemError
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return path_ / name; }

 private:
  RunFolder(std::filesystem::path path, std::shared_ptr<FolderLock> lock)
      : path_(std::move(path)), lock_(std::move(lock)) {}
  std::filesystem::path path_;
  std::shared_ptr<FolderLock> lock_;  // of rank 0, while any copy lives
};

// Writes a file so that a reader sees the old or the new one and never half of it: temporary name, then rename.
// SystemError where the disk is full, InputError where it cannot be written otherwise. Not collective.
void writeFileAtomically(const std::filesystem::path& path, const std::string& content);

}  // namespace lampblack::io
