// Values and majorants of CollisionKernel, inline as they are in the innermost loops. Included by collision_kernel.hpp.
#pragma once

#include <span>

#include "core/modules.hpp"
#include "numerics/lanes.hpp"
#include "particles/population/model/collision_kernel.hpp"

namespace lampblack::particles {

inline double CollisionKernel::collisionRate(const Properties& i, const Properties& j) const {
  const double sum = i.diameter + j.diameter;
  switch (options_.type) {
    case CollisionKernelType::constant:
      return options_.rate;
    case CollisionKernelType::additive:
      return options_.rate * (i.volume + j.volume);
    case CollisionKernelType::multiplicative:
      return options_.rate * i.volume * j.volume;
    case CollisionKernelType::freeMolecular:
      return freeMolecular_ * std::sqrt((i.mass + j.mass) / (i.mass * j.mass)) * sum * sum;
    case CollisionKernelType::continuum:
      return continuum_ * (slipOver(i.diameter) + slipOver(j.diameter)) * sum;
    case CollisionKernelType::transition: {
      const double continuum = continuum_ * (slipOver(i.diameter) + slipOver(j.diameter)) * sum;
      return harmonicMean(freeMolecular_ * std::sqrt((i.mass + j.mass) / (i.mass * j.mass)) * sum * sum, continuum);
    }
    case CollisionKernelType::transitionFuchs: {
      // 1/K = 1/F + x/C with x = (di + dj) / (di + dj + 2g), g^2 = gi^2 + gj^2: the harmonic mean of F and C/x.
      const double si = slipOver(i.diameter), sj = slipOver(j.diameter);
      const double gi = reach(i, si) - i.diameter, gj = reach(j, sj) - j.diameter;
      const double continuum = continuum_ * (si + sj) * (sum + std::sqrt(gi * gi + gj * gj));
      return harmonicMean(freeMolecular_ * std::sqrt((i.mass + j.mass) / (i.mass * j.mass)) * sum * sum, continuum);
    }
    case CollisionKernelType::shear:
      return options_.shearRate / 6 * sum * sum * sum;
    case CollisionKernelType::gravitational:
      return 0.25 * constants::pi * sum * sum * std::abs(settling(i) - settling(j));
  }
  return 0;
}

inline double CollisionKernel::value(const Properties& i, const Properties& j) const {
  return efficiency(i, j) * collisionRate(i, j);
}

[[gnu::always_inline]] inline CollisionKernel::Terms CollisionKernel::transitionTerms(const Properties& x) const {
  // Both are the harmonic mean H of F and C' with C' <= k (Ci/di + Cj/dj) (ei + ej), e = d + 2g (g = 0 without
  // Fuchs), since sqrt(gi^2 + gj^2) <= gi + gj; H = min over t of t^2 F + (1 - t)^2 C', so that any t gives a bound
  // by the bounds of the two limits. The factors t^2 and (1 - t)^2 are in the scales.
  const double d = x.diameter, root = 1 / std::sqrt(x.mass), square = freeMolecularScale_ * d * d;
  if (continuumScale_ == 0) return {{square * root, square, 0}, {1, root, 0}};
  const double slipOverDiameter = slipOver(d), e = reach(x, slipOverDiameter);
  const double slip = continuumScale_ * slipOverDiameter;
  return {{square * root + slip * e, square, slip}, {1, root, e}};
}

inline CollisionKernel::Terms CollisionKernel::terms(const Properties& x) const {
  const double d = x.diameter;
  switch (options_.type) {
    case CollisionKernelType::constant:  // exact
      return {{scale_}, {1}};
    case CollisionKernelType::additive:  // exact
      return {{scale_ * x.volume}, {1}};
    case CollisionKernelType::multiplicative:  // exact
      return {{scale_ * x.volume}, {x.volume}};
    case CollisionKernelType::freeMolecular: {
      // sqrt(1/mi + 1/mj) <= 1/sqrt(mi) + 1/sqrt(mj) and (di + dj)^2 <= 2 (di^2 + dj^2) (Goodson and Kraft 2002); for
      // spheres of one density at most twice the kernel.
      const double root = 1 / std::sqrt(x.mass), square = freeMolecularScale_ * d * d;
      return {{square * root, square}, {1, root}};
    }
    case CollisionKernelType::continuum: {  // exact: Ci + Cj + (Ci/di) dj + (Cj/dj) di
      const double slip = continuumScale_ * slipOver(d);
      return {{slip * d, slip}, {1, d}};
    }
    case CollisionKernelType::transition:
    case CollisionKernelType::transitionFuchs:
      return transitionTerms(x);
    case CollisionKernelType::shear:  // exact: di^3 + dj^3 + 3 di^2 dj + 3 di dj^2
      return {{scale_ * d * d * d, 3 * scale_ * d * d}, {1, d}};
    case CollisionKernelType::gravitational: {  // |vi - vj| <= |vi| + |vj|
      const double v = std::abs(settling(x)), square = scale_ * d * d;
      return {{square * v, square, 2 * scale_ * d * v}, {1, v, d}};
    }
  }
  return {};
}

// The largest of a_i and zero.
inline double largestOf(const double* a, std::size_t n) {
  numerics::Lanes most{};
  std::size_t i = 0;
  for (; i + numerics::laneCount <= n; i += numerics::laneCount) {
    const numerics::Lanes v = numerics::loadLanes(a + i);
    most = v > most ? v : most;
  }
  double largest = 0;
  for (std::size_t k = 0; k < numerics::laneCount; ++k) largest = std::max(largest, most[k]);
  for (; i < n; ++i) largest = std::max(largest, a[i]);
  return largest;
}

inline CollisionKernel::Terms CollisionKernel::largestTerms(std::span<const Properties> particles) const {
  Terms most;
  if (options_.type != CollisionKernelType::transition) {
    for (const Properties& x : particles) {
      const Terms one = terms(x);
      for (std::size_t r = 0; r < rank_; ++r) {
        most.p[r] = std::max(most.p[r], one.p[r]);
        most.q[r] = std::max(most.q[r], one.q[r]);
      }
    }
    return most;
  }
  constexpr std::size_t atATime = 64;
  double values[2 * largestRank][atATime];
  for (std::size_t first = 0; first < particles.size(); first += atATime) {
    const std::size_t n = std::min(atATime, particles.size() - first);
    for (std::size_t k = 0; k < n; ++k) {
      const Terms one = transitionTerms(particles[first + k]);
      for (std::size_t r = 0; r < largestRank; ++r) {
        values[r][k] = one.p[r];
        values[largestRank + r][k] = one.q[r];
      }
    }
    for (std::size_t r = 0; r < largestRank; ++r) {
      most.p[r] = std::max(most.p[r], largestOf(values[r], n));
      most.q[r] = std::max(most.q[r], largestOf(values[largestRank + r], n));
    }
  }
  return most;
}

template <class ForEach>
void CollisionKernel::tune(ForEach&& forEach) {
  if (!tunable_) return;
  double root = 0, square = 0, rootSquare = 0, slip = 0, reached = 0, slipReached = 0, count = 0;
  forEach([&](const Properties& x, double weight = 1) {
    const double r = 1 / std::sqrt(x.mass), s = x.diameter * x.diameter;
    // Slip to 16 %, without an exponential: where the totals matter to the mixture, that is some tenths of a per cent
    // of its own.
    const double c = (1 + 1.4 * twiceMeanFreePath_ / x.diameter) / x.diameter, e = reach(x, c);
    root += weight * r;
    square += weight * s;
    rootSquare += weight * r * s;
    slip += weight * c;
    reached += weight * e;
    slipReached += weight * c * e;
    count += weight;
  });
  // The totals of the bounds of the two limits; the best mixture gives their harmonic mean. Where that is hardly less
  // than the free-molecular one alone, terms are better without slip.
  const double free = 2 * freeMolecular_ * (count * rootSquare + root * square);
  const double continuum = continuum_ * (count * slipReached + slip * reached);
  mix(free > 0.02 * continuum ? continuum / (free + continuum) : 1);
}

}  // namespace lampblack::particles
