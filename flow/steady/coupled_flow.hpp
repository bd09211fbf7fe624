// Velocities, pressure and mass fluxes of all cells as one linear system, by elimination: what a flow answers to what
// is left of its equations, whatever the pseudo-time and however thin the cells. Convection is upwind of first order,
// its derivative by the mass flux counted; a face's mass flux follows the velocities beside it and the difference of
// the pressures. Of several ranks each eliminates its own cells and those beside them, and GMRES joins them (additive
// Schwarz; Saad 2003, 14.3); in space, where elimination couples too many cells, by incomplete factors.
// docs/theory/flow.md, "Iterations".
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/petsc.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class CoupledFlow {
 public:
  // Collective. The residual has to live as long.
  CoupledFlow(const FlowContext& context, const State& state, FlowResidual& residual);

  // Collective. The residual has been evaluated of the state; `inertia` (kg/s, owned cells): mass over the cell's
  // pseudo-time.
  void prepare(const State& state, std::span<const double> inertia);
  struct Left {
    std::vector<double> momentum;  // N, a velocity (swirl the last) and owned cell
    std::vector<double> mass;      // kg/s, owned cells
    std::vector<double> massFlux;  // kg/s, a face
  };
  struct Change {
    std::vector<double> velocity;  // m/s, a velocity (swirl the last) and cell
    std::vector<double> pressure;  // Pa, a cell
    std::vector<double> massFlux;  // kg/s, a face
  };
  // What is left of the equations, to be filled for find().
  [[nodiscard]] Left& left() { return left_; }
  // Collective. What changes for it in the state of prepare(); NumericsError where the system is singular.
  const Change& find();

 private:
  // What a mass flux changes by with what it depends on.
  struct Flux {
    double ofVelocity = 0.0;  // kg/m3 m2, with the velocity through the face
    double ofPressure = 0.0;  // kg/s/Pa, with the pressure of `low` over that of `high`
  };
  void findSlopes();
  void assembleCell(int cell, const State& state, double inertia);
  void add(int row, int column, const std::vector<double>& block);
  [[nodiscard]] double weightOf(int cell, int face) const;

  const FlowContext& context_;
  FlowResidual& residual_;
  std::size_t d_, velocities_, width_;
  std::vector<PetscInt> row_;  // of every local cell, in blocks
  PetscMatrix matrix_;
  PetscVector rightSide_, solution_;
  PetscSolver solver_;
  bool isJoined_ = false;  // by GMRES, of what ranks eliminate
  bool isSetUp_ = false;
  std::vector<Vector3> slopes_;  // 1/m, a face of an owned cell: of what lies beyond it, in the cell's gradient
  std::vector<Flux> flux_;       // a face
  std::vector<double> steps_;    // m/s, a velocity and side of a face (low, high): that comes in less that there is
  std::vector<double> drawn_;    // Pa s/kg, a boundary face: pressure there with the mass flux, where gas is drawn in
  std::vector<double> own_, other_;  // blocks of the matrix, row by row
  std::vector<double> known_;        // a cell: velocities and pressure
  Left left_;
  Change change_;
};

}  // namespace lampblack::flow
