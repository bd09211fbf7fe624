// A folder that all ranks of a test share and no other run of the test does, gone at the end.
#pragma once

#include <mpi.h>

#include "tests/every_module.hpp"
#include "tests/scratch.hpp"
#include "tests/world.hpp"

namespace lampblack::test {

// Making it and ending it are collective on all ranks.
class SharedScratchFolder {
 public:
  SharedScratchFolder() {
    std::string name;
    if (worldRank() == 0) name = makeScratchFolder().string();
    auto size = static_cast<int>(name.size());
    MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
    name.resize(static_cast<std::size_t>(size));
    MPI_Bcast(name.data(), size, MPI_CHAR, 0, MPI_COMM_WORLD);
    path_ = name;
  }
  ~SharedScratchFolder() {
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code ignored;
    if (worldRank() == 0) std::filesystem::remove_all(path_, ignored);
  }
  SharedScratchFolder(const SharedScratchFolder&) = delete;
  SharedScratchFolder& operator=(const SharedScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace lampblack::test
