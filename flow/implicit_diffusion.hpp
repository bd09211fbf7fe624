// Implicit diffusion of many fields at once: for each field k the symmetric positive definite system
//   diagonal_k(P) x_k(P) + sum over interior faces of conductance_k(f) (x_k(P) - x_k(N)) = source_k(P),
// solved by conjugate gradients with Jacobi preconditioning, all fields in the same sweeps, one halo message and one
// reduction an iteration (Chronopoulos and Gear 1989). Fields that have converged leave the sweeps.
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
    double worstResidual = 0.0;  // largest of any field, over that of the initial guess
  };

  // Collective. `diagonal`, `source`: fields a owned cell; `conductance`: fields an interior face; `x`: fields a cell,
  // the initial guess in, the solution out (halo filled). A field is converged when its residual has fallen to
  // `tolerance` of that of the initial guess and to 1e-7 of its source, or to round-off. With the last step's field as
  // the guess, the error is that share of what the step changes, and a steady state has none. NumericsError when that
  // takes more than `maxIterations`.
  Result solve(int fields, std::span<const double> diagonal, std::span<const double> conductance,
               std::span<const double> source, std::span<double> x, double tolerance = 1e-4, int maxIterations = 2000);

  // source -= the left side above of `x` (fields a cell, halo filled), in the owned cells.
  void subtract(int fields, std::span<const double> diagonal, std::span<const double> conductance,
                std::span<const double> x, std::span<double> source);

 private:
  // The fields that are still being solved: their places among all, and their systems.
  struct Active {
    std::vector<int> field;
    std::span<const double> diagonal, conductance;
    std::span<double> x;
    std::vector<double> rz, rr, target, step;  // a value a field
    [[nodiscard]] int count() const { return static_cast<int>(field.size()); }
  };

  void apply(const Active& active, std::span<const double> x, std::span<double> result) const;
  // Residuals' products with what they are preconditioned to, of each active field and all ranks: [r.z | z.Az | r.r].
  void products(const Active& active);
  void leave(Active& active, std::span<double> x);

  const Mesh& mesh_;
  HaloExchange& halo_;
  std::vector<double> residual_, preconditioned_, product_, direction_, directionProduct_, inverse_, sums_;
  std::vector<double> activeDiagonal_, activeConductance_, activeX_;
};

}  // namespace lampblack::flow
