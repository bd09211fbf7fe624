// A linear system of several fields in every cell: a dense block of each cell for what couples its fields, and between
// two cells one number a field, as convection and diffusion couple them,
//   block(P) x(P) - sum over interior faces of coefficient_k(P, face) x_k(N) = right side(P).
// Restarted GMRES (Saad and Schultz 1986) of PETSc, preconditioned by one symmetric Gauss-Seidel sweep over the blocks
// of each rank's own cells (Saad 2003, section 4.1).
#pragma once

#include <span>
#include <vector>

#include "core/halo_exchange.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "core/petsc.hpp"
#include "core/petsc_callbacks.hpp"
#include "numerics/dense_blocks.hpp"

namespace lampblack::flow {

class BlockSystem {
 public:
  BlockSystem(const Mesh& mesh, HaloExchange& halo, std::size_t fields);  // collective
  BlockSystem(const BlockSystem&) = delete;
  BlockSystem& operator=(const BlockSystem&) = delete;

  // A new system: all coefficients are zero.
  void clear();
  // Of an owned cell, column-major, to be added to.
  [[nodiscard]] double* block(int cell) { return &blocks_[static_cast<std::size_t>(cell) * fields_ * fields_]; }
  // The inverse of that block, of the last solve.
  [[nodiscard]] const double* inverse(int cell) const {
    return &inverse_[static_cast<std::size_t>(cell) * fields_ * fields_];
  }
  // Adds to a field the diffusion through any face by a conductance, beyond a boundary to a fixed value, and upwind
  // convection by a flow from low to high or outwards of what differs from the cell's own value; gas that comes through
  // a boundary has a fixed value.
  void connect(int face, std::size_t field, double conductance, double flow);
  // Adds upwind what a drift takes out of a cell and brings into the other: no difference, but the whole.
  void drift(int face, std::size_t field, double flow);
  // Adds one number to the diagonal of a cell, of each field.
  void addInertia(int cell, double inertia);

  struct Result {
    int iterations = 0;
    bool isConverged = false;
  };
  // Collective. `right`: fields a owned cell; `x`: fields a cell, the solution out (halo filled). Down to `reduction`
  // of the right side, each cell's counted over the mean of its diagonal. NumericsError where a block is singular.
  Result solve(std::span<const double> right, std::span<double> x, double reduction, int mostIterations);

 private:
  void invert();
  void multiply(Vec x, Vec y);
  void precondition(Vec x, Vec y);
  void relax(int cell, std::span<const double> right);

  const Mesh& mesh_;
  HaloExchange& halo_;
  std::size_t fields_;
  std::vector<double> blocks_, inverse_;
  std::vector<double> toLow_, toHigh_;  // coefficients, fields an interior face
  std::vector<double> scale_;           // of the equations of a cell
  std::vector<double> work_, row_, ones_;
  std::vector<int> pivots_;
  DenseBlocks dense_;
  PetscExceptions exceptions_;
  PetscMatrix matrix_;
  PetscVector solution_, rightSide_;
  PetscSolver solver_;
};

}  // namespace lampblack::flow
