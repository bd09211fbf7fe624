// Heat lost by radiation from an optically thin gas: Planck-mean absorption of H2O, CO2, CO and CH4 (polynomials of the
// TNF workshop, Barlow, Karpetis, Frank, Chen, Combust. Flame 127 (2001) 2102-2118), and whatever soot adds.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

struct RadiationOptions {
  bool on = false;
  double surroundings = 298;  // K
};

// What of a mechanism does not radiate though it would: H2O, CO2 or CO where the mechanism has their elements but no
// species that is one of them for sure (findKnownSpecies), and NH3, N2O and NO, which have no polynomials here.
std::vector<std::string> radiationWarnings(const Mechanism& mechanism);

class ThinRadiation {
 public:
  // Species are those of findKnownSpecies; those the mechanism does not have do not radiate. `surroundings`: K.
  ThinRadiation(const Mechanism& mechanism, double surroundings);

  // Planck-mean absorption coefficient of the gas, 1/m, at T (K), p (Pa), mole fractions X. The polynomials were fitted
  // from 300 to 2500 K; colder and hotter gas absorbs as at these ends. That of CO rises by 1.2 % at 750 K, where its
  // two polynomials meet.
  [[nodiscard]] double absorption(double T, double p, std::span<const double> X) const;
  // Heat lost, W/m3: 4 sigma a (T^4 - T_s^4) (Wang 2025, eq. 7-13 with the sign of a loss).
  [[nodiscard]] double loss(double absorption, double T) const;
  [[nodiscard]] double lossSlope(double absorption, double T) const;  // of loss with T at constant absorption

 private:
  std::optional<std::size_t> h2o_, co2_, co_, ch4_;
  double surroundings4_;
};

}  // namespace lampblack::flow
