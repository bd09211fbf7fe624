// A stochastic population of aggregates of spheres in space in a given gas: births, collisions on straight lines,
// growth on the free surface, sintering. How often particles collide is the kernel's; where and how they touch is drawn
// in space (BallisticJoining). Equal weights with doubling and contraction (EqualWeightMethod). Splitting (Strang
// 1968): births and collisions for half a step, growth and sintering for all of it, births and collisions for half a
// step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"
#include "particles/population/engine/even_births.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"
#include "particles/spheres/sphere_particles.hpp"
#include "particles/spheres/sphere_sintering.hpp"

namespace lampblack::particles {

struct SpherePopulationOptions {
  std::size_t particles = 512;  // most numerical ones, at least 8
  std::uint64_t seed = 1, owner = 0;
  double density = 0;  // kg/m3
  // Of coagulation; the gas gives its gas.
  CollisionKernelOptions kernel{.type = CollisionKernelType::transition};
  SphereCollisionSize size = SphereCollisionSize::shadow;
  double fractalDimension = 1.8;  // of SphereCollisionSize::fractal
  bool coagulation = true;
  SinteringLaw sintering;
  double sinteringTolerance = 1e-4;
  double splitTolerance = 0.05;  // part of the particles that collide, or of a radius that grows, in a step
  double fullAt = 1e18;          // 1/m3, number density at which an empty sample is full first
};

// What the gas does besides collisions.
struct SphereSources {
  double births = 0;   // 1/m3/s
  double nucleus = 0;  // m3, of what is born
  double growth = 0;   // m/s, >= 0, by which the free surface moves outward
};

class SpherePopulation {
 public:
  // InputError.
  explicit SpherePopulation(const SpherePopulationOptions& options);

  // Replaces the population by spheres of these radii (m), `number` (1/m3) in all.
  void fill(std::span<const double> radii, double number);
  // advance() calls it before each event and each step. An exception of it ends advance() in an incomplete state: the
  // population cannot be used further.
  void setCallback(std::function<void()> callback) { callback_ = std::move(callback); }
  // Over dt (s). NumericsError.
  void advance(const CarrierGas& gas, const SphereSources& sources, double dt);

  [[nodiscard]] std::size_t size() const { return method_.size(); }
  [[nodiscard]] double weight() const { return method_.weight(); }  // 1/m3 for a numerical particle
  void forEach(const std::function<void(const SphereParticle&)>& f) const {
    method_.forEachParticle([&](const SphereParticle& p, double) { f(p); });
  }
  [[nodiscard]] std::uint64_t collisions() { return method_.counters().coagulations; }
  [[nodiscard]] std::uint64_t births() { return method_.counters().nucleations; }
  [[nodiscard]] std::uint64_t tries() const { return type_.tries(); }
  [[nodiscard]] std::uint64_t merged() const { return merged_; }  // spheres that became one with a neighbour

 private:
  using Method = EqualWeightMethod<SphereParticles, ClassStore<EqualRates<SphereParticles>>>;
  // What the events of the loop do here.
  struct Events {
    SpherePopulation& of;
    double weight = 0;  // before the event, 1/m3
    void look() {
      if (of.callback_) of.callback_();
    }
    void setTime(double) { weight = of.method_.weight(); }
    void giveBirth();
    template <class Process>
    void take(const Process&, bool happened) {
      if (!happened) ++of.method_.counters().fictitious;
    }
  };
  [[nodiscard]] double stepLength(const SphereSources& sources, double remaining) const;
  void jump(double dt);
  void change(double temperature, double growth, double dt);

  SpherePopulationOptions options_;
  SphereParticles type_;
  RandomStream random_;
  Method method_;
  EvenBirths births_;
  SphereSintering sintering_;
  std::function<void()> callback_;
  double time_ = 0;
  std::uint64_t merged_ = 0;
};

}  // namespace lampblack::particles
