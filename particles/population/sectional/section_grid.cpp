#include "particles/population/sectional/section_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::particles {

SectionGrid::SectionGrid(const SectionalOptions& options) : spacing_(options.spacing) {
  const std::size_t n = options.sections;
  if (n < 20 || n > 400) throw InputError(fmt::format("sections: from 20 to 400, not {}", n));
  if (!(options.smallest > 0) || !std::isfinite(options.smallest)) {
    throw InputError("sections: the volume of the first pivot needs to be above zero");
  }
  if ((spacing_ != 0) == (options.largest != 0)) {
    throw InputError("sections: give either the spacing of the pivots or the volume of the last one");
  }
  if (spacing_ == 0) {
    if (!(options.largest > options.smallest) || !std::isfinite(options.largest)) {
      throw InputError("sections: the volume of the last pivot needs to be above that of the first");
    }
    spacing_ = std::pow(options.largest / options.smallest, 1 / static_cast<double>(n - 1));
  }
  if (!(spacing_ > 1)) throw InputError(fmt::format("sections: the spacing needs to be above 1, not {}", spacing_));
  volumes_.resize(n + 1);
  volumes_[0] = 0;
  for (std::size_t k = 1; k <= n; ++k) volumes_[k] = options.smallest * std::pow(spacing_, static_cast<double>(k - 1));
  if (options.largest > 0) volumes_[n] = options.largest;
  if (!std::isfinite(volumes_[n])) throw InputError("sections: the volume of the last pivot is not finite");
}

SectionGrid::Place SectionGrid::pivotsAround(double volume) const {
  const auto above = std::upper_bound(volumes_.begin(), volumes_.end(), volume);
  const auto k = std::min(static_cast<std::size_t>(above - volumes_.begin()) - 1, last() - 1);
  return {k, (volume - volumes_[k]) / (volumes_[k + 1] - volumes_[k])};
}

double SectionGrid::lowerBoundary(std::size_t k) const {
  const double scale = 2 / (1 + spacing_);
  return k <= last() ? scale * volumes_[k] : scale * spacing_ * volumes_[k - 1];
}

}  // namespace lampblack::particles
