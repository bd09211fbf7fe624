// Implicit diffusion of many fields at once by Chebyshev's iteration with Jacobi preconditioning (Saad 2003, algorithm
// 12.1). Gershgorin's circles bound the eigenvalues and with them the number of iterations, so that one reduction does
// for all of them. The sums of a cell do not depend on the ranks.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/halo_exchange.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

class ImplicitDiffusion {
 public:
  ImplicitDiffusion(const Mesh& mesh, HaloExchange& halo) : mesh_(mesh), halo_(halo) {}

  struct Result {
    int iterations = 0;  // of the field that takes most
  };

  // For each field k the symmetric positive definite system
  //   diagonal_k(P) x_k(P) + sum over interior faces of conductance_k(f) (x_k(P) - x_k(N)) = source_k(P).
  // Collective. `diagonal`, `source`: fields a owned cell; `conductance`: fields an interior face; `x`: fields a cell,
  // the initial guess in, the solution out (halo filled). The residual of each field falls, in the norm of the
  // preconditioner, to `tolerance` of that of the initial guess, and about to 1e-7 of the source, or to round-off. With
  // the last step's field as the guess, the error is that share of what the step changes, and a steady state has none.
  // NumericsError on all ranks when that takes more than `maxIterations`.
  Result solve(int fields, std::span<const double> diagonal, std::span<const double> conductance,
               std::span<const double> source, std::span<double> x, double tolerance = 1e-4,
               int maxIterations = 100000);

  // source -= the left side above of `x` (fields a cell, halo filled), in the owned cells.
  void subtract(int fields, std::span<const double> diagonal, std::span<const double> conductance,
                std::span<const double> x, std::span<double> source) const;

  // Writes the conductances of some fields, by number, through a face; zero where nothing passes.
  using Conductance = std::function<void(int face, std::span<const int> fields, double* conductance)>;

  // Changes d_k of many fields in a step,
  //   inertia(P) d_k(P) + sum over all faces of conductance_k(f) (d_k(P) - d_k(N)) = rate_k(P),
  // beyond boundary faces no change. Fields that take alike many iterations go together, so that little memory is
  // needed and a heavy species ends long before hydrogen, whatever group it shares messages with. Collective.
  // `inertia`: a owned cell, above zero; `change`: `fields` a cell, rates of owned cells in, changes out (halo filled);
  // `sinks`, not below zero: what each field's inertia has beside that, `fields` a owned cell; empty: nothing. As
  // above.
  Result changes(int fields, std::span<const double> inertia, const Conductance& conductance, std::span<double> change,
                 double tolerance = 1e-4, int maxIterations = 100000, std::span<const double> sinks = {});

 private:
  static constexpr int width = 8;  // fields that go together

  // For each field: the half width of the eigenvalues around one, and by how much the residual has to fall.
  struct Targets {
    std::vector<double> radius, reduction;
  };
  [[nodiscard]] Targets targets(int fields, std::span<const double> source, double tolerance) const;
  [[nodiscard]] std::vector<double> radii(int fields, std::span<const double> inertia, const Conductance& conductance,
                                          std::span<const double> sinks);
  // Fields that go together: `width` values a cell or face.
  struct Group {
    std::vector<int> fields;
    int iterations = 0;
    std::vector<double> residual, solution, change, otherChange;
    // Single precision moves a solution by 1e-7 of the change that fluxes make; the fluxes that cells exchange are
    // evaluated from it with conductances of double precision.
    std::vector<float> conductance;
    std::vector<double> sinks;     // empty without
    std::vector<double> diagonal;  // of owned cells
  };
  void begin(Group& group, std::span<const int> fields, int all, std::span<const double> inertia,
             std::span<const double> change, const Conductance& conductance, std::span<const double> sinks);
  void iterate(Group& group, std::span<const double> old, std::span<const double> fresh,
               std::span<const double> inertia);

  const Mesh& mesh_;
  HaloExchange& halo_;
  std::vector<double> residual_, change_, inverse_, neighbours_;
  std::vector<Group> groups_;
};

}  // namespace lampblack::flow
