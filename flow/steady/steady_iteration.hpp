// Iterations that bring a flow to its steady state, where nothing is left of its equations (FlowResidual): implicit in
// a pseudo-time of every cell's own, which grows as the residual falls (switched evolution relaxation, Mulder and van
// Leer 1985; Kelley and Keyes 1998). In each iteration species and temperature change together (GasUpdate), then
// velocities and pressure for the new density (FlowUpdate), then what is carried (CarriedUpdate). A flame in eddies
// takes steps of one time for all cells (ImplicitStep) until it stands. Near the end gas and flow change together, by
// Newton's method (NewtonKrylov). docs/theory/flow.md, "The steady state".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/state.hpp"
#include "flow/steady/carried_update.hpp"
#include "flow/steady/flow_update.hpp"
#include "flow/steady/gas_update.hpp"
#include "flow/steady/implicit_step.hpp"
#include "flow/steady/load_control.hpp"
#include "flow/steady/newton_krylov.hpp"
#include "numerics/anderson_mixing.hpp"

namespace lampblack::flow {

class SteadyIteration {
 public:
  struct Options {
    VelocityScheme scheme = VelocityScheme::Limited;
    // Pseudo-time of a cell over the time in which the gas in it is renewed.
    double firstCourant = 2.0, mostCourant = 1e4;
    // Of velocities and pressure: as slow as the gas, but within these. In a short time the pressure has to be large to
    // move all of the mass that a new density moves; in a long one it is felt everywhere at once. Some flames come to
    // rest only with a least of one, others only with the most at all times.
    double leastFlowCourant = 1.0, mostFlowCourant = 5.0;
    // Outcome::measure below which iterations are Newton's or, where those lead nowhere or a load is an unknown too,
    // accelerated: of a flow whose flame stands where it will stand.
    double accelerated = 3e-4;
    bool newton = true;
    // The same, but what is left of all that is carried, above which, where gas that eddies stir reacts, iterations are
    // steps of one time (ImplicitStep): Newton's method after them knows the eddies.
    double inTime = 1e-5;
    // Whether they are; below that, too, where Newton's method leads nowhere. Where the flow rests (Newton's method
    // not allowed) the gas alone changes then, twice in a row.
    bool oneTime = false;
  };

  // Collective. `operators`: whose rates act in the cells; they have to live as long. The state is evaluated.
  // `control`: of a load that is an unknown too, with a condition; null: the load is as it is.
  // NumericsError where the gas has no properties or rates.
  SteadyIteration(const FlowContext& context, const State& state, Options options, std::vector<Operator*> operators,
                  LoadControl* control = nullptr);

  struct Outcome {
    bool taken = false;
    double courant = 0.0;  // that was tried
    double measure = 0.0;  // of what is left of all equations, of the state as it is now
    std::string why;       // it was not taken
    int gasIterations = 0, flowIterations = 0, pressureIterations = 0;  // of the linear solvers
    // Of that of gas and flow together; zero where no step of Newton's method was tried, and whether one that was has
    // been taken back: the iteration is then one of the other kind.
    int newtonIterations = 0;
    bool newtonTakenBack = false;
    double largestRise = 0.0;  // K, that the linear system asked for
    std::int64_t limited = 0;  // cells where less than that was taken
    // Cells in which limits held back the last change of what is carried (CarriedUpdate), such as k and omega.
    std::int64_t held = 0;
  };
  // Collective. One iteration; leaves the state as it was where it fails, and the next one tries less. `allowed`:
  // not all where the flow is at rest but for species: what is a small difference of large rates, as of two species in
  // equilibrium, an iteration finds by itself, and a combination of several disturbs.
  struct Allowed {
    bool combined = true, newtons = true;
  };
  Outcome iterate(State& state, Allowed allowed);
  Outcome iterate(State& state) { return iterate(state, Allowed{}); }

  // Of the last iteration; nothing before the first.
  [[nodiscard]] const Outcome& last() const { return last_; }
  // Of the state as it is now.
  [[nodiscard]] const FlowResidual& residual() const { return residual_; }

  // What is kept from one iteration to the next; the state has to be loaded before, its halo filled. What is not saved
  // (the iterations that are combined) is begun anew, by who saves too: both go on with
  // the same bits. Collective.
  void saveOrLoad(const State& state, StateArchive& archive);

 private:
  Outcome tryOne(State& state, Allowed allowed);
  Outcome attempt(State& state, bool mayCombine);
  // The same by Newton's method.
  Outcome attemptTogether(State& state);
  // The same by a step of one time, and a shorter one where that fails, several times.
  Outcome attemptInTime(State& state);
  Outcome stepInTime(State& state);
  void takeBack(State& state, double measure);
  void waitForNewton();
  // Takes the best combination of the last iterations in place of the present.
  void accelerate(State& state);
  [[nodiscard]] double massOf(const State& state) const;  // kg
  void keepMass(State& state, double mass) const;
  [[nodiscard]] std::vector<double> unknownsOf(const State& state) const;
  [[nodiscard]] std::vector<double> weights(const State& state) const;
  void setInertia(const State& state);
  void hurry();
  [[nodiscard]] double flowCourant() const;
  std::int64_t advanceCarried(State& state);  // Outcome::held
  // Of the state that was evaluated: what is left of all equations over what goes through the cells.
  [[nodiscard]] double measure(const State& state) const;
  [[nodiscard]] double through(const State& state) const;  // kg/s, the sum of all faces
  [[nodiscard]] double ofCarried(const State& state, double through) const;

  const FlowContext& context_;
  Options options_;
  std::vector<Operator*> operators_;
  LoadControl* control_;
  FlowResidual residual_;
  std::optional<FlowResidual> beside_;  // of other loads, where there is a control
  GasUpdate gas_;
  std::optional<CarriedUpdate> carried_;  // where the flow carries something
  FlowUpdate flow_;
  std::optional<NewtonKrylov> newton_;  // where no load or pressure of a vessel is an unknown
  std::optional<ImplicitStep> step_;    // where besides gas that eddies stir reacts
  AndersonMixing mixing_;
  double courant_;
  bool isAnew_ = true;     // the first iteration, or the last has failed
  bool isLimited_ = true;  // cells of the last iteration could not take all of their change, or it has failed
  static constexpr int leastPause = 5;
  int waits_ = 0, pause_ = leastPause;  // iterations before Newton's method is tried again; of the next time
  int ofGasAlone_ = 0;                  // iterations in a row
  double measure_ = 0.0;
  Outcome last_;
  std::vector<double> inertia_, carriedInertia_, flowInertia_;  // kg/s, owned cells
  std::vector<double> haste_;                                   // owned cells: of the pseudo-time that others have
  std::optional<State> before_;
  double loadBefore_ = 1.0;
};

}  // namespace lampblack::flow
