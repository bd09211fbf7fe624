#include "particles/population/model/surface_volume.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace lampblack::particles {

SurfaceVolume::SurfaceVolume(double density, double fractalDimension, double sinteringTime)
    : density_(density), inverseDimension_(1 / fractalDimension), sinteringTime_(sinteringTime) {
  if (!(density > 0)) throw InputError("aggregates: the density needs to be above zero");
  if (!(fractalDimension >= 1 && fractalDimension <= 3)) {
    throw InputError(fmt::format("aggregates: the fractal dimension needs to be in [1, 3], not {}", fractalDimension));
  }
  if (!(sinteringTime > 0)) throw InputError("aggregates: the sintering time needs to be above zero");
}

SurfaceVolume::Particle SurfaceVolume::grown(const Particle& p, double condensation, double surface, double dt) const {
  const double halfSintering = std::isinf(sinteringTime_) ? 1.0 : std::exp(-0.5 * dt / sinteringTime_);
  const auto sintered = [&](const Particle& x) {
    if (halfSintering == 1) return x;
    const double sphere = sphereSurface(x.volume);
    return Particle{x.volume, sphere + (x.surface - sphere) * halfSintering};
  };
  Particle x = sintered(p);
  const double e = std::expm1(condensation * dt / 3);
  // Of the diameters at the end and at the beginning.
  double ratio = 1 + e;
  if (surface != 0) ratio += 2 * surface * (condensation != 0 ? 3 * e / condensation : dt) / primaryDiameter(x);
  if (!(ratio > 0)) return {0, 0};
  x.volume *= ratio * ratio * ratio;
  x.surface *= ratio * ratio;
  return sintered(x);
}

}  // namespace lampblack::particles
