#include "core/grading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"

namespace lampblack {

namespace {

double cellsOf(const AxisSegment& segment, double refinement) {
  return std::max(1.0, std::round(segment.cells * refinement));
}

}  // namespace

double gradedCells(const std::vector<AxisSegment>& segments, double refinement) {
  double cells = 0.0;
  for (const AxisSegment& segment : segments) cells += cellsOf(segment, refinement);
  return cells;
}

std::vector<double> gradedAxis(double from, const std::vector<AxisSegment>& segments, double refinement) {
  if (segments.empty()) throw InputError("a mesh axis needs at least one segment");
  if (!(refinement > 0.0) || !std::isfinite(refinement))
    throw InputError(fmt::format("mesh refinement must be positive, found {}", refinement));
  if (const double cells = gradedCells(segments, refinement); cells > std::numeric_limits<int>::max())
    throw InputError(fmt::format("a mesh axis has {:.6g} cells; at most {}", cells, std::numeric_limits<int>::max()));
  std::vector<double> vertices{from};
  for (const AxisSegment& segment : segments) {
    if (segment.cells < 1) throw InputError(fmt::format("a mesh axis segment has {} cells; at least 1", segment.cells));
    if (!(segment.to > vertices.back()) || !std::isfinite(segment.to))
      throw InputError(
          fmt::format("a mesh axis segment ends at {} m, not beyond its start at {} m", segment.to, vertices.back()));
    if (!(segment.ratio > 0.0) || !std::isfinite(segment.ratio))
      throw InputError(fmt::format("grading ratio must be positive, found {}", segment.ratio));
    const int cells = static_cast<int>(cellsOf(segment, refinement));
    const double start = vertices.back();
    const double length = segment.to - start;
    // Cell sizes form a geometric series with last/first = ratio.
    const double growth = cells > 1 ? std::pow(segment.ratio, 1.0 / (cells - 1)) : 1.0;
    double total = 0.0;
    for (int i = 0; i < cells; ++i) total += std::pow(growth, i);
    double sum = 0.0;
    for (int i = 0; i + 1 < cells; ++i) {
      sum += std::pow(growth, i);
      vertices.push_back(start + length * sum / total);
    }
    vertices.push_back(segment.to);
  }
  return vertices;
}

}  // namespace lampblack
