// The discrete equations of a one-dimensional flame (flame_problem.hpp): vertex-centred finite volumes, so that what
// leaves one control volume enters the next and budgets close to round-off of a converged solution; and their Newton
// matrix, with analytic derivatives of chemistry, convection and diffusion at frozen transport coefficients.
//
// Points are spread over the ranks for the evaluation; vectors are alike on all ranks. docs/theory/flames.md.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_problem.hpp"
#include "flow/flame/flame_profile.hpp"
#include "flow/flame/given_exchange.hpp"
#include "flow/models/carried_model.hpp"
#include "numerics/block_tridiagonal.hpp"
#include "numerics/unsteady_system.hpp"

namespace lampblack::flow {

// Relative and absolute sizes of a change of an unknown that counts as 1.
struct FlameTolerances {
  double relative = 1e-4;
  double species = 1e-9, temperature = 1e-2, flow = 1e-4, scalars = 1e-7;
};

// Fluxes in and out, and sources, of one conserved quantity.
struct FlameBudget {
  std::string name;  // element, "mass", "energy"
  double in = 0;     // with the streams: kg/m2/s, W/m2
  double out = 0;    // leaving at the ends and, by spreading, sideways
  double wall = 0;   // conducted into burner or wall, deposited on the wall
  double radiated = 0;
  double given = 0;  // by a GivenExchange; negative: taken
  [[nodiscard]] double imbalance() const { return in + given - out - wall - radiated; }
};

// What the wall of a flame takes of the particles, kg/m2/s, and the velocity of thermophoresis to it, m/s: of the
// scalar that drifts most.
struct WallDeposition {
  double rate = 0, thermophoresis = 0;
};

class FlameEquations : public UnsteadySystem {
 public:
  // `carried` may be null; it has to live as long. InputError for problems that make no sense.
  FlameEquations(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism, FlameProblem problem,
                 CarriedModel* carried = nullptr, FlameTolerances tolerances = {});
  ~FlameEquations() override;

  [[nodiscard]] const FlameProblem& problem() const;
  [[nodiscard]] const FlameLayout& layout() const;
  void setGrid(std::span<const double> z);
  [[nodiscard]] std::span<const double> grid() const;

  // Free flames: the temperature at a point of the grid, which pins the flame.
  void setAnchor(std::size_t point, double temperature);
  // Unknowns that are held at their values in `held` (components of the layout; globals follow). Nothing is held after
  // release(). Used to solve the gas at a given temperature, or the scalars in a given gas.
  void hold(std::function<bool(std::size_t component)> which, std::span<const double> held);
  void release();
  void setLoad(double load) override;
  void setConstraint(std::optional<LoadConstraint> constraint) override;
  void setExchange(std::optional<GivenExchange> exchange);

  // Keeps the transport coefficients of the last residual (but for a power of the temperature) until told otherwise:
  // the Newton matrix is then exact.
  void freezeTransport(bool frozen);

  // NewtonSystem.
  [[nodiscard]] std::size_t size() const override;
  void residual(std::span<const double> x, std::span<double> F) override;
  // Where convection is central and where upwind is decided by the first profile on a grid and that at the beginning of
  // each time step, and then stays: Newton's method does not converge while it changes.
  void beginStep() override;
  void timeWeights(std::span<const double> x, std::span<double> M) override;
  [[nodiscard]] bool factorise(std::span<const double> x, double inverseTimeStep) override;
  void solve(std::span<double> b) override;
  void bounds(std::span<double> lower, std::span<double> upper) const override;
  // Scalars stay positive: a step that would take more than nine tenths of one takes nine tenths.
  void correct(std::span<const double> x, std::span<double> trial) const override;
  void clipNegativeAmounts(std::span<double> x) const override;
  void scales(std::span<const double> x, std::span<double> scale) const override;
  [[nodiscard]] std::string nameOf(std::size_t unknown) const override;

  // UnsteadySystem: the storage is d(rho)/dt in continuity. The momentum of the radial flow and the mass of the gas
  // make the pressure gradient an unknown of index two; it is out of the error estimate and inaccurate in the first
  // steps.
  void storage(std::span<const double> x, std::span<const double> rate, std::span<double> F) override;
  [[nodiscard]] bool factoriseUnsteady(std::span<const double> x, double shift) override;

  // Whether the factors at hand are those of the steady equations, with nothing held, at some state on this grid.
  [[nodiscard]] bool hasSteadyFactors() const;
  // Sign of the determinant of the matrix that was factorised last.
  [[nodiscard]] int determinantSign() const;

  // Budgets of the elements, mass and energy of a profile on the present grid. Collective.
  [[nodiscard]] std::vector<FlameBudget> budgets(std::span<const double> x);
  // Heat that the gas gives to the burner, W/m2, positive into it: what the volume at z = 0 has to lose to keep the
  // temperature that it is given. Collective.
  [[nodiscard]] double burnerHeatFlux(std::span<const double> x);
  [[nodiscard]] WallDeposition wallDeposition(std::span<const double> x);

  struct Counters {
    std::size_t residuals = 0, jacobians = 0;
    std::size_t jacobianPoints = 0;  // over all Jacobians and ranks
    double residualSeconds = 0, jacobianSeconds = 0, factoriseSeconds = 0, solveSeconds = 0;
  };
  [[nodiscard]] const Counters& counters() const;

  struct Data;  // flame_equations_data.hpp; for the other files of this class, and FlameScalars
  [[nodiscard]] Data& data() { return *data_; }
  // What a step from `value` to `trial` leaves of an amount that cannot be negative.
  static double positivePart(double value, double trial) {
    const double least = value > 0 ? 0.1 * value : 0.0;
    return trial > least ? trial : least;
  }

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace lampblack::flow
