// Aggregates of spheres in space as a type of particles (particle_type.hpp). They have no mean and no pieces, as trees
// have none. A particle shares its aggregate with its copies until it changes.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/cube_root.hpp"
#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/spheres/ballistic_joining.hpp"
#include "particles/spheres/sphere_measures.hpp"

namespace lampblack::particles {

// Diameter of collision: of the sphere with the mean shadow along three lines at right angles, which no process
// chooses; or a power of the number of spheres times their mean diameter.
enum class SphereCollisionSize { shadow, fractal };

struct SphereParticle {
  std::shared_ptr<const SphereAggregate> aggregate;
  double volume = 0, surface = 0, collision = 0;  // m3, m2, m
};

class SphereParticles {
 public:
  using Particle = SphereParticle;
  static constexpr bool moreThanVolume = true;

  SphereParticles(double density, SphereCollisionSize size, double fractalDimension)
      : density_(density), size_(size), fractalDimension_(fractalDimension) {}

  [[nodiscard]] double volume(const Particle& p) const { return p.volume; }
  [[nodiscard]] double mass(const Particle& p) const { return density_ * p.volume; }
  [[nodiscard]] double surface(const Particle& p) const { return p.surface; }
  [[nodiscard]] double collisionDiameter(const Particle& p) const { return p.collision; }
  [[nodiscard]] double fractalDimension() const { return fractalDimension_; }

  [[nodiscard]] Particle make(double volume) const {
    return made(SphereAggregate(cubeRoot(volume * 3 / (4 * constants::pi))));
  }
  [[nodiscard]] Particle made(SphereAggregate&& aggregate) const {
    Particle p{nullptr, aggregate.volume(), aggregate.surface(), collisionDiameter(aggregate)};
    p.aggregate = std::make_shared<const SphereAggregate>(std::move(aggregate));
    return p;
  }
  [[nodiscard]] Particle coagulated(Particle&& p, Particle&& q, RandomStream& random) const {
    return made(joining_->join(*p.aggregate, *q.aggregate, random));
  }
  [[nodiscard]] std::uint64_t tries() const { return joining_->tries(); }  // lines drawn by all collisions

 private:
  [[nodiscard]] double collisionDiameter(const SphereAggregate& aggregate) const {
    if (aggregate.count() == 1) return 2 * aggregate.spheres()[0].radius;
    if (size_ == SphereCollisionSize::shadow) return shadowDiameter(shadowAlongAxes(aggregate));
    return 2 * meanRadius(aggregate) * std::pow(static_cast<double>(aggregate.count()), 1 / fractalDimension_);
  }

  double density_;
  SphereCollisionSize size_;
  double fractalDimension_;
  std::shared_ptr<BallisticJoining> joining_ = std::make_shared<BallisticJoining>();
};

}  // namespace lampblack::particles
