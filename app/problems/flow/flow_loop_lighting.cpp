// What the search for a steady flame does where the flame of the start has not caught.
#include <fmt/format.h>

#include <algorithm>

#include "app/problems/flow/flow_loop.hpp"
#include "app/run/warnings.hpp"
#include "flow/steady/lighting.hpp"

namespace lampblack::app {
namespace {

constexpr double hotStart = 1000.0;  // K, in a start that is to light a flame
constexpr int mostLightings = 2;     // what goes out again does not burn in this flow

}  // namespace

bool FlowLoop::isHot() const {
  double hottest = *std::ranges::max_element(domain_->state.temperature);
  MPI_Allreduce(MPI_IN_PLACE, &hottest, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return hottest > hotStart;
}

bool FlowLoop::mayAttempt() const {
  if (case_.time.search->triesWithoutFlame) return burnsOrCannot() || isHot();
  if (case_.mechanism->numReactions() == 0) return false;
  return burnsOrCannot() || (isHot() && couldBurn(domain_->context, domain_->state));
}

void FlowLoop::lightIfDark(Outputs& outputs) {
  const bool goesOn = search_->phase() == SteadySearch::Phase::Steps && !search_->isSteady();
  if (goesOn || search_->isAttempt() || !startsHot_ || !case_.time.search->lights ||
      search_->lightings() == mostLightings)
    return;
  if (burnsOrCannot()) return;
  const std::int64_t cells = flow::lightMixture(domain_->context, domain_->state);
  if (cells == 0) return;
  iteration_.reset();
  domain_->beginAnew(case_);
  steadiness_.begin(domain_->state, time_);
  beginNextStep();
  dt_ = case_.time.firstStep;
  normsOf_ = -1;
  heldCells_ = 0;
  search_->addLighting();
  outputs.progress.finish();
  printWarnings(
      {fmt::format("step {}: nothing burns, though the start was hot: what is mixed is lit in {} cells, where "
                   "burning heats it by {:g} K or more (time.steady.light)",
                   steps_, cells, flow::leastRiseOfLighting)});
}

}  // namespace lampblack::app
