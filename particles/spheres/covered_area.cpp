// The area of the union of discs, from the arcs of its edge (Green's theorem).
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/constants.hpp"
#include "particles/spheres/sphere_measures.hpp"

namespace lampblack::particles {
namespace {

struct Arc {
  double from, to;
};

// What the free arc of a circle, from one angle to another, gives of the integral (x dy - y dx)/2.
double partOfArc(const RigidSphere& disc, double from, double to) {
  const double r = disc.radius;
  return 0.5 * r *
         (r * (to - from) + disc.centre[0] * (std::sin(to) - std::sin(from)) -
          disc.centre[1] * (std::cos(to) - std::cos(from)));
}

}  // namespace

double coveredArea(std::span<const RigidSphere> discs) {
  // By where they begin along x, so that only those at hand are looked at.
  std::vector<RigidSphere> sorted(discs.begin(), discs.end());
  std::ranges::sort(sorted, {}, [](const RigidSphere& d) { return d.centre[0]; });
  double widest = 0;
  for (const RigidSphere& d : sorted) widest = std::max(widest, d.radius);
  std::vector<Arc> covered;
  double area = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const RigidSphere& disc = sorted[i];
    covered.clear();
    bool isHidden = false;
    const auto cover = [&](std::size_t j) {
      const double dx = sorted[j].centre[0] - disc.centre[0], dy = sorted[j].centre[1] - disc.centre[1];
      const double square = dx * dx + dy * dy, both = disc.radius + sorted[j].radius;
      if (square >= both * both) return;
      const double apart = std::sqrt(square), more = sorted[j].radius - disc.radius;
      if (apart <= more) {  // of two that are the same the first one counts
        isHidden = isHidden || more > 0 || j < i;
        return;
      }
      if (apart <= -more) return;
      const double cosine =
          (square + disc.radius * disc.radius - sorted[j].radius * sorted[j].radius) / (2 * apart * disc.radius);
      const double half = std::acos(std::clamp(cosine, -1.0, 1.0)), middle = std::atan2(dy, dx);
      const double from = middle - half, to = middle + half, pi = constants::pi;
      if (from < -pi) {
        covered.push_back({from + 2 * pi, pi});
        covered.push_back({-pi, to});
      } else if (to > pi) {
        covered.push_back({from, pi});
        covered.push_back({-pi, to - 2 * pi});
      } else {
        covered.push_back({from, to});
      }
    };
    const double range = disc.radius + widest;
    for (std::size_t j = i; j-- > 0 && sorted[j].centre[0] > disc.centre[0] - range;) cover(j);
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].centre[0] < disc.centre[0] + range; ++j) cover(j);
    if (isHidden) continue;
    std::ranges::sort(covered, {}, &Arc::from);
    double at = -constants::pi;
    for (const Arc& arc : covered) {
      if (arc.from > at) area += partOfArc(disc, at, arc.from);
      at = std::max(at, arc.to);
    }
    if (at < constants::pi) area += partOfArc(disc, at, constants::pi);
  }
  return area;
}

}  // namespace lampblack::particles
