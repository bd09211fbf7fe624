// What a mixture is once it has burnt, for starts of flames (Burke and Schumann 1928): fuel and oxygen that meet have
// become CO2 and H2O. H2O is made first, then CO, then CO2 as far as oxygen reaches; 3 % of the H2O is H + OH. Fuels
// are species of C and H alone. A mechanism without these products, for instance of hydrogen, burns to chemical
// equilibrium.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/equilibrium.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

class BurntMixture {
 public:
  BurntMixture(const Mechanism& mechanism, const Thermo& thermo);

  // Burns mass fractions of an enthalpy (J/kg) at a pressure (Pa). Returned is the temperature (K) that the enthalpy
  // gives, at most `hottest`.
  double burn(double enthalpy, double pressure, double hottest, std::vector<double>& Y);

 private:
  [[nodiscard]] bool isComplete() const;  // whether the mechanism has the products, and the radicals
  void burnCompletely(std::vector<double>& Y) const;
  [[nodiscard]] double atoms(std::size_t k, std::size_t which) const;
  [[nodiscard]] bool onlyCarbonAndHydrogen(std::size_t k) const;

  const Mechanism& mechanism_;
  const Thermo& thermo_;
  Equilibrium equilibrium_;
  std::vector<std::optional<std::size_t>> elements_;  // C, H, O
  std::vector<std::optional<std::size_t>> products_;  // CO2, CO, H2O, O2
  std::vector<std::optional<std::size_t>> radicals_;  // H, OH
};

}  // namespace lampblack::flow
