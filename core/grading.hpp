// Vertex positions along one axis of a box mesh, made of segments with geometric grading.
#pragma once

#include <vector>

namespace lampblack {

// One stretch of an axis: it ends at `to` (m) and has `cells` cells; `ratio` is the size of its last cell over its
// first (1: uniform).
struct AxisSegment {
  double to = 0.0;
  int cells = 0;
  double ratio = 1.0;
};

// Cells of all segments when `refinement` multiplies each one's count (rounded, at least 1); whole, but in floating
// point: a deck may ask for more than there are integers.
double gradedCells(const std::vector<AxisSegment>& segments, double refinement = 1.0);

// Vertices (m), increasing, from `from` through all segments: sum of cells + 1 values. `refinement` multiplies every
// segment's cell count as in gradedCells. InputError for zero cells, more than 32 bits hold, ends that do not increase
// or ratio <= 0.
std::vector<double> gradedAxis(double from, const std::vector<AxisSegment>& segments, double refinement = 1.0);

}  // namespace lampblack
