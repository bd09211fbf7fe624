#include "io/checkpoint_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/errors.hpp"
#include "io/checkpoint_file.hpp"
#include "io/disk_space.hpp"
#include "io/sealed_file.hpp"

namespace lampblack::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* checkpointPrefix = "step_";
constexpr const char* outputsPrefix = "outputs_";

bool isOurs(const fs::path& file) {
  const std::string name = file.filename().string();
  return (name.starts_with(checkpointPrefix) || name.starts_with(outputsPrefix)) &&
         (name.ends_with(".h5") || name.ends_with(".h5.part"));
}

// What is wrong with a checkpoint or its outputs, or nothing; fills in the outputs.
std::string problemOf(MPI_Comm comm, const fs::path& file, std::vector<fs::path>& outputs) {
  const std::string problem = sealProblem(comm, file);
  if (!problem.empty()) return fmt::format("{}: this file {}", file.string(), problem);
  outputs.clear();
  for (const std::string& name : CheckpointReader::textsOf(comm, file, "outputs")) {
    outputs.push_back(file.parent_path() / name);
    const std::string theirs = sealProblem(comm, outputs.back());
    if (!theirs.empty())
      return fmt::format("{}: this checkpoint needs {}, which {}", file.string(), outputs.back().string(), theirs);
  }
  return "";
}

// What rank 0 finds there, on all ranks.
std::vector<fs::path> fromRankZero(MPI_Comm comm, const CheckpointFolder& folder) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string names;
  if (rank == 0)
    for (const fs::path& file : folder.checkpoints()) names += file.filename().string() + '\n';
  auto size = static_cast<int>(names.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, comm);
  names.resize(static_cast<std::size_t>(size));
  MPI_Bcast(names.data(), size, MPI_CHAR, 0, comm);
  std::vector<fs::path> files;
  std::istringstream lines(names);
  for (std::string name; std::getline(lines, name);) files.push_back(folder.path() / name);
  return files;
}

}  // namespace

CheckpointFolder::CheckpointFolder(const fs::path& runFolder)
    : path_(runFolder / "checkpoint"), request_(runFolder / "checkpoint-now") {}

fs::path CheckpointFolder::checkpoint(std::int64_t step) const {
  return path_ / fmt::format("{}{:06}.h5", checkpointPrefix, step);
}

fs::path CheckpointFolder::outputs(std::int64_t step) const {
  return path_ / fmt::format("{}{:06}.h5", outputsPrefix, step);
}

void CheckpointFolder::make() const {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) refuseWrite(path_, error.value());
}

void CheckpointFolder::removeAllBut(const std::vector<fs::path>& kept) const {
  std::error_code error;
  std::vector<fs::path> doomed;
  for (const auto& entry : fs::directory_iterator(path_, error))
    if (isOurs(entry.path()) && std::ranges::find(kept, entry.path()) == kept.end()) doomed.push_back(entry.path());
  for (const fs::path& file : doomed) {
    fs::remove(file, error);
    if (error) throw InputError(fmt::format("{}: cannot be removed: {}", file.string(), error.message()));
  }
  if (fs::is_empty(path_, error) && !error) fs::remove(path_, error);
}

std::vector<fs::path> CheckpointFolder::checkpoints() const {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(checkpointPrefix) && name.ends_with(".h5")) files.push_back(entry.path());
  }
  // Longer numbers are larger.
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    const std::string first = a.string();
    const std::string second = b.string();
    return first.size() != second.size() ? first.size() > second.size() : first > second;
  });
  return files;
}

WholeCheckpoint wholeCheckpoint(MPI_Comm comm, const fs::path& file) {
  WholeCheckpoint found{file, {}, {}};
  const std::string problem = problemOf(comm, file, found.outputs);
  collectively(comm, [&] {
    if (!problem.empty()) throw InputError(problem);
  });
  return found;
}

WholeCheckpoint newestCheckpoint(MPI_Comm comm, const fs::path& runFolder) {
  const CheckpointFolder folder(runFolder);
  WholeCheckpoint found;
  for (const fs::path& file : fromRankZero(comm, folder)) {
    const std::string problem = problemOf(comm, file, found.outputs);
    if (problem.empty()) {
      found.file = file;
      return found;
    }
    found.damaged.push_back(problem);
  }
  collectively(comm, [&] {
    if (found.damaged.empty())
      throw InputError(fmt::format(
          "{}: there is no checkpoint in this folder to restart from. Name the folder of the interrupted run with "
          "--out, or a checkpoint with --restart FILE",
          folder.path().string()));
    throw InputError(fmt::format("{}, and there is no other checkpoint", found.damaged.front()));
  });
  return found;
}

}  // namespace lampblack::io
