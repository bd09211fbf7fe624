// Inside of SectionalSoot: the number that growth (upwards) or oxidation (downwards) takes from each section to the
// next. With G_k the carbon that aggregates of pivot k gain or lose (kg/m3/s) and D_k the distance to the next pivot
// the flux is
//
//   F_k = (G_k - w_k L_k + w_{k+1} L_{k+1}) / D_k,   w_k = D_k / (D_k + D_{k-1}),
//
// k rising in the direction of the flux. Whatever L, the carbon is exactly the sum of all G. L = 0 is upwind; the
// limited scheme is that of the population balance (section_growth.hpp). Not for other models.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

class SectionFlux {
 public:
  SectionFlux() = default;
  // Downwards what leaves the first section leaves for nothing; upwards nothing may leave the last one.
  SectionFlux(std::span<const double> pivots, bool upwards, bool limited);

  // From `perAggregate` (kg/s, not negative).
  void update(std::span<const double> aggregates);

  std::vector<double> perAggregate;
  std::vector<double> frequency;  // of leaving, 1/s, for aggregates and their primaries alike

  // Calls f(section, d F / d G_k) for the sections whose flux G of section k has an influence on.
  template <class F>
  void forInfluence(std::size_t k, F&& f) const {
    f(k, byThis_[k]);
    if (!limited_) return;
    const std::size_t last = distance_.size() - 1;
    if (k > 0) f(k - 1, (upwards_ ? byDownstream_ : byUpstream_)[k - 1]);
    if (k < last) f(k + 1, (upwards_ ? byUpstream_ : byDownstream_)[k + 1]);
  }

 private:
  std::vector<double> distance_, weight_, gain_;
  std::vector<double> byThis_, byUpstream_, byDownstream_;  // d F_k by G of k, of the one before and after it, 1/kg
  bool upwards_ = true, limited_ = false;
};

}  // namespace lampblack::particles
