// A model of turbulence in a flow: it carries the model's variables as a block of scalars, tells transport their
// sources, and sets the eddy viscosity by which momentum, heat, species and other scalars are mixed (GasProperties).
// All of it is that of the state at the end of a sweep: of first order in time, and in a steady state exact. The eddy
// viscosity is part of the state.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "flow/boundaries/gas_variation.hpp"
#include "flow/boundaries/wall_law.hpp"
#include "flow/discretisation/velocity_gradient.hpp"
#include "flow/flow_context.hpp"
#include "flow/models/turbulence/eddies.hpp"
#include "flow/models/turbulence/turbulence_model.hpp"
#include "flow/operator.hpp"
#include "flow/peak.hpp"
#include "flow/properties/gas_properties.hpp"

namespace lampblack::flow {

class TurbulenceOperator : public Operator {
 public:
  // `boundaries`: of each boundary, what comes in there; walls hold zero.
  static ScalarBlock blockOf(const TurbulenceModel& model, const std::vector<BoundaryCondition>& conditions,
                             const std::vector<FreeStream>& boundaries);

  struct Options {
    // Of the eddy viscosity over that of the molecules, beyond which checkResult() fails.
    double mostRatio = std::numeric_limits<double>::infinity();
    bool buoyancy = false;  // eddies gain k, or lose it, where gravity and the slope of the density make or hinder them
  };
  // `properties`: of transport, its molecular viscosities. The state has the model's block. The context has wall
  // distances where the model needs them (std::logic_error). Collective.
  TurbulenceOperator(const FlowContext& context, const State& state, std::shared_ptr<const TurbulenceModel> model,
                     const GasProperties& properties, const Options& options);
  TurbulenceOperator(const FlowContext& context, const State& state, std::shared_ptr<const TurbulenceModel> model,
                     const GasProperties& properties)
      : TurbulenceOperator(context, state, std::move(model), properties, Options()) {}

  // The same everywhere, or the variables per kg and the eddy viscosity of `fields`, where they are. The state has its
  // density and velocities. A model that knows k begins in shear with no larger eddy viscosity than that with which as
  // much of k is produced as dissipated: else k runs away from a frequency that knows nothing of the shear. Collective.
  void setStart(State& state, const FreeStream& start, std::span<const FieldFunction> fields = {});

  [[nodiscard]] const char* name() const override { return "turbulence"; }
  // Moves the eddy viscosity towards that of the variables: all the way where the step is short against the strain's
  // time, a fifth of it where the step is long, lest strain and eddies swing each other up.
  void advance(State& state, double time, double dt) override;
  void endSweep(State& state) override;
  void addRates(const State& state, State::Balance& rates) override;
  void addRatesOfCarried(const State& state, State::Balance& rates) override;
  // Of the state that addRates() was asked of last.
  void addSlopes(const State& state, const Slopes& slopes) override;
  void addCarriedFlow(std::span<double> flow) override;
  [[nodiscard]] bool actsOnCarried() const override { return true; }
  // Both of them functions of the state alone: the diffusivities of the variables, and the eddy viscosity, all of it.
  // Fills the halo of the state first, which slopes need. Collective.
  void setDiffusivities(State& state) override;

  // What reactions need to know of an owned cell. `ofShear`: dissipated is what shear produces, nu_t S^2, and k is nu_t
  // S over C_mu^(1/2) (Bradshaw), with the shear of the state that was evaluated last.
  [[nodiscard]] bool knowsDissipation() const { return model_->knowsEnergy(); }
  [[nodiscard]] Eddies eddies(const State& state, int cell, bool ofShear) const;

  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  void checkResult() const override;
  // The same of a state of which no row of the history has been made, with the molecular viscosity of the properties.
  // NumericsError; collective.
  void checkEddies(const State& state) const;
  void fields(const State& state, const FieldSink& sink) const override;

