// Multicomponent transport of a gas: the linear systems of Dixon-Lewis, Proc. R. Soc. Lond. A 307 (1968) 111-135, in
// the notation of Kee, Coltrin, Glarborg (2003, section 12.4). They give the conductivity
// with its translational, rotational and vibrational parts, the matrix of ordinary diffusion coefficients and the
// coefficients of thermal diffusion. Costs an LU factorisation of twice as many unknowns as species, the internal ones
// being eliminated before (one times for diffusion). What depends on temperature alone is kept for the next call. An
// object holds its workspace, so use one per thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/numerics/dense_blocks.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "chemistry/transport/pure_gas.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/rooms.hpp"

namespace lampblack::chemistry {

class MulticomponentTransport {
 public:
  // InputError if a species has no transport data.
  explicit MulticomponentTransport(const Mechanism& mechanism,
                                   CollisionIntegrals integrals = CollisionIntegrals::MonchickMason);

  struct Mixture {
    double viscosity = 0;     // Pa s; Wilke's rule, as Transport has it
    double conductivity = 0;  // W/m/K, of a gas whose composition stays uniform (lambda_0)
  };

  // Properties of the mixture with mole fractions X (negative values count as zero) at T (K), p (Pa), from 200 to 4000
  // K (else NumericsError). DT receives the thermal diffusion coefficients (kg/m/s), which sum to zero and are zero for
  // absent species; j_k = -DT_k grad ln T, as for Transport::thermalDiffusion.
  Mixture mixture(double T, double p, std::span<const double> X, std::span<double> DT);

  // Ordinary multicomponent diffusion coefficients, n x n values in m2/s, D_kj at D[k n + j], D_kk = 0. Mass fluxes in
  // the mass-averaged frame are j_k = rho W_k/W^2 sum_j W_j D_kj grad X_j at uniform pressure.
  void diffusion(double T, double p, std::span<const double> X, std::span<double> D);

  // The same fluxes as j_k = W_k/(R T) sum_j M_kj grad X_j, n x n values in Pa m2/s, M_kj at M[k n + j]: the inverse of
  // the Stefan-Maxwell equations in the mass-averaged frame. M_kj is in proportion to X_k for j != k, so that the flux
  // of a trace is exact to rounding of itself; with D_kj it is a small difference of what the gradients of all others
  // give.
  void fluxMatrix(double T, double p, std::span<const double> X, std::span<double> M);

 private:
  void setMixture(double T, std::span<const double> X);
  void setTemperature(double T);
  void invert(double T, double p);
  double ordinary(std::size_t i, std::size_t j) const;
  void fillThermalSystem(double T);
  void eliminateInternal();
  [[noreturn]] static void singular(double T, double p);

  std::size_t n_ = 0;
  PureGas gas_;
  Transport averaged_;
  SpeciesThermo thermo_;
  std::vector<double> weights_;  // kg/mol

  // Of the mixture at hand.
  std::vector<double> x_, drag_, viscosity_, cp_, internal_, rotation_, averagedDiffusion_, unknowns_;
  std::vector<double> conductance_, a_, b_, c_;  // [i][j]: 1/(p D_ij) in m-2 s/Pa; A*, B*, C*
  std::vector<double> ordinary_, inverse_;       // n x n
  std::vector<double> thermal_;                  // 2n x 2n: diffusion and translational energy
  // Their exchange with internal energy, [column][row]: columns of it, rows of it, its own diagonal.
  std::vector<double> toInternal_, fromInternal_, internalDiagonal_, thermalDrag_, collisions_;
  std::vector<int> pivots_;
  DenseBlocks dense_;
  double temperature_ = 0;  // of what depends on it alone
};

}  // namespace lampblack::chemistry
