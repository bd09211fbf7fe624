// What is said of a cycle of an engine from its trace: when the fuel burns, work, how fast the pressure rises.
#pragma once

#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

// A value a point of time, in rising order.
struct EngineTrace {
  std::vector<double> angle, time, volume, pressure, temperature, gamma;  // deg, s, m3, Pa, K
  std::vector<double> chemical;                                           // J, set free since the start
};

// deg, where this part of all the heat has been set free, linear in between; NaN where none was.
[[nodiscard]] double burntAngle(const EngineTrace& trace, double part);
// J/deg at each point: gamma/(gamma - 1) p dV + V dp/(gamma - 1), by central differences.
[[nodiscard]] std::vector<double> netHeatRelease(const EngineTrace& trace);
// The highest pressure of all points of time that it is told, and the steepest rise over a window of time: the rise
// over a shorter step would be that of one particle.
class EnginePeaks {
 public:
  void begin(double window, double time, double pressure);  // s, Pa
  // Whether this pressure is the highest so far.
  bool add(double time, double pressure);
  void setGas(double temperature, double gamma, double gasConstant);  // at the highest: K, 1, J/kg/K

  [[nodiscard]] double pressure() const { return pressure_; }  // Pa
  [[nodiscard]] double time() const { return time_; }          // s, of it
  [[nodiscard]] double rise() const { return rise_; }          // Pa/s
  // W/m2, (0.05 ms dp/dt)^2/(2 gamma p) sqrt(gamma R T) at the highest pressure (Eng, SAE 2002-01-2859).
  [[nodiscard]] double ringing() const;

  // All that it has, for a checkpoint.
  [[nodiscard]] std::vector<double> packed() const;
  void unpack(const std::vector<double>& values);

 private:
  double window_ = 0, pressure_ = 0, time_ = 0, rise_ = 0;
  double temperature_ = 0, gamma_ = 1, gasConstant_ = 0;
  std::vector<double> times_, pressures_;  // the window, with one point before it
};

}  // namespace lampblack::chemistry
