// A steady gas and the ensembles in its cells, in turn.
#include <fmt/format.h>

#include "app/problems/flow/flow_loop.hpp"
#include "app/run/warnings.hpp"

namespace lampblack::app {
namespace {

// Blocks of the averages in the time that the gas takes to pass through, where the deck does not say.
constexpr double blocksInResidenceTime = 20.0;
// Of the last step in time, which was one of the gas.
constexpr double firstStepOfParticles = 0.1;

}  // namespace

void FlowLoop::takeTurn(Outputs& outputs) {
  if (!isTurnOfParticles()) {
    searchOn(outputs);
    if (search_->isSteady()) endTurnOfGas(outputs);
    return;
  }
  stepInTime(outputs);
  if (domain_->ensembles->averagedBlocks() >= rounds_->blocks()) endTurnOfParticles(outputs);
}

void FlowLoop::endTurnOfGas(Outputs& outputs) {
  iteration_.reset();
  domain_->adopt(case_);
  std::optional<double> change;
  if (rounds_->rounds() == 0) {
    gases_.begin(domain_->state, 0.0);
  } else {
    gases_.add(
        domain_->state, domain_->flow.properties(), [this] { return heatRelease(); },
        static_cast<double>(rounds_->rounds()));
    if (const auto found = gases_.change(Steadiness::Norm::Maximum)) change = found->value;
  }
  rounds_->addGas(change);
  outputs.progress.finish();
  if (domain_->mesh.rank == 0)
    fmt::print("round {}: the gas is steady after {} iterations so far{}\n", rounds_->rounds() + 1,
               search_->iterations(), change ? fmt::format(" and has changed by {:.2g} of its range", *change) : "");
  if (rounds_->isDone()) return;
  const std::optional<EnsembleStatistics::Options>& averages = case_.ensembles->statistics;
  const double block = averages->block > 0.0 ? averages->block : steadiness_.time() / blocksInResidenceTime;
  std::optional<double> from;
  if (!rounds_->isLong()) from = time_ + static_cast<double>(rounds_->options().leastBlocks) * block;
  domain_->ensembles->beginParticles(domain_->state, block, from);
  domain_->budget->begin(domain_->state);
  dt_ *= firstStepOfParticles;
  resumeFromLoadedState();
}

void FlowLoop::endTurnOfParticles(Outputs& outputs) {
  domain_->ensembles->beginGas(domain_->state);
  domain_->budget->begin(domain_->state);
  rounds_->addParticles();
  outputs.progress.finish();
  if (domain_->mesh.rank == 0)
    fmt::print("round {}: the ensembles have their averages at t = {:.6g} s\n", rounds_->rounds(), time_);
  if (rounds_->isDone()) return;
  resumeFromLoadedState();
  search_->resume(evaluateForSearch(), totalHeatRelease());
  if (search_->isSteady()) endTurnOfGas(outputs);
}

void FlowLoop::warnOfRounds() const {
  if (!rounds_ || !rounds_->isDone() || rounds_->agrees()) return;
  printWarnings(
      {fmt::format("gas and ensembles do not agree after {} rounds: the gas still changes by {:.2g} of its range from "
                   "one to the next "
                   "(to be {:.2g}); more particles or blocks make the noise less (particles.number, "
                   "time.steady.blocks), more rounds "
                   "go on (time.steady.rounds)",
                   rounds_->rounds(), rounds_->change().value_or(1.0), rounds_->options().tolerance)});
}

std::vector<std::string> FlowLoop::roundLines() const {
  if (!rounds_) return {};
  if (!rounds_->options().actsOnGas) return {"the gas does not know of the ensembles (particles.exchange: one_way)"};
  return {
      fmt::format("gas and ensembles in turn, {} rounds: the gas of the last is that of the one before but for "
                  "{:.2g} of its range{}",
                  rounds_->rounds(), rounds_->change().value_or(1.0),
                  rounds_->agrees() ? "" : fmt::format(" (to be {:.2g})", rounds_->options().tolerance))};
}

void FlowLoop::addRounds(JsonWriter& json) const {
  json.field("rounds", static_cast<std::int64_t>(rounds_->rounds()));
  json.field("change_of_gas", rounds_->change().value_or(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace lampblack::app
