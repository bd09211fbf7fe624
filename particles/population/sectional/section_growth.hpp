// Condensation, surface growth and oxidation: a flux of number from each pivot to the next one, upwards or downwards.
// With G_k = N_k dv/dt(v_k) and D_k = v_{k+1} - v_k the flux upwards is
//
//   F_k = (G_k - w_k L_k + w_{k+1} L_{k+1}) / D_k,   w_k = D_k / (D_k + D_{k-1}).
//
// Every choice of L conserves number and gives the volume exactly sum G_k. L = 0 is upwind. L = G would keep the rate
// of the second moment exact as well but makes wiggles and negative numbers; the limited scheme has, with r =
// G_{k-1}/G_k,
//
//   L_k = G_k where r > 1,  G_k (1 - (1 - r)^2) elsewhere, in the sense of the flux limiters of Sweby (1984).
//
// The limiter is close to G where the spectrum is smooth and goes to upwind at steep fronts. Its first derivative has
// no jump, which implicit integration likes. No number becomes negative.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/sectional/section_grid.hpp"

namespace lampblack::particles {

class SectionGrowth {
 public:
  // What leaves the first pivot downwards has the volume options.smallestVolume, but no more than a section below that
  // pivot, and vanishes. The section at zero does not grow. Throws InputError where the smallest volume is above the
  // first pivot.
  SectionGrowth(const SectionGrid& grid, const GrowthOptions& options, SectionGrowthScheme scheme);

  void addRates(const double* y, double* f) const;
  void addJacobian(const double* y, double* J, std::size_t ld) const;
  [[nodiscard]] double vanishingVolume() const { return vanishingVolume_; }  // m3, of each particle that vanishes

 private:
  // One direction, with sections in its order: entry 0 is upstream of the first pivot, entry n + 1 beyond the last.
  struct Direction {
    std::vector<std::size_t> unknown;  // of entry k
    std::vector<double> speed;         // dv/dt in this direction or zero, m3/s
    std::vector<double> inverseWidth;  // 1 / D_k
    std::vector<double> weight;        // w_k
    bool active = false;
  };
  struct Limited {
    double value, byThis, byUpstream;  // L_k and its derivatives by N_k and N_{k-1}
  };

  [[nodiscard]] Direction direction(const std::vector<double>& volumes, std::vector<double> speed,
                                    std::vector<std::size_t> unknown) const;
  [[nodiscard]] Limited limited(const Direction& along, std::size_t k, const double* y) const;

  std::size_t pivots_;
  SectionLayout layout_;
  SectionGrowthScheme scheme_;
  double vanishingVolume_ = 0;
  double overflow_ = 1;  // volume of what passes the last pivot, in units of that pivot
  Direction up_, down_;
};

}  // namespace lampblack::particles
