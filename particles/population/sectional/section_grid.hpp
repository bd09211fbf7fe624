// The sections of the volume axis: one at volume zero, then pivots in a geometric row. What lies between two of them is
// divided between both so that number and volume are kept (Kumar and Ramkrishna 1996); for that the section at zero is
// the lower neighbour of the first pivot. That section holds number without volume: the part of the number that a
// coarse view of what is smaller than the first pivot needs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/sectional/sectional_options.hpp"

namespace lampblack::particles {

// Where the unknowns of the sectional method are: number densities of the sections (1/m3), then what has left them.
struct SectionLayout {
  std::size_t sections;                                              // with that at zero
  [[nodiscard]] std::size_t overNumber() const { return sections; }  // beyond the last pivot, 1/m3
  // Volume beyond the last pivot in units of that pivot, 1/m3.
  [[nodiscard]] std::size_t overVolume() const { return sections + 1; }
  [[nodiscard]] std::size_t vanished() const { return sections + 2; }  // shrunk away below the first pivot, 1/m3
  [[nodiscard]] std::size_t size() const { return sections + 3; }
};

class SectionGrid {
 public:
  // 1 - upper of the number goes to section `lower`, the rest to the next one.
  struct Place {
    std::size_t lower;
    double upper;
  };

  explicit SectionGrid(const SectionalOptions& options);  // throws InputError

  // Section k = 0 is at volume zero, k = 1 ... last() are the pivots.
  [[nodiscard]] std::size_t last() const { return volumes_.size() - 1; }
  [[nodiscard]] SectionLayout layout() const { return {volumes_.size()}; }
  [[nodiscard]] double volume(std::size_t k) const { return volumes_[k]; }  // m3
  [[nodiscard]] std::span<const double> volumes() const { return volumes_; }
  [[nodiscard]] double spacing() const { return spacing_; }
  // For a volume from zero to the last pivot.
  [[nodiscard]] Place pivotsAround(double volume) const;
  // The harmonic mean of pivot k and the one below it, also for k = 1 and k = last() + 1. A uniform density between
  // lowerBoundary(k) and lowerBoundary(k + 1) has its mean in pivot k.
  [[nodiscard]] double lowerBoundary(std::size_t k) const;

 private:
  double spacing_;
  std::vector<double> volumes_;
};

}  // namespace lampblack::particles
