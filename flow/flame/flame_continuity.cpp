#include "flow/flame/flame_continuity.hpp"

#include <cmath>

#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

// What leaves the volume of point i sideways, per unit of V.
double sideways(const FlameProfile& profile, std::span<const double> density, std::size_t i) {
  const std::size_t last = profile.points() - 1;
  const double low = i == 0 ? profile.z[0] : 0.5 * (profile.z[i - 1] + profile.z[i]);
  const double high = i == last ? profile.z[last] : 0.5 * (profile.z[i] + profile.z[i + 1]);
  return 2 * density[i] * (high - low);
}

}  // namespace

void setMassFlux(FlameProfile& profile, std::span<const double> density, double left) {
  profile.global(leftMassFlux) = left;
  double flux = left;
  for (std::size_t i = 0; i < profile.points(); ++i) {
    flux -= sideways(profile, density, i) * profile.at(i, FlameLayout::spread);
    profile.at(i, FlameLayout::massFlux) = flux;
  }
}

double scaleSpreading(FlameProfile& profile, std::span<const double> density, double left, double right) {
  double sum = 0;
  for (std::size_t i = 0; i < profile.points(); ++i)
    sum += sideways(profile, density, i) * profile.at(i, FlameLayout::spread);
  const double factor = (left - right) / sum;
  if (!std::isfinite(factor))
    throw NumericsError("flame: a profile that does not spread cannot take streams to the side");
  for (std::size_t i = 0; i < profile.points(); ++i) profile.at(i, FlameLayout::spread) *= factor;
  profile.global(pressureGradient) *= factor * factor;
  setMassFlux(profile, density, left);
  profile.at(profile.points() - 1, FlameLayout::massFlux) = right;
  return factor;
}

}  // namespace lampblack::flow
