// Chemistry in every cell by a CellReactor, a stiff solve at constant pressure and enthalpy where nothing else is asked
// for: many cells at once, shared between the ranks.
//
// Coupling with transport. The reactions are integrated from the step's start with the transport of species and
// enthalpy as a constant source, while transport was given the last sweep's mean reaction rate (by State::balance):
// spectral deferred corrections (Nonaka, Bell, Day, Gilet, Almgren, Minion 2012), of second order with two sweeps and
// more. A steady flame is a steady state whatever the step, and the stiff solver, which then starts in equilibrium with
// the transport, needs few steps.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chemistry/reactor/growth_rate.hpp"
#include "chemistry/reactor/reactor.hpp"
#include "chemistry/reactor/reactor_failure.hpp"
#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/models/cell_reactor.hpp"
#include "flow/models/combustion/cell_mixing.hpp"
#include "flow/models/coupled_cells.hpp"
#include "flow/models/reference_map.hpp"
#include "flow/models/shared_cell_work.hpp"
#include "flow/operator.hpp"

namespace lampblack::flow {

// W/m3, what the reactions of State::balance set free in an owned cell. `enthalpies`: scratch, a value a species.
[[nodiscard]] double heatRelease(const FlowContext& context, const State& state, std::size_t cell,
                                 std::span<double> enthalpies);

class ReactionOperator : public Operator {
 public:
  struct Options {
    bool shareWork = true;
    ConstantPressureReactor::Options reactor;
    // Keeps a cell that cannot be advanced, on the rank that tried; what it returns is added to the message. Called at
    // most once on each rank, as the first failure ends its work. May be empty.
    std::function<std::string(std::int64_t naturalCell, const FailedCell& failed)> keepFailed;
    // Cells that take the reactions of others in steps of time; nothing: none do.
    std::optional<ReferenceMap> map = {};
  };
  struct Diagnostics {  // of all ranks and all stages since the last call of takeDiagnostics()
    double solverSteps = 0.0;
    double integratedCells = 0.0, skippedCells = 0.0, handedOverCells = 0.0, retries = 0.0;
    double coupledCells = 0.0;  // whose rates were found with their neighbours
    double limitedCells = 0.0;  // whose rates the next transport takes only in part
    MeanImbalance imbalance;
    MapTally map;
  };

  // Closed vessels at constant pressure.
  ReactionOperator(const FlowContext& context, const Options& options);
  // What else `reactor` makes of cells.
  ReactionOperator(const FlowContext& context, Options options, std::unique_ptr<CellReactor> reactor);

  void advance(State& state, double time, double dt) override;
  void endStep(State& state) override;
  void addRates(const State& state, State::Balance& rates) override;
  void addSlopes(const State& state, const Slopes& slopes) override;
  void saveOrLoad(StateArchive& archive) override;
  [[nodiscard]] const char* name() const override { return "chemistry"; }
  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  [[nodiscard]] std::optional<Imbalance> imbalance() const override { return work_.imbalance(); }
  void beginRun() override {
    work_.beginRun();
    mapOfRun_ = {};
  }
  [[nodiscard]] std::vector<std::string> closingLines() const override;
  void fields(const State& state, const FieldSink& sink) const override;
  void addCost(const Mesh&, CellCost& cost) const override { work_.addCost(cost); }
  Diagnostics takeDiagnostics();  // collective
  // How the cells are mixed; without one each is its mean. It has to live as long. For another reactor that heeds it
  // otherwise than by its reacting share the constructor has one.
  void mixBy(MixingModel& mixing) { mixing_ = &mixing; }
  // As it was in the last sweep, of an owned cell.
  [[nodiscard]] CellMixing mixingOf(std::size_t cell) const {
    return mixing_ ? mixing_->present()[cell] : CellMixing{};
  }
  // W/m3, of the owned cells: what the reactions of the last step have set free.
  [[nodiscard]] std::vector<double> heatReleases(const State& state) const;
  // The rates of the state are these (kg/m3/s, species a cell), not those of a step that led to it.
  void setRates(State& state, std::span<const double> rates);

