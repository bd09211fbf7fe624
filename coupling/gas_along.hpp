// A gas with a prescribed history, as the equations of a split reactor. Between the rows of the history concentrations,
// temperature and pressure are straight lines. Particles change only the species that they deplete: with Y_g the mass
// fraction of the history, the mass fraction Y of such a species obeys
//   dY/dt = dY_g/dt + exchange              where Y_g rises: the gas makes as much as it is said to,
//   dY/dt = (Y/Y_g) dY_g/dt + exchange      where it falls: it loses the same part of what there is.
// Without exchange Y is Y_g. docs/theory/particles_along.md.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/ode_system.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "core/modules.hpp"
#include "coupling/given_gas.hpp"

namespace lampblack::coupling {

class GasAlong final : public OdeSystem {
 public:
  // All have to live as long. `depleted`: species by number. InputError as givenPath().
  GasAlong(const Mechanism& mechanism, const GasHistory& history, const std::vector<std::size_t>& depleted,
           CarriedPhase* carried);

  // Initial state (Y, T, amounts of the carried phase), at the first row.
  [[nodiscard]] std::vector<double> initialState() const;
  [[nodiscard]] double density(double t, const double* y) const;  // kg/m3
  [[nodiscard]] double pressure(double t) const;                  // Pa
  // The next row behind t; infinity behind the last.
  [[nodiscard]] double nextRow(double t) const;
  // For every species, whether its mass fraction is that of the history.
  [[nodiscard]] const std::vector<bool>& held() const { return held_; }

  [[nodiscard]] std::size_t size() const override { return system_.size(); }
  bool rates(double t, const double* y, double* f) override;
  bool jacobian(double t, const double* y, double* f, double* J, std::size_t ld) override;
  void prescribe(double t, double* y) const override;
  [[nodiscard]] double toleranceScale(std::size_t i) const override;
  [[nodiscard]] std::string describe(double t, const double* y) const override;

 private:
  struct Place {
    std::size_t row = 0;
    double share = 0;  // of the way to the next
  };
  [[nodiscard]] Place placeOf(double t) const;
  [[nodiscard]] double mixed(const std::vector<double>& values, const Place& place) const;
  [[nodiscard]] double fraction(const Place& place, std::size_t k) const;
  const double* withGivenGas(double t, const double* y);
  void setConditions(const Place& place, double t);

  const Mechanism& mechanism_;
  const GasHistory& history_;
  std::vector<bool> held_;
  std::vector<double> partial_;  // kg/m3, a row of all species for each time
  std::vector<double> density_;  // their sums
  ReactorSystem system_;
  std::vector<double> y_, slope_, source_, loss_;
};

}  // namespace lampblack::coupling
