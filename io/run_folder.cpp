#include "io/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "io/checkpoint_folder.hpp"
#include "io/disk_space.hpp"

namespace lampblack::io {
namespace {

namespace fs = std::filesystem;

// What a run leaves in its folder.
constexpr std::array<const char*, 10> runFiles{"results.h5",        "results.h5.part", "results.xdmf", "run.json",
                                               "history.csv",       "branch.csv",      "profile.csv",  "reactors.csv",
                                               "sensitivities.csv", "table.csv"};

// How the earlier run ended, in words.
std::string stateOf(const fs::path& folder) {
  std::ifstream file(folder / "run.json");
  const std::string record{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (record.find("\"status\": \"done\"") != std::string::npos) return "a finished run";
  if (record.find("\"status\": \"failed\"") != std::string::npos) return "a run that failed";
  if (record.find("\"status\": \"stopped\"") != std::string::npos) return "a run that was stopped";
  if (record.find("\"status\": \"running\"") != std::string::npos) {
    return "a run that was cut off";
  }
  return fs::exists(folder / "results.h5") ? "the results of a run" : "parts of a run";
}

void removeFile(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw InputError(fmt::format("{}: cannot be removed: {}", file.string(), error.message()));
}

// Files of a folder, by the beginnings and the end of their names.
template <typename Beginnings>
void removeFiles(const fs::path& folder, const Beginnings& beginnings, std::string_view end) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const auto begins = [&](std::string_view beginning) { return name.starts_with(beginning); };
    if (std::ranges::any_of(beginnings, begins) && name.ends_with(end)) files.push_back(entry.path());
  }
  for (const fs::path& file : files) removeFile(file);
}

constexpr std::string_view tableKinds[] = {"probe_",   "line_",  "boundary_", "wall_",
                                           "deposit_", "sizes_", "joint_",    "streamline_"};

// Of an earlier run: its tables, and their folder where nothing else is in it; cells that failed; and what only some
// runs leave, by names that other files may have, so that this is for folders of runs alone.
constexpr std::array<std::string_view, 1> failedCells{RunFolder::failedCellPrefix};
constexpr std::array<std::string_view, 6> someLeave{"size_distributions.", "share_distributions.", "classes_", "soot.",
                                                    "spectrum.csv",        "closure.csv"};

void removeTables(const fs::path& folder) {
  const fs::path tables = folder / RunFolder::tableFolder;
  removeFiles(tables, tableKinds, ".csv");
  std::error_code error;
  if (fs::is_directory(tables, error) && fs::is_empty(tables, error)) fs::remove(tables, error);
}

enum class Earlier { refused, replaced, continued };

bool holdsRun(const fs::path& folder) {
  std::error_code error;
  const auto isThere = [&](const char* name) { return fs::exists(folder / name, error); };
  return std::ranges::any_of(runFiles, isThere) || !CheckpointFolder(folder).checkpoints().empty();
}

// The files of an earlier run, but for its checkpoints where it goes on, and those of its runs on coarser meshes.
void removeRun(const fs::path& folder, Earlier earlier) {
  const bool used = holdsRun(folder);
  for (const char* name : runFiles) removeFile(folder / name);
  removeFiles(folder, failedCells, ".yaml");
  if (used) removeFiles(folder, someLeave, ".csv");
  removeTables(folder);
  if (earlier == Earlier::continued) return;
  CheckpointFolder(folder).removeAllBut({});
  std::error_code error;
  for (int level = 1; used; ++level) {
    const fs::path coarser = folder / RunFolder::coarser(level);
    if (!fs::is_directory(coarser, error)) return;
    if (!holdsRun(coarser)) continue;
    removeRun(coarser, earlier);
    if (fs::is_empty(coarser, error)) fs::remove(coarser, error);
  }
}

// Throws on rank 0 only.
std::shared_ptr<FolderLock> prepareHere(const fs::path& path, Earlier earlier) {
  std::error_code error;
  for (fs::path there = path; !there.empty(); there = there.has_relative_path() ? there.parent_path() : fs::path()) {
    if (!fs::exists(there, error)) continue;
    if (fs::is_directory(there, error)) break;
    throw InputError(
        fmt::format("{}: this is a file; the output has to go to a folder. Choose another with --out", there.string()));
  }
  std::shared_ptr<FolderLock> lock;
  if (fs::exists(path, error)) lock = std::make_shared<FolderLock>(path);
  if (earlier == Earlier::refused && holdsRun(path)) {
    throw InputError(
        fmt::format("{}: this folder holds {} already. Choose another with --out DIR, or replace that run with --force",
                    path.string(), stateOf(path)));
  }
  removeRun(path, earlier);
  fs::create_directories(path, error);
  if (error == std::errc::no_space_on_device) refuseWrite(path, error.value());
  if (error) throw InputError(fmt::format("{}: the folder cannot be made: {}", path.string(), error.message()));
  if (!lock) lock = std::make_shared<FolderLock>(path);
  const fs::path probe = path / ".writable";
  if (std::FILE* file = std::fopen(probe.c_str(), "wb")) {
    std::fclose(file);
    fs::remove(probe, error);
  } else {
    if (errno == ENOSPC) refuseWrite(path, errno);
    throw InputError(fmt::format("{}: the folder cannot be written to: {}", path.string(), std::strerror(errno)));
  }
  return lock;
}

std::shared_ptr<FolderLock> prepareTogether(const fs::path& path, Earlier earlier, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::shared_ptr<FolderLock> lock;
  collectively(comm, [&] {
    if (rank == 0) lock = prepareHere(path, earlier);
  });
  return lock;
}

}  // namespace

RunFolder RunFolder::prepare(const fs::path& path, bool force, MPI_Comm comm) {
  return {path, prepareTogether(path, force ? Earlier::replaced : Earlier::refused, comm)};
}

RunFolder RunFolder::resume(const fs::path& path, MPI_Comm comm) {
  return {path, prepareTogether(path, Earlier::continued, comm)};
}

void RunFolder::makeTableFolder() const {
  const fs::path tables = path_ / tableFolder;
  std::error_code error;
  fs::create_directories(tables, error);
  if (error) refuseWrite(tables, error.value());
}

void writeFileAtomically(const fs::path& path, const std::string& content) {
  const fs::path temporary = path.string() + ".tmp";
  std::error_code error;
  int failure = 0;
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (file == nullptr) refuseWrite(path, errno);
  if (std::fwrite(content.data(), 1, content.size(), file) != content.size()) failure = errno;
  if (std::fclose(file) != 0 && failure == 0) failure = errno;
  if (failure == 0) {
    fs::rename(temporary, path, error);
    failure = error.value();
  }
  if (failure == 0) return;
  fs::remove(temporary, error);
  refuseWrite(path, failure);
}

}  // namespace lampblack::io
