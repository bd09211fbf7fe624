// The matrix I - gamma J of a reactor's Newton iterations, factorised. The Jacobian is a sparse matrix plus a product
// u v^T (ReactorSystem::SparseJacobian); with one more unknown s = v.x the system is sparse as a whole:
//   (I - gamma S) x - gamma u s = b,      gamma s - gamma v.x = 0.
// Where elimination without pivoting is not safe, the full matrix is factorised with pivoting instead.
#pragma once

#include <optional>
#include <vector>

#include "chemistry/reactor/reactor_system.hpp"
#include "core/modules.hpp"
#include "numerics/dense_lu.hpp"
#include "numerics/sparse_lu.hpp"

namespace lampblack::chemistry {

// The order of elimination of that bordered matrix: species, temperature, s.
Elimination borderedElimination(const SparsePattern& species);

class NewtonMatrix {
 public:
  explicit NewtonMatrix(const ReactorSystem& system);

  // Takes the Jacobian at y under the system's conditions, and leaves f = dy/dt. False where the system has none.
  bool evaluate(ReactorSystem& system, const double* y, double* f);
  // False if I - gamma J is singular or not finite. gamma > 0.
  bool factorise(double gamma);
  // Overwrites b (size() values of the system) with the solution.
  void solve(double* b);

  // Factorisations that needed pivoting so far.
  long pivotedFactorisations() const { return pivoted_; }
  const SparseLu& sparse() const { return sparse_; }

 private:
  void loadDense(double gamma);

  std::size_t size_;  // unknowns of the reactor; the sparse matrix has one more
  SparsePattern pattern_;
  std::vector<double> inverseWeights_;
  SparseLu sparse_;
  std::vector<std::size_t> speciesAt_, rowAt_, columnAt_, productAt_;  // positions in values_
  AlignedVector values_;
  ReactorSystem::SparseJacobian jacobian_;
  std::vector<double> diagonal_, rightHandSide_;
  std::optional<DenseLu> dense_;  // made when first needed
  std::vector<double> rowScale_;
  bool usesDense_ = false;
  long pivoted_ = 0;
};

}  // namespace lampblack::chemistry
