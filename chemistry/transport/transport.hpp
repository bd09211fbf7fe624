// Mixture-averaged transport properties of a gas (Wang 2025, eqs 6-18..6-46). Pure viscosities, conductivities and
// binary diffusion coefficients come from kinetic theory once, at construction, and are then polynomials in ln T; a
// mixture is a handful of matrix-vector products. An object holds its workspace, so use one per thread.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "chemistry/transport/collision_integrals.hpp"
#include "chemistry/transport/pair_polynomials.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class PureGas;

// How species diffuse. Viscosity and conductivity are those of the mixture in every model.
enum class DiffusionModel {
  MixtureAveraged,  // eq. 6-21
  UnityLewis,       // every species with the diffusivity of heat, lambda/(rho cp)
  ConstantLewis,    // species k with lambda/(rho cp Le_k)
};

// Viscosity of the whole mixture by the law of Sutherland (Phil. Mag. 36 (1893) 507-531), whatever its composition:
// mu = mu_0 (T/T_0)^(3/2) (T_0 + S)/(T + S); its conductivity by a constant Prandtl number, lambda = mu cp/Pr.
struct SutherlandLaw {
  double viscosity = 0;    // Pa s, mu_0
  double temperature = 0;  // K, T_0
  double constant = 0;     // K, S
  double prandtl = 0;      // Pr

  [[nodiscard]] double viscosityAt(double T) const {
    const double ratio = T / temperature;
    return viscosity * ratio * std::sqrt(ratio) * (temperature + constant) / (T + constant);
  }
};

struct TransportOptions {
  CollisionIntegrals integrals = CollisionIntegrals::MonchickMason;
  DiffusionModel diffusion = DiffusionModel::MixtureAveraged;
  std::vector<double> lewisNumbers;  // of every species, positive; read by ConstantLewis alone
  // Instead of kinetic theory; not with mixture-averaged diffusion.
  std::optional<SutherlandLaw> sutherland{};
};

class Transport {
 public:
  // Range of the polynomials; outside it the members throw NumericsError.
  static constexpr double minTemperature = 200.0;   // K
  static constexpr double maxTemperature = 4000.0;  // K

  static void requireInRange(double T);

  // InputError if a species has no transport data or, for constant Lewis numbers, no positive Lewis number, and for
  // Sutherland's law with mixture-averaged diffusion or values that are not positive.
  explicit Transport(const Mechanism& mechanism, const TransportOptions& options = {});

  struct Mixture {
    double viscosity = 0;     // Pa s, eq. 6-18
    double conductivity = 0;  // W/m/K, eq. 6-20
  };

  // Properties of the mixture with mole fractions X (negative values count as zero) at T (K), p (Pa). D receives the
  // diffusion coefficients (m2/s) of the model of `options`. Mixture-averaged coefficients, (1-Y_k)/sum_{j!=k}
  // X_j/D_jk, relate mass fluxes in the mass-averaged frame to gradients of mole fractions:
  // j_k = -rho W_k/W D_k grad X_k. Every X is raised by 1e-12 first, which gives the formula its limit where one
  // species is alone.
  Mixture mixture(double T, double p, std::span<const double> X, std::span<double> D);

  // Mixture-averaged coefficients (m2/s) of two other definitions of the flux, whatever the model of `options`:
  // (1-X_k)/sum_{j!=k} X_j/D_jk, molar fluxes in the molar-averaged frame, J_k = -c D_k grad X_k, and
  void molarDiffusion(double T, double p, std::span<const double> X, std::span<double> D);
  // 1/(sum_{j!=k} X_j/D_jk + X_k/(1-Y_k) sum_{j!=k} Y_j/D_jk), mass fluxes from gradients of mass fractions,
  // j_k = -rho D_k grad Y_k (Kee, Coltrin, Glarborg 2003, section 12.7).
  void massDiffusion(double T, double p, std::span<const double> X, std::span<double> D);

  // Thermal diffusion coefficients DT (kg/m/s) in the mixture-averaged approximation of Chapman and Cowling (Schlup,
  // Blanquart, Combust. Theory Model. 22 (2018) 264-290), j_k = -DT_k grad ln T; their sum is zero. Positive: towards
  // the cold. Light species wander to the hot side.
  void thermalDiffusion(double T, double p, std::span<const double> X, std::span<double> DT);

  double binaryDiffusion(double T, double p, std::size_t j, std::size_t k) const;  // m2/s; j = k: self-diffusion
  double speciesViscosity(double T, std::size_t k) const;                          // Pa s
  double speciesConductivity(double T, std::size_t k) const;                       // W/m/K

  // Largest relative difference between polynomials and kinetic theory, over the whole range of temperature; for tests.
  double largestFitError(const PureGas& gas) const;

 private:
  // Coefficients of the polynomials in T^(-1/3), scaled to [-1, 1].
  static constexpr std::size_t kPureTerms = 8;
  static constexpr std::size_t kPairTerms = 6;
  static constexpr std::size_t kThermalTerms = 8;
  static constexpr std::size_t kMostTerms = 8;
  struct Basis {
    std::array<double, kMostTerms> powers;
    double rootT;
  };

  void fitPure(const PureGas& gas);
  void fitPairs(const PureGas& gas);
  Basis basis(double T) const;
  void setMoleFractions(std::span<const double> X);
  void wilkeSums(const Basis& at);
  Mixture viscosityAndConductivity(double T, const Basis& at);
  Mixture bySutherland(double T);
  void restAlone(std::span<double> D) const;
  void averagedDiffusion(double T, double p, const Basis& at, std::span<double> D);
  double pairResistance(const Basis& at, std::size_t j, std::size_t k) const;

  std::size_t n_ = 0, ld_ = 0;  // species; the same, padded
  DiffusionModel model_;
  std::vector<double> inverseLewis_;
  std::optional<SutherlandLaw> sutherland_;
  SpeciesThermo thermo_;
  std::vector<double> weights_;               // kg/mol
  std::vector<double> roots_, quarterRoots_;  // W^(1/2), W^(-1/4)
  std::vector<double> gasConstants_;          // R/W_k, J/kg/K
  std::vector<double> viscosity_;             // [term][species]: sqrt(mu / sqrt T)
  std::vector<double> rigid_, vibrating_;     // [term][species]: Eucken factors
  std::vector<double> ownResistance_;         // [term][species]: T^(3/2) / (p D_kk)
  PairPolynomials<kPairTerms> resistance_;    // T^(3/2) / (p D_jk), zero for j = k
  PairPolynomials<kThermalTerms> thermal_;    // (6/5 C* - 1)/(W_j + W_k) T^(3/2) / (p D_jk), zero for j = k
  std::vector<double> wilke_;                 // [species j][species k]: (8 (W_j + W_k))^(-1/2)

  // Of the mixture at hand.
  double meanWeight_ = 0;  // kg/mol
  mutable std::vector<double> cp_;
  std::vector<double> x_, root_, u_, a_, b_, c_, sum0_, sum1_, sum2_, wilkeSum_;
};

}  // namespace lampblack::chemistry
