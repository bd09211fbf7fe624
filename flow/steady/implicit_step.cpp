#include "flow/steady/implicit_step.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "flow/stepping/time_step.hpp"

namespace lampblack::flow {
namespace {

// Of Newton's method in a step: its linear systems, how often at most, in a row without progress (less than a tenth of
// the least that was left), and what of the step's equations is enough. Gas that a step burns or cools by 1000 K takes
// ten passes of its limits.
constexpr double linearReduction = 0.05;
constexpr int vectorsInTime = 60;
constexpr int mostNewtonPasses = 12, mostIdlePasses = 2;
constexpr double progress = 0.9;
constexpr double enough = 0.15;
// What a step may leave of its equations to be taken, and to be followed by a longer one.
constexpr double mostLeftInTime = 0.3, leftOfEasy = 0.2;
// Of the time of a step: near a time that was refused it grows more slowly.
constexpr double growthOfTime = 2.0, slowGrowthOfTime = 1.2, nearRefused = 0.6, shorterInTime = 0.4;
constexpr int carriedPassesInTime = 2;
// The longest step, of what the gas stays in the domain, and in any case of what it does in the cell that it leaves
// first.
constexpr double mostOfResidence = 0.05, mostOfShortest = 10.0;

}  // namespace

bool NewtonPasses::goOn(double left) {
  ++done_;
  idle_ = left <= progress * least_ ? 0 : idle_ + 1;
  least_ = std::min(least_, left);
  return left > enough && done_ < mostNewtonPasses && idle_ < mostIdlePasses;
}

ImplicitStep::ImplicitStep(const FlowContext& context, const State& state, FlowResidual& residual, GasUpdate& gas,
                           CarriedUpdate& carried, std::vector<Operator*> operators)
    : context_(context),
      residual_(residual),
      carried_(carried),
      operators_(std::move(operators)),
      newton_(context, state, residual, gas, vectorsInTime),
      inertia_(static_cast<std::size_t>(context.mesh.owned)) {}

void ImplicitStep::shorten() {
  refused_ = time_;
  time_ *= shorterInTime;
}

void ImplicitStep::lengthen() {
  if (time_ >= refused_) refused_ = INFINITY;
  time_ = std::min(growthOfTime * time_, std::max(slowGrowthOfTime * time_, nearRefused * refused_));
  time_ = std::min(time_, longest_);
}

void ImplicitStep::saveOrLoad(StateArchive& archive) {
  archive.shared("steady_implicit_time", time_);
  archive.shared("steady_implicit_time_refused", refused_);
}

double ImplicitStep::shareLeft(const NewtonKrylov::Left& left, const NewtonKrylov::Left& before, bool isLimited) {
  if (!(before.sum > 0.0)) return 0.0;  // nothing to do
  const double ofWorst = left.root / before.root;
  return isLimited ? ofWorst : std::min(ofWorst, left.sum / before.sum);
}

ImplicitStep::Result ImplicitStep::advance(State& state, std::span<const double> haste) {
  for (Operator* op : operators_) op->setDiffusivities(state);
  state.updateHalo(context_.halo);
  residual_.evaluate(state);
  const double shortest = convectiveTimeStep(context_.mesh, state, 1.0);
  longest_ = std::max(mostOfResidence * residenceTime(context_.mesh, state), mostOfShortest * shortest);
  if (!(time_ > 0.0)) time_ = shortest;
  for (std::size_t c = 0; c < inertia_.size(); ++c)
    inertia_[c] = state.density[c] * context_.mesh.volume[c] / (time_ * haste[c]);
  const State start = state;
  Result result;
  result.time = time_;
  std::optional<NewtonKrylov::Left> before;  // the first pass
  double left = 0.0;
  NewtonPasses passes;
  do {
    const NewtonKrylov::Result step = newton_.advance(state, inertia_, linearReduction, &start);
    if (!before) before = step.before;
    result.vectors += step.iterations;
    result.largestRise = std::max(result.largestRise, step.largestRise);
    result.limited = step.limited;
    residual_.evaluate(state);
    left = shareLeft(newton_.leftInTime(state, start), *before, step.limited > 0);
  } while (passes.goOn(left));
  result.taken = left <= mostLeftInTime;
  if (!result.taken) {
    shorten();
    return result;
  }
  for (int pass = 0; pass < carriedPassesInTime; ++pass) {
    residual_.evaluateCarried(state, pass > 0 ? FlowResidual::Gas::Same : FlowResidual::Gas::Changed);
    result.held = carried_.advance(state, residual_, inertia_);
  }
  residual_.evaluate(state);
  if (left <= leftOfEasy) lengthen();
  return result;
}

}  // namespace lampblack::flow
