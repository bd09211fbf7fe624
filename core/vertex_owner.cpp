#include "core/vertex_owner.hpp"

#include <algorithm>
#include <cstddef>

#include "core/rank_exchange.hpp"

namespace lampblack {

VertexOwner::VertexOwner(MPI_Comm comm, const MeshBlock& block)
    : comm_(comm), block_(block), shares_(comm, block.firstVertex, block.totalVertices) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<std::vector<std::array<std::int64_t, 2>>> toOwner(static_cast<std::size_t>(ranks));
  for (const auto& [image, original] : block.periodic)
    toOwner[static_cast<std::size_t>(shares_.rankOf(image))].push_back({image, original});
  for (const auto& [image, original] : sendToRanks(comm, toOwner).values) originals_[image] = original;
  followImages();
  hasImages_ = originals_.empty() ? 0 : 1;
  MPI_Allreduce(MPI_IN_PLACE, &hasImages_, 1, MPI_INT, MPI_MAX, comm);
}

std::vector<VertexOwner::Vertex> VertexOwner::vertices(const std::vector<std::int64_t>& wanted) {
  std::vector<char> isUsed(block_.vertices.size(), 0);
  std::vector<Vertex> result = ask<Vertex>(comm_, shares_, wanted, [&](std::int64_t number) {
    const auto own = static_cast<std::size_t>(number - block_.firstVertex);
    isUsed[own] = 1;
    return Vertex{block_.vertices[own], originalOf(number), number};
  });
  std::int64_t used = std::count(isUsed.begin(), isUsed.end(), 1), before = 0;
  MPI_Exscan(&used, &before, 1, MPI_INT64_T, MPI_SUM, comm_);
  MPI_Allreduce(&used, &total_, 1, MPI_INT64_T, MPI_SUM, comm_);
  if (total_ == block_.totalVertices) return result;
  std::vector<std::int64_t> newNumber;
  newNumber.reserve(isUsed.size());
  for (const char use : isUsed) {
    newNumber.push_back(before);
    before += use;
  }
  const auto renumbered = ask<std::int64_t>(comm_, shares_, wanted, [&](std::int64_t number) {
    return newNumber[static_cast<std::size_t>(number - block_.firstVertex)];
  });
  for (std::size_t i = 0; i < result.size(); ++i) result[i].number = renumbered[i];
  return result;
}

std::int64_t VertexOwner::originalOf(std::int64_t number) const {
  const auto found = originals_.find(number);
  return found == originals_.end() ? number : found->second;
}

void VertexOwner::followImages() {
  for (int changed = 1; changed != 0;) {
    std::vector<std::int64_t> images, originals;
    for (const auto& [image, original] : originals_) {
      images.push_back(image);
      originals.push_back(original);
    }
    const auto further =
        ask<std::int64_t>(comm_, shares_, originals, [&](std::int64_t number) { return originalOf(number); });
    changed = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (further[i] == originals[i]) continue;
      originals_[images[i]] = further[i];
      changed = 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, comm_);
  }
}

}  // namespace lampblack
