// One of each type of particles, and what is extensive in each: what coagulation adds and breakage shares out.
#pragma once

#include <array>
#include <vector>

#include "particles/population/model/components.hpp"
#include "particles/population/model/fractal_aggregate.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/model/surface_volume.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

static_assert(ParticleType<Sphere>);

inline std::vector<double> extensive(const Sphere::Particle& p) {
  return {p.volume};
}
inline std::vector<double> extensive(const SurfaceVolume::Particle& p) {
  return {p.volume, p.surface};
}
inline std::vector<double> extensive(const Components::Particle& p) {
  return {p.mass.begin(), p.mass.end()};
}

template <class Type>
Type makeType();
template <>
inline Sphere makeType<Sphere>() {
  return Sphere(1800);
}
template <>
inline FractalAggregate makeType<FractalAggregate>() {
  return FractalAggregate(1800, 20e-9, 1.8);
}
template <>
inline SurfaceVolume makeType<SurfaceVolume>() {
  return SurfaceVolume(1800);
}
template <>
inline Components makeType<Components>() {
  return Components(std::array{1800.0, 1000.0, 4000.0}, std::array{0.5, 0.0, 0.5}, std::array{1.0, 3.0, 0.0});
}

// Volume of a sphere, m3.
inline double ball(double diameter) {
  return constants::pi / 6 * diameter * diameter * diameter;
}

}  // namespace lampblack::test
