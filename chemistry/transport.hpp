// Mixture-averaged transport properties of a gas (thesis eqs 6-18..6-46). Pure viscosities, conductivities and binary
// diffusion coefficients come from kinetic theory once, at construction, and are then polynomials in ln T; a mixture is
// a handful of matrix-vector products. An object holds its workspace, so use one per thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/collision_integrals.hpp"
#include "chemistry/mechanism.hpp"
#include "chemistry/nasa7.hpp"

namespace lampblack {

class PureGas;

class Transport {
 public:
  // Range of the polynomials; outside it the members throw NumericsError. That of most data: NASA-7 polynomials enter
  // the conductivity.
  static constexpr double minTemperature = 200.0;   // K
  static constexpr double maxTemperature = 3500.0;  // K

  // InputError if a species has no transport data.
  explicit Transport(const Mechanism& mechanism, CollisionIntegrals integrals = CollisionIntegrals::NeufeldBrokaw);

  struct Mixture {
    double viscosity = 0;     // Pa s, eq. 6-18
    double conductivity = 0;  // W/m/K, eq. 6-20
  };

  // Properties of the mixture with mole fractions X (negative values count as zero) at T (K), p (Pa). D receives the
  // mixture-averaged diffusion coefficients (m2/s) of eq. 6-21, (1-Y_k)/sum_{j!=k} X_j/D_jk, which relate mass fluxes
  // in the mass-averaged frame to gradients of mole fractions. Every X is raised by 1e-12 first, which gives the
  // formula its limit where one species is alone.
  Mixture mixture(double T, double p, std::span<const double> X, std::span<double> D);

  double binaryDiffusion(double T, double p, std::size_t j, std::size_t k) const;  // m2/s
  double speciesViscosity(double T, std::size_t k) const;                          // Pa s
  double speciesConductivity(double T, std::size_t k) const;                       // W/m/K

  // Largest relative difference between polynomials and kinetic theory, over the whole range of temperature.
  double largestFitError() const { return fitError_; }

 private:
  // Coefficients of the polynomials in ln T scaled to [-1, 1].
  static constexpr std::size_t kPureTerms = 8;
  static constexpr std::size_t kPairTerms = 6;
  struct Basis {
    double powers[kPureTerms];
    double rootT;
  };

  void fit(const PureGas& gas);
  void setWilke();
  double measureFitError(const PureGas& gas) const;
  Basis basis(double T) const;
  double conductivity(double viscosity, std::size_t k, double rigid, double vibrating, double cpOverR) const;

  std::size_t n_ = 0, ld_ = 0;  // species; the same, padded
  Nasa7Table table_;
  std::vector<double> weights_;                   // kg/mol
  std::vector<double> gasConstants_;              // R/W_k, J/kg/K
  std::vector<double> viscosity_;                 // [term][species]: sqrt(mu / sqrt T)
  std::vector<double> rigid_, vibrating_;         // [term][species]: Eucken factors
  std::vector<double> resistance_;                // [term][species j][species k]: T^(3/2) / (p D_jk)
  std::vector<double> ownResistance_;             // [term][species]: the same for j = k
  std::vector<double> wilke0_, wilke1_, wilke2_;  // [species j][species k]: eq. 6-19 expanded in sqrt(mu_k/mu_j)
  double fitError_ = 0;
  mutable std::vector<double> cp_;
  std::vector<double> x_, y_, z_, root_, a_, b_, sum0_, sum1_, sum2_, resist_, own_;
};

}  // namespace lampblack
