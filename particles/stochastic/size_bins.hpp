// Equal bins of the logarithm of a diameter.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

struct SizeBins {
  double logMin = -9.2, logMax = -6.2;  // log10(d/m)
  std::size_t count = 60;

  [[nodiscard]] double width() const { return (logMax - logMin) / static_cast<double>(count); }
  // The bin of a diameter (m); `count` outside.
  [[nodiscard]] std::size_t of(double diameter) const { return ofLog(std::log10(diameter)); }
  [[nodiscard]] std::size_t ofLog(double logDiameter) const {  // log10(d/m)
    const double x = (logDiameter - logMin) / width();
    return x >= 0 && x < static_cast<double>(count) ? static_cast<std::size_t>(x) : count;
  }
  [[nodiscard]] double edge(std::size_t bin) const {  // m, its lower one
    return std::pow(10.0, logMin + width() * static_cast<double>(bin));
  }
  [[nodiscard]] std::vector<double> edges() const {  // m, count + 1
    std::vector<double> all;
    for (std::size_t b = 0; b <= count; ++b) all.push_back(edge(b));
    return all;
  }
};

}  // namespace lampblack::particles
