// Rates of the processes of a molecule's edge, per site that they may start from: from the constants of a table and the
// gas. docs/theory/pah.md has the formulas and the sources of each number.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"
#include "particles/gas/rate_constant.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/pah/pah_process.hpp"

namespace lampblack::particles {

// Rates of parallel channels add up.
using RateSum = std::vector<RateConstant>;

// Bimolecular ones in cm3/mol/s, those said to be of a step by itself in 1/s; set R1 by default.
struct PahRateConstants {
  // The opening and closing of radical sites, and growth in an armchair, are the surface's of soot.
  SurfaceRateConstants surface = {};
  RateSum growthFreeEdge{{1.1e7, 1.71, 3.9}, {3.3e33, -5.7, 25.5}};
  RateSum lossArmchair{{5.465e30, -3.657, 86.24}, {4.868e22, -1.697, 75.55}};
  RateSum lossFreeEdge{{1.3e11, 1.08, 70.42}};  // by itself
  RateSum closeBay{{1.11e11, 0.658, 23.99}};    // by itself
  RateSum bayOpenByH{{9.24e7, 1.5, 9.646}};
  RateSum bayOpenByOH{{2.1e13, 0, 4.56937799}};
  RateSum bayCloseByH2{{9.6e4, 1.96, 9.021}};
  RateSum bayCloseByH{{8.02e19, -2.011, 1.968}};
  RateSum zigzagOpenByH{{4.57e8, 1.88, 14.839}};
  RateSum zigzagCloseByH2{{1.69e4, 2.62, 4.559}};
  RateSum zigzagCloseByH{{4.17e13, 0.15, 0}};
  RateSum growthZigzag{{1.25e27, -3.95, 16.779}, {3.09e20, -2.78, 8.889}};
  RateSum chainZigzag{{3.09e25, -3.11, 31.586}, {2.85e7, 1.52, 13.19}};
  RateSum fiveAddH{{5.4e11, 0.45, 1.82}};
  RateConstant fiveEquilibrium{1.791, 0, -35.187};  // cm3/mol
  RateSum fiveLoseH{{2.0e12, 0, 0}};
  RateSum fiveLoss{{3.1e11, 0.87, 74.323}, {6.7e11, 0.84, 70.79}};  // by itself
  RateSum fiveMove{{1.3e11, 0.16, 45.9}};                           // by itself
  RateSum fiveOpenByH{{4.89e9, 1.508, 19.862}};
  RateSum fiveCloseByH2{{5.0677e4, 2.4449, 4.5197}};
  RateSum fiveCloseByH{{6.08e12, 0.27, 0}};
  RateSum fiveRadicalLoss{{1.6e14, 0, 42.42}};  // by itself
  RateSum oxidationO2{{9.7e3, 2.42, 38.46338}};
  RateSum oxidationOH{{1.3e13, 0, 10.62}};

  // Ways of a process at one site, by which its rate is multiplied.
  double waysArmchair = 2, waysLossArmchair = 0.5, waysBay = 2, waysZigzag = 0.5;
  // C-H sites that zigzagOpenByH was measured for as one.
  double sitesPerZigzagRate = 1;
};

// The table's names of the constants that are sums.
struct PahRateName {
  const char *name, *description;
  RateSum PahRateConstants::*value;
};
extern const std::array<PahRateName, 23> pahRateNames;
// And of the factors.
struct PahFactorName {
  const char *name, *description;
  double PahRateConstants::*value;
};
extern const std::array<PahFactorName, 5> pahFactorNames;

// Species that the rates take from the gas, in this order: the first of SootSpecies, as far as C2H2.
inline constexpr std::size_t pahGasSpecies = SootSpecies::C2H2 + 1;
[[nodiscard]] std::vector<std::string> pahGasSpeciesNames();

// 1/s, of each process.
using PahRates = std::array<double, pahProcessCount>;

// The part of O6R_... that OH does rather than O2; zero where neither does.
[[nodiscard]] double oxidationByOH(const PahRateConstants& constants, double temperature,
                                   std::span<const double> concentrations);

// `concentrations`: mol/m3, of pahGasSpecies. NumericsError for a temperature or concentrations that are not physical.
[[nodiscard]] PahRates pahRates(const PahRateConstants& constants, double temperature,
                                std::span<const double> concentrations);

}  // namespace lampblack::particles
