// Plug flow of constant pressure through a duct of constant area: a steady stream without mixing along its way, in the
// unknowns (Y_1..Y_N, T, amounts of what it carries, residence time) over the place z. With the mass flux G = rho u of
// gas and what it carries, which does not change,
// d/dz = (rho/G) d/dt of the closed reactor of constant pressure.
#pragma once

#include <optional>
#include <vector>

#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/ode_system.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "chemistry/reactor/temperature_profile.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class PlugFlow : public OdeSystem {
 public:
  // `massFlux` in kg/m2/s, `length` in m (for the error control of the residence time). With a profile (over z, m) the
  // temperature is given; it replaces that of the inlet. The mechanism and the carried phase have to live as long.
  PlugFlow(const Mechanism& mechanism, const GasState& inlet, double massFlux, double length,
           std::optional<TemperatureProfile> profile = std::nullopt, CarriedPhase* carried = nullptr);

  std::vector<double> initialState() const;
  const std::optional<TemperatureProfile>& profile() const { return profile_; }
  double density(const double* y) const;                                     // kg/m3
  double velocity(const double* y) const { return massFlux_ / density(y); }  // m/s
  double residenceTime(const double* y) const { return y[system_.size()]; }  // s, since the inlet

  std::size_t size() const override { return system_.size() + 1; }
  bool rates(double z, const double* y, double* f) override;
  bool jacobian(double z, const double* y, double* f, double* J, std::size_t ld) override;
  void prescribe(double z, double* y) const override;
  double toleranceScale(std::size_t i) const override;
  std::string describe(double z, const double* y) const override;

 private:
  void takeState(double z, const double* y);

  const Mechanism& mechanism_;
  GasState inlet_;
  double massFlux_;
  double timeScale_ = 0;
  std::optional<TemperatureProfile> profile_;
  std::size_t species_;
  Thermo thermo_;
  ReactorSystem system_;
  std::vector<double> y_, f_;
};

}  // namespace lampblack::chemistry
