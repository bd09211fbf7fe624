// From moments to the nodes and weights of Gaussian quadrature: the n points that have the same first 2 n moments.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/modules.hpp"
#include "particles/population/moments/moment_options.hpp"

namespace lampblack::particles {

struct MomentQuadrature {
  static constexpr std::size_t most = 4;
  std::size_t count = 0;
  std::array<double, most> nodes{}, weights{};  // nodes increase
};

// The rule of moments.size()/2 nodes (2 to 8 moments), or of fewer where the moments are those of a population of fewer
// sizes, to round-off, or of none with that many positive sizes. No nodes where m_0 or m_1 is not above zero.
[[nodiscard]] MomentQuadrature momentQuadrature(std::span<const double> moments, QuadratureInversion inversion);

}  // namespace lampblack::particles
