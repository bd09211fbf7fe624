// Multicomponent transport of a gas: the linear systems of Dixon-Lewis, Proc. R. Soc. Lond. A 307 (1968) 111-135, in
// the notation of Kee, Coltrin, Glarborg (2003, section 12.4). The systems give the conductivity with its
// translational, rotational and vibrational parts, the coefficients of thermal diffusion, and ordinary diffusion as
// fluxes or as a matrix of coefficients. All are symmetric: conjugate gradients (Ern, Giovangigli 1994) solve them
// without forming what only an elimination would need; matrices of coefficients take an LU factorisation. What depends
// on temperature alone is kept for the next call. An object holds its workspace, so use one per thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "chemistry/transport/multicomponent_pairs.hpp"
#include "chemistry/transport/pure_gas.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/modules.hpp"
#include "numerics/dense_blocks.hpp"
#include "numerics/weighted_conjugate_gradients.hpp"

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

  // Mass fluxes j_k (kg/m2/s) of ordinary diffusion in the mass-averaged frame, from the gradients of mole fractions
  // (1/m): the solution of the Stefan-Maxwell equations to 1e-8 of itself, summing to zero. An absent species has the
  // flux of its gradient in the mixture of the others.
  void diffusionFluxes(double T, double p, std::span<const double> X, std::span<const double> gradX,
                       std::span<double> j);

  // Ordinary multicomponent diffusion coefficients, n x n values in m2/s, D_kj at D[k n + j], D_kk = 0. Mass fluxes in
  // the mass-averaged frame are j_k = rho W_k/W^2 sum_j W_j D_kj grad X_j at uniform pressure.
  void diffusion(double T, double p, std::span<const double> X, std::span<double> D);

  // The fluxes as j_k = W_k/(R T) sum_j M_kj grad X_j, n x n values in Pa m2/s, M_kj at M[k n + j]: the inverse of
  // the Stefan-Maxwell equations in the mass-averaged frame. M_kj is in proportion to X_k for j != k, so that the flux
  // of a trace is exact to rounding of itself; with D_kj it is a small difference of what the gradients of all others
  // give.
  void fluxMatrix(double T, double p, std::span<const double> X, std::span<double> M);

 private:
  void setMixture(double T, std::span<const double> X);
  void setTemperature(double T);
  void prepareThermal(double T);
  void thermalProduct(double T, const double* p, double* q);
  void invert(double T, double p);
  double ordinary(std::size_t i, std::size_t j) const;
  double conductance(std::size_t i, std::size_t j) const { return pairs_.conductance[j * ld_ + i]; }
  [[noreturn]] static void singular(double T, double p);

  std::size_t n_ = 0, ld_ = 0;  // species; the same, rounded up to whole lanes
  PureGas gas_;
  Transport averaged_;
  SpeciesThermo thermo_;
  std::vector<double> weights_;  // kg/mol, here and below one a species and zero up to ld_
  MulticomponentPairs pairTable_;
  std::vector<double> inverseMass_;  // mol/kg, 1/(W_j + W_k), a column a species

  // Of the temperature.
  double temperature_ = 0;
  MulticomponentPairs::Matrices pairs_;
  std::vector<double> viscosity_, cp_, internal_, rotation_;  // Pa s; over R: heat capacities, rotation over collisions

  // Of the mixture. Drag: sum_j x_j c_ij. Frame: what is added to fix the frame of the fluxes.
  std::vector<double> x_, drag_, averagedDiffusion_;
  double frame_ = 0;
  std::vector<double> energy_;  // a column a species: translational energy by that of another species
  std::vector<double> thermalDrag_, collisions_, exchange_, exchanges_, internalDiagonal_;

  // Of the systems: three unknowns a species (diffusion, translational and internal energy), in rows of ld_.
  std::vector<double> weight_, inverseDiagonal_, residual_, solution_;
  std::vector<double> y0_, y1_, y2_, momentum_, heated_;
  WeightedConjugateGradients ofFluxes_, ofHeat_;

  std::vector<double> ordinary_, inverse_;  // n x n
  std::vector<int> pivots_;
  DenseBlocks dense_;
};

}  // namespace lampblack::chemistry
