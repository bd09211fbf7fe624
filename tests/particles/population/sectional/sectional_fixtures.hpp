// What the tests of the sectional method share.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/random.hpp"
#include "particles/population/sectional/section_grid.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

inline SectionalOptions gridOf(std::size_t sections, double smallest, double largest) {
  SectionalOptions options;
  options.sections = sections;
  options.smallest = smallest;
  options.largest = largest;
  return options;
}

inline SectionalOptions spacedGrid(std::size_t sections, double smallest, double spacing) {
  SectionalOptions options;
  options.sections = sections;
  options.smallest = smallest;
  options.spacing = spacing;
  return options;
}

// A rough spectrum over four decades of number.
inline std::vector<double> roughSpectrum(const SectionLayout& layout) {
  RandomStream random(7, 0, 0);
  std::vector<double> y(layout.size(), 0.0);
  for (std::size_t k = 0; k < layout.sections; ++k) y[k] = std::pow(10.0, 4 * random.uniform());
  return y;
}

// What all unknowns hold, with f their values or rates.
inline double numberOf(const SectionLayout& layout, const std::vector<double>& f) {
  double sum = f[layout.overNumber()] + f[layout.vanished()];
  for (std::size_t k = 0; k < layout.sections; ++k) sum += f[k];
  return sum;
}
inline double volumeOf(const SectionGrid& grid, const std::vector<double>& f, double vanishingVolume = 0) {
  const SectionLayout layout = grid.layout();
  double sum = f[layout.overVolume()] * grid.volume(grid.last()) + f[layout.vanished()] * vanishingVolume;
  for (std::size_t k = 0; k < layout.sections; ++k) sum += f[k] * grid.volume(k);
  return sum;
}

}  // namespace lampblack::test
