#include "particles/population/sectional/section_growth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "particles/population/model/sphere.hpp"

namespace lampblack::particles {

SectionGrowth::SectionGrowth(const SectionGrid& grid, const GrowthOptions& options, SectionGrowthScheme scheme)
    : pivots_(grid.last()), layout_(grid.layout()), scheme_(scheme), overflow_(grid.spacing()) {
  if (!options.active()) return;
  const std::size_t n = pivots_;
  if (options.smallestVolume > grid.volume(1)) {
    throw InputError("sections: the smallest volume of shrinking particles is above the first pivot");
  }
  vanishingVolume_ = std::min(options.smallestVolume, grid.volume(1) / grid.spacing());
  const Sphere spheres(1);  // its surface does not depend on density
  std::vector<double> volumes(n + 2), faster(n + 2, 0.0), slower(n + 2, 0.0);
  std::vector<std::size_t> unknown(n + 2);
  volumes[0] = vanishingVolume_;
  volumes[n + 1] = grid.spacing() * grid.volume(n);
  for (std::size_t k = 1; k <= n; ++k) {
    volumes[k] = grid.volume(k);
    const double rate = options.condensation * volumes[k] + options.surface() * spheres.surface({volumes[k]});
    faster[k] = std::max(rate, 0.0);
    slower[k] = std::max(-rate, 0.0);
    unknown[k] = k;
  }
  unknown[0] = layout_.vanished();
  unknown[n + 1] = layout_.overNumber();
  up_ = direction(volumes, faster, unknown);
  for (auto* list : {&volumes, &slower}) std::reverse(list->begin(), list->end());
  std::reverse(unknown.begin(), unknown.end());
  down_ = direction(volumes, slower, unknown);
}

SectionGrowth::Direction SectionGrowth::direction(const std::vector<double>& volumes, std::vector<double> speed,
                                                  std::vector<std::size_t> unknown) const {
  Direction along;
  along.inverseWidth.assign(volumes.size(), 0.0);
  along.weight.assign(volumes.size(), 0.0);
  for (std::size_t k = 1; k + 1 < volumes.size(); ++k) {
    const double width = std::abs(volumes[k + 1] - volumes[k]), before = std::abs(volumes[k] - volumes[k - 1]);
    along.inverseWidth[k] = 1 / width;
    along.weight[k] = width / (width + before);
  }
  along.active = std::any_of(speed.begin(), speed.end(), [](double v) { return v > 0; });
  along.speed = std::move(speed);
  along.unknown = std::move(unknown);
  return along;
}

SectionGrowth::Limited SectionGrowth::limited(const Direction& along, std::size_t k, const double* y) const {
  if (scheme_ == SectionGrowthScheme::upwind || k < 2 || k > pivots_) return {0, 0, 0};
  const double here = along.speed[k] * y[along.unknown[k]];
  const double upstream = along.speed[k - 1] * y[along.unknown[k - 1]];
  if (here <= 0 || upstream <= 0) return {0, 0, 0};
  if (upstream >= here) return {here, along.speed[k], 0};
  const double r = upstream / here;
  return {upstream * (2 - r), along.speed[k] * r * r, along.speed[k - 1] * 2 * (1 - r)};
}

void SectionGrowth::addRates(const double* y, double* f) const {
  for (const Direction* along : {&up_, &down_}) {
    if (!along->active) continue;
    double here = 0;
    for (std::size_t k = 1; k <= pivots_; ++k) {
      const double next = along->weight[k + 1] * limited(*along, k + 1, y).value;
      const std::size_t from = along->unknown[k], to = along->unknown[k + 1];
      const double flux = (along->speed[k] * y[from] - here + next) * along->inverseWidth[k];
      f[from] -= flux;
      f[to] += flux;
      if (to == layout_.overNumber()) f[layout_.overVolume()] += overflow_ * flux;
      here = next;
    }
  }
}

void SectionGrowth::addJacobian(const double* y, double* J, std::size_t ld) const {
  for (const Direction* along : {&up_, &down_}) {
    if (!along->active) continue;
    for (std::size_t k = 1; k <= pivots_; ++k) {
      const std::size_t from = along->unknown[k], to = along->unknown[k + 1];
      const auto add = [&](std::size_t section, double derivative) {
        if (derivative == 0) return;
        const double value = derivative * along->inverseWidth[k];
        double* column = J + along->unknown[section] * ld;
        column[from] -= value;
        column[to] += value;
        if (to == layout_.overNumber()) column[layout_.overVolume()] += overflow_ * value;
      };
      const Limited here = limited(*along, k, y), next = limited(*along, k + 1, y);
      add(k, along->speed[k] - along->weight[k] * here.byThis + along->weight[k + 1] * next.byUpstream);
      if (k > 1) add(k - 1, -along->weight[k] * here.byUpstream);
      if (k < pivots_) add(k + 1, along->weight[k + 1] * next.byThis);
    }
  }
}

}  // namespace lampblack::particles
