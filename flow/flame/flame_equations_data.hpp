// Inside of FlameEquations: what residual, Newton matrix and budgets share. Not for other modules.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "chemistry/kinetics/kinetics.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_equations.hpp"
#include "flow/flame/flame_gas.hpp"

namespace lampblack::flow {

// What happens at an end of the domain.
enum class FlameEnd { Stream, Outlet, Wall };

struct FlameEquations::Data {
  Data(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism, FlameProblem problem, CarriedModel* carried,
       FlameTolerances tolerances);

  MPI_Comm comm;
  int rank = 0, ranks = 1;
  std::shared_ptr<const Mechanism> mechanism;
  FlameProblem problem;
  CarriedModel* carried;
  FlameTolerances tolerances;
  FlameLayout layout;
  FlameEnd rightEnd = FlameEnd::Outlet;
  bool spreading = false;                    // V is solved for
  double leftDensity = 0, rightDensity = 0;  // of the streams, kg/m3

  FlameGas gas;
  Kinetics kinetics;
  FlameProfile profile;                    // the grid, and the unknowns at hand
  std::vector<double> volume;              // of the control volume of each point, m
  std::vector<double> given;               // temperature of each point, where it is given
  std::size_t begin = 0, end = 0;          // points this rank evaluates
  std::vector<int> counts, displacements;  // values of each rank, for gathering

  std::size_t anchor = 0;
  double anchorTemperature = 0;
  double loadValue = 1;
  bool unsteady = false;  // the matrix is that of factoriseUnsteady
  bool steadyFactors = false;
  std::optional<LoadConstraint> constraint;
  std::optional<GivenExchange> exchange;
  std::function<bool(std::size_t)> holds;
  std::vector<double> held;

  std::unique_ptr<BlockTridiagonal> matrix;
  Counters counters;

  [[nodiscard]] std::size_t species() const { return layout.species; }
  [[nodiscard]] std::size_t scalars() const { return layout.scalars; }
  [[nodiscard]] std::size_t width() const { return layout.width(); }
  [[nodiscard]] std::size_t points() const { return profile.points(); }
  [[nodiscard]] std::size_t unknowns() const { return profile.size(); }
  [[nodiscard]] bool isHeld(std::size_t component) const { return holds && holds(component); }

  // Collective: raises Stopped on all ranks where the run is asked to stop.
  void endIfAsked() const;

  [[nodiscard]] std::string nameOf(std::size_t point, std::size_t component) const;

  void setUnknowns(std::span<const double> x) { std::copy(x.begin(), x.end(), profile.x.begin()); }
  bool blendIsChosen = false;
  void chooseBlend();
  // Gas at the points [first, last) and the faces beside them.
  void evaluate(std::size_t first, std::size_t last);

  // Mass flux into the control volume of a point from the left, and the fluxes there.
  [[nodiscard]] double leftFlux(std::size_t i) const {
    return i == 0 ? profile.global(leftMassFlux) : profile.at(i - 1, FlameLayout::massFlux);
  }
  // Of a species through the left and right surfaces of the control volume of point i, kg/m2/s.
  [[nodiscard]] double speciesFluxLeft(std::size_t i, std::size_t k) const;
  [[nodiscard]] double speciesFluxRight(std::size_t i, std::size_t k) const;
  // Velocity (times density) of scalar s at an end, towards larger z; zero where it would bring scalars in. At a wall
  // drift and diffusion to a place without particles, over the value that the flame has there.
  [[nodiscard]] double endDrift(std::size_t s, bool right) const;
  [[nodiscard]] double scalarFluxLeft(std::size_t i, std::size_t s) const;
  [[nodiscard]] double scalarFluxRight(std::size_t i, std::size_t s) const;
  [[nodiscard]] bool temperatureIsGiven(std::size_t i) const;
  [[nodiscard]] double temperatureGiven(std::size_t i) const;
  [[nodiscard]] bool spreadIsGiven(std::size_t i) const;
  [[nodiscard]] double spreadGiven(std::size_t i) const;
  [[nodiscard]] double spreadGivenPerLoad(std::size_t i) const;

  void pointResidual(std::size_t i, double* F) const;
  // Of scalar s alone, over its scale.
  [[nodiscard]] double scalarResidual(std::size_t i, std::size_t s) const;
  // d(flux through face f)/d(scalar s of point f, of point f + 1).
  [[nodiscard]] std::pair<double, double> scalarSlopes(std::size_t f, std::size_t s) const;
  void globalResidual(double* F) const;
  // Energy that gas and scalars gain in a control volume apart from what the temperature equation of a point sets to
  // zero: that equation itself.
  [[nodiscard]] double energyResidual(std::size_t i) const;

  struct JacobianWork;
  void fillRow(std::size_t i, double inverseTimeStep, JacobianWork& work);
  void holdRow(JacobianWork& work);
  void fillGlobals();
  void pointTimeWeights(std::size_t i, double* M) const;
  // Faces and weights of the stagnation plane of a potential flow: mass flux there is a mean of two.
  struct Plane {
    std::size_t face = 0;
    double share = 0;
  };
  [[nodiscard]] Plane stagnationPlane() const;
};

}  // namespace lampblack::flow