  // At a wall that the gas sticks to: Pa, friction along it; y+ of the cell's centre.
  struct WallState {
    double shear = 0.0, yPlus = 0.0;
  };
  // Of wall functions, before a run: the walls with cells too thin for the law's logarithmic layer even at a friction
  // velocity of a tenth of the largest speed, which is a c_f of 0.02.
  struct ThinCells {
    double share = 0.0;      // of the walls' area; zero of models without wall functions
    double mostYPlus = 0.0;  // of those cells, at that friction velocity
    double speed = 0.0;      // m/s, the largest
  };
  // Collective.
  [[nodiscard]] ThinCells thinCells(const State& state) const;
  // What the user should know of the cells beside walls, of the last row of the history; may be empty.
  [[nodiscard]] std::string warning() const;
  [[nodiscard]] WallState atWall(int face, const State& state) const;

 private:
  // Of rates by the variables: they become sinks, which steps and iterations take implicitly.
  enum class Tangents { Wanted, Unused };
  void evaluate(const State& state, Tangents tangents);
  [[nodiscard]] bool isOtherFlow(const State& state);
  void findFlow(const State& state);
  void findRates(const State& state);
  void findNeighbours();
  void linearise();
  void findLayers();
  void findWallLaw(const State& state);
  void applyWallLaw();
  void storeDiffusivities(State& state) const;
  [[nodiscard]] Peak largestRatio(const State& state) const;  // of the eddy viscosity over that of the molecules
  void refuseTooViscous(const Peak& ratio) const;
  [[nodiscard]] std::array<double, 2> range() const;  // of y+, that the model is for
  void findShear(const State& state);
  void addStrainGradient(const State& state);
  void findTurning(const State& state);
  void findBuoyancy(const State& state);
  [[nodiscard]] bool isSticky(int face) const;
  [[nodiscard]] double strainAtWall(int face, const State& state) const;
  void add(const State& state, State::Balance& rates) const;

  const FlowContext& context_;
  std::shared_ptr<const TurbulenceModel> model_;
  const GasProperties& properties_;
  Options options_;
  std::size_t first_, count_;
  VelocityGradient velocityGradient_;
  Gradient gradient_;
  std::vector<BoundaryData> known_, knownDensity_, knownStrain_;
  std::vector<TurbulentCell> cells_, beside_;  // beside: one variable a little more
  std::vector<TurbulentRates> rates_, ratesBeside_;
  std::vector<TurbulentRates> modelled_;  // without tangents and what walls make
  bool areRatesKnown_ = false;            // those of values_ and of the flow that was seen last
  struct {
    std::vector<double> velocity, boundary, swirl, density, viscosity;
  } seen_;
  using Slope = std::array<std::array<double, TurbulentCell::most>, TurbulentCell::most>;
  std::vector<Slope> slopes_;  // of the rate of one variable by another
  // Walls for whose layers the law of the wall stands, and of the owned cells beside them what it makes there, and
  // area.
  std::vector<int> layerFaces_;
  std::vector<double> dissipationBeside_;  // of the law where k is a little larger
  std::vector<walllaw::Layer> layers_;
  std::vector<double> layerArea_;
  struct {
    double leastYPlus = 0.0, mostYPlus = 0.0, outside = 0.0;  // outside: share of the walls' area
    Peak ratio;                                               // of the eddy viscosity over that of the molecules
  } told_;
  // Of the local cells and boundary faces: the variables per mass; 1/s.
  std::vector<double> values_, boundaryValues_, valueGradient_, densityGradient_, strain_, boundaryStrain_, strainLog_,
      boundaryStrainLog_, strainGradient_, strainSum_;
  std::vector<Gradient::Beyond> beyond_;
  // Of a flow that swirls: the angular velocity w/r of the local cells and boundary faces, 1/s, and its gradient.
  std::vector<double> turning_, boundaryTurning_, turningGradient_;
  std::vector<BoundaryData> knownTurning_;
  std::vector<double> density_;  // of the owned cells, as evaluated
  std::vector<double> drift_;    // kg/(m^2 s), of the local cells: density times the velocity that moves a variable
};

}  // namespace lampblack::flow
