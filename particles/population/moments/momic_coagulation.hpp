// Rates of the moments by coagulation from moments of broken order (Frenklach 2002; Kazakov and Frenklach 1998).
#pragma once

#include <array>
#include <vector>

#include "particles/population/model/collision_kernel.hpp"
#include "particles/population/moments/moment_interpolation.hpp"

namespace lampblack {

class MomicCoagulation {
 public:
  // Of `count` moments in units of a volume `unit` (m3), of spheres of this density. Throws InputError for kernels that
  // have no such expansion.
  MomicCoagulation(const CollisionKernelOptions& kernel, std::size_t count, double unit, double density);

  // f += rates. Volumes of zero or below never come here.
  void addRates(const double* moments, double* f);

 private:
  static constexpr std::size_t most = 8;
  using Rates = std::array<double, most>;
  // Sum over pairs of c_t u^(a_t) v^(b_t), exponents in sixths: the kernels that are polynomials.
  struct Term {
    double coefficient;
    int first, second;
    bool slip = false;  // times the factor of the slip correction
  };

  [[nodiscard]] Rates polynomial() const;
  [[nodiscard]] double slipFactor(double meanVolume) const;
  [[nodiscard]] Rates freeMolecular() const;
  [[nodiscard]] double gridFunction(std::size_t x, std::size_t y) const;

  CollisionKernelType type_;
  std::size_t count_;
  MomentInterpolation moments_;
  std::vector<Term> terms_;   // of the kernel, or of its continuum limit
  double knudsen_ = 0;        // of the unit volume
  double freeMolecular_ = 0;  // prefactor
};

}  // namespace lampblack
