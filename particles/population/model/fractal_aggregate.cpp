#include "particles/population/model/fractal_aggregate.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace lampblack::particles {

FractalAggregate::FractalAggregate(double density, double primaryDiameter, double fractalDimension)
    : sphere_(density),
      primaryDiameter_(primaryDiameter),
      primaryVolume_(constants::pi / 6 * primaryDiameter * primaryDiameter * primaryDiameter),
      inverseDimension_(1 / fractalDimension) {
  if (!(density > 0) || !(primaryDiameter > 0)) {
    throw InputError("aggregates: density and primary diameter need to be above zero");
  }
  if (!(fractalDimension >= 1 && fractalDimension <= 3)) {
    throw InputError(fmt::format("aggregates: the fractal dimension needs to be in [1, 3], not {}", fractalDimension));
  }
}

FractalAggregate::Particle FractalAggregate::grown(const Particle& p, double condensation, double surface,
                                                   double dt) const {
  const double rate = condensation + 6 * surface / primaryDiameter_;
  if (p.volume > primaryVolume_) {
    const double end = p.volume * std::exp(rate * dt);
    if (end >= primaryVolume_) return {end};
    const double reached = std::log(primaryVolume_ / p.volume) / rate;
    return sphere_.grown({primaryVolume_}, condensation, surface, dt - reached);
  }
  const Particle end = sphere_.grown(p, condensation, surface, dt);
  if (end.volume <= primaryVolume_) return end;
  // The time at which the diameter, with dd/dt = condensation d / 3 + 2 surface, is that of a primary.
  const double d = sphere_.collisionDiameter(p), gap = primaryDiameter_ - d;
  const double reached = condensation != 0
                             ? 3 / condensation * std::log1p(condensation * gap / (condensation * d + 6 * surface))
                             : gap / (2 * surface);
  return {primaryVolume_ * std::exp(rate * (dt - reached))};
}

}  // namespace lampblack::particles
