// The implicit change of all species and the temperature together in an iteration towards the steady state
// (docs/theory/flow.md, "The steady state"): in every cell a dense block of inertia, transport, reactions and models,
// between cells diffusion by its conductances and convection upwind of first order; what it changes is what is left of
// the equations as they are.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/state.hpp"
#include "flow/steady/block_system.hpp"
#include "flow/steady/load_control.hpp"

namespace lampblack::flow {

// No iteration leaves less of a species than this mass fraction, or than there was; of a species that reacts faster
// than it is moved not less than this in any case. Rates may not tell one amount below zero from another, and what
// oxygen below zero would burn grows: traces such as HCO then live where there is no oxygen.
inline constexpr double leastOfSpecies = -1e-12;

// Mass fraction below which a species is a trace. An iteration leaves at least a tenth of a trace that is moved faster
// than it reacts: of two that burn each other at once there is one or the other, and a change that takes all of the one
// has the other grow in a gas that then has too much of both, with rates far beyond any of the flame.
inline constexpr double traceOfSpecies = 1e-6;

// NumericsError for a temperature (K) that no gas has data for.
void checkTemperature(double temperature);

// Density and enthalpy of an owned cell become those of its temperature and mass fractions; what is carried keeps its
// amount per mass. NumericsError as above.
void followGas(const FlowContext& context, State& state, int cell);

class GasUpdate {
 public:
  // What an iteration may take of a species that is more than a trace: all, or nine tenths. Where it may take all, a
  // cell of burnt gas whose linear system asks for more than there is ends without H, CH3 and what else burns, in the
  // next without O and OH, and so to and fro between two gases, however short the time.
  enum class Takes { All, NineTenths };

  static constexpr double kelvins =
      1000.0;  // K, the unit of the temperature in the linear system: all are of the order of one

  GasUpdate(const FlowContext& context, const State& state, std::vector<Operator*> operators,
            Takes takes = Takes::All);  // collective

  struct Result {
    int iterations = 0;        // of the linear solver
    double largestRise = 0.0;  // K, of any cell before it was limited
    std::int64_t limited = 0;  // cells whose change was limited
    double loadChange = 0.0;   // that the control asks for, within its limits
    bool isSolved = true;      // no more than a fifth of the linear system's right side is left
  };
  // Collective. The residual is of the state; `inertia` (kg/s, owned cells): mass over the cell's pseudo-time. The
  // state has a new gas of the same pressure then, halo filled; what is carried keeps its amount per mass.
  // With a load it is one more unknown; it is not yet changed. NumericsError where there is no such gas.
  struct LoadAsUnknown {
    LoadControl& control;
    FlowResidual& beside;  // for states of other loads
  };
  Result advance(State& state, const FlowResidual& residual, std::span<const double> inertia,
                 const std::optional<LoadAsUnknown>& load = {});

  // What the factors of the linear system keep. Collective.
  void saveOrLoad(StateArchive& archive);

  // The parts of advance(). Collective: the linear system of a state,
  void prepare(const State& state, const FlowResidual& residual, std::span<const double> inertia);
  // its solution for any right side, which findLeft() gives of a cell; `change`: of all cells,
  BlockSystem::Result solve(std::span<const double> right, std::span<double> change, double reduction,
                            int mostIterations) {
    return system_.solve(right, change, reduction, mostIterations);
  }
  // kg/s and, of the temperature, over its unit: what is left of the equations of a cell; `right`: n + 1 numbers.
  void findLeft(const State& state, const FlowResidual& residual, std::size_t cell, double* right);
  // Collective. Whether that is no more than round-off in all cells: of a gas of one temperature that mixes with no
  // other nothing has to change. `through` (kg/s, owned cells): the mass of a cell over its pseudo-time.
  bool isAtRest(const State& state, const FlowResidual& residual, std::span<const double> through);
  // and the change, of which a cell takes what it may.
  Result take(State& state, std::span<const double> change);

  // Of an owned cell, the share that the last advance() took of what the linear system gave.
  [[nodiscard]] std::span<const double> shares() const { return shares_; }

 private:
  void assemble(const State& state, const FlowResidual& residual, std::span<const double> inertia);
  void assembleBlock(const State& state, const FlowResidual& residual, int cell);
  // What a load that is larger by one brings into the cells: the right side for the answer of the gas to it.
  void assembleLoad(const State& state, const LoadAsUnknown& load);
  // Changes also the load so that its condition holds for the change of all cells; the change of the load.
  double addLoad(const State& state, const LoadAsUnknown& load);
  // Whether the linear system takes away, to less than nothing, what the cell's equations say there will be more of.
  [[nodiscard]] bool isMisled(const State& state, std::size_t cell, double share);
  // The share of the change that the limits leave.
  [[nodiscard]] double shareOf(std::span<const double> Y, std::span<const double> change) const;
  // The share of the change that was taken: none where it misleads.
  double take(State& state, int cell, double& largestRise);

  const FlowContext& context_;
  std::vector<Operator*> operators_;
  Takes takes_;
  std::size_t n_;
  BlockSystem system_;
  std::vector<double> slopes_;
  std::vector<double> right_, change_, shares_;
  std::vector<double> rightOfLoad_, changeByLoad_;  // empty until a load is controlled
  std::vector<double> made_, enthalpies_, capacities_;
};

}  // namespace lampblack::flow
