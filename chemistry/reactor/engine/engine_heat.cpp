#include "chemistry/reactor/engine/engine_heat.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/poisson.hpp"

namespace lampblack::chemistry {
namespace {

// Air's viscosity after Sutherland (1893; White, Viscous Fluid Flow, table 1-2), Pa s; and its Prandtl number.
double airViscosity(double T) {
  return 1.716e-5 * std::pow(T / 273.15, 1.5) * (273.15 + 110.4) / (T + 110.4);
}
constexpr double airPrandtl = 0.71;

double gasSpeed(const EngineHeatLaw& law, const EngineHeatState& s) {
  const double pistons = (law.pistonSpeedFactor + law.swirlFactor * law.swirl) * s.pistonSpeed;
  const double above = s.motoredPressure > 0 ? std::max(0.0, s.pressure - s.motoredPressure) : 0.0;
  const double reference = s.referencePressure * s.referenceVolume;
  return above > 0 ? pistons + law.combustionFactor * s.displacement * s.referenceTemperature / reference * above
                   : pistons;
}

}  // namespace

EngineHeatLaw woschniLaw() {
  EngineHeatLaw law;
  law.model = EngineHeatLaw::Model::woschni;
  law.factor = 3.26;
  return law;
}

EngineHeatLaw hohenbergLaw() {
  EngineHeatLaw law;
  law.model = EngineHeatLaw::Model::hohenberg;
  law.factor = 129.8;
  law.sizePower = -0.06;
  law.temperaturePower = -0.4;
  return law;
}

EngineHeatLaw nusseltLaw() {
  EngineHeatLaw law;
  law.model = EngineHeatLaw::Model::nusselt;
  law.factor = 0.035;
  return law;
}

double heatCoefficient(const EngineHeatLaw& law, const EngineHeatState& s) {
  switch (law.model) {
    case EngineHeatLaw::Model::none:
      return 0;
    case EngineHeatLaw::Model::constant:
      return law.factor;
    case EngineHeatLaw::Model::woschni:
      return law.factor * std::pow(s.bore, law.sizePower) * std::pow(1e-3 * s.pressure, law.pressurePower) *
             std::pow(s.temperature, law.temperaturePower) * std::pow(gasSpeed(law, s), law.speedPower);
    case EngineHeatLaw::Model::hohenberg:
      return law.factor * std::pow(s.volume, law.sizePower) * std::pow(1e-5 * s.pressure, law.pressurePower) *
             std::pow(s.temperature, law.temperaturePower) * std::pow(s.pistonSpeed + law.speedOffset, law.speedPower);
    case EngineHeatLaw::Model::nusselt: {
      const double viscosity = airViscosity(s.temperature), conductivity = viscosity * s.capacity / airPrandtl;
      const double reynolds = s.density * gasSpeed(law, s) * s.bore / viscosity;
      return law.factor * std::pow(reynolds, law.reynoldsPower) * std::pow(airPrandtl, law.prandtlPower) *
             conductivity / s.bore;
    }
  }
  return 0;
}

double EngineHeatLoss::advance(double duration, double conductance, double wall, RandomStream& random,
                               EngineGas& gas) const {
  if (!(conductance > 0) || !(duration > 0)) return 0;
  const double mass = std::accumulate(gas.mass.begin(), gas.mass.end(), 0.0);
  double lost = 0;
  for (std::size_t i = 0; i < gas.count(); ++i) {
    const double T = gas.temperature[i], rate = conductance * duration / mass;
    // The heat capacity is that halfway.
    const double halfway = wall + (T - wall) * std::exp(-0.5 * rate / thermo_.cpMass(T, gas.Y(i)));
    const double times = rate / thermo_.cpMass(halfway, gas.Y(i));
    const double left = jump_ > 0 ? std::pow(1 - 1 / jump_, poisson(random, jump_ * times)) : std::exp(-times);
    if (left == 1) continue;
    gas.temperature[i] = wall + (T - wall) * left;
    lost += gas.mass[i] * (thermo_.enthalpyMass(T, gas.Y(i)) - thermo_.enthalpyMass(gas.temperature[i], gas.Y(i)));
  }
  return lost;
}

}  // namespace lampblack::chemistry
