// What the tests of molecules share: named ones, gases, sites.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "particles/pah/molecule.hpp"
#include "particles/pah/molecule_growth.hpp"
#include "particles/pah/named_molecules.hpp"
#include "particles/pah/pah_rates.hpp"
#include "tests/every_module.hpp"

namespace lampblack::particles::test {

inline Molecule named(std::string_view name) {
  return Molecule(namedMolecule(name));
}

// The reference numbers were made with gas constants of nine digits, 1.98720425e-3 kcal/mol/K and 82.0573661 cm3
// atm/mol/K; with E/R and concentrations by these, rates compare to their last digit.
inline constexpr double referenceR = 1.98720425e-3;

inline PahRateConstants referenceConstants() {
  PahRateConstants c;
  const double ratio = constants::gasConstant / (1e3 * constants::thermochemicalCalorie) / referenceR;
  for (const PahRateName& name : pahRateNames)
    for (RateConstant& k : c.*name.value) k.E *= ratio;
  c.fiveEquilibrium.E *= ratio;
  for (const auto k :
       {&SurfaceRateConstants::openByH, &SurfaceRateConstants::closeByH2, &SurfaceRateConstants::openByOH,
        &SurfaceRateConstants::closeByH2O, &SurfaceRateConstants::closeByH, &SurfaceRateConstants::growth})
    (c.surface.*k).E *= ratio;
  return c;
}

// mol/m3 of pahGasSpecies at 1 atm.
inline std::vector<double> concentrationsAt(double temperature, double H, double H2, double C2H2) {
  const double total = 1e6 / (82.0573661 * temperature);
  return {H * total, H2 * total, 0, 0, 0, C2H2 * total};
}

inline PahRates referenceRates(double temperature, double H = 0.01, double H2 = 0.1, double C2H2 = 0.1) {
  return pahRates(referenceConstants(), temperature, concentrationsAt(temperature, H, H2, C2H2));
}

inline double& rateOf(PahRates& rates, PahProcess process) {
  return rates[static_cast<std::size_t>(process)];
}

inline PahRates only(const PahRates& rates, std::initializer_list<PahProcess> processes) {
  PahRates some{};
  for (const PahProcess p : processes) some[static_cast<std::size_t>(p)] = rates[static_cast<std::size_t>(p)];
  return some;
}

inline constexpr std::uint64_t manyEvents = 1000000000;

}  // namespace lampblack::particles::test
