// The equations of a well-mixed reactor of constant pressure or constant density in the unknowns (Y_1..Y_N, T), and
// their analytic Jacobian:
//   dY_k/dt = f W_k wdot_k / rho + S_k - r Y_k - l_k Y_k
//   constant pressure:  cp dT/dt = q - r h - sum_k h_k dY_k/dt      (dh/dt = q - r h)
//   constant density:   cv dT/dt = q - r u - sum_k u_k dY_k/dt      (du/dt = q - r u)
// Where the volume V is a given function of time, the density of a moment takes the place of the constant one, and
// the gas works on what moves: du/dt = q - r u - e p/rho, e = V'/V.
// A constant source S_k, a removal rate r and a heating q are all zero in a closed adiabatic reactor; a factor f is
// on the reactions, one where nothing holds them up. Where the temperature is given, dT/dt is a given number instead,
// and species may be lost at rates l_k of their own.
//
// A source alone (r = q = 0) brings the enthalpy (energy) that keeps the mixture's. A perfectly stirred reactor of
// residence time tau and constant pressure has S = Y_in/tau, r = 1/tau, q = h_in/tau; losses to a wall lower q.
//
// A reactor may carry a phase besides its gas (particles), whose amounts z per kg follow (Y, T) as unknowns. Everything
// per kg is then per kg of gas and particles together: the mass fractions of the species sum to the gas's share, rho is
// the mass of both per volume, and the phase takes part in the balances of species and energy (reactor_carried.cpp).
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/carried_phase.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class ReactorSystem {
 public:
  enum class Held { Pressure, Density };
  enum class Energy { Conserved, GivenTemperature };

  struct Conditions {
    Held held = Held::Pressure;
    double value = 0;  // Pa or kg/m3
    Energy energy = Energy::Conserved;
    double temperatureRate = 0;                  // dT/dt, K/s, where the temperature is given
    std::span<const double> source;              // S, 1/s, a value a species; copied; may be empty
    std::span<const double> carriedSource = {};  // the same of a carried phase
    // l, 1/s, a value a species; copied; may be empty. What is lost takes no energy along: of given temperature only.
    std::span<const double> loss = {};
    double carriedRemoval = 0;  // the same of all that is carried, beside r
    double removal = 0;         // r, 1/s
    double heating = 0;         // q, J/kg/s
    double expansion = 0;       // e, 1/s, of a volume that changes: beside constant density alone
    bool reacts = true;         // false: without wdot
    double rateFactor = 1;      // f
  };

  // J in parts, the sum of a sparse matrix with a full last row and column and of a product of two vectors:
  // J_ij = S_ij + u_i v_j. S_kj of the species has the entries of pattern(); v_j = 1/W_j of the species, v_T = 0.
  struct SparseJacobian {
    std::vector<double> species;            // S_kj, an entry each
    std::vector<double> temperatureRow;     // S_Tj, a value a species
    std::vector<double> temperatureColumn;  // S_iT, a value an unknown
    std::vector<double> product;            // u_i, a value an unknown
  };

  // The carried phase, if any, has to live as long. Rates follow mass action through zero, which drives single species
  // back, down to `leastFraction`: a mass fraction below it counts as that. Where transport leaves all radicals of a
  // gas below zero, chain branching multiplies what is negative as it does what is positive; from there on it does not.
  explicit ReactorSystem(const Mechanism& mechanism, CarriedPhase* carried = nullptr,
                         double leastFraction = std::numeric_limits<double>::lowest());

  std::size_t numSpecies() const { return weights_.size(); }
  std::size_t numCarried() const { return carriedSource_.size(); }
  std::size_t size() const { return weights_.size() + 1 + carriedSource_.size(); }
  Thermo& thermo() { return thermo_; }
  std::span<const double> inverseWeights() const { return inverseWeights_; }  // mol/kg
  const SparsePattern& pattern() const { return kinetics_.jacobianPattern(); }

  // What holds for the evaluations that follow.
  void setConditions(const Conditions& conditions);
  // Constant pressure (Pa), energy conserved, a source (1/s, may be empty), a heating (J/kg/s), a factor on the rates.
  void setConditions(double pressure, std::span<const double> source, double heating = 0, double rateFactor = 1);

  // f = dy/dt. False, with f undefined, if the state is outside the range of the data
  // (Thermo::minTemperature..maxTemperature) or not finite.
  bool rates(const double* y, double* f);
  // The chemical part of dY_k/dt alone.
  bool chemicalRates(const double* y, double* f);
  // J[i + ld*j] = d f_i / d y_j; also leaves f.
  bool jacobian(const double* y, double* f, double* J, std::size_t ld);
  // The same, of a gas alone; sizes its argument.
  bool sparseJacobian(const double* y, double* f, SparseJacobian& J);

  // Why an evaluation returned false last; empty if none has since clearRefusal().
  const std::string& refusal() const { return refusal_; }
  void clearRefusal() { refusal_.clear(); }

  // Of the state of the last evaluation.
  double density() const { return density_; }    // kg/m3
  double pressure() const { return pressure_; }  // Pa

 private:
  bool prepare(const double* y);
  // The factor on what reactions make, or its derivatives.
  void scaleRates(std::span<double> values) const;
  bool refuse(std::string reason);
  bool accept(const double* f);
  // Of a carried phase: f of its amounts, and what it adds to those of the species; the same of the Jacobian, after
  // the rates.
  bool addCarriedRates(const double* y, double* f);
  void addCarriedJacobian(const double* y, double* J, std::size_t ld);
  double heatCapacity(const double* y) const;
  void speciesEnergies(double T);
  double temperatureSlope(const double* y, const double* f);
  void finishExcess(double T, double* temperatureColumn);
  bool finishRates(const double* y, double* f);
  void speciesBlock(double* J, std::size_t ld) const;
  void sparseColumns(SparseJacobian& J) const;
  // d(e p/rho)/dY_j, J/kg/s
  double workByFraction(std::size_t j, double T) const { return conditions_.expansion * gasConstants_[j] * T; }
  double temperatureDiagonal(const double* y, const double* f, const double* temperatureColumn);

  Thermo thermo_;
  Kinetics kinetics_;
  double leastFraction_;
  std::vector<double> weights_, inverseWeights_;
  Conditions conditions_;
  std::vector<double> source_, loss_;
  double density_ = 0, pressure_ = 0, meanWeight_ = 0;
  std::vector<double> c_, wdot_;
  double inverseCapacity_ = 0;  // 1/(mixture's heat capacity); 0 where the temperature is given
  // Enthalpies and cp at constant pressure, internal energies and cv at constant density; J/kg, J/kg/K, J/kg/K2.
  std::vector<double> energy_, capacity_, capacitySlope_, gasConstants_;
  std::vector<double> excess_, byT_, common_;
  CarriedPhase* carried_;
  std::vector<double> carriedSource_, carriedDensity_, carriedRates_, carriedEnergy_, carriedCapacity_;
  std::vector<double> exchange_, carriedJacobian_;
  std::string refusal_;
};

// What the absolute tolerance of unknown i is multiplied with: one for mass fractions and the temperature, which steers
// no steps where it is given; of a carried phase 1e4, as it is in units of its typical amounts.
double reactorToleranceScale(std::size_t i, std::size_t species, bool temperatureIsGiven);

}  // namespace lampblack::chemistry
