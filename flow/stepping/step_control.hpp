// What a step did, and how long the next one may be.
//
// A step in which a cell's temperature jumps, a mass fraction falls far below zero, or a cell becomes colder than
// anything that could have cooled it, is no step of this gas: it fails, with the place, before it is accepted, so that
// it is tried again from the good state. The next step is no longer than what the last one changed allows.
//
// With a tolerance the steps go by their error as well. The last sweep of deferred correction corrects what the sweep
// before has found; by how much is the error of the sweep before, in time, and the next step is that for which it is
// what the deck allows. The state that goes on is the corrected one, whose error is smaller. Needs two sweeps.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/peak.hpp"

namespace lampblack::flow {

class StepControl : public Operator {
 public:
  struct Options {
    int sweeps = 1;
    // Of the temperature, relative, and of mass fractions, the largest in any cell; nothing: errors are not looked at.
    std::optional<double> tolerance = {};
    double temperatureChange = 500.0;  // K, of a cell in a step
    double leastMassFraction = -1e-4;
  };

  // Stands behind all other operators of a step. std::logic_error for a tolerance with less than two sweeps.
  StepControl(const FlowContext& context, const Options& options);

  [[nodiscard]] const char* name() const override { return "step control"; }
  // NumericsError on all ranks, behind the last sweep, where the step has gone wrong.
  void advance(State& state, double time, double dt) override;
  void endStep(State& state) override;
  // W/m3, of the owned cells: what the reactions of the state set free, where no step has led to it.
  void setHeatRelease(std::span<const double> heat) { heat_.assign(heat.begin(), heat.end()); }
  void saveOrLoad(StateArchive& archive) override;
  [[nodiscard]] double largestStep(const State& state) override;
  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  [[nodiscard]] std::vector<std::string> closingLines() const override;

 private:
  void findError(const State& state);
  [[nodiscard]] double excess(const State& state, int cell, std::string* fault) const;
  void requireSound(const State& state);
  void keepChange(const State& state, double time, double dt);
  void keepHeat(const State& state);
  [[nodiscard]] double coldestGiven() const;

  const FlowContext& context_;
  Options options_;
  int sweep_ = 0;
  std::vector<double> temperature_, Y_;  // of the owned cells, after the sweep before the last
  std::vector<double> start_;            // K, of the owned cells when the step began
  double failed_;                        // excess() of an attempt at this step that has failed; infinite: of none
  double coldest_;                       // K, of the start and of all that boundaries have had
  double error_ = 0.0, step_ = 0.0;      // of the last step; zero before the first
  double change_ = 0.0;                  // K, the largest of the last step
  double undershoot_ = 0.0;              // by how much the last step has taken a mass fraction (further) below zero
  double changeSinceRow_ = 0.0;          // K
  std::vector<double> heat_;  // W/m3, that the last step's reactions have set free, or the state's, of the owned cells
  double largestHeat_ = 0.0;  // the largest of any cell
  // The largest change of it in a step since the last row, in units of the largest there was before or after.
  double heatChangeSinceRow_ = 0.0;
  struct Worst {
    Peak peak;
    double time = 0.0;  // s
  };
  Worst warming_;                 // K, the largest change of the run
  Vector3 place_{};               // m, where change_ was
  Worst negative_;                // how far below zero a mass fraction has been in the run
  bool hasTakenTooMuch_ = false;  // whether the present step is beyond what it may do, as a shorter one was
  double takenTooMuch_ = 0.0;     // how many such steps there were
  double firstTooMuch_ = 0.0;     // s, when the first of them began
};

}  // namespace lampblack::flow
