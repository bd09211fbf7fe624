// Mixture-averaged transport properties of a gas (thesis eqs 6-18..6-46). Pure viscosities, conductivities and binary
// diffusion coefficients come from kinetic theory once, at construction, and are then polynomials in ln T; a mixture is
// a handful of matrix-vector products. An object holds its workspace, so use one per thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/mechanism.hpp"

namespace lampblack {

class Transport {
 public:
  // Range of the polynomials; outside it the members throw NumericsError.
  static constexpr double minTemperature = 100.0;   // K
  static constexpr double maxTemperature = 6000.0;  // K

  // InputError if a species has no transport data.
  explicit Transport(const Mechanism& mechanism);

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
  static constexpr std::size_t kTerms = 8;  // coefficients a polynomial

  void fit(const Mechanism& mechanism);
  void setWilke(const Mechanism& mechanism);
  double basis(double T, double* powers) const;  // powers of the scaled ln T; returns sqrt(T)

  std::size_t n_ = 0, ld_ = 0;
  std::vector<double> weights_;                   // kg/mol
  std::vector<double> viscosity_, conductivity_;  // [term][species]: sqrt(mu / sqrt T), lambda / sqrt T
  std::vector<double> resistance_;                // [pair][...]: T^(3/2) / (p D_jk), columns j of ld_ rows k, [term]
  std::vector<double> wilke0_, wilke1_, wilke2_;  // eq. 6-19 expanded in sqrt(mu_k/mu_j)
  double fitError_ = 0;
  std::vector<double> x_, root_, inverseRoot_, lambda_, sum0_, sum1_, sum2_, resist_;
};

}  // namespace lampblack
