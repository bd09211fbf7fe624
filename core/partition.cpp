#include "core/partition.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack {

std::vector<int> partitionGraph(const std::vector<std::int64_t>& start, const std::vector<std::int64_t>& neighbours,
                                const std::vector<double>& weight, int parts) {
  const std::size_t vertices = start.size() - 1;
  if (parts <= 1) return std::vector<int>(vertices, 0);
  if (vertices < static_cast<std::size_t>(parts))
    throw InputError(fmt::format("the mesh has {} cells, fewer than the {} ranks it is to be spread over", vertices, parts));

  std::vector<idx_t> rowStart(start.begin(), start.end());
  std::vector<idx_t> adjacency(neighbours.begin(), neighbours.end());
  std::vector<idx_t> vertexWeight;
  if (!weight.empty()) {
    // METIS takes integers: the mean weight becomes 1000.
    double sum = 0.0;
    for (double w : weight) sum += w;
    const double scale = 1000.0 * static_cast<double>(vertices) / sum;
    for (double w : weight) vertexWeight.push_back(std::max<idx_t>(1, static_cast<idx_t>(std::lround(w * scale))));
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_CONTIG] = 0;
  idx_t vertexCount = static_cast<idx_t>(vertices);
  idx_t constraints = 1;
  idx_t partCount = parts;
  idx_t cut = 0;
  std::vector<idx_t> part(vertices);
  const int status =
      METIS_PartGraphRecursive(&vertexCount, &constraints, rowStart.data(), adjacency.data(),
                               vertexWeight.empty() ? nullptr : vertexWeight.data(), nullptr, nullptr, &partCount,
                               nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK) throw NumericsError(fmt::format("METIS could not partition the mesh (status {})", status));
  return {part.begin(), part.end()};
}

}  // namespace lampblack
