// Sintering of an aggregate of spheres: the two of each neck move towards each other and the volume of both stays, so
// that their radii grow; necks with others keep their radius, and all behind a neck moves with it. Spheres that have
// become one are merged. By the law of grain-boundary diffusion, or of viscous flow with the time of any other law
// (Eggersdorfer, Kadau, Herrmann, Pratsinis 2011). docs/theory/spheres.md.
#pragma once

#include <cstdint>
#include <vector>

#include "core/modules.hpp"
#include "numerics/bogacki_shampine.hpp"
#include "particles/spheres/sintering_law.hpp"
#include "particles/spheres/sphere_aggregate.hpp"

namespace lampblack::particles {

// Rate (1/s times the length) at which the centres of two spheres come nearer, given by their radii and the square of
// the radius of their neck, which is not zero.
[[nodiscard]] double approachRate(const SinteringLaw& law, double temperature, double first, double second,
                                  double neck);

class SphereSintering {
 public:
  // `tolerance`: relative error of a step in the sixth power of a neck's radius. InputError.
  explicit SphereSintering(const SinteringLaw& law, double tolerance = 1e-4);

  // Over a time (s) at a temperature (K). NumericsError.
  void advance(SphereAggregate& aggregate, double temperature, double time);
  // Area (m2/s, >= 0) by which the surface shrinks now. NumericsError.
  [[nodiscard]] double surfaceRate(const SphereAggregate& aggregate, double temperature);
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  // Radius of a neck in point contact, over that of the smaller sphere, as sintering begins.
  static constexpr double firstNeck = 0.01;

 private:
  void rates(std::span<const double> state, std::vector<double>& to);
  void begin(const SphereAggregate& aggregate, double temperature);
  bool setRadii(std::span<const double> state);
  bool mergeAtOnce(SphereAggregate& aggregate, double shortest) const;  // s
  [[nodiscard]] bool isPastMerging(std::span<const double> state) const;

  SinteringLaw law_;
  double tolerance_, temperature_ = 0;
  std::uint64_t steps_ = 0;
  const SphereAggregate* aggregate_ = nullptr;
  std::vector<double> state_, trial_, smallest_, radii_, volumes_, slopes_, necks_;
  numerics::BogackiShampine step_;
};

}  // namespace lampblack::particles
