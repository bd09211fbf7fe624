// Physical quantities as people write them in decks: "20 cm/s", "1 atm", "50 um", "25 degC", "2.3e19 1/m^2". A quantity
// is a number and a unit expression; the expression is checked against the dimension that is expected and the value
// comes back in SI. Angles count as a base dimension of their own, so that "30 deg" cannot pass for a plain number.
#pragma once

#include <string>
#include <string_view>

#include "core/modules.hpp"

namespace lampblack::io::units {

// Integer exponents of the base units m, kg, s, K, mol and rad.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;
  int temperature = 0;
  int amount = 0;
  int angle = 0;

  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

constexpr Dimension operator*(const Dimension& a, const Dimension& b) {
  return {a.length + b.length,           a.mass + b.mass,     a.time + b.time,
          a.temperature + b.temperature, a.amount + b.amount, a.angle + b.angle};
}

constexpr Dimension power(const Dimension& a, int n) {
  return {a.length * n, a.mass * n, a.time * n, a.temperature * n, a.amount * n, a.angle * n};
}

constexpr Dimension operator/(const Dimension& a, const Dimension& b) {
  return a * power(b, -1);
}

inline constexpr Dimension dimensionless{};
inline constexpr Dimension length{.length = 1};
inline constexpr Dimension mass{.mass = 1};
inline constexpr Dimension time{.time = 1};
inline constexpr Dimension temperature{.temperature = 1};
inline constexpr Dimension amount{.amount = 1};
inline constexpr Dimension angle{.angle = 1};
inline constexpr Dimension area = power(length, 2);
inline constexpr Dimension volume = power(length, 3);
inline constexpr Dimension frequency = power(time, -1);
inline constexpr Dimension angularVelocity = angle / time;
inline constexpr Dimension velocity = length / time;
inline constexpr Dimension acceleration = velocity / time;
inline constexpr Dimension density = mass / volume;
inline constexpr Dimension force = mass * acceleration;
inline constexpr Dimension pressure = force / area;
inline constexpr Dimension energy = force * length;
inline constexpr Dimension watt = energy / time;
inline constexpr Dimension massFlow = mass / time;
inline constexpr Dimension massFlux = massFlow / area;
inline constexpr Dimension volumeFlow = volume / time;
inline constexpr Dimension viscosity = pressure * time;
inline constexpr Dimension diffusivity = area / time;
inline constexpr Dimension conductivity = watt / (length * temperature);
inline constexpr Dimension heatFlux = watt / area;
inline constexpr Dimension molarEnergy = energy / amount;
inline constexpr Dimension molarMass = mass / amount;
inline constexpr Dimension concentration = amount / volume;
inline constexpr Dimension specificEnergy = energy / mass;
inline constexpr Dimension temperatureGradient = temperature / length;
inline constexpr Dimension absorption = power(length, -1);
inline constexpr Dimension perArea = power(length, -2);
inline constexpr Dimension perVolume = power(length, -3);
inline constexpr Dimension ratePerVolume = perVolume / time;

// "a velocity", "a number per area"; "a quantity in kg m/s" for a dimension without a name.
std::string describe(const Dimension& dimension);

// "20 cm/s": how a quantity of this dimension may be written. Empty where there is no customary example.
std::string example(const Dimension& dimension);

// The SI unit: "m/s", "kg/m^3", "1/m^2", "Pa"; empty for a plain number. parseUnit() reads it back.
std::string siUnit(const Dimension& dimension);

// A unit: a value in it is `factor * value + offset` in SI. Only degC has an offset.
struct Unit {
  double factor = 1.0;
  double offset = 0.0;
  Dimension dimension;
};

// Reads a unit expression: products ("kg m", "kg*m"), quotients ("J/mol/K", "W/(m^2 K)"), integer powers ("m^2", "m2",
// "s^-1"), SI prefixes. InputError where it cannot be read; the message names the part that is not understood.
Unit parseUnit(std::string_view text);

// Reads a number: decimal, finite, the whole text. InputError otherwise.
double parseNumber(std::string_view text);

// Reads "number unit" (a bare number is SI; angles and speeds of revolution need a unit) and returns the value in SI.
// InputError where it is not a finite quantity of the expected dimension: "expected a velocity (for instance '20
// cm/s'), found '20 cm', a length".
double parseQuantity(std::string_view text, const Dimension& expected);

}  // namespace lampblack::io::units
