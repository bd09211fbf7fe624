#include "particles/models/sectional/sectional_soot_flux.hpp"

namespace lampblack::particles {

SectionFlux::SectionFlux(std::span<const double> pivots, bool upwards, bool limited)
    : upwards_(upwards), limited_(limited) {
  const std::size_t n = pivots.size();
  const double beyond = pivots[n - 1] * pivots[1] / pivots[0];
  const auto pivot = [&](std::size_t k) { return k < n ? pivots[k] : beyond; };
  for (std::size_t k = 0; k < n; ++k) {
    const double above = pivot(k + 1) - pivot(k), below = k > 0 ? pivot(k) - pivot(k - 1) : pivot(0);
    distance_.push_back(upwards ? above : below);
    weight_.push_back((upwards ? above : below) / (above + below));
  }
  for (auto* values : {&perAggregate, &frequency, &gain_, &byUpstream_, &byDownstream_}) values->assign(n, 0);
  for (const double d : distance_) byThis_.push_back(1 / d);
}

void SectionFlux::update(std::span<const double> aggregates) {
  const std::size_t n = distance_.size();
  if (!limited_) {
    for (std::size_t k = 0; k < n; ++k) frequency[k] = perAggregate[k] / distance_[k];
    return;
  }
  for (std::size_t k = 0; k < n; ++k) {
    gain_[k] = perAggregate[k] * aggregates[k];
    byThis_[k] = 1;
    byUpstream_[k] = byDownstream_[k] = 0;
    frequency[k] = 1;  // over the upwind one, for the time being
  }
  // Between each section and the one upstream of it: L of the section, in the fluxes of both.
  for (std::size_t k = upwards_ ? 1 : 0; k < (upwards_ ? n : n - 1); ++k) {
    const std::size_t upstream = upwards_ ? k - 1 : k + 1;
    const double here = gain_[k], before = gain_[upstream], w = weight_[k];
    if (!(here > 0) || !(before > 0)) continue;
    if (before >= here) {
      frequency[k] -= w;
      frequency[upstream] += w * here / before;
      byThis_[k] -= w;
      byDownstream_[upstream] += w;
      continue;
    }
    const double r = before / here, byHere = r * r, byBefore = 2 * (1 - r);
    frequency[k] -= w * r * (2 - r);
    frequency[upstream] += w * (2 - r);
    byThis_[k] -= w * byHere;
    byUpstream_[k] -= w * byBefore;
    byThis_[upstream] += w * byBefore;
    byDownstream_[upstream] += w * byHere;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double inverse = 1 / distance_[k];
    frequency[k] *= perAggregate[k] * inverse;
    byThis_[k] *= inverse;
    byUpstream_[k] *= inverse;
    byDownstream_[k] *= inverse;
  }
}

}  // namespace lampblack::particles
