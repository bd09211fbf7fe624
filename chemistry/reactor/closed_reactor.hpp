// A closed, well-mixed reactor of constant pressure, or of a volume that is constant or given in time; adiabatic or of
// given temperature, in the unknowns
// (Y_1..Y_N, T) and the amounts of what it carries (ReactorSystem); with the derivatives of its rates by the logarithm
// of the rate constants, for sensitivities of a gas alone.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "chemistry/reactor/ode_system.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "chemistry/reactor/temperature_profile.hpp"
#include "chemistry/reactor/volume_law.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct GasState {
  double temperature = 0;            // K
  double pressure = 0;               // Pa
  std::vector<double> Y;             // mass fractions
  std::vector<double> carried = {};  // amounts of a carried phase; empty: none of it
};

class ClosedReactor : public OdeSystem, public OdeParameters {
 public:
  // A reactor that starts from `initial` and holds its pressure or its density. With a profile (over time, s) the
  // temperature is given. With a law for the volume, which goes with a held density, the density is that of the start
  // over V/V(0). The mechanism and the carried phase have to live as long.
  ClosedReactor(const Mechanism& mechanism, const GasState& initial, ReactorSystem::Held held,
                std::optional<TemperatureProfile> profile = std::nullopt, CarriedPhase* carried = nullptr,
                std::optional<VolumeLaw> volume = std::nullopt);

  // From another start, all else as it is.
  void startFrom(const GasState& initial);
  // The start as unknowns; a given temperature replaces that of the initial state.
  std::vector<double> initialState() const;
  bool isAdiabatic() const { return !profile_; }
  const std::optional<TemperatureProfile>& profile() const { return profile_; }

  const std::optional<VolumeLaw>& volume() const { return volume_; }

  // Density (kg/m3, of all the reactor holds) and pressure (Pa) of a state at a time.
  double density(double t, const double* y) const;
  double pressure(double t, const double* y) const;
  // Heat set free by the reactions, W/m3.
  double heatRelease(double t, const double* y);

  std::size_t size() const override { return system_.size(); }
  bool rates(double t, const double* y, double* f) override;
  bool jacobian(double t, const double* y, double* f, double* J, std::size_t ld) override;
  bool dependsOnTime() const override { return profile_ || volume_; }
  void prescribe(double t, double* y) const override;
  double toleranceScale(std::size_t i) const override;
  std::string describe(double t, const double* y) const override;

  // The reactions (numbers in the mechanism) whose rate constants, both directions at once so that the equilibrium
  // stays, are the parameters: p = ln k. None until then.
  void setParameters(std::vector<std::size_t> reactions);
  std::size_t numParameters() const override { return parameters_.size(); }
  bool prepareParameters(double t, const double* y) override;
  void addByParameter(std::size_t parameter, double* f) const override;

 private:
  struct Parameter {
    std::size_t reaction = 0;
    std::vector<StoichiometricTerm> net;
  };
  // The state with the given temperature in it where there is one; sets what holds at that time.
  const double* at(double t, const double* y);
  // kg/m3, of a held density
  double heldDensity(double t) const { return volume_ ? startDensity_ / volume_->ratio(t) : startDensity_; }

  const Mechanism& mechanism_;
  GasState initial_;
  ReactorSystem::Conditions conditions_;
  std::optional<TemperatureProfile> profile_;
  std::optional<VolumeLaw> volume_;
  double startDensity_ = 0;  // kg/m3
  Thermo thermo_;
  ReactorSystem system_;
  Kinetics kinetics_;
  std::vector<Parameter> parameters_;
  std::vector<double> y_, rates_, concentrations_, progress_, reverse_;
  std::vector<double> energy_;  // of species, J/kg: enthalpies, or internal energies at constant volume
  double capacity_ = 0, density_ = 0;
};

// The unknowns (Y, T, amounts of a carried phase of `carried` scalars) of a state.
std::vector<double> unknownsOf(const GasState& state, std::size_t carried);

// "CH4: 0.1, ..." of the mass fractions above 1e-6 in size, for messages.
std::string compositionText(const Mechanism& mechanism, std::span<const double> Y);

}  // namespace lampblack::chemistry
