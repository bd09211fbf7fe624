// What particles do in one cell to what is carried there, for iterations towards a steady state.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "flow/models/carried_operator.hpp"

namespace lampblack::flow {
namespace {

class ParticlesInCells : public Operator::CarriedInCells {
 public:
  struct Cells {
    std::size_t first, scalars, all;  // the model's in what is carried
    std::function<double(int)> viscosity;
  };
  ParticlesInCells(const FlowContext& context, const State& state, CarriedModel& model, Cells cells)
      : context_(context),
        state_(state),
        model_(model),
        cells_(std::move(cells)),
        columns_(cells_.scalars + model.exchanged().size() + 1),
        made_(cells_.scalars),
        exchanged_(model.exchanged().size()),
        jacobian_((columns_ - 1) * columns_) {}

  void add(int cell, std::span<const double> amounts, std::span<double> rates, std::span<double> slopes) override {
    const std::span<const double> own = amounts.subspan(cells_.first, cells_.scalars);
    if (cell != cell_) {
      viscosity_.reset();
      gas_ = gasOfCell(context_, state_, cell, 0.0, model_.exchanged(), concentrations_);
      cell_ = cell;
    }
    if (!viscosity_) {
      if (model_.idle(*gas_, own)) return;
      viscosity_ = cells_.viscosity(cell);
      gas_ = gasOfCell(context_, state_, cell, *viscosity_, model_.exchanged(), concentrations_);
    }
    model_.sources(*gas_, own, made_, exchanged_);
    for (std::size_t s = 0; s < cells_.scalars; ++s) rates[cells_.first + s] += made_[s];
    if (slopes.empty()) return;
    std::ranges::fill(jacobian_, 0.0);
    model_.jacobian(*gas_, own, {jacobian_, columns_});
    for (std::size_t by = 0; by < cells_.scalars; ++by)
      for (std::size_t s = 0; s < cells_.scalars; ++s)
        slopes[(cells_.first + by) * cells_.all + cells_.first + s] += jacobian_[s * columns_ + by];
  }

 private:
  const FlowContext& context_;
  const State& state_;
  CarriedModel& model_;
  Cells cells_;
  std::size_t columns_;
  std::vector<double> made_, exchanged_, jacobian_, concentrations_;
  int cell_ = -1;  // of the gas that is kept
  std::optional<ParticleGas> gas_;
  std::optional<double> viscosity_;  // Pa s, where it was needed
};

}  // namespace

std::unique_ptr<Operator::CarriedInCells> CarriedOperator::carriedInCells(const State& state) {
  if (mixing_) return nullptr;  // what mixing lets go of the sources is that of all cells at once
  return std::make_unique<ParticlesInCells>(
      context_, state, model_, ParticlesInCells::Cells{first_, scalars_, state.scalars.size(), [this, &state](int c) {
                                                         return viscosityOf(state, c);
                                                       }});
}

}  // namespace lampblack::flow
