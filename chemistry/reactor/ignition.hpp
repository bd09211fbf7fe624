// Ignition delays: when a homogeneous mixture in the unknowns (Y_1..Y_N, T) ignites, by several criteria. Each is a
// zero of an analytic derivative along the solution, found on the integrator's dense output, so that the delay is as
// exact as the integration and does not depend on its steps.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/ode_system.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "chemistry/reactor/volume_law.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct IgnitionCriterion {
  enum class Kind {
    TemperatureRate,  // largest dT/dt
    PressureRate,     // largest dp/dt, at constant volume or one that is given
    MoleFraction,     // largest mole fraction of a species
    MassFraction,     // largest mass fraction of a species
    TemperatureRise,  // T first is `rise` above the initial temperature
  };
  Kind kind = Kind::TemperatureRate;
  std::size_t species = 0;
  double rise = 0;   // K
  std::string name;  // for results
  // Of dp/dt: density at time zero times the gas constant (SI), so that p = scale T sum(Y/W) V(0)/V.
  double scale = 1;
  // Of a rate: its first maximum after some heat has been set free, where a higher one follows.
  bool firstStage = false;

  // Whether it is about a maximum of dT/dt or dp/dt.
  [[nodiscard]] bool ofRate() const { return kind == Kind::TemperatureRate || kind == Kind::PressureRate; }
};

struct IgnitionEvent {
  double time = 0;   // s: the delay
  double value = 0;  // of what is largest (K/s, Pa/s or 1), or the temperature
  // Of a maximum: sqrt(|a/a''|), the time in which the quantity a falls off noticeably; of a rise: rise/(dT/dt).
  double width = 0;
};

// The quantity a criterion is about - dT/dt, dp/dt, a fraction, or T - and its rate of change, at a state of a system.
class IgnitionQuantity {
 public:
  // With a law for the volume, which has to live as long, dp/dt is that of the volume of the moment.
  IgnitionQuantity(const Mechanism& mechanism, OdeSystem& system, const VolumeLaw* volume = nullptr);

  struct Value {
    double value = 0, slope = 0;
  };
  // Prepares the rates (and, for dT/dt and dp/dt, the Jacobian) of a state; NumericsError where it is no state of a
  // gas.
  void prepare(double t, const double* y, bool withJacobian);
  Value of(const IgnitionCriterion& criterion, const double* y) const;
  // What goes with a change s of the prepared state and sDot of its rates: the change of dT/dt or dp/dt itself, of the
  // slope of a fraction, or of a temperature.
  double change(const IgnitionCriterion& criterion, const double* y, const double* s, const double* sDot) const;

 private:
  // X_k = (Y_k/W_k)/M, M = sum Y/W: the change of X_k with that of Y.
  struct MoleFraction {
    double X = 0, M = 0;
  };
  MoleFraction moleFraction(std::size_t k, const double* y) const;
  double moles(const double* Y) const;
  double moleFractionChange(std::size_t k, const MoleFraction& at, const double* s) const;

  const Mechanism& mechanism_;
  OdeSystem& system_;
  // (J f + df/dt)_row: the second derivative of an unknown.
  double second(std::size_t row) const;

  const VolumeLaw* volume_ = nullptr;
  double time_ = 0;
  std::vector<double> f_, J_;
  std::vector<double> byTime_, other_;  // df/dt at a held state; empty where there is none
};

// Watches an integration step by step. Of several maxima the highest inside the time counts; a quantity that is largest
// at the beginning or the end has none, and a fraction that stays below 1e4 absolute tolerances is noise.
class IgnitionMonitor {
 public:
  IgnitionMonitor(const Mechanism& mechanism, OdeSystem& system, std::vector<IgnitionCriterion> criteria,
                  const VolumeLaw* volume = nullptr);

  void begin(double time, const double* y);
  void observe(const StiffIntegrator& integrator);  // after each step

  const std::vector<IgnitionCriterion>& criteria() const { return criteria_; }
  // In the order of the criteria; nothing where it did not happen.
  const std::vector<std::optional<IgnitionEvent>>& events() const { return events_; }

 private:
  // What a criterion looks for a zero of: the slope of the quantity, or T less the temperature to reach.
  double signal(std::size_t i, const IgnitionQuantity::Value& value) const;
  void locate(std::size_t i, const StiffIntegrator& integrator, double before, double after);

  IgnitionQuantity quantity_;
  std::vector<IgnitionCriterion> criteria_;
  std::vector<std::optional<IgnitionEvent>> events_;
  std::vector<std::optional<IgnitionEvent>> first_;  // maxima that are a first stage where a higher one follows
  std::vector<double> signals_;                      // at the end of the last step
  std::size_t temperature_;                          // its unknown
  std::vector<double> y_;
  double startTemperature_ = 0;
  bool needsJacobian_ = false;
};

}  // namespace lampblack::chemistry
