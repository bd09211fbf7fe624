// What a particle is. A method of the population balance is a template over a type of particles, a small class that
// says how particles are made, joined, split and grown; the methods know nothing else about them. A new kind of
// particle - a connectivity tree, an aggregate of molecules - is a new class with these members, and no method changes.
#pragma once

#include <concepts>
#include <utility>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/model/collision_kernel.hpp"

namespace lampblack::particles {

//
// What methods of equal weights ask for; coagulated() as in joined() below.
template <class Type>
concept CoagulatingType = std::copyable<typename Type::Particle> &&
    requires(const Type type, const typename Type::Particle p, double x) {
  { type.volume(p) } -> std::convertible_to<double>;             // m3; orders the particles, moments are of it
  { type.mass(p) } -> std::convertible_to<double>;               // kg
  { type.surface(p) } -> std::convertible_to<double>;            // m2
  { type.collisionDiameter(p) } -> std::convertible_to<double>;  // m
  // A particle of this volume, as nucleation and the initial population make it.
  { type.make(x) } -> std::same_as<typename Type::Particle>;
};

// And those of different weights, and growth and breakage in any.
template <class Type>
concept ParticleType = CoagulatingType<Type> && requires(const Type type, const typename Type::Particle p, double x) {
  { type.coagulated(p, p) } -> std::same_as<typename Type::Particle>;
  // The weighted mean of two, conserving every extensive quantity: (w1 p1 + w2 p2) / (w1 + w2).
  { type.mean(p, x, p, x) } -> std::same_as<typename Type::Particle>;
  // A piece with this fraction of the volume.
  { type.fragment(p, x) } -> std::same_as<typename Type::Particle>;
  // After `dt` (s) of dv/dt = condensation v + surface S; a volume of zero or less when nothing is left.
  { type.grown(p, x, x, x) } -> std::same_as<typename Type::Particle>;
};

// A type of which particles change while nobody looks (deferred growth, see deferred_growth.hpp) has five more members,
// which the functions below use: properties(kernel, p) as of now; exists(p), false for what has shrunk to nothing;
// terms(kernel, p), bounds until the end of the step; orderVolume(p), constant until the end of the step; largest(p, f)
// of a monotone f(volume) until then.

// A type of which not every collision joins two particles has a member sticking(p, q), from 0 to 1, a factor of the
// kernel.

// A type whose pairs may pass each other where the kernel has them collide has meet(p, q, RandomStream&), which draws
// whether they do; methods of equal weights ask for it.

// Two particles as one. A type whose particles join at a place that is drawn has coagulated(Particle&&, Particle&&,
// RandomStream&).
template <class Type>
[[nodiscard, gnu::always_inline]] inline typename Type::Particle joined(const Type& type, typename Type::Particle& p,
                                                                        typename Type::Particle& q,
                                                                        RandomStream& random) {
  if constexpr (requires { type.coagulated(std::move(p), std::move(q), random); }) {
    return type.coagulated(std::move(p), std::move(q), random);
  } else {
    return type.coagulated(p, q);
  }
}

// What the kernel asks for, and no more: a diameter costs a cube root.
template <class Type>
[[nodiscard]] CollisionKernel::Properties kernelProperties(const CollisionKernel& kernel, const Type& type,
                                                           const typename Type::Particle& particle) {
  if constexpr (requires { type.properties(kernel, particle); }) {
    return type.properties(kernel, particle);
  } else {
    CollisionKernel::Properties properties;
    properties.volume = type.volume(particle);
    if (kernel.needsDiameter()) {
      properties.mass = type.mass(particle);
      properties.diameter = type.collisionDiameter(particle);
    }
    return properties;
  }
}

// False only for what waits to be removed; all its rates are zero.
template <class Type>
[[nodiscard]] bool exists(const Type& type, const typename Type::Particle& particle) {
  if constexpr (requires { type.exists(particle); }) {
    return type.exists(particle);
  } else {
    return true;
  }
}

// Terms of the majorant.
template <class Type>
[[nodiscard]] CollisionKernel::Terms kernelTerms(const CollisionKernel& kernel, const Type& type,
                                                 const typename Type::Particle& particle) {
  if constexpr (requires { type.terms(kernel, particle); }) {
    return type.terms(kernel, particle);
  } else {
    return kernel.terms(kernelProperties(kernel, type, particle));
  }
}

// The volume (m3) that stores sort and class by.
template <class Type>
[[nodiscard]] double orderVolume(const Type& type, const typename Type::Particle& particle) {
  if constexpr (requires { type.orderVolume(particle); }) {
    return type.orderVolume(particle);
  } else {
    return type.volume(particle);
  }
}

// The largest value that a monotone function of the volume may have; bound of the rate of a process.
template <class Type, class F>
[[nodiscard]] double largest(const Type& type, const typename Type::Particle& particle, F&& f) {
  if constexpr (requires { type.largest(particle, f); }) {
    return type.largest(particle, f);
  } else {
    return f(type.volume(particle));
  }
}

// The particle after its volume has changed by `change` (m3) by growth, above minus the volume. A type of which grown()
// does more than to add a new particle, or to leave a piece, has a member enlarged(p, change).
template <class Type>
[[nodiscard]] typename Type::Particle enlarged(const Type& type, const typename Type::Particle& particle,
                                               double change) {
  if constexpr (requires { type.enlarged(particle, change); }) {
    return type.enlarged(particle, change);
  } else if (change > 0) {
    return type.coagulated(particle, type.make(change));
  } else {
    const double volume = type.volume(particle);
    return type.fragment(particle, (volume + change) / volume);
  }
}

// Whether particles of one volume may differ, so that a method must not keep them as a number: a static constant of the
// type, false where it has none.
template <class Type>
[[nodiscard]] constexpr bool moreThanVolume() {
  if constexpr (requires { Type::moreThanVolume; }) {
    return Type::moreThanVolume;
  } else {
    return false;
  }
}

// How the diameter of collision goes with the volume of large particles, d_c ~ v^(1/D): D is the member
// fractalDimension() of the type, 3 where it has none.
template <class Type>
[[nodiscard]] double fractalDimension(const Type& type) {
  if constexpr (requires { type.fractalDimension(); }) {
    return type.fractalDimension();
  } else {
    return 3;
  }
}

}  // namespace lampblack::particles
