#include <cmath>
#include <numbers>

#include "app/deck/gas_input.hpp"
#include "app/problems/engine/engine_repeat.hpp"
#include "chemistry/thermo/equilibrium.hpp"
#include "core/errors.hpp"
#include "core/random.hpp"

namespace lampblack::app {
namespace {

// What random numbers are for: RandomStream.
constexpr std::uint32_t chargePurpose = 0x63687267;

double normal(RandomStream& random) {
  const double radius = std::sqrt(-2 * std::log(random.uniform()));
  return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

// Part of burnt gas by mass.
double exhaustByMass(const EngineCase& made, const Thermo& thermo, std::span<const double> fresh,
                     std::span<const double> burnt) {
  if (!made.isExhaustByMole) return made.exhaust;
  const double ofBurnt = made.exhaust * thermo.meanMolecularWeight(burnt);
  return ofBurnt / (ofBurnt + (1 - made.exhaust) * thermo.meanMolecularWeight(fresh));
}

std::vector<double> freshGas(const EngineCase& made, const Thermo& thermo, double ratio) {
  if (made.fuel.empty()) return made.fresh;
  std::vector<double> Y(made.fresh.size());
  thermo.moleToMass(mixByEquivalenceRatio(*made.mechanism, made.fuel, made.oxidizer, ratio), Y);
  return Y;
}

}  // namespace

EngineGas engineCharge(const EngineCase& made, std::uint64_t repeat, const EngineResidual& left) {
  const Thermo thermo(*made.mechanism);
  RandomStream random(made.options.seed, repeat, chargePurpose);
  std::vector<double> burnt = made.fresh;
  if (made.exhaust > 0) Equilibrium(*made.mechanism).atTemperatureAndPressure(made.exhaustFrozen, made.pressure, burnt);
  const double exhaust = made.exhaust > 0 ? exhaustByMass(made, thermo, made.fresh, burnt) : 0;
  const double residual = left.massFractions.empty() ? 0 : made.residual;

  double residualEnthalpy = 0;
  if (residual > 0) {
    EngineGas expanded;
    expanded.species = made.fresh.size();
    expanded.pressure = left.pressure;
    expanded.add(1, left.temperature, left.massFractions);
    // To the pressure of the charge along its isentrope.
    EngineCompression compression(thermo);
    for (int tries = 0; tries < 60 && std::abs(expanded.pressure / made.pressure - 1) > 1e-13; ++tries) {
      const double slope =
          thermo.cvMass(expanded.temperature[0], expanded.Y(0)) / thermo.cpMass(expanded.temperature[0], expanded.Y(0));
      compression.moveTo(volumeOf(thermo, expanded) * std::pow(expanded.pressure / made.pressure, slope), expanded);
    }
    residualEnthalpy = thermo.enthalpyMass(expanded.temperature[0], expanded.Y(0));
  }

  EngineGas gas;
  gas.species = made.fresh.size();
  gas.pressure = made.pressure;
  for (std::size_t i = 0; i < made.particles; ++i) {
    const double ratio = made.ratioDeviation > 0 ? made.ratio + made.ratioDeviation * normal(random) : made.ratio;
    const double T =
        made.temperature + (made.temperatureDeviation > 0 ? made.temperatureDeviation * normal(random) : 0);
    if (!(ratio >= 0) || !(T > Thermo::minTemperature))
      throw InputError(
          "the deviations of the charge are so large that a particle has no fuel or heat left; give less "
          "of charge.temperature_deviation or charge.ratio_deviation");
    std::vector<double> Y = made.ratioDeviation > 0 ? freshGas(made, thermo, ratio) : made.fresh;
    for (std::size_t k = 0; k < Y.size(); ++k) Y[k] += exhaust * (burnt[k] - Y[k]);
    double temperature = T;
    if (residual > 0) {
      const double enthalpy = (1 - residual) * thermo.enthalpyMass(T, Y) + residual * residualEnthalpy;
      for (std::size_t k = 0; k < Y.size(); ++k) Y[k] += residual * (left.massFractions[k] - Y[k]);
      temperature = thermo.temperatureFromEnthalpy(enthalpy, Y, T);
    }
    gas.add(1, temperature, Y);
  }
  const double volume = volumeOf(thermo, gas), cylinder = made.options.volume(0);
  for (double& mass : gas.mass) mass *= cylinder / volume;
  return gas;
}

}  // namespace lampblack::app
