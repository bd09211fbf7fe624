// The gas of a cylinder as particles of one pressure: each has a mass, a composition and a temperature, and none a
// place (the stochastic reactor model; docs/theory/engine.md).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// Heat set free is told by the enthalpies at this temperature, K.
inline constexpr double formationTemperature = 298.15;

struct EngineGas {
  std::size_t species = 0;
  double pressure = 0;              // Pa
  std::vector<double> mass;         // kg, a value a particle
  std::vector<double> temperature;  // K
  std::vector<double> massFractions;
  std::size_t scalars = 0;        // that particles of gas carry (EngineCarried)
  std::vector<double> carried;    // of each, an amount per kg of gas
  std::vector<double> firstStep;  // s, what the last reactions ask of the next; 0: nothing yet
  std::vector<double> cost;       // of the last reactions, as ConstantPressureReactor counts it

  [[nodiscard]] std::size_t count() const { return mass.size(); }
  [[nodiscard]] std::span<double> Y(std::size_t i) { return std::span(massFractions).subspan(i * species, species); }
  [[nodiscard]] std::span<const double> Y(std::size_t i) const {
    return std::span(massFractions).subspan(i * species, species);
  }
  [[nodiscard]] std::span<double> amounts(std::size_t i) { return std::span(carried).subspan(i * scalars, scalars); }
  [[nodiscard]] std::span<const double> amounts(std::size_t i) const {
    return std::span(carried).subspan(i * scalars, scalars);
  }
  // Without anything carried.
  void add(double particleMass, double particleTemperature, std::span<const double> particleY);
  void remove(std::size_t i);  // the last takes its place
};

struct EngineTotals {
  double mass = 0, volume = 0;        // kg, m3
  double enthalpy = 0, energy = 0;    // J
  double capacity = 0;                // J/K, at constant pressure
  double temperature = 0;             // K, mean by mass
  std::vector<double> massFractions;  // of all
};

[[nodiscard]] EngineTotals totalsOf(const Thermo& thermo, const EngineGas& gas);
[[nodiscard]] double volumeOf(const Thermo& thermo, const EngineGas& gas);         // m3
[[nodiscard]] double energyOf(const Thermo& thermo, const EngineGas& gas);         // J, with energies of formation
[[nodiscard]] double enthalpyOf(const Thermo& thermo, const EngineGas& gas);       // J, the same
[[nodiscard]] std::vector<double> elementsOf(const Mechanism&, const EngineGas&);  // mol of atoms

// Every particle goes along its isentrope, its composition as it is, to the pressure at which all together have this
// volume (m3). NumericsError where a temperature leaves the range of Thermo.
class EngineCompression {
 public:
  explicit EngineCompression(const Thermo& thermo) : thermo_(thermo), work_(thermo.numSpecies()) {}
  // Returned is the work done on the piston, J: by the isentropes, what the particles lose in energy.
  double moveTo(double volume, EngineGas& gas);

 private:
  double entropyAt(double T, std::span<const double> Y);  // J/kg/K, at 1 atm, without that of mixing
  double isentropic(double entropy, double guess, std::span<const double> Y);

  const Thermo& thermo_;
  std::vector<double> work_, entropy_, constant_;
};

}  // namespace lampblack::chemistry
