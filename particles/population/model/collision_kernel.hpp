// Collision kernels of the population balance (m3/s) with a majorant that factorises. The majorant of a pair is
//
//   sum over r < rank of  p_r(i) q_r(j) + p_r(j) q_r(i)  >=  K(i, j)
//
// so that its sum over all unordered pairs is sum_r (sum_i p_r(i)) (sum_j q_r(j)), self-pairs included as fictitious
// ones, and a pair is drawn by one draw in proportion to p_r and one in proportion to q_r. A pair drawn so is accepted
// with probability K / majorant: the jumps that remain have exactly the rates of the kernel (Eibeck and Wagner 2000;
// Goodson and Kraft 2002).
#pragma once

#include <array>
#include <cstddef>

namespace lampblack {

enum class CollisionKernelType {
  constant,         // A
  additive,         // A (u + v)
  multiplicative,   // A u v
  freeMolecular,    // thesis eq. 9-28
  continuum,        // with slip, thesis eq. 9-29
  transition,       // harmonic mean of the two, thesis eq. 9-30
  transitionFuchs,  // Fuchs interpolation (Fuchs 1964)
  shear,            // laminar shear (Smoluchowski 1917)
  gravitational     // differential settling in the Stokes regime
};

// The gas the particles are in; needed by the physical kernels.
struct KernelGas {
  double temperature = 0;          // K
  double pressure = 0;             // Pa
  double viscosity = 0;            // Pa s
  double meanMolecularWeight = 0;  // kg/mol
  double density = 0;              // kg/m3; of the gas, for settling
};

struct CollisionKernelOptions {
  CollisionKernelType type = CollisionKernelType::constant;
  double rate = 0;  // A of the first three: m3/s, 1/s, 1/(m3 s)
  KernelGas gas;
  double enhancement = 1;  // of free-molecular collisions (van der Waals)
  double shearRate = 0;    // 1/s
  // Probability that a collision sticks: 1, a constant, or a function of the smaller diameter,
  // 1 / (1 + (efficiencyDiameter / d)^efficiencyExponent).
  double efficiency = 1;
  double efficiencyDiameter = 0;  // m; zero: the constant alone
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

  explicit CollisionKernel(const CollisionKernelOptions& options);  // throws InputError

  [[nodiscard]] std::size_t rank() const { return rank_; }
  [[nodiscard]] bool needsDiameter() const { return needsDiameter_; }
  [[nodiscard]] bool gels() const { return gels_; }  // grows faster than linearly: may gel in finite time

  [[nodiscard]] Terms terms(const Properties& particle) const;
  [[nodiscard]] double value(const Properties& i, const Properties& j) const;
  [[nodiscard]] const CollisionKernelOptions& options() const { return options_; }

 private:
  CollisionKernelOptions options_;
  std::size_t rank_ = 1;
  bool needsDiameter_ = false, gels_ = false;
};

}  // namespace lampblack
