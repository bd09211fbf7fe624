// Coalescing spheres of several components, known by the mass of each: organic and inorganic ash on soot, a metal and
// its oxide. Nuclei and condensing material have each a composition of their own; evaporation, oxidation and breakage
// take all components in proportion.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/sphere.hpp"

namespace lampblack::particles {

class Components {
 public:
  static constexpr std::size_t most = 4;

  static constexpr bool moreThanVolume = true;  // see particle_type.hpp

  struct Particle {
    std::array<double, most> mass;  // kg; zero beyond the components there are
  };

  // Densities of the components, kg/m3, and mass fractions of a nucleus and of what condenses; fractions are scaled to
  // a sum of one. The volume is the sum of the components' volumes. Throws InputError for none or more than `most`
  // components, different lengths, densities that are not positive and fractions below zero or all zero.
  Components(std::span<const double> densities, std::span<const double> nucleus, std::span<const double> condensing);

  [[nodiscard]] std::size_t count() const { return count_; }

  [[nodiscard]] double volume(const Particle& p) const {
    double sum = 0;
    for (std::size_t k = 0; k < most; ++k) sum += p.mass[k] * inverseDensity_[k];
    return sum;
  }
  [[nodiscard]] double mass(const Particle& p) const {
    double sum = 0;
    for (const double mass : p.mass) sum += mass;
    return sum;
  }
  [[nodiscard]] double collisionDiameter(const Particle& p) const { return sphere_.collisionDiameter({volume(p)}); }
  [[nodiscard]] double surface(const Particle& p) const { return sphere_.surface({volume(p)}); }

  [[nodiscard]] Particle make(double volume) const { return combined({}, 0, nucleus_, volume); }
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q) const {
    return combined(p.mass, 1, q.mass, 1);
  }
  [[nodiscard]] Particle mean(const Particle& p, double wp, const Particle& q, double wq) const {
    return combined(p.mass, wp / (wp + wq), q.mass, wq / (wp + wq));
  }
  [[nodiscard]] Particle fragment(const Particle& p, double fraction) const {
    return combined(p.mass, fraction, {}, 0);
  }
  [[nodiscard]] Particle grown(const Particle& p, double condensation, double surface, double dt) const {
    const double before = volume(p);
    return enlarged(p, sphere_.grown({before}, condensation, surface, dt).volume - before);
  }
  [[nodiscard]] Particle enlarged(const Particle& p, double change) const {
    if (change > 0) return combined(p.mass, 1, condensing_, change);
    const double before = volume(p);
    return combined(p.mass, change < 0 ? (before + change) / before : 1.0, {}, 0);
  }

 private:
  using Masses = std::array<double, most>;

  [[nodiscard]] static Particle combined(const Masses& x, double a, const Masses& y, double b) {
    Particle result;
    for (std::size_t k = 0; k < most; ++k) result.mass[k] = a * x[k] + b * y[k];
    return result;
  }

  Sphere sphere_{1};
  std::size_t count_;
  Masses inverseDensity_{};
  Masses nucleus_{}, condensing_{};  // kg of each component in 1 m3
};

static_assert(ParticleType<Components>);

}  // namespace lampblack::particles
