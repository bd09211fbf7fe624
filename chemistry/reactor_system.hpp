// The equations of a constant-pressure adiabatic reactor in the unknowns (Y_1..Y_N, T):
//   dY_k/dt = W_k wdot_k / rho + S_k,   dT/dt = -(1/cp) sum_k h_k dY_k/dt,
// with a constant source S_k that brings its own enthalpy, and their analytic Jacobian.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/kinetics.hpp"
#include "chemistry/mechanism.hpp"
#include "chemistry/thermo.hpp"

namespace lampblack {

class ReactorSystem {
 public:
  explicit ReactorSystem(const Mechanism& mechanism);

  std::size_t numSpecies() const { return weights_.size(); }
  std::size_t size() const { return weights_.size() + 1; }
  Thermo& thermo() { return thermo_; }

  // The pressure (Pa) and the source (1/s, may be empty) of the evaluations that follow.
  void setConditions(double pressure, std::span<const double> source);

  // f = dy/dt. Rates follow mass action through zero: negative mass fractions are negative concentrations. False, with
  // f undefined, if the state is outside the range of the data (Thermo::minTemperature..maxTemperature) or not finite.
  bool rates(const double* y, double* f);
  // The chemical part of dY_k/dt alone.
  bool chemicalRates(const double* y, double* f);
  // J[i + ld*j] = d f_i / d y_j; also leaves f.
  bool jacobian(const double* y, double* f, double* J, std::size_t ld);

 private:
  bool prepare(const double* y);

  Thermo thermo_;
  Kinetics kinetics_;
  std::vector<double> weights_, inverseWeights_;
  std::vector<double> source_;
  bool hasSource_ = false;
  double pressure_ = 0;
  double density_ = 0, meanWeight_ = 0;
  std::vector<double> c_, wdot_, h_, cp_, cpSlope_, rowSum_, byT_;
};

}  // namespace lampblack
