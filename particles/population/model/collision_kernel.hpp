// Collision kernels of the population balance (m3/s) with a majorant that factorises. The majorant of a pair is
//
//   sum over r < rank of  p_r(i) q_r(j) + p_r(j) q_r(i)  >=  K(i, j)
//
// so that its sum over all unordered pairs is sum_r (sum_i p_r(i)) (sum_j q_r(j)), self-pairs included as fictitious
// ones, and a pair is drawn by one draw in proportion to p_r and one in proportion to q_r. A pair drawn so is accepted
// with probability K / majorant: the jumps that remain have exactly the rates of the kernel (Eibeck and Wagner 2000;
// Goodson and Kraft 2002). Each bound is proved beside its terms, in collision_terms.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

#include "particles/collisions/collision_physics.hpp"

namespace lampblack::particles {

enum class CollisionKernelType {
  constant,         // A
  additive,         // A (u + v)
  multiplicative,   // A u v
  freeMolecular,    // Wang (2025), eq. 9-28
  continuum,        // with slip, Wang (2025), eq. 9-29
  transition,       // harmonic mean of the two, Wang (2025), eq. 9-30
  transitionFuchs,  // Fuchs interpolation (Fuchs 1964; Seinfeld and Pandis, table 13.1)
  shear,            // laminar shear, rate/6 (di + dj)^3 (Smoluchowski 1917)
  gravitational     // pi/4 (di + dj)^2 |vi - vj| with the settling velocities of Stokes, with slip and buoyancy
};

[[nodiscard]] std::string_view nameOf(CollisionKernelType type);  // as messages call it: "free-molecular", ...

struct CollisionKernelOptions {
  CollisionKernelType type = CollisionKernelType::constant;
  double rate = 0;  // A of the first three: m3/s, 1/s, 1/(m3 s)
  CarrierGas gas{};
  double enhancement = 1;  // of free-molecular collisions (van der Waals)
  double shearRate = 0;    // 1/s
  SlipLaw slip = SlipLaw::davies;
  // Probability that a collision sticks: `efficiency`, times 1 / (1 + (efficiencyDiameter / d)^efficiencyExponent) of
  // the smaller diameter d where efficiencyDiameter is not zero.
  double efficiency = 1;
  double efficiencyDiameter = 0;  // m
  double efficiencyExponent = 0;
};

class CollisionKernel {
 public:
  static constexpr std::size_t largestRank = 3;

  // What a kernel may look at; a particle type fills what the kernel asks for.
  struct Properties {
    double volume = 0;    // m3
    double mass = 0;      // kg
    double diameter = 0;  // m, of collision
  };
  struct Terms {
    std::array<double, largestRank> p{}, q{};
  };

  // Throws InputError for rates below zero, efficiencies outside (0, 1] and gas data that the kernel needs and lacks.
  explicit CollisionKernel(const CollisionKernelOptions& options);

  [[nodiscard]] std::size_t rank() const { return rank_; }
  [[nodiscard]] bool needsDiameter() const { return needsDiameter_; }
  // Whether the kernel grows faster than linearly with size, so that a population may gel in finite time; of particles
  // whose diameters go with the power 1/fractalDimension of their volume.
  [[nodiscard]] bool gels(double fractalDimension = 3) const {
    return gels_ || (options_.type == CollisionKernelType::shear && fractalDimension < 3);
  }
  // Whether the majorant equals the kernel, so that only self-pairs are fictitious.
  [[nodiscard]] bool exact() const;

  [[nodiscard]] Terms terms(const Properties& particle) const;
  [[nodiscard]] Terms largestTerms(std::span<const Properties> particles) const;  // each of them; zero of none
  [[nodiscard]] double value(const Properties& i, const Properties& j) const;
  [[nodiscard]] double majorant(const Terms& i, const Terms& j) const {
    double sum = 0;
    for (std::size_t r = 0; r < rank_; ++r) sum += i.p[r] * j.q[r] + j.p[r] * i.q[r];
    return sum;
  }
  [[nodiscard]] const CollisionKernelOptions& options() const { return options_; }

  // The transition kernels are bounded by a mixture of the bounds of their two limits, which is valid whatever the
  // mixture but tight only where it suits the population. tune() makes it the best one for the given particles:
  // `forEach(f)` calls `f(properties)` or `f(properties, weight)` for each of them. O(N): do it when all terms are
  // computed anew, as terms taken before do not go with terms taken after. Without it the bound is the free-molecular
  // one. Nothing happens for the other kernels.
  [[nodiscard]] bool tunable() const { return tunable_; }
  template <class ForEach>
  void tune(ForEach&& forEach);

 private:
  // Sticking probability as a fraction of its upper bound, which the terms contain.
  [[nodiscard]] double efficiency(const Properties& i, const Properties& j) const {
    if (!(options_.efficiencyDiameter > 0)) return options_.efficiency;
    const double ratio = options_.efficiencyDiameter / std::min(i.diameter, j.diameter);
    return options_.efficiency / (1 + std::pow(ratio, options_.efficiencyExponent));
  }
  [[nodiscard]] double slipOver(double diameter) const {  // C/d
    const double knudsen = twiceMeanFreePath_ / diameter;
    return (options_.slip == SlipLaw::davies ? slipCorrection(knudsen) : 1 + DaviesSlip::fast * knudsen) / diameter;
  }
  [[nodiscard]] double reach(const Properties& x, double slipOverDiameter) const {  // d + 2g, or d without Fuchs
    if (options_.type != CollisionKernelType::transitionFuchs) return x.diameter;
    return x.diameter + 2 * fuchsDistance(x.diameter, fuchsPath_ * slipOverDiameter * std::sqrt(x.mass));
  }
  [[nodiscard]] double settling(const Properties& x) const {  // m/s, downwards
    return settling_ * (x.mass - options_.gas.density * x.volume) * slipOver(x.diameter);
  }
  [[nodiscard]] double collisionRate(const Properties& i, const Properties& j) const;  // value without efficiency
  void mix(double freeMolecularShare);
  [[nodiscard]] Terms transitionTerms(const Properties& particle) const;  // with or without Fuchs

  CollisionKernelOptions options_;
  std::size_t rank_ = 1;
  bool needsDiameter_ = false, gels_ = false, tunable_ = false;
  // Prefactors of the values.
  double freeMolecular_ = 0, continuum_ = 0, twiceMeanFreePath_ = 0, fuchsPath_ = 0, settling_ = 0;
  // Prefactors of the terms, with the largest efficiency.
  double scale_ = 0, freeMolecularScale_ = 0, continuumScale_ = 0;
};

}  // namespace lampblack::particles

#include "core/modules.hpp"
#include "particles/population/model/collision_terms.hpp"
