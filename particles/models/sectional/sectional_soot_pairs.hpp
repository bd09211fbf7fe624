// Inside of SectionalSoot: coagulation between sections. On a geometric grid the sum of pivots i and i - d lies between
// pivots i + s and i + s + 1 with a shift s that depends on d alone, so that all pairs of one d are loops over
// contiguous arrays. Not for other models.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/models/sectional/sectional_soot_shapes.hpp"

namespace lampblack::particles {

class SectionPairs {
 public:
  struct Gas {
    double freeMolecular, continuum;  // prefactors of the kernels
    bool transition;                  // else free-molecular
  };

  // Partners of a section below `melting` do not keep the primaries of that section.
  SectionPairs(std::span<const double> pivots, double factor, std::size_t melting);

  // Kernels of all pairs, and their derivatives by n_p of either (only needed for addJacobian).
  void updateKernels(const SectionShapes& shapes, const Gas& gas);
  void updateSlopes(const SectionShapes& shapes, const Gas& gas);

  // aggregateRates += ..., primaryRates += ... (1/m3/s); the latter may be empty, with no primaries then.
  void addRates(std::span<const double> aggregates, std::span<const double> primaries, std::span<double> aggregateRates,
                std::span<double> primaryRates);
  // J[row * ld + column] += derivatives; rows and columns are aggregates, then primaries if there are any.
  void addJacobian(const SectionShapes& shapes, std::span<const double> aggregates, std::span<const double> primaries,
                   double* J, std::size_t ld) const;

  // Kernel of two sections, m3/s.
  [[nodiscard]] double kernel(std::size_t i, std::size_t j) const;

 private:
  struct Diagonal {
    std::size_t d, offset, count;  // pairs (t + d, t), t < count, from `offset`
    std::size_t shift, interior;   // those whose sum is below the last pivot come first
    double number[2];              // aggregates that go to the lower and upper pivot
    double primaries[2];           // part of the primaries that goes there
    double ratio;                  // of the smaller pivot to the larger
    double beyond;                 // aggregates of the last pivot for one pair: number = beyond * larger pivot / last
  };

  std::size_t sections_, melting_;
  std::vector<Diagonal> diagonals_;
  std::vector<double> root_, kernel_, slopeLarger_, slopeSmaller_;  // sqrt(1/mi + 1/mj); halved kernels where i = j
  std::vector<double> overLast_;                                    // pivot over the last one
  std::vector<double> events_, larger_, smaller_;
};

}  // namespace lampblack::particles