  // Cells whose reactions grow by more than a factor of e within a step (GrowthRate), or have done so since they burn:
  // transport as a constant source would have them run away. A foot that stands grows little, and yet is as fast as it
  // was when it came to stand once it moves. For who couples them with their neighbours (CoupledCells).
  //
  // Collective. Finds them for a step from this state; whether there are any, on any rank.
  bool findOutrunning(const State& state, double dt);
  [[nodiscard]] bool outruns(std::size_t cell) const { return outruns_[cell] != 0; }
  // In how many parts such a step has to be taken.
  [[nodiscard]] int parts() const { return parts_; }
  // Collective. Advances the reactions of these cells of this rank by a part of a step (s) with constant sources; the
  // work is shared and counted as all other.
  void react(std::span<CoupledCells::Reacting> cells, double time, double part);
  // The cell's rates in State::balance are those of the step, and what transport makes of them is its state.
  void take(std::size_t cell) {
    isTaken_[cell] = 1;
    isLimited_[cell] = 0.0;
  }
  [[nodiscard]] double largestStep(const State& state) override;

 private:
  using Work = SharedCellWork::Work<CellReactor::Gas, CellReactor::Result>;
  template <typename Take>
  void eachRates(const State& state, bool wantsSlopes, const Take& take);
  [[nodiscard]] double meanDensity(const State& state, std::size_t cell) const;
  [[nodiscard]] double densityOfRate(const State& state, std::size_t cell) const;
  // Work whose items have mass fractions and their sources behind the gas; mass fractions come back.
  [[nodiscard]] Work workOver(double dt);
  void solve(double dt, std::span<const SharedCellWork::Task<CellReactor::Gas>> tasks,
             std::span<CellReactor::Result> results, std::span<RowWriter> rows);
  void take(State& state, std::size_t cell, double dt, const CellReactor::Result& result, std::span<const double> Y);
  // What comes of the reactions of an owned cell by themselves.
  using TakeCell = std::function<void(int cell, const CellReactor::Result& result, std::span<const double> Y)>;
  void advanceCells(const State& state, double time, double dt, std::span<const int> cells, const TakeCell& take);
  void advanceMapped(State& state, double time, double dt, std::span<const int> cells);
  [[nodiscard]] std::optional<CellReactor::Result> takeFromOther(State& state, std::size_t cell, double dt,
                                                                 std::span<const double> row,
                                                                 std::span<double> reacted);
  void count(const CellReactor::Result& result);
  void begin(double dt);
  void removeNetMass(State& state, std::size_t cell);
  void limitRates(State& state, std::size_t cell);

  const FlowContext& context_;
  Options options_;
  std::unique_ptr<CellReactor> reactor_;
  MixingModel* mixing_ = nullptr;
  std::vector<CellReactor::Cell> cells_;  // of solve()
  SharedCellWork work_;
  std::vector<double> initialStep_;  // s, CellReactor::Gas::firstStep of the next solve
  double step_ = 0.0;                // s, the present; zero between steps
  std::vector<double> isLimited_;    // 1 or 0, owned cells: whether rates are less than found (limitRates)
  std::vector<double> heatRelease_;  // W/m3, of the last step, where rates are limited
  GrowthRate growthRate_;
  std::vector<char> outruns_, isTaken_;  // of the present step, owned cells
  std::vector<double> grows_;            // 1/s, the largest growth rate that a burning cell has had, owned cells
  std::vector<double> fastest_;          // 1/s, of any species, the fastest that it has reacted meanwhile
  std::vector<double> askedChange_;      // of a mass fraction in the step at whose begin the growth rate was last found
  std::vector<double> unasked_;          // steps until it is found again
  double growth_ = 0.0;                  // 1/s, the largest of them
  double growthInStep_ = 0.0;            // the largest of the last step's start, times that step
  int parts_ = 1;
  Diagnostics diagnostics_;
  MapTally mapOfRun_, mapTold_;  // since beginRun(): of this rank, and of all in the last row of the history
};

}  // namespace lampblack::flow
