#include "flow/flame/flame_profile.hpp"

#include <algorithm>

namespace lampblack::flow {

double FlameProfile::peakTemperature() const {
  double peak = 0;
  for (std::size_t i = 0; i < points(); ++i) peak = std::max(peak, temperature(i));
  return peak;
}

FlameProfile withLayout(const FlameProfile& from, const FlameLayout& layout) {
  FlameProfile to{layout, from.z, {}};
  to.x.assign(to.size(), 0.0);
  const std::size_t species = std::min(from.layout.species, layout.species);
  const std::size_t scalars = std::min(from.layout.scalars, layout.scalars);
  for (std::size_t i = 0; i < from.points(); ++i) {
    for (std::size_t c = 0; c < FlameLayout::firstSpecies + species; ++c) to.at(i, c) = from.at(i, c);
    for (std::size_t s = 0; s < scalars; ++s) to.at(i, layout.firstScalar() + s) = from.scalars(i)[s];
  }
  for (std::size_t g = 0; g < numFlameGlobals; ++g)
    to.global(static_cast<FlameGlobal>(g)) = from.global(static_cast<FlameGlobal>(g));
  return to;
}

}  // namespace lampblack::flow
