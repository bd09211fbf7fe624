// Profiles on other grids (flame_grid.hpp).
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "flow/flame/flame_grid.hpp"
#include "numerics/monotone_cubic.hpp"

namespace lampblack::flow {
namespace {

// Interval of rising z in which a point lies, by its lower end; the last or first one beyond.
std::size_t intervalOf(std::span<const double> z, double at) {
  const auto after = std::upper_bound(z.begin() + 1, z.end() - 1, at);
  return static_cast<std::size_t>(after - z.begin()) - 1;
}

// What is needed of the interval: weights of the values and slopes at both ends.
struct CubicWeights {
  CubicWeights(double from, double to, double at) {
    const double h = to - from;
    const double t = std::clamp((at - from) / h, 0.0, 1.0);
    const double s = 1 - t;
    value1 = t * t * (3 - 2 * t);
    slope0 = h * t * s * s;
    slope1 = -h * t * t * s;
    straight = t;
  }
  double value1, slope0, slope1, straight;
};

// Places of the mass fluxes: the left end, the faces between the points, the right end.
std::vector<double> facesOf(std::span<const double> z) {
  std::vector<double> faces{z.front()};
  for (std::size_t i = 0; i + 1 < z.size(); ++i) faces.push_back(0.5 * (z[i] + z[i + 1]));
  faces.push_back(z.back());
  return faces;
}

void interpolateMassFlux(const FlameProfile& from, FlameProfile& to) {
  const auto oldFaces = facesOf(from.z);
  const auto newFaces = facesOf(to.z);
  const auto flux = [&](std::size_t face) {
    return face == 0 ? from.global(leftMassFlux) : from.at(face - 1, FlameLayout::massFlux);
  };
  for (std::size_t f = 0; f < newFaces.size(); ++f) {
    const std::size_t i = intervalOf(oldFaces, newFaces[f]);
    const double t = std::clamp((newFaces[f] - oldFaces[i]) / (oldFaces[i + 1] - oldFaces[i]), 0.0, 1.0);
    const double value = flux(i) + t * (flux(i + 1) - flux(i));
    (f == 0 ? to.global(leftMassFlux) : to.at(f - 1, FlameLayout::massFlux)) = value;
  }
}

}  // namespace

FlameProfile onGrid(const FlameProfile& profile, std::span<const double> z) {
  const auto rising = [](std::span<const double> x) {
    return x.size() >= 2 && std::ranges::adjacent_find(x, std::greater_equal<>()) == x.end();
  };
  if (!rising(z) || !rising(profile.z)) throw InputError("grid: two points or more are needed, in rising order");
  const FlameLayout& layout = profile.layout;
  const std::size_t n = profile.points();
  const std::size_t width = layout.width();
  FlameProfile result;
  result.layout = layout;
  result.z.assign(z.begin(), z.end());
  result.x.assign(result.size(), 0.0);
  std::copy(profile.x.end() - numFlameGlobals, profile.x.end(), result.x.end() - numFlameGlobals);
  interpolateMassFlux(profile, result);

  std::vector<double> slopes(n * width);
  std::vector<double> values(n), d(n);
  for (std::size_t c = FlameLayout::spread; c < width; ++c) {
    for (std::size_t i = 0; i < n; ++i) values[i] = profile.at(i, c);
    numerics::monotoneSlopes(profile.z, values, d);
    for (std::size_t i = 0; i < n; ++i) slopes[i * width + c] = d[i];
  }
  for (std::size_t p = 0; p < z.size(); ++p) {
    const std::size_t i = intervalOf(profile.z, z[p]);
    const CubicWeights w(profile.z[i], profile.z[i + 1], z[p]);
    double sum = 0, straightSum = 0;
    for (std::size_t c = FlameLayout::spread; c < width; ++c) {
      const double a = profile.at(i, c), b = profile.at(i + 1, c);
      // In this order the values at both ends are met exactly.
      const double base = w.straight < 1 ? a + w.value1 * (b - a) : b;
      const double value = base + w.slope0 * slopes[i * width + c] + w.slope1 * slopes[(i + 1) * width + c];
      result.at(p, c) = value;
      if (c >= FlameLayout::firstSpecies && c < layout.firstScalar()) {
        sum += value;
        straightSum += a + w.straight * (b - a);
      }
    }
    if (sum <= 0 || w.straight <= 0 || w.straight >= 1) continue;
    for (std::size_t k = 0; k < layout.species; ++k) result.at(p, FlameLayout::firstSpecies + k) *= straightSum / sum;
  }
  return result;
}

FlameProfile widened(const FlameProfile& profile, double left, double right) {
  if (!(left >= 0 && right >= 0)) throw InputError("grid: a domain is widened by lengths that are not negative");
  constexpr double growth = 1.5;
  // Offsets from the end, to exactly `length`, of spacings that grow from `first`.
  const auto offsets = [](double first, double length) {
    std::vector<double> at;
    if (length == 0) return at;
    double sum = 0;
    for (double h = growth * first; sum < length; h *= growth) at.push_back(sum += h);
    // A scale of at most 1 that makes the last one the length.
    for (double& x : at) x *= length / sum;
    return at;
  };
  const std::size_t n = profile.points();
  const auto before = offsets(profile.z[1] - profile.z[0], left);
  const auto after = offsets(profile.z[n - 1] - profile.z[n - 2], right);
  const double start = profile.z.front();
  FlameProfile moved = profile;
  for (double& z : moved.z) z += left;
  std::vector<double> z;
  for (auto x = before.rbegin(); x != before.rend(); ++x) z.push_back(start + left - *x);
  if (!before.empty()) z.front() = start;
  z.insert(z.end(), moved.z.begin(), moved.z.end());
  for (double x : after) z.push_back(moved.z.back() + x);
  FlameProfile result = onGrid(moved, z);
  // The points that were there keep their values to the last digit; fluxes keep to their faces, which may have moved at
  // the old ends.
  const std::size_t width = profile.layout.width();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < width; ++c) result.at(before.size() + i, c) = profile.at(i, c);
  return result;
}

}  // namespace lampblack::flow
