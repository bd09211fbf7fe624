// Coagulation between sections. On a geometric grid the sum of pivots i and i - d lies between pivots i + s and
// i + s + 1 with a shift s that depends on d alone, so that all pairs of one d are loops over contiguous arrays.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/population/sectional/section_grid.hpp"

namespace lampblack::particles {

class SectionCoagulation {
 public:
  // The kernel is evaluated here, once, for coalescing spheres of this density (kg/m3).
  SectionCoagulation(const SectionGrid& grid, const CollisionKernel& kernel, double density);

  // f += rates (1/m3/s) of all unknowns of the layout.
  void addRates(const double* y, double* f);
  // J[i + ld j] += d f_i / d y_j.
  void addJacobian(const double* y, double* J, std::size_t ld) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Diagonal {
    std::size_t d, shift;
    std::size_t offset;    // of its first pair in the arrays
    std::size_t count;     // of its pairs
    std::size_t interior;  // those whose sum is at most the last pivot come first
  };

  SectionLayout layout_;
  std::vector<Diagonal> diagonals_;
  std::vector<double> rate_;      // K, half of it for pairs of one pivot
  std::vector<double> upper_;     // part of the number that goes to the upper pivot; beyond the end: volume / last
  std::vector<double> withZero_;  // K of the section at zero with all sections; the first is halved
  std::vector<double> events_, smaller_, larger_, made_, flux_;
};

}  // namespace lampblack::particles
