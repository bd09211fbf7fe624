// Surface growth and oxidation of soot by the HACA mechanism of Appel, Bockhorn and Frenklach (2000; Wang 2025,
// tables 7.1 and 9.1): C-H sites are opened by H and OH, and the open (radical) sites, in steady state, take acetylene
// or oxygen; OH also oxidises at a fraction of its collision rate. What one event moves between gas and soot:
//   growth:           C2H2            -> 2 C(s) + H2
//   oxidation by O2:  O2 + 2 CH_x(s)  -> 2 CO + x H2
//   oxidation by OH:  OH + CH_x(s)    -> CO + H + (x/2) H2
// where x is the soot's own hydrogen-to-carbon ratio.
#pragma once

#include <cmath>
#include <span>

#include "core/modules.hpp"
#include "particles/gas/soot_gas.hpp"

namespace lampblack::particles {

// Events per unit area divided by the concentration of the gas reactant, m/s: events of growth are
// growth * [C2H2] * area in mol/s.
struct SurfaceRates {
  double growth = 0;
  double oxidationO2 = 0;
  double oxidationOH = 0;
};

class SurfaceChemistry {
 public:
  // Rate constants at one temperature (K); evaluate once and use for every particle and sub-step.
  SurfaceChemistry(const SootModelOptions& options, double temperature);

  // Fraction of sites that react, in [0, 1] (Appel, Bockhorn, Frenklach 2000; Wang 2025, eqs. 7-47 to 7-49), or the
  // constant or table of the options. `meanCarbonAtoms`: mean number of carbon atoms of a particle of the population,
  // mu_1, above 1.
  [[nodiscard]] double alpha(double meanCarbonAtoms) const;

  // `c`: concentrations in the order of SootSpecies, mol/m3.
  [[nodiscard]] SurfaceRates rates(std::span<const double> c, double alpha) const {
    using S = SootSpecies;
    const double opening = k1_ * c[S::H] + k2_ * c[S::OH];
    const double closing = k1r_ * c[S::H2] + k2r_ * c[S::H2O] + k3_ * c[S::H] + k4_ * c[S::C2H2] +
                           k5closing_ * c[S::O2];  // Wang (2025), eq. 7-46
    const double radicals = closing > 0 ? alpha * sites_ * opening / (bounded_ ? closing + opening : closing) : 0;
    return {growthOn_ * k4_ * radicals, oxidationOn_ * k5_ * radicals, oxidationOn_ * ohFlux_};
  }

 private:
  double k1_, k1r_, k2_, k2r_, k3_, k4_, k5_, k5closing_;  // m3/mol/s
  double sites_;                                           // mol/m2
  double ohFlux_;                                          // m/s, efficiency times a quarter of the mean speed of OH
  double a_, b_;
  bool bounded_;
  double growthOn_, oxidationOn_;
  std::optional<double> alpha_;
};

// alpha(T, mu1) of Appel, Bockhorn and Frenklach (2000), bounded to [0, 1]; mu1 > 1.
[[nodiscard]] double activeSiteFraction(double temperature, double meanCarbonAtoms);

}  // namespace lampblack::particles
