#include "io/run_folder.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

namespace lampblack {
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
  if (record.find("\"status\": \"running\"") != std::string::npos) {
    return "a run that is still going or was cut off";
  }
  return fs::exists(folder / "results.h5") ? "the results of a run" : "parts of a run";
}

void removeFailedCells(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(RunFolder::failedCellPrefix) || !name.ends_with(".yaml")) continue;
    fs::remove(entry.path(), error);
    if (error) throw InputError(fmt::format("{}: cannot be removed: {}", entry.path().string(), error.message()));
  }
}

// Throws on rank 0 only.
void prepareHere(const fs::path& path, bool force) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_directory(path, error)) {
    throw InputError(
        fmt::format("{}: this is a file; the output has to go to a folder. Choose another with --out", path.string()));
  }
  bool used = false;
  for (const char* name : runFiles) used = used || fs::exists(path / name, error);
  if (used && !force) {
    throw InputError(
        fmt::format("{}: this folder holds {} already. Choose another with --out DIR, or replace that run with --force",
                    path.string(), stateOf(path)));
  }
  for (const char* name : runFiles) {
    fs::remove(path / name, error);
    if (error) {
      throw InputError(fmt::format("{}: cannot be removed: {}", (path / name).string(), error.message()));
    }
  }
  removeFailedCells(path);
  fs::create_directories(path, error);
  if (error) throw InputError(fmt::format("{}: the folder cannot be made: {}", path.string(), error.message()));
  const fs::path probe = path / ".writable";
  if (std::FILE* file = std::fopen(probe.c_str(), "wb")) {
    std::fclose(file);
    fs::remove(probe, error);
  } else {
    throw InputError(fmt::format("{}: the folder cannot be written to: {}", path.string(), std::strerror(errno)));
  }
}

}  // namespace

RunFolder RunFolder::prepare(const fs::path& path, bool force, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  collectively(comm, [&] {
    if (rank == 0) prepareHere(path, force);
  });
  return RunFolder(path);
}

void writeFileAtomically(const fs::path& path, const std::string& content) {
  const fs::path temporary = path.string() + ".tmp";
  std::error_code error;
  {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file << content;
    file.flush();
    if (!file) throw InputError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
  }
  fs::rename(temporary, path, error);
  if (error) throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
}

}  // namespace lampblack
