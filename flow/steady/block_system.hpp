// A linear system of several fields in every cell: a dense block of each cell for what couples its fields, and between
// two cells one number a field, as convection and diffusion couple them,
//   block(P) x(P) - sum over interior faces of coefficient_k(P, face) x_k(N) = right side(P).
// Restarted GMRES (Saad and Schultz 1986) of PETSc, preconditioned by incomplete factors of each rank's own cells in
// the order of their numbers: without fill, only the cells' blocks differ from those of the matrix (Saad 2003, sections
// 10.3 and 10.3.5). Their inverses are in single precision, which is half of what a sweep has to read.
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
  // Of the inverse of that block; zero where there is none.
  [[nodiscard]] double inverseDiagonal(int cell, std::size_t field);
  // Adds to a field the diffusion through any face by a conductance, beyond a boundary to a fixed value, and upwind
  // convection by a flow from low to high or outwards of what differs from the cell's own value; gas that comes through
  // a boundary has a fixed value.
  void connect(int face, std::size_t field, double conductance, double flow);
  // Adds upwind what a drift takes out of a cell and brings into the other: no difference, but the whole.
  void drift(int face, std::size_t field, double flow);
  // Adds to `sum` what the neighbours of an owned cell, beyond the rank's too, bring with these values, fields a cell.
  void addBrought(int cell, std::span<const double> values, std::span<double> sum) const;
  // Adds one number to the diagonal of a cell, of each field.
  void addInertia(int cell, double inertia);
  // Collective. What solve() needs of the system as it is. NumericsError where a block is singular.
  void factorise();
  // Of what elimination would couple beyond neighbours, the share that factors count as the cell's own from then on.
  // All would keep sums over cells, but may leave a cell next to no pivot.
  [[nodiscard]] double keptFill() const { return keptFill_; }
  void setKeptFill(double share) { keptFill_ = share; }

  struct Result {
    int iterations = 0;
    bool isConverged = false;
    double reached = 0.0;  // of the right side, that is left
  };
  // Collective. `right`: fields a owned cell; `x`: fields a cell, the solution out (halo filled). Down to `reduction`
  // of the right side, each cell's counted over the mean of its diagonal.
  Result solve(std::span<const double> right, std::span<double> x, double reduction, int mostIterations);

 private:
  struct Neighbour {
    int cell = -1;
    const double *comes = nullptr, *goes = nullptr;  // coefficients: of it in the cell's equations, and the other way
  };
  [[nodiscard]] Neighbour neighbour(int cell, int face) const;
  // To `row_`, what the neighbours before the cell, or behind it, bring.
  void addNeighbours(int cell, std::span<const double> values, bool before);
  void multiply(Vec x, Vec y);
  void precondition(Vec x, Vec y);

  const Mesh& mesh_;
  HaloExchange& halo_;
  std::size_t fields_;
  double keptFill_ = 0.9;
  std::vector<double> blocks_;
  std::vector<float> inverse_;          // of what elimination leaves of the blocks
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
