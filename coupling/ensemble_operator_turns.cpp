// Ensembles and a steady gas in turn: EnsembleOperator::beginGas(), beginParticles().
#include <algorithm>
#include <limits>

#include "coupling/ensemble_operator.hpp"

namespace lampblack::coupling {

void EnsembleOperator::beginAverages(double block, std::optional<double> from) {
  EnsembleStatistics::Options options = *options_.statistics;
  options.block = block;
  options.start = from;
  statistics_.emplace(context_.mesh, particles_->material(), options,
                      options_.sizes ? std::optional(options_.bins) : std::nullopt);
}

void EnsembleOperator::beginParticles(State& state, double block, std::optional<double> averagedFrom) {
  turn_ = Turn::Particles;
  hasMoved_ = false;
  for (int cell = 0; cell < context_.mesh.owned; ++cell) setAmounts(state, cell);
  context_.halo.update(state.carried, state.carriedCount());
  beginAverages(block, averagedFrom);
  averagedTime_ = 0.0;
  reserveBefore_.clear();
  amountSums_.assign(static_cast<std::size_t>(context_.mesh.owned) * amounts_.owedElement(0), 0.0);
}

void EnsembleOperator::addToMeans(const State& state) {
  if (!statistics_->since()) return;
  if (reserveBefore_.empty()) {  // the averages start with the next step
    reserveBefore_ = reserve_;
    return;  // from a given time on the step that brought it is in the averages of the fields, and not here
  }
  averagedTime_ += lastStep_;
  const std::size_t width = amounts_.owedElement(0);
  for (int cell = 0; cell < context_.mesh.owned; ++cell)
    for (std::size_t i = 0; i < width; ++i)
      amountSums_[static_cast<std::size_t>(cell) * width + i] += lastStep_ * state.carried[amountsAt(state, cell) + i];
}

void EnsembleOperator::beginGas(State& state) {
  turn_ = Turn::Gas;
  hasMoved_ = false;
  if (meanExchange_) {
    std::vector<double> gained(reserve_.size());
    for (std::size_t i = 0; i < gained.size(); ++i) gained[i] = reserve_[i] - reserveBefore_[i];
    meanExchange_->approach(state, gained, averagedTime_);
  }
  std::ranges::fill(reserve_, 0.0);
  const std::size_t width = amounts_.owedElement(0);
  for (int cell = 0; cell < context_.mesh.owned; ++cell) {
    for (std::size_t i = 0; i < width; ++i)
      state.carried[amountsAt(state, cell) + i] =
          amountSums_[static_cast<std::size_t>(cell) * width + i] / averagedTime_;
    setOwed(state, cell);
  }
  context_.halo.update(state.carried, state.carriedCount());
}

void EnsembleOperator::addRates(const State& state, State::Balance& rates) {
  if (turn_ == Turn::Gas && meanExchange_) meanExchange_->addTo(state, rates);
}

void EnsembleOperator::addSlopes(const State& state, const Slopes& slopes) {
  if (turn_ == Turn::Gas && meanExchange_) meanExchange_->addSlopes(slopes, state.species);
}

void EnsembleOperator::saveOrLoadTurn(StateArchive& archive) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<double> turn{turn_ == Turn::Particles ? 1.0 : 0.0, averagedTime_, reserveBefore_.empty() ? 0.0 : 1.0,
                           statistics_->block(), statistics_->start().value_or(never)};
  archive.shared("ensemble_turn", turn);
  if (archive.loading()) {
    turn_ = turn.at(0) != 0.0 ? Turn::Particles : Turn::Gas;
    averagedTime_ = turn.at(1);
    beginAverages(turn.at(3), turn.at(4) < never ? std::optional(turn.at(4)) : std::nullopt);
  }
  if (meanExchange_) meanExchange_->saveOrLoad(archive);
  const auto owned = static_cast<std::size_t>(context_.mesh.owned);
  amountSums_.resize(owned * amounts_.owedElement(0));
  archive.cells("ensemble_amount_sums", amountSums_, static_cast<int>(amounts_.owedElement(0)));
  reserveBefore_.resize(reserve_.size());
  archive.cells("ensemble_reserve_before", reserveBefore_, static_cast<int>(reserveWidth()));
  if (turn.at(2) == 0.0) reserveBefore_.clear();
}

}  // namespace lampblack::coupling
