// A step of one time for all cells, implicit (Euler's), of a turbulent flame that has not come to where it stands: gas,
// velocities, pressure and mass fluxes together by Newton's method (NewtonKrylov) with the eddies as they are, then
// what is carried, the eddies' variables among it (CarriedUpdate). The eddies' equations, whose sources bend within
// what a jet's edge takes to cross a cell, would hold all others in as short a time. Steps need no accuracy in time:
// they follow the flame where iterations in pseudo-times of the cells' own take one cell further than its neighbours,
// and are far longer than explicit ones once the flame moves slowly (pseudo-transient continuation: Kelley
// and Keyes 1998). docs/theory/flow.md, "Iterations".
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/state.hpp"
#include "flow/steady/carried_update.hpp"
#include "flow/steady/gas_update.hpp"
#include "flow/steady/newton_krylov.hpp"

namespace lampblack::flow {

// Whether Newton's method goes on in a step: until enough of the step's equations is done, all of its passes are, or
// two in a row have gained too little.
class NewtonPasses {
 public:
  // After a pass; `left`: what it has left, of what there was before the first.
  [[nodiscard]] bool goOn(double left);

 private:
  int done_ = 0, idle_ = 0;
  double least_ = INFINITY;
};

class ImplicitStep {
 public:
  // Collective. All have to live as long.
  ImplicitStep(const FlowContext& context, const State& state, FlowResidual& residual, GasUpdate& gas,
               CarriedUpdate& carried, std::vector<Operator*> operators);

  struct Result {
    bool taken = false;        // else the state is of no use, and the next step is shorter
    double time = 0.0;         // s, that was tried
    int vectors = 0;           // of the linear solver
    double largestRise = 0.0;  // K, of any cell before it was limited
    std::int64_t limited = 0;  // cells whose last change was limited
    std::int64_t held = 0;     // cells in which limits held back the last change of what is carried
  };
  // Collective. The residual is of the state then where the step is taken. `haste` (owned cells): of the time that
  // other cells have. NumericsError where the gas has no properties or rates.
  Result advance(State& state, std::span<const double> haste);
  // What Newton's method has left of a step's equations, of what they had. Where limits held cells back the worst of
  // them counts (in the sum of all cells it would pass, and become a pocket hotter than any gas that burns); where they
  // held none a cell that goes to and fro is near its end, and need not hold the others.
  [[nodiscard]] static double shareLeft(const NewtonKrylov::Left& left, const NewtonKrylov::Left& before,
                                        bool isLimited);
  // After a step that ended with an error.
  void shorten();
  // s, of the next step; zero before the first.
  [[nodiscard]] double time() const { return time_; }
  void saveOrLoad(StateArchive& archive);

 private:
  void lengthen();

  const FlowContext& context_;
  FlowResidual& residual_;
  CarriedUpdate& carried_;
  std::vector<Operator*> operators_;
  NewtonKrylov newton_;
  double time_ = 0.0, refused_ = INFINITY;  // s, of the next step, and the last that was not taken
  // s: a twentieth of what the gas stays in the domain. The eddies follow the flow, and in longer steps would go to and
  // fro with it for long.
  double longest_ = INFINITY;
  std::vector<double> inertia_;  // kg/s, owned cells
};

}  // namespace lampblack::flow
