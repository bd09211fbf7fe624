// Inside of FlameEquations: the gas at the points of a flame and between them, in flat arrays. Not for other modules.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "chemistry/kinetics/batch_kinetics.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "chemistry/transport/multicomponent_transport.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_equations.hpp"
#include "flow/flame/flame_problem.hpp"
#include "flow/flame/flame_profile.hpp"
#include "flow/models/carried_model.hpp"
#include "flow/models/radiation.hpp"

namespace lampblack::flow {

// At the points. Arrays of species (and scalars) are point-major.
struct FlameNodes {
  std::vector<double> density, weight, cp;         // kg/m3, kg/mol, J/kg/K
  std::vector<double> X;                           // mole fractions
  std::vector<double> enthalpy, heat;              // of each species: J/kg, and cp in J/kg/K
  std::vector<double> source;                      // kg/m3/s of each species: reactions, and what is exchanged
  std::vector<double> exchanged;                   // kg/m3/s, sum of what is exchanged: of the whole gas
  std::vector<double> scalarRate;                  // of each scalar, per m3 and s, in its own unit
  std::vector<double> scalarEnthalpy, scalarHeat;  // of a unit of each scalar: J, J/K
  std::vector<double> absorption, loss;            // 1/m, W/m3 (less what a given exchange brings)
};

// Between point f and f + 1; coefficients at the mean state of the two.
struct FlameFaces {
  std::vector<double> viscosity, conductivity;
  std::vector<double> drift;           // kg/m2/s: rho times thermophoretic velocity at coefficient 1
  std::vector<double> upwind;          // 0: central, 1: upwind
  std::vector<double> temperature;     // K, where the coefficients were evaluated
  std::vector<double> conductance;     // kg/m2/s: a_k with j_k = -a_k (X_k+ - X_k), or mass fractions (Lewis numbers)
  std::vector<double> pairs;           // multicomponent: G_kl at [f][k][l], j_k = sum_l G_kl (X_l+ - X_l)
  std::vector<double> thermal;         // kg/m/s, thermal diffusion coefficients
  std::vector<double> diffusion;       // kg/m2/s, j_k after correction
  std::vector<double> excess;          // sum of j_k before correction
  std::vector<double> flux;            // kg/m2/s: convection and diffusion of each species
  std::vector<double> enthalpy, heat;  // of each species at the face's temperature: J/kg, J/kg/K
  std::vector<double> scalarFlux;      // unit/m2/s
  std::vector<double> scalarLift;      // value at the face over that of the point upstream, less 1
  std::vector<double> scalarConductance;
  std::vector<double> scalarEnthalpy, scalarHeat;  // of a unit of each scalar: J, J/K

  // A face value of the gas at mass flux m is (1/2 + lean) of the point on the left and (1/2 - lean) of that on the
  // right.
  [[nodiscard]] double lean(std::size_t f, double m) const { return m > 0 ? 0.5 * upwind[f] : -0.5 * upwind[f]; }
};

// Conductances (rho D, lambda, mu) grow about with this power of the temperature.
inline constexpr double conductanceExponent = 0.7;

class FlameGas {
 public:
  FlameGas(const Mechanism& mechanism, const FlameProblem& problem, CarriedModel* carried);

  void resize(std::size_t points);
  // Density, weight, mole fractions of points [begin, end).
  void composition(const FlameProfile& x, std::size_t begin, std::size_t end);
  // The heat capacity of every point.
  void heatCapacities(const FlameProfile& x);
  // Everything else of these points; the composition is there. `exchange` may be null.
  void sources(const FlameProfile& x, std::size_t begin, std::size_t end, const GivenExchange* exchange);
  // Faces [begin, end); the composition of both their points is there.
  void fluxes(const FlameProfile& x, std::size_t begin, std::size_t end);

  // What carried matter does between the points of face f, and at point i: fluxes and sources of the scalars alone.
  void scalarFluxes(const FlameProfile& x, std::size_t f);
  void scalarSources(const FlameProfile& x, std::size_t i);

  // Decides between central and upwind differences at every face, and about the values of scalars there, for this and
  // all following fluxes: Newton's method does not converge while it changes.
  void chooseBlend(const FlameProfile& x);
  void chooseScalarValues(const FlameProfile& x);  // of scalars alone; the drift is there

  // The gas of a point as the carried model wants it; `storage` holds its concentrations.
  [[nodiscard]] ParticleGas carriedGas(const FlameProfile& x, std::size_t point, std::vector<double>& storage);
  // Densities (per m3) of the scalars of a point.
  void densities(const FlameProfile& x, std::size_t point, std::span<double> out) const;

  // d(loss)/dT at a point, W/m3/K.
  [[nodiscard]] double lossSlope(const FlameProfile& x, std::size_t point) const;

  [[nodiscard]] bool massBasis() const { return massBasis_; }
  [[nodiscard]] bool multicomponent() const { return multicomponent_.has_value(); }

  // Coefficients keep their composition, and follow the temperature by a power (conductanceExponent): what the Newton
  // matrix assumes.
  bool frozen = false;

  FlameNodes nodes;
  FlameFaces faces;
  std::vector<double> weights;                      // kg/mol
  std::vector<std::vector<double>> scalarElements;  // kg of each element per unit of a scalar
  std::vector<double> scalarScale, scalarThermophoresis;

 private:
  void speciesEnthalpies(double T, double* h, double* cp) const;
  void addExchange(const FlameProfile& x, std::size_t point, const GivenExchange& exchange);
  void addCarried(const FlameProfile& x, std::size_t point);
  void coefficients(const FlameProfile& x, std::size_t f, double h);
  void evaluateCoefficients(double T, std::size_t f, double h);
  void scaleCoefficients(double T, std::size_t f);
  [[nodiscard]] double pecletNumber(double m, std::size_t f, double h) const;
  void diffusiveFluxes(const FlameProfile& x, std::size_t f, double h);

  std::size_t n_;
  double pressure_;
  TransportModel options_;
  CarriedModel* carried_;
  SpeciesThermo thermo_;
  Transport transport_;
  std::optional<MulticomponentTransport> multicomponent_;
  BatchKinetics kinetics_;
  std::optional<ThinRadiation> radiation_;
  bool massBasis_ = false;
  double meanMoles_ = 0;  // mol/kg, of the face at hand

  std::vector<double> temperatures_, concentrations_, rates_, meanX_, meanY_, D_, pairM_;
  std::vector<double> carriedConcentrations_, densities_, carriedRates_, carriedExchange_, carriedD_;
};

}  // namespace lampblack::flow
