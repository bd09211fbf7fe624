// Work in the cells of a flow that the ranks share (core/WorkSharing): chemistry, models of particles, ensembles. What
// the operators that do such work have in common: how a cell is packed, what the cells have cost, how even the work of
// the ranks was, and what is said of a cell that fails.
//
// A cell travels as its number and place, a record and rows of any length; it comes back as another record and rows. A
// record is a struct of nothing but doubles: its members are the order on the way, and their names all that is known of
// it on both sides.
#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/group_failure.hpp"
#include "core/modules.hpp"
#include "core/packed_doubles.hpp"
#include "core/state_archive.hpp"
#include "core/vector3.hpp"
#include "core/work_sharing.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"

namespace lampblack::flow {

// A record of what came of a cell, with its cost in about microseconds of one processor: counted, not timed.
template <class T>
concept CostedRecord = Doubles<T> && requires(const T& record) {
  { record.cost } -> std::convertible_to<double>;
};

// Means over stages of work of the busiest rank's cost over the mean.
class MeanImbalance {
 public:
  void add(const WorkSharing::Statistics& stage);
  [[nodiscard]] int stages() const { return static_cast<int>(stages_); }
  [[nodiscard]] Operator::Imbalance mean() const;  // zero without any stage
  void saveOrLoad(StateArchive& archive, const std::string& name);

 private:
  double before_ = 0.0, after_ = 0.0, stages_ = 0.0;  // sums, and how many
};

// The rows behind a record, to be written.
class RowWriter {
 public:
  explicit RowWriter(std::vector<double>& values) : values_(&values) {}
  // To be filled. Rows given before may move: ask for all at once.
  [[nodiscard]] std::span<double> add(std::size_t count) { return addRow(*values_, count); }
  void add(std::span<const double> row) { addRow(*values_, row); }

 private:
  std::vector<double>* values_;
};

class SharedCellWork {
 public:
  struct Options {
    std::string name;      // of what is kept in checkpoints, "chemistry" for "chemistry_cost"
    std::string subject;   // of the message of a failure, "chemistry" for "chemistry failed in cell 3"
    bool isShared = true;  // false: every rank advances its own cells
    // Expected of a cell that was never advanced: as of all others.
    double firstCost = 1.0;
    // Whether the mean of what was expected and what it was is expected next; else what it was.
    bool isSmoothed = false;
  };

  // What messages call a cell by, wherever it is advanced.
  struct Label {
    double number;  // permanent
    Vector3 place;  // m, its centre
  };
  // A cell that has been sent to whoever advances it.
  template <Doubles Input>
  struct Task {
    Label label;
    Input input;
    std::span<const double> rows;
  };
  template <Doubles Input, CostedRecord Result>
  struct Work {
    // Of an item, on the rank that owns its cell.
    std::function<Input(std::size_t item, RowWriter rows)> pack;
    std::size_t together = 1;  // tasks at a time, at most; which ones must not show in what comes of them
    // On any rank, from the tasks alone. FailureInGroup; where one is advanced at a time, NumericsError.
    std::function<void(std::span<const Task<Input>> tasks, std::span<Result> results, std::span<RowWriter> rows)>
        advance;
    // Of an item, on the rank that owns its cell.
    std::function<void(std::size_t item, const Result& result, std::span<const double> rows)> unpack;
  };
  struct Item {
    int cell;             // of the owned ones
    double expectedCost;  // in about microseconds of one processor
  };
  // Whether the items' cells are advanced over the whole step. What parts of it cost counts with the step, but is no
  // guide to the next, nor a stage of the report.
  enum class Over { Step, Part };

  SharedCellWork(const FlowContext& context, Options options);

  // Whatever comes first in a step, and what ends it: its costs are counted anew.
  void beginStep();
  void endStep() { isInStep_ = false; }
  // What the cell is expected to cost.
  [[nodiscard]] double expectedCost(int cell) const { return cost_[static_cast<std::size_t>(cell)]; }
  void setExpectedCost(int cell, double cost) { cost_[static_cast<std::size_t>(cell)] = cost; }

  // Collective. `time` (s): of the step's begin, for messages.
  template <Doubles Input, CostedRecord Result>
  WorkSharing::Statistics advance(std::span<const Item> items, double time, const Work<Input, Result>& work,
                                  Over over = Over::Step);

  // Of the step's advances, to the costs of the cells.
  void addCost(CellCost& cost) const;
  // Since beginRun().
  [[nodiscard]] std::optional<Operator::Imbalance> imbalance() const;
  void beginRun() { imbalance_ = {}; }
  void saveOrLoad(StateArchive& archive);

 private:
  [[nodiscard]] Label labelOf(int cell) const;
  [[nodiscard]] NumericsError failure(const Label& label, double time, const std::string& reason) const;
  void recordCost(const Item& item, double cost, Over over);
  WorkSharing::Statistics share(std::span<const Item> items, WorkSharing::Items& packed, Over over);

  const FlowContext& context_;
  Options options_;
  WorkSharing sharing_;
  std::vector<double> cost_;        // expected, owned cells
  std::vector<double> costOfStep_;  // owned cells
  bool isInStep_ = false;
  MeanImbalance imbalance_;
};

template <Doubles Input, CostedRecord Result>
WorkSharing::Statistics SharedCellWork::advance(std::span<const Item> items, double time,
                                                const Work<Input, Result>& work, Over over) {
  constexpr std::size_t resultWidth = sizeof(Result) / sizeof(double);
  struct Head {
    Label label;
    Input input;
  };
  std::vector<Task<Input>> tasks;
  std::vector<Result> results;
  std::vector<RowWriter> rows;
  WorkSharing::Items packed;
  packed.pack = [&](std::size_t item, std::vector<double>& in) {
    in.resize(sizeof(Head) / sizeof(double));
    const Input input = work.pack(item, RowWriter(in));
    setFront(in, Head{labelOf(items[item].cell), input});
  };
  packed.groupSize = work.together;
  packed.advanceGroup = [&](std::span<const std::span<const double>> in, std::span<std::vector<double>> out) {
    tasks.clear();
    rows.clear();
    results.assign(in.size(), Result{});
    for (std::size_t i = 0; i < in.size(); ++i) {
      PackedDoubles values(in[i]);
      const auto head = values.next<Head>();
      tasks.push_back({head.label, head.input, values.nextRow(values.left())});
      out[i].resize(resultWidth);
      rows.emplace_back(out[i]);
    }
    try {
      work.advance(tasks, results, rows);
    } catch (const FailureInGroup& error) {
      throw failure(tasks[error.place()].label, time, error.what());
    } catch (const NumericsError& error) {
      if (in.size() != 1) throw;
      throw failure(tasks.front().label, time, error.what());
    }
    for (std::size_t i = 0; i < in.size(); ++i) setFront(out[i], results[i]);
  };
  packed.unpack = [&](std::size_t item, std::span<const double> out) {
    PackedDoubles values(out);
    const auto result = values.next<Result>();
    recordCost(items[item], result.cost, over);
    work.unpack(item, result, values.nextRow(values.left()));
  };
  packed.work = [](std::span<const double> out) -> double { return PackedDoubles(out).next<Result>().cost; };
  return share(items, packed, over);
}

}  // namespace lampblack::flow
