// Collision kernels of spheres in a gas (m3/s), from the free-molecular to the continuum regime, and the bound that the
// ensemble of soot samples from. Everything is inline: these sit in the innermost loops.
#pragma once

#include <cmath>

#include "particles/collision_physics.hpp"
#include "particles/soot_gas.hpp"

namespace lampblack {

[[nodiscard]] inline double meanFreePath(const SootGasState& gas) {
  return meanFreePath(gas.temperature, gas.pressure, gas.viscosity, gas.meanMolecularWeight);
}

[[nodiscard]] inline double continuumPrefactor(const SootGasState& gas) {
  return continuumPrefactor(gas.temperature, gas.viscosity);
}

// A kernel evaluated for one gas state, written so that it and its bound share their terms. Each particle has terms
// a and b, and the bound of the kernel of a pair is `scale (a_i + a_j)(b_i + b_j)`, a product form whose sum over all
// pairs needs only the sums of a, b and ab:
//   free molecular: sqrt(x + y) <= sqrt(x) + sqrt(y) and (x + y)^2 <= 2 (x^2 + y^2) (Goodson and Kraft 2002), so that
//                   a = d^2, b = 1/sqrt(m), scale = 2 prefactor; accepted with probability 1/2 to 1;
//   continuum:      a = C/d, b = d, scale = prefactor: exact.
// The transition kernel is bounded by either; the caller takes the one with the smaller total.
class PairKernel {
 public:
  enum class Bound { freeMolecular, continuum };
  struct Terms {
    double a, b, ab;
    double other;  // what the transition kernel needs besides: C/d with the first bound, 1/m with the second
  };

  // `verificationScale`: the constant kernel, m3/s, or the additive kernel's factor of the sum of masses, m3/s/kg.
  PairKernel(CoagulationKernel type, const SootGasState& gas, double enhancement, Bound bound = Bound::freeMolecular,
             double verificationScale = 1)
      : type_(type), bound_(bound) {
    if (type == CoagulationKernel::constant || type == CoagulationKernel::additive) {
      scale_ = verificationScale;
      return;
    }
    freeMolecular_ = freeMolecularPrefactor(gas.temperature, enhancement);
    if (type == CoagulationKernel::transition) {
      continuum_ = continuumPrefactor(gas);
      twiceMeanFreePath_ = 2 * meanFreePath(gas);
    }
    scale_ = bound == Bound::freeMolecular ? 2 * freeMolecular_ : continuum_;
  }

  [[nodiscard]] double scale() const { return scale_; }

  [[nodiscard]] Terms terms(double mass, double diameter) const {
    switch (type_) {
      case CoagulationKernel::constant:
        return {0.5, 0.5, 0.25, 0};
      case CoagulationKernel::additive:
        return {mass, 0.5, 0.5 * mass, 0};
      case CoagulationKernel::freeMolecular: {
        const double a = diameter * diameter, b = 1 / std::sqrt(mass);
        return {a, b, a * b, 0};
      }
      case CoagulationKernel::transition:
        break;
    }
    const double slip = slipCorrection(twiceMeanFreePath_ / diameter) / diameter;
    if (bound_ == Bound::continuum) return {slip, diameter, slip * diameter, 1 / mass};
    const double a = diameter * diameter, b = 1 / std::sqrt(mass);
    return {a, b, a * b, slip};
  }

  // The kernel of a pair, m3/s.
  [[nodiscard]] double value(const Terms& i, const Terms& j) const {
    if (type_ == CoagulationKernel::constant || type_ == CoagulationKernel::additive) return bound(i, j);
    const bool first = bound_ == Bound::freeMolecular;
    const double sum = first ? std::sqrt(i.a) + std::sqrt(j.a) : i.b + j.b;
    const double inverseMass = first ? i.b * i.b + j.b * j.b : i.other + j.other;
    const double fm = freeMolecular_ * std::sqrt(inverseMass) * sum * sum;
    if (type_ == CoagulationKernel::freeMolecular) return fm;
    return harmonicMean(fm, continuum_ * (first ? i.other + j.other : i.a + j.a) * sum);
  }

  [[nodiscard]] double bound(const Terms& i, const Terms& j) const { return scale_ * (i.a + j.a) * (i.b + j.b); }

 private:
  CoagulationKernel type_;
  Bound bound_;
  double freeMolecular_ = 0, continuum_ = 0, twiceMeanFreePath_ = 0, scale_ = 0;
};

}  // namespace lampblack
