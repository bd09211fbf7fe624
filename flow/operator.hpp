// One physical process of a flow: advances the state, and gives columns, fields and lines for the results. A run is a
// sequence of operators and does not depend on their types.
#pragma once

#include <concepts>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh_region.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "core/state_archive.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// Cost of the owned cells, about microseconds of one processor, as counted by the operators.
struct CellCost {
  std::vector<double> own;     // work of the rank that owns the cell
  std::vector<double> shared;  // work that work sharing distributes over all ranks
  explicit CellCost(int owned) : own(static_cast<std::size_t>(owned)), shared(own.size()) {}
};

class Operator {
 public:
  // Load imbalance: cost of the busiest rank over the mean, without and with work sharing; means over the stages of a
  // run.
  struct Imbalance {
    double before = 1.0, after = 1.0;
  };
  // Of the results, for the whole run: the name is its path in them, "/soot_sizes/bin_edges".
  struct Dataset {
    Quantity quantity;
    std::vector<double> values;
  };
  // Of a region of the mesh, rows at each output: "sizes".
  struct RegionTable {
    std::string kind;
    std::vector<Quantity> columns;
  };
  // Receives one field: for each owned cell as many values as the field has components.
  struct FieldSink {
    template <typename Take>
    requires std::invocable<Take, const Quantity&, std::span<const double>> FieldSink(Take taker)
        : take(std::move(taker)) {}
    void operator()(const Quantity& field, std::span<const double> values) const { take(field, values); }

    std::function<void(const Quantity&, std::span<const double>)> take;
    // Whether a field is used; an operator does not compute unused costly fields.
    std::function<bool(const std::string& name)> wants = [](const std::string&) { return true; };
    // Whether fields that are not known yet are given too, as NaN: a table has its columns from the start.
    bool future = false;
  };

  virtual ~Operator() = default;
  [[nodiscard]] virtual const char* name() const = 0;

  // A step is one sweep or several of deferred correction: in each, all operators advance from the beginning of the
  // step to its end. Collective.
  virtual void advance(State& state, double time, double dt) = 0;
  // Adds the mean rates that the transport of the next sweep takes as sources to State::balance. Called after each
  // sweep of all operators, before the first step, and after loading; the transport is called first and clears the
  // balance.
  virtual void endSweep(State&) {}
  // The state is the start of the next step. Called after the last sweep of a step (before endSweep()), before the
  // first step, and after loading.
  virtual void endStep(State&) {}
  // Adds the rates at which a state changes by what acts in its owned cells, as they are now: no mean of a step, and of
  // this state alone. `rates` has the sizes of State::balance. For operators that change the state by means other than
  // transport.
  virtual void addRates(const State&, State::Balance& /*rates*/) {}
  // The same of what is carried, where nothing else has changed since addRates() was asked: what of it is source and
  // what sink may be told in another way, and no slopes are asked of it.
  virtual void addRatesOfCarried(const State& state, State::Balance& rates) { addRates(state, rates); }
  // Whether addRates() makes or takes any of what is carried: where the gas rests, only such an operator is asked.
  [[nodiscard]] virtual bool actsOnCarried() const { return false; }
  // Derivatives of what addRates() adds in the owned cells, a dense matrix a cell, one behind the other, column-major.
  // They steer iterations towards a steady state, which does not depend on them: what is small may be left out. What is
  // empty is not asked for.
  struct Slopes {
    // Rows: kg/m^3/s of each species, then W/m^3; columns: mass fractions at constant pressure, then the temperature.
    std::span<double> gas;
    // Of what is carried, per m^3 and s, by what is carried per m^3.
    std::span<double> carried;
  };
  virtual void addSlopes(const State&, const Slopes&) {}
  // What addRates() adds of what is carried, where it knows of no other cell, in the gas of one state.
  class CarriedInCells {
   public:
    virtual ~CarriedInCells() = default;
    // Adds to the rates of all that is carried, per m^3 and s, at `amounts` of it in an owned cell, per m^3; and, where
    // they are asked for, to their derivatives, column-major.
    virtual void add(int cell, std::span<const double> amounts, std::span<double> rates, std::span<double> slopes) = 0;
  };
  // Null where it is not told so. It uses the state and the operator.
  [[nodiscard]] virtual std::unique_ptr<CarriedInCells> carriedInCells(const State&) { return {}; }
  // Of what addRates() adds in the owned cells, the part by the gradient of a carried scalar itself: as a flow through
  // each face, of each scalar (kg/s, from low to high), that changes cells as convection would by what they differ from
  // where it comes from. For iterations as well. Collective.
  virtual void addCarriedFlow(std::span<double> /*flow*/) {}
  // Sets what transport needs to know of the operator's scalars in a state, and what is a function of them
  // (State::carriedDiffusivity, eddyViscosity), in the owned cells; advance() and endSweep() do so by themselves. The
  // halo is filled by who calls. Collective.
  virtual void setDiffusivities(State&) {}
  // Saves or loads the data that the operator keeps between two steps, besides the state. With both, the next step is
  // the same to the last bit. Collective.
  virtual void saveOrLoad(StateArchive&) {}
  // Largest step (s) that `advance` allows in this state. Collective.
  [[nodiscard]] virtual double largestStep(const State&) { return std::numeric_limits<double>::infinity(); }

  // Whether, in a step from this time (s), the operator alone advances, in a gas that stays as it is.
  [[nodiscard]] virtual bool holdsOthers(double) const { return false; }
  // Whether carried scalars are noise by what it does, which does not come to rest in a steady flow.
  [[nodiscard]] virtual bool isStochastic() const { return false; }

  // Adds the cost of each owned cell in the last step. Costs are counted, not timed: every run has the same.
  virtual void addCost(const Mesh&, CellCost&) const {}

  // Columns of the history, and their present values: of the state, or since the last row. Collective.
  [[nodiscard]] virtual std::vector<Quantity> historyColumns() const { return {}; }
  [[nodiscard]] virtual std::vector<double> historyValues(const State&) { return {}; }
  // NumericsError where the state of the last row of the history is no result of the operator's model. Collective.
  virtual void checkResult() const {}
  // Text for the line of progress, "fv 0.1 ppm", of the last row of the history; may be empty.
  [[nodiscard]] virtual std::string status() const { return {}; }
  // Lines of the closing report, of the last row of the history.
  [[nodiscard]] virtual std::vector<std::string> closingLines() const { return {}; }
  // Since beginRun().
  [[nodiscard]] virtual std::optional<Imbalance> imbalance() const { return {}; }
  // The run begins, or goes on from a checkpoint, after loading: what its report counts is counted from here.
  virtual void beginRun() {}

  virtual void fields(const State&, const FieldSink&) const {}
  [[nodiscard]] virtual std::vector<Dataset> datasets() const { return {}; }
  [[nodiscard]] virtual std::vector<RegionTable> regionTables() const { return {}; }
  // Rows of one of these, one behind the other; the same on all ranks. Collective.
  [[nodiscard]] virtual std::vector<double> regionRows(std::size_t, const MeshRegion&) const { return {}; }
};

}  // namespace lampblack::flow
