// Dimers of PAH molecules, the link from the gas to soot (Blanquart and Pitsch 2009; Wang 2025, eqs. 7-34 to 7-43).
// Dimers are in steady state: made by sticking PAH collisions, used up by colliding with each other (a new particle)
// and with particles (condensation). Both soot models share this one.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/gas/soot_gas.hpp"

namespace lampblack::particles {

// Production of dimers at one gas state.
struct DimerProduction {
  double rate = 0;                  // dimers, 1/m3/s (eq. 7-39)
  double carbon = 0, hydrogen = 0;  // atoms in a mean dimer (eq. 7-40)
  double mass = 0;                  // of a mean dimer, kg
  double diameter = 0;              // of a sphere of soot density, m
  double selfCollision = 0;         // beta_N, m3/s: dimers lost to nucleation are beta_N N^2
};

// Positive root of selfCollision N^2 + particleCollision N = production (1/m3), without cancellation. Zero production
// gives zero; both collision rates zero with production positive is a caller's error and gives infinity.
[[nodiscard]] double steadyDimers(double production, double selfCollision, double particleCollision);

class DimerModel {
 public:
  explicit DimerModel(const SootModelOptions& options);  // throws InputError

  [[nodiscard]] std::size_t size() const { return carbon_.size(); }
  [[nodiscard]] double carbonAtoms(std::size_t i) const { return carbon_[i]; }
  [[nodiscard]] double hydrogenAtoms(std::size_t i) const { return hydrogen_[i]; }
  // The smallest nucleus: carbon atoms of four molecules of the lightest PAH, two where nuclei are of monomers (1 where
  // no PAH is listed).
  [[nodiscard]] double smallestNucleus() const { return smallestNucleus_; }
  [[nodiscard]] bool consumes() const { return consumes_; }

  // Rate (1/s) at which PAH i is consumed, sum_j gamma_ij beta_ij N_A [PAH_j]: d[PAH_i]/dt = -loss_i [PAH_i].
  void lossRates(double temperature, std::span<const double> pah, PahArray& loss) const;

  // `consumption`: what each PAH loses, mol/m3/s, from which the rate and mean dimer follow: mass is conserved exactly.
  [[nodiscard]] DimerProduction production(double temperature, std::span<const double> consumption) const;

  // 1/s, at which dimers come apart, so that without other losses they are in equilibrium with all PAH (mol/m3), one
  // constant for all pairs: zero without it.
  [[nodiscard]] double breaking(double temperature, double rate, std::span<const double> pah) const;

  // Free-molecular collision rate of a dimer with a particle, m3/s, `prefactor` by freeMolecularPrefactor.
  [[nodiscard]] static double particleCollision(const DimerProduction& dimer, double prefactor, double mass,
                                                double diameter) {
    return freeMolecularKernel(prefactor, dimer.mass, dimer.diameter, mass, diameter);
  }

 private:
  std::vector<double> carbon_, hydrogen_;
  std::vector<double> pair_;  // gamma_ij beta_ij N_A / sqrt(T), row-major, m3/mol/s/K^0.5
  double carbonMass_, hydrogenMass_, sootDensity_, vanDerWaals_;
  double smallestNucleus_ = 1;
  std::optional<RateConstant> equilibrium_;
  bool consumes_;
};

}  // namespace lampblack::particles
