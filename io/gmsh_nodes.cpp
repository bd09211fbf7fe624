#include "io/gmsh_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/errors.hpp"
#include "core/rank_exchange.hpp"

namespace lampblack::io {
namespace {

std::vector<int> ranksOfTags(MPI_Comm comm, std::span<const std::int64_t> tags) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<int> result;
  result.reserve(tags.size());
  for (const std::int64_t tag : tags) {
    // 2^64 over the golden ratio: tags with gaps of any regular size are spread evenly.
    const std::uint64_t hash = static_cast<std::uint64_t>(tag) * 0x9E3779B97F4A7C15U;
    result.push_back(static_cast<int>((hash >> 32U) % static_cast<std::uint64_t>(ranks)));
  }
  return result;
}

}  // namespace

GmshNodeDirectory::GmshNodeDirectory(MPI_Comm comm, std::span<const std::int64_t> tags, std::int64_t first)
    : comm_(comm) {
  const RankExchange exchange(comm, ranksOfTags(comm, tags));
  std::vector<std::int64_t> positions(tags.size());
  std::iota(positions.begin(), positions.end(), first);
  const std::vector<std::int64_t> theirTags = exchange.send(tags, 1);
  const std::vector<std::int64_t> theirPositions = exchange.send(positions, 1);
  collectively(comm, [&] {
    entries_.reserve(theirTags.size());
    for (std::size_t i = 0; i < theirTags.size(); ++i) entries_.emplace_back(theirTags[i], theirPositions[i]);
    // Gmsh itself writes them in order.
    if (!std::ranges::is_sorted(entries_)) std::ranges::sort(entries_);
    const auto twice = std::ranges::adjacent_find(entries_, {}, [](const auto& entry) { return entry.first; });
    if (twice != entries_.end())
      throw InputError(
          fmt::format("section $Nodes: two nodes have the tag {}; the file is damaged: save it again", twice->first));
  });
}

std::vector<std::int64_t> GmshNodeDirectory::positionsOf(std::span<const std::int64_t> tags) const {
  const RankExchange exchange(comm_, ranksOfTags(comm_, tags));
  std::vector<std::int64_t> answers = exchange.send(tags, 1);
  for (std::int64_t& value : answers) {
    const auto found = std::ranges::lower_bound(entries_, value, {}, [](const auto& entry) { return entry.first; });
    value = found != entries_.end() && found->first == value ? found->second : -1;
  }
  return exchange.reply(answers, 1);
}

}  // namespace lampblack::io
