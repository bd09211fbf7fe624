// Rates of the moments by coagulation from moments of broken order (Frenklach 2002; Kazakov and Frenklach 1998).
#pragma once

#include <array>

#include "core/modules.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/population/moments/moment_interpolation.hpp"

namespace lampblack::particles {

class MomicCoagulation {
 public:
  // Orders of the moments (in sixths) that `addRates` reads.
  static constexpr int lowestOrder = -4;
  static constexpr int highestOrder(std::size_t count) { return 6 * static_cast<int>(count) + 6; }

  // Of `count` moments in units of a volume `unit` (m3), of spheres of this density. Throws InputError for kernels that
  // have no such expansion.
  MomicCoagulation(const CollisionKernelOptions& kernel, std::size_t count, double unit, double density);

  // Another kernel or gas, without the checks of the constructor and without allocation: for a gas that changes from
  // call to call.
  void set(const CollisionKernelOptions& kernel, double unit, double density);

  // f += rates. Volumes of zero or below never come here.
  void addRates(const BrokenMoments& moments, double* f) const;

 private:
  static constexpr std::size_t most = MomentInterpolation::mostMoments;
  using Rates = std::array<double, most>;
  // Sum over pairs of c_t u^(a_t) v^(b_t), exponents in sixths: the kernels that are polynomials.
  struct Term {
    double coefficient;
    int first, second;
    bool slip = false;  // times the factor of the slip correction
  };

  [[nodiscard]] Rates polynomial(const BrokenMoments& moments) const;
  [[nodiscard]] double slipFactor(double meanVolume) const;
  [[nodiscard]] Rates freeMolecular(const BrokenMoments& moments) const;
  [[nodiscard]] double gridFunction(const BrokenMoments& moments, std::size_t x, std::size_t y) const;
  void add(const Term& term) { terms_[termCount_++] = term; }

  CollisionKernelType type_;
  std::size_t count_;
  std::array<Term, 4> terms_;  // of the kernel, or of its continuum limit
  std::size_t termCount_ = 0;
  double knudsen_ = 0;                                  // of the unit volume
  double freeMolecular_ = 0;                            // prefactor
  std::array<std::array<double, 4>, 4> halfWeights_{};  // Lagrange's weights at 1/2 of the points 0 ... l
};

}  // namespace lampblack::particles
