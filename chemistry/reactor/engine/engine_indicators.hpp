// What is said of a cycle of an engine from its trace: when the fuel burns, work, how fast the pressure rises.
#pragma once

#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

// A value a point of time, in rising order.
struct EngineTrace {
  std::vector<double> angle, time, volume, pressure, temperature, gamma;  // deg, s, m3, Pa, K
  std::vector<double> gasConstant;                                        // J/kg/K
  std::vector<double> chemical;                                           // J, set free since the start
};

// deg, where this part of all the heat has been set free, linear in between; NaN where none was.
[[nodiscard]] double burntAngle(const EngineTrace& trace, double part);
// J/deg at each point: gamma/(gamma - 1) p dV + V dp/(gamma - 1), by central differences.
[[nodiscard]] std::vector<double> netHeatRelease(const EngineTrace& trace);
// Steepest rise between two points: Pa/deg and Pa/s.
struct PressureRise {
  double perAngle = 0, perTime = 0;
};
[[nodiscard]] PressureRise steepestRise(const EngineTrace& trace);
// W/m2, (0.05 ms dp/dt)^2/(2 gamma p) sqrt(gamma R T) at the highest pressure (Eng, SAE 2002-01-2859).
[[nodiscard]] double ringingIntensity(const EngineTrace& trace);

}  // namespace lampblack::chemistry
