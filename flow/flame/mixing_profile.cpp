#include "flow/flame/mixing_profile.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

constexpr std::size_t points = 401;
constexpr int passes = 60;
constexpr double relaxation = 0.3;  // share of the new density that is taken over

double between(const std::vector<double>& z, const std::vector<double>& values, double at) {
  const auto above = std::upper_bound(z.begin() + 1, z.end() - 1, at);
  const auto i = static_cast<std::size_t>(above - z.begin());
  const double t = std::clamp((at - z[i - 1]) / (z[i] - z[i - 1]), 0.0, 1.0);
  return values[i - 1] + t * (values[i] - values[i - 1]);
}

// Integral from the first point to each, by trapezia.
std::vector<double> integral(const std::vector<double>& z, const std::vector<double>& f) {
  std::vector<double> sum(z.size(), 0.0);
  for (std::size_t i = 1; i < z.size(); ++i) sum[i] = sum[i - 1] + 0.5 * (f[i - 1] + f[i]) * (z[i] - z[i - 1]);
  return sum;
}

// Where falling values pass zero.
double zeroOf(const std::vector<double>& z, const std::vector<double>& falling) {
  std::size_t i = 1;
  while (i + 1 < z.size() && falling[i] > 0) ++i;
  const double drop = falling[i - 1] - falling[i];
  return drop > 0 ? std::clamp(z[i - 1] + (z[i] - z[i - 1]) * falling[i - 1] / drop, z[i - 1], z[i]) : z[i];
}

}  // namespace

double MixingProfile::shareAt(double at) const {
  return between(z, share, at);
}
double MixingProfile::spreadAt(double at) const {
  return between(z, spread, at);
}

MixingProfile mixOpposedStreams(const OpposedStreams& s) {
  MixingProfile p;
  for (std::size_t i = 0; i < points; ++i)
    p.z.push_back(s.length * static_cast<double>(i) / static_cast<double>(points - 1));
  const double rightDensity = s.density(0);
  const double leftDensity = s.density(1);
  double plane = s.stagnationPlane;
  if (!s.potential) {
    const double pull = s.leftFlux / std::sqrt(leftDensity);
    plane = s.length * pull / (pull + s.rightFlux / std::sqrt(rightDensity));
  }
  p.share.assign(points, 0.0);
  std::vector<double> density(points), inverse(points), exponent(points), weight(points), sideways(points);
  for (std::size_t i = 0; i < points; ++i) {
    p.share[i] = p.z[i] < plane ? 1 : 0;
    density[i] = s.density(p.share[i]);
  }
  p.spread.assign(points, 0.0);
  std::vector<double> flux(points);
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < points; ++i) {
      const double shape = s.potential ? 1.0 : std::min(p.z[i] / plane, (s.length - p.z[i]) / (s.length - plane));
      p.spread[i] = shape / std::sqrt(density[i]);
      sideways[i] = 2 * density[i] * p.spread[i];
    }
    const auto lost = integral(p.z, sideways);
    const double factor =
        s.potential ? s.strainRate * std::sqrt(rightDensity) : (s.leftFlux + s.rightFlux) / lost.back();
    p.lambda = -factor * factor;
    p.leftFlux = s.potential ? factor * between(p.z, lost, plane) : s.leftFlux;
    for (std::size_t i = 0; i < points; ++i) {
      p.spread[i] *= factor;
      flux[i] = p.leftFlux - factor * lost[i];
      inverse[i] = flux[i] / s.conductivityOverCp(p.share[i]);
    }
    if (!s.potential) plane += 0.5 * (zeroOf(p.z, flux) - plane);
    if (!(plane > 0 && plane < s.length)) throw NumericsError("flame: the streams do not meet within the domain");
    const auto slope = integral(p.z, inverse);
    const double most = *std::ranges::max_element(slope);
    for (std::size_t i = 0; i < points; ++i) weight[i] = std::exp(slope[i] - most) / s.conductivityOverCp(p.share[i]);
    const auto mixed = integral(p.z, weight);
    for (std::size_t i = 0; i < points; ++i) {
      p.share[i] += relaxation * (1 - mixed[i] / mixed.back() - p.share[i]);
      density[i] = s.density(p.share[i]);
    }
  }
  return p;
}

}  // namespace lampblack::flow
