// Kinetic theory of pure gases and pairs of gases (thesis eqs 6-22..6-46), evaluated directly. Slow; Transport fits
// polynomials to it once.
#pragma once

#include <cstddef>
#include <vector>

#include "chemistry/collision_integrals.hpp"
#include "chemistry/mechanism.hpp"

namespace lampblack {

class PureGas {
 public:
  // InputError naming the species if one has no transport data.
  explicit PureGas(const Mechanism& mechanism, CollisionIntegrals integrals = CollisionIntegrals::NeufeldBrokaw);

  std::size_t size() const { return molecules_.size(); }
  double viscosity(std::size_t k, double T) const;     // Pa s, eq. 6-22
  double conductivity(std::size_t k, double T) const;  // W/m/K, eqs 6-23..6-33
  // The conductivity's parts that are smooth in temperature: lambda = mu R/W (rigid + vibrating cp/R).
  struct EuckenFactors {
    double rigid = 0, vibrating = 0;
  };
  EuckenFactors euckenFactors(std::size_t k, double T) const;
  // Binary diffusion coefficient times pressure, m2/s Pa, eq. 6-34 (first Chapman-Enskog approximation); symmetric.
  double diffusionTimesPressure(std::size_t j, std::size_t k, double T) const;

 private:
  struct Molecule {
    TransportData data;
    Species species;
    double weight = 0;  // kg/mol
    double mass = 0;    // kg
  };
  struct Pair {
    double wellDepth = 0;      // eps/k_B, K
    double diameter = 0;       // m
    double reducedDipole = 0;  // delta*
  };
  Pair pair(std::size_t j, std::size_t k) const;

  std::vector<Molecule> molecules_;
  CollisionIntegrals integrals_;
};

}  // namespace lampblack
