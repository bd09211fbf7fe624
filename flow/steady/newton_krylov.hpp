// Newton's method for the steady state of a flow whose flame stands: gas, velocities, pressure and mass fluxes
// together. The linear systems are solved by flexible GMRES (Saad 1993), the matrix known by differences of
// FlowResidual alone (Knoll and Keyes 2004), preconditioned by what an iteration does with the gas (GasUpdate) and then
// the flow by elimination (CoupledFlow), with the matrices of the state that the step begins with. What is carried and
// moves all else, as the variables of turbulence do by the eddy viscosity, is unknown too, and comes last in the
// preconditioner (CarriedUpdate), with what the change of the flow brings it. docs/theory/flow.md, "Iterations".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/petsc.hpp"
#include "core/petsc_callbacks.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/state.hpp"
#include "flow/steady/carried_update.hpp"
#include "flow/steady/coupled_flow.hpp"
#include "flow/steady/gas_update.hpp"

namespace lampblack::flow {

class NewtonKrylov {
 public:
  // Collective. All have to live as long. `carried`: of all that the flow carries, which is unknown, too, then, and
  // what the operators make of it (Operator::setDiffusivities) follows; null: it stays as it is, per mass. `vectors`:
  // at most, of the linear solver, each of which takes 16 B an unknown while it is used.
  NewtonKrylov(const FlowContext& context, const State& state, FlowResidual& residual, GasUpdate& gas, int vectors,
               CarriedUpdate* carried = nullptr, std::vector<Operator*> operators = {});

  // Of equations, over what goes through the domain: all sizes, and the root of all squares, which the worst cell
  // makes.
  struct Left {
    double sum = 0.0, root = 0.0;
  };
  struct Result {
    int iterations = 0;        // of the linear solver
    double largestRise = 0.0;  // K, of any cell before it was limited
    std::int64_t limited = 0;  // cells whose change was limited
    std::int64_t held = 0;     // cells of all ranks in which limits held back what is carried; 0 without unknowns of it
    double reached = 0.0;      // what is left of the linear system
    Left before;               // what is left before the step, as leftInTime() has it
  };
  // Collective. The residual is of the state; inertia (kg/s, owned cells): mass over the cell's pseudo-time. The
  // residual is of some other state then. `start`: the state that the pseudo-time begins with, where that is an earlier
  // one (ImplicitStep), not where what is carried is an unknown, too; null: the state itself.
  Result advance(State& state, std::span<const double> inertia, double reduction, const State* start = nullptr);
  // Collective, after a step with it: what is left of the equations of that pseudo-time in a state, of which the
  // residual is.
  [[nodiscard]] Left leftInTime(const State& state, const State& start);

 private:
  void find(const State& state, std::span<double> left);
  // Of what is left: what the change since the start of the pseudo-time takes.
  void takeInertia(const State& state, const State& start, std::span<double> left) const;
  [[nodiscard]] Left sizeInTime() const;
  void move(State& state, double step, std::span<const double> along) const;
  void findScales(const State& state);
  void multiply(Vec x, Vec y);
  void precondition(Vec x, Vec y);
  [[nodiscard]] double stepOf(std::span<const double> along) const;
  void addBrought(std::span<const double> along);

  const FlowContext& context_;
  FlowResidual& residual_;
  GasUpdate& gas_;
  CarriedUpdate* carried_;
  std::vector<Operator*> operators_;
  CoupledFlow flow_;
  int vectors_;
  std::size_t width_, velocities_, scalars_, perCell_, pastFlow_, faces_, size_;
  const State* base_ = nullptr;
  std::span<const double> inertia_;
  std::vector<double> left_, leftInTime_, leftBeside_, rows_, units_;
  std::vector<double> gasRight_, gasChange_, densityChange_, faceDensity_, baseMass_;
  std::vector<double> carriedRight_, carriedChange_;
  PetscExceptions exceptions_;
  PetscMatrix matrix_;
  PetscVector solution_, rightSide_;
  PetscSolver solver_;
};

}  // namespace lampblack::flow
