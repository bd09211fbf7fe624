#include "core/partition.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/errors.hpp"

namespace lampblack {
namespace {

// METIS takes whole weights and sums them in idx_t: the mean becomes 1000, or what 2^30 in all leaves to each. Empty
// (equal weights) when the weights have no positive, finite sum.
std::vector<idx_t> wholeWeights(const std::vector<double>& weight) {
  const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
  if (!(sum > 0.0) || !std::isfinite(sum)) return {};
  const double scale = std::min(1000.0 * static_cast<double>(weight.size()), 0x1p30) / sum;
  std::vector<idx_t> whole;
  for (double w : weight) whole.push_back(std::max<idx_t>(1, static_cast<idx_t>(std::lround(w * scale))));
  return whole;
}

// Runs of successive vertices of about equal weight, for graphs too small for METIS (which then complains on stdout).
std::vector<int> partitionInOrder(std::size_t vertices, const std::vector<idx_t>& weight, int parts) {
  const double total =
      weight.empty() ? static_cast<double>(vertices) : std::accumulate(weight.begin(), weight.end(), 0.0);
  std::vector<int> part;
  double before = 0.0;
  for (std::size_t v = 0; v < vertices; ++v) {
    const double own = weight.empty() ? 1.0 : static_cast<double>(weight[v]);
    const int wanted = static_cast<int>((before + 0.5 * own) / total * parts);
    // At most one part further than the last vertex, and no further back than leaves a vertex to every part to come.
    const int furthest = part.empty() ? 0 : part.back() + 1;
    const int nearest = std::max(part.empty() ? 0 : part.back(), parts - static_cast<int>(vertices - v));
    part.push_back(std::clamp(wanted, nearest, std::min(furthest, parts - 1)));
    before += own;
  }
  return part;
}

// METIS may leave a part empty when one vertex outweighs the others; such a part takes a vertex from the part that has
// most of them.
void fillEmptyParts(std::vector<idx_t>& part, int parts) {
  std::vector<int> size(static_cast<std::size_t>(parts), 0);
  for (idx_t p : part) ++size[static_cast<std::size_t>(p)];
  for (int p = 0; p < parts; ++p) {
    if (size[static_cast<std::size_t>(p)] > 0) continue;
    const auto largest = std::max_element(size.begin(), size.end());
    *std::find(part.begin(), part.end(), static_cast<idx_t>(largest - size.begin())) = p;
    --*largest;
    ++size[static_cast<std::size_t>(p)];
  }
}

}  // namespace

std::vector<int> partitionGraph(const std::vector<std::int64_t>& start, const std::vector<std::int64_t>& neighbours,
                                const std::vector<double>& weight, int parts) {
  const std::size_t vertices = start.size() - 1;
  if (parts <= 1) return std::vector<int>(vertices, 0);
  if (vertices < static_cast<std::size_t>(parts))
    throw InputError(
        fmt::format("the mesh has {} cells, fewer than the {} ranks it is to be spread over", vertices, parts));

  constexpr std::size_t fewVertices = 8;  // a part
  std::vector<idx_t> vertexWeight = wholeWeights(weight);
  if (vertices < fewVertices * static_cast<std::size_t>(parts)) return partitionInOrder(vertices, vertexWeight, parts);

  std::vector<idx_t> rowStart(start.begin(), start.end());
  std::vector<idx_t> adjacency(neighbours.begin(), neighbours.end());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_CONTIG] = 0;
  idx_t vertexCount = static_cast<idx_t>(vertices);
  idx_t constraints = 1;
  idx_t partCount = parts;
  idx_t cut = 0;
  std::vector<idx_t> part(vertices);
  const int status = METIS_PartGraphRecursive(&vertexCount, &constraints, rowStart.data(), adjacency.data(),
                                              vertexWeight.empty() ? nullptr : vertexWeight.data(), nullptr, nullptr,
                                              &partCount, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK) throw NumericsError(fmt::format("METIS could not partition the mesh (status {})", status));
  fillEmptyParts(part, parts);
  return {part.begin(), part.end()};
}

}  // namespace lampblack
