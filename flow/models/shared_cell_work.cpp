#include "flow/models/shared_cell_work.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lampblack::flow {

void MeanImbalance::add(const WorkSharing::Statistics& stage) {
  before_ += stage.imbalanceBefore;
  after_ += stage.imbalanceAfter;
  ++stages_;
}

Operator::Imbalance MeanImbalance::mean() const {
  return stages_ > 0.0 ? Operator::Imbalance{before_ / stages_, after_ / stages_} : Operator::Imbalance{0.0, 0.0};
}

void MeanImbalance::saveOrLoad(StateArchive& archive, const std::string& name) {
  std::vector<double> values{before_, after_, stages_};
  archive.shared(name, values);
  before_ = values.at(0);
  after_ = values.at(1);
  stages_ = values.at(2);
}

SharedCellWork::SharedCellWork(const FlowContext& context, Options options)
    : context_(context),
      options_(std::move(options)),
      sharing_(context.mesh.comm, options_.isShared),
      cost_(static_cast<std::size_t>(context.mesh.owned), options_.firstCost),
      costOfStep_(cost_.size()) {}

void SharedCellWork::beginStep() {
  if (!isInStep_) std::ranges::fill(costOfStep_, 0.0);
  isInStep_ = true;
}

SharedCellWork::Label SharedCellWork::labelOf(int cell) const {
  const auto c = static_cast<std::size_t>(cell);
  return {static_cast<double>(context_.mesh.naturalCell[c]), context_.mesh.centre[c]};
}

NumericsError SharedCellWork::failure(const Label& label, double time, const std::string& reason) const {
  return NumericsError(fmt::format("{} failed in cell {:.0f} at {} at time {:.6g} s: {}", options_.subject,
                                   label.number, placeText(label.place, context_.mesh.dimension), time, reason));
}

void SharedCellWork::recordCost(const Item& item, double cost, Over over) {
  const auto c = static_cast<std::size_t>(item.cell);
  costOfStep_[c] += cost;
  if (over == Over::Step) cost_[c] = options_.isSmoothed ? 0.5 * (cost_[c] + cost) : cost;
}

WorkSharing::Statistics SharedCellWork::share(std::span<const Item> items, WorkSharing::Items& packed, Over over) {
  for (const Item& item : items) packed.cost.push_back(item.expectedCost);
  const WorkSharing::Statistics statistics = sharing_.run(packed);
  if (over == Over::Step) imbalance_.add(statistics);
  return statistics;
}

void SharedCellWork::addCost(CellCost& cost) const {
  std::vector<double>& to = options_.isShared ? cost.shared : cost.own;
  for (std::size_t cell = 0; cell < to.size(); ++cell) to[cell] += costOfStep_[cell];
}

std::optional<Operator::Imbalance> SharedCellWork::imbalance() const {
  if (imbalance_.stages() == 0) return {};
  return imbalance_.mean();
}

void SharedCellWork::saveOrLoad(StateArchive& archive) {
  if (archive.loading()) isInStep_ = false;  // of a step that was broken off
  archive.cells(options_.name + "_cost", cost_, 1);
  imbalance_.saveOrLoad(archive, options_.name + "_imbalance");
}

}  // namespace lampblack::flow
