// Implicit diffusion of many fields at once: for each field k the symmetric positive definite system
//   diagonal_k(P) x_k(P) + sum over interior faces of conductance_k(f) (x_k(P) - x_k(N)) = source_k(P),
// solved by conjugate gradients with Jacobi preconditioning, all fields in the same sweeps, one halo message and one
// reduction an iteration.
#pragma once

#include <span>
#include <vector>

#include "core/halo_exchange.hpp"
#include "core/mesh.hpp"
#include "core/rooms.hpp"

namespace lampblack::flow {

class ImplicitDiffusion {
 public:
  ImplicitDiffusion(const Mesh& mesh, HaloExchange& halo) : mesh_(mesh), halo_(halo) {}

  struct Result {
    int iterations = 0;
    double worstResidual = 0.0;  // largest relative residual of any field
  };

  // Collective. `diagonal`, `source`: fields a owned cell; `conductance`: fields an interior face; `x`: fields a cell,
  // the initial guess in, the solution out (halo filled). Each field is converged when its residual has fallen to
  // `tolerance` of its source. NumericsError when that takes more than `maxIterations`.
  Result solve(int fields, std::span<const double> diagonal, std::span<const double> conductance,
               std::span<const double> source, std::span<double> x, double tolerance = 1e-9, int maxIterations = 2000);

 private:
  void apply(int fields, std::span<const double> diagonal, std::span<const double> conductance,
             std::span<const double> x, std::span<double> result) const;

  const Mesh& mesh_;
  HaloExchange& halo_;
  std::vector<double> residual_, direction_, product_, inverse_;
};

}  // namespace lampblack::flow
