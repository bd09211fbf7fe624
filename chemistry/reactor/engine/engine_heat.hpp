// Heat from the gas of a cylinder to its walls: correlations of the coefficient, and the loss of each particle, by
// jumps or as a mean (docs/theory/engine.md has equations and sources).
#pragma once

#include "chemistry/reactor/engine/engine_gas.hpp"
#include "core/modules.hpp"
#include "core/random.hpp"

namespace lampblack::chemistry {

struct EngineHeatLaw {
  enum class Model { none, woschni, hohenberg, nusselt, constant } model = Model::none;
  // Woschni: W/m2/K of bore in m, pressure in kPa, temperature in K, gas speed in m/s. Hohenberg: of m3, bar, K, m/s.
  double factor = 0;
  double pressurePower = 0.8, temperaturePower = -0.55, speedPower = 0.8;
  double sizePower = -0.2;                        // of the bore; Hohenberg: of the volume
  double pistonSpeedFactor = 2.28;                // Woschni, Nusselt
  double swirlFactor = 0.308;                     // times the swirl's ratio to the speed of the piston
  double combustionFactor = 3.24e-3;              // m/s/K
  double speedOffset = 1.4;                       // m/s, Hohenberg
  double reynoldsPower = 0.71, prandtlPower = 0;  // Nu = factor Re^a Pr^b
  double swirl = 0;
};
[[nodiscard]] EngineHeatLaw woschniLaw();
[[nodiscard]] EngineHeatLaw hohenbergLaw();
[[nodiscard]] EngineHeatLaw nusseltLaw();

// What the coefficient sees.
struct EngineHeatState {
  double pressure = 0, temperature = 0, volume = 0;                             // Pa, K, m3
  double density = 0, capacity = 0;                                             // kg/m3, J/kg/K at constant pressure
  double bore = 0, pistonSpeed = 0;                                             // m, m/s, mean
  double displacement = 0;                                                      // m3
  double referencePressure = 0, referenceTemperature = 0, referenceVolume = 0;  // at a time without combustion
  double motoredPressure = 0;  // Pa, what the reference comes to without combustion
};
// W/m2/K.
[[nodiscard]] double heatCoefficient(const EngineHeatLaw& law, const EngineHeatState& state);

// A particle jumps to T - (T - T_wall)/C at the rate C kappa, kappa its coefficient times area over its share of the
// heat capacity; C infinite (0 here): T - T_wall decays as exp(-kappa t). At constant pressure.
class EngineHeatLoss {
 public:
  EngineHeatLoss(const Thermo& thermo, double jumpConstant) : thermo_(thermo), jump_(jumpConstant) {}
  // conductance: coefficient times area, W/K. Returned is the heat lost, J.
  double advance(double duration, double conductance, double wall, RandomStream& random, EngineGas& gas) const;

 private:
  const Thermo& thermo_;
  double jump_;
};

}  // namespace lampblack::chemistry
