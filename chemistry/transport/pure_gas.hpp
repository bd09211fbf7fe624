// Kinetic theory of pure gases and pairs of gases (Wang 2025, eqs 6-22..6-46), evaluated directly: what the models of
// mixtures are built from. Slow; Transport fits polynomials to it once.
#pragma once

#include <cstddef>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/transport/collision_integrals.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class PureGas {
 public:
  // InputError naming the species if one has no transport data, or a reduced dipole moment beyond the tables.
  explicit PureGas(const Mechanism& mechanism, CollisionIntegrals integrals = CollisionIntegrals::MonchickMason);

  std::size_t size() const { return molecules_.size(); }

  double viscosity(std::size_t k, double T) const;  // Pa s, eq. 6-22
  // The conductivity's parts that are smooth in temperature (eqs 6-23..6-33): lambda = mu R/W (rigid + vibrating cp/R).
  struct EuckenFactors {
    double rigid = 0, vibrating = 0;
  };
  EuckenFactors euckenFactors(std::size_t k, double T) const;
  double conductivity(std::size_t k, double T, double cpOverR) const;  // W/m/K

  double rotationalHeatCapacity(std::size_t k) const;  // in units of R: 0, 1 or 3/2 by shape
  // Collision number, eq. 6-30; it counts as `least` at 298 K if the data have less.
  double rotationalRelaxation(std::size_t k, double T, double least = 0.0) const;

  // T^(3/2) (K^(3/2)) over the binary diffusion coefficient (eq. 6-34, the first Chapman-Enskog approximation) times
  // pressure (m2/s Pa); symmetric, and a slow function of temperature.
  double resistance(std::size_t j, std::size_t k, double T) const;
  double diffusionTimesPressure(std::size_t j, std::size_t k, double T) const;  // m2/s Pa
  // Ratios of collision integrals of a pair, see collision_integrals.hpp.
  double ratioA(std::size_t j, std::size_t k, double T) const;
  double ratioB(std::size_t j, std::size_t k, double T) const;
  double ratioC(std::size_t j, std::size_t k, double T) const;
  // Of all pairs at once, size() x size() values each: 1/(p D_jk) in m-2 s/Pa, A*, B* and C*.
  void pairProperties(double T, double* conductance, double* A, double* B, double* C) const;

 private:
  struct Molecule {
    TransportData data;
    double weight = 0;  // kg/mol
    double mass = 0;    // kg
  };
  struct Pair {
    double logWellDepth = 0;    // ln of eps/k_B in K
    double diameter = 0;        // m
    double hardResistance = 0;  // resistance() over Omega(1,1)*
    std::size_t integrals = 0;  // index
  };
  Pair makePair(std::size_t j, std::size_t k, CollisionIntegrals source);
  std::size_t integralsOf(double reducedDipole, CollisionIntegrals source);
  const Pair& pair(std::size_t j, std::size_t k) const {
    return j > k ? pairs_[j * (j + 1) / 2 + k] : pairs_[k * (k + 1) / 2 + j];
  }

  std::vector<Molecule> molecules_;
  std::vector<Pair> pairs_;                  // of j >= k
  std::vector<ReducedIntegrals> integrals_;  // one for every reduced dipole moment that occurs
  std::vector<double> dipoles_;              // these
};

}  // namespace lampblack::chemistry
