// Units as mechanism files write them: "1.0e+13 cm^3/mol/s" behind a number, and the defaults of a `units` map.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/modules.hpp"

namespace lampblack::chemistry {

// A value in this unit is `factor` times the value in SI with mol.
struct MechanismUnit {
  enum Base : std::size_t { Mass, Length, Time, Temperature, Amount };
  double factor = 1;
  std::array<double, 5> exponents{};  // of kg, m, s, K, mol

  bool sameDimension(const MechanismUnit& other) const;
};

inline constexpr MechanismUnit kKelvin{1.0, {0, 0, 0, 1, 0}};
inline constexpr MechanismUnit kPascal{1.0, {1, -1, -2, 0, 0}};

// Products and quotients of units with decimal powers, as Cantera writes them: "cm^3/mol/s", "J/kmol", "1/s", with the
// one-letter SI prefixes. InputError whose text names what is not understood.
MechanismUnit parseMechanismUnit(std::string_view text);

// (m3/mol)^(order-1)/s
MechanismUnit rateConstantUnit(double order);

// "m^3/mol/s": the SI unit of the same dimension, for messages.
std::string describe(const MechanismUnit& unit);

// K per activation energy in this unit: a temperature, an energy per amount, or an energy per molecule (eV). InputError
// if it is none of these.
double activationUnitInKelvin(std::string_view unit);

// The units of numbers that stand alone. Cantera's defaults are SI with kmol.
class UnitSystem {
 public:
  // One entry of a `units` map ("length", "cm"). InputError if the unit is not one of this quantity; false if the
  // quantity is unknown.
  bool set(std::string_view quantity, std::string_view unit);

  double rateConstant(double order) const;                  // (m3/mol)^(order-1)/s
  double pressure() const { return pressure_; }             // Pa
  double activationTemperature() const;                     // K, of an activation energy
  double molarEnergy() const { return energy_ / amount_; }  // J/mol

 private:
  double length_ = 1;      // m
  double time_ = 1;        // s
  double amount_ = 1e3;    // mol
  double energy_ = 1;      // J
  double pressure_ = 1;    // Pa
  double activation_ = 0;  // K; zero means energy per amount
};

}  // namespace lampblack::chemistry
