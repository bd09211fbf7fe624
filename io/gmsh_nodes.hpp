// Tags of nodes may be any numbers in any order. Which node has a tag is known to the rank that the tag's hash names,
// so that no rank holds them all: 16 bytes a node of its share.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::io {

class GmshNodeDirectory {
 public:
  // Collective. `tags`: of this rank's nodes, whose positions in the file are `first` and those that follow.
  // InputError, without the name of the file, where two nodes have the same tag.
  GmshNodeDirectory(MPI_Comm comm, std::span<const std::int64_t> tags, std::int64_t first);

  // Collective. The position in the file of the node of each tag, -1 where there is none.
  [[nodiscard]] std::vector<std::int64_t> positionsOf(std::span<const std::int64_t> tags) const;

 private:
  MPI_Comm comm_;
  std::vector<std::pair<std::int64_t, std::int64_t>> entries_;  // tag and position, by tag
};

}  // namespace lampblack::io
