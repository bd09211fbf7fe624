// One physical process of a flow: what advances the state, and what it has to say of itself. The run strings operators
// together and writes what they tell, without knowing which they are.
#pragma once

#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "core/state_archive.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// What the owned cells cost, in about microseconds of one processor, as operators count it.
struct CellCost {
  std::vector<double> own;     // what the rank that owns the cell has to do itself
  std::vector<double> shared;  // what work sharing spreads over the ranks, whoever owns the cell
  explicit CellCost(int owned) : own(static_cast<std::size_t>(owned)), shared(own.size()) {}
};

class Operator {
 public:
  // Busiest rank's cost over the mean: as the mesh is partitioned, and with work sharing, means over the stages so far.
  struct Imbalance {
    double before = 1.0, after = 1.0;
  };
  // Takes one field: a value for each owned cell, or as many for each as it has components.
  struct FieldSink {
    template <typename Take>
    requires std::invocable<Take, const Quantity&, std::span<const double>> FieldSink(Take taker)
        : take(std::move(taker)) {}
    void operator()(const Quantity& field, std::span<const double> values) const { take(field, values); }

    std::function<void(const Quantity&, std::span<const double>)> take;
    // Whether a field counts: what costs is not worked out for nobody.
    std::function<bool(const std::string& name)> wants = [](const std::string&) { return true; };
    // Whether fields are wanted too that are not known yet, as NaN: a table has its columns from the start.
    bool future = false;
  };

  virtual ~Operator() = default;
  [[nodiscard]] virtual const char* name() const = 0;

  // A step is one sweep or several of deferred correction: in each, all operators advance from the beginning of the
  // step to its end. Collective.
  virtual void advance(State& state, double time, double dt) = 0;
  // Called when all operators have made a sweep, of the transport first, which clears State::balance: adds the mean
  // rates that the next sweep's transport takes as its sources. Also before the first step, and after loading.
  virtual void endSweep(State&) {}
  // Called when the step's last sweep has ended, before endSweep(), before the first step, and after loading: the state
  // is what the next step begins with.
  virtual void endStep(State&) {}
  // What the operator keeps from step to step besides the state: with both, the next step is the same to the last bit.
  // Between two steps. Collective.
  virtual void saveOrLoad(StateArchive&) {}
  // s, that `advance` may be asked for in this state. Collective.
  [[nodiscard]] virtual double largestStep(const State&) { return std::numeric_limits<double>::infinity(); }

  // Adds what each owned cell has cost in the last step. Counted, not timed, so that it is the same in every run.
  virtual void addCost(const Mesh&, CellCost&) const {}

  // What a row of the history has of it, and the values now: of the state, or since the last row. Collective.
  [[nodiscard]] virtual std::vector<Quantity> historyColumns() const { return {}; }
  [[nodiscard]] virtual std::vector<double> historyValues(const State&) { return {}; }
  // Of the last row, for the line that tells how far the run is: "fv 0.1 ppm"; may be empty.
  [[nodiscard]] virtual std::string status() const { return {}; }
  // Of the last row, for the report at the end: a line each.
  [[nodiscard]] virtual std::vector<std::string> closingLines() const { return {}; }
  [[nodiscard]] virtual std::optional<Imbalance> imbalance() const { return {}; }

  virtual void fields(const State&, const FieldSink&) const {}
};

}  // namespace lampblack::flow
