#include "flow/steady/steady_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "flow/cell_errors.hpp"

namespace lampblack::flow {
namespace {

constexpr double mostGrowth = 1.5;   // of the Courant number, from one iteration to the next
constexpr double leastGrowth = 0.5;  // the same
// Growth of what is left, in an iteration that is taken: more, and the iterations run away. What the first takes of the
// mass of a flow that is not steady is left of its momentum; where an iteration has failed, what the flow has to answer
// to is the same in the next.
constexpr double toleratedFirst = 100.0, tolerated = 4.0;
constexpr double forgets = 2.0;  // growth with which the earlier iterations are of no use
// Velocities and pressure, which cost little beside a gas of many species, are changed so many times in an iteration.
constexpr int flowPasses = 3;
// So is what is carried where all cells are one linear system, and moves on by a cell each time: whole steps of sources
// that bend would lead elsewhere. Cell by cell it may pass as many as there are, and changes again only while more of
// its equations is left than a share of all that was left before the iteration.
constexpr int carriedPasses = 3;
constexpr double carriedShare = 0.3;
constexpr double mostCarriedCourant = 1.0, mostSweptCourant = 1e3;
constexpr std::size_t acceleratedDepth = 10;  // iterations that are combined
constexpr double afterFailure = 0.25;
constexpr double leastCourant = 1e-2;
constexpr double growthAfterFailure = 1.2;
// Of the linear solver of Newton's method: stiff gas in thin cells needs many (sooting bluff bodies more than 60).
constexpr int newtonVectors = 150;
constexpr int mostOfGasAlone = 2;  // iterations after steps of one time, or Newton's, where the flow rests
// Of the Courant number, at least, where no cell was limited and no more is left than before: in thin cells the
// residual falls as slowly as a small one lets it, and would hold it where it is.
constexpr double quietGrowth = 1.1;
// A cell whose change has to be limited goes slower than others in the next iteration, by the share that was taken, and
// catches up when it has not to be: gas that ignites does so in far less time than it stays.
constexpr double mostSlowed = 0.25, catchesUp = 1.5, leastHaste = 1e-8;

}  // namespace

SteadyIteration::SteadyIteration(const FlowContext& context, const State& state, Options options,
                                 std::vector<Operator*> operators, LoadControl* control)
    : context_(context),
      options_(options),
      operators_(std::move(operators)),
      control_(control),
      residual_(context, state, options.scheme, operators_),
      gas_(context, state, operators_, options.oneTime ? GasUpdate::Takes::NineTenths : GasUpdate::Takes::All),
      flow_(context, state, residual_),
      mixing_(context.mesh.comm, acceleratedDepth),
      courant_(options.firstCourant),
      inertia_(static_cast<std::size_t>(context.mesh.owned)),
      carriedInertia_(inertia_.size()),
      haste_(inertia_.size(), 1.0) {
  if (control_) beside_.emplace(context, state, options.scheme, operators_);
  if (!state.scalars.empty()) carried_.emplace(context, state, residual_, operators_);
  // What is carried follows, but of eddies, which move all else. No step of Newton's is one after which the pressure of
  // a closed vessel moves.
  if (!control_ && !context.isClosed() && options.newton) {
    if (state.eddyViscosity.empty())
      newton_.emplace(context, state, residual_, gas_, newtonVectors);
    else
      newton_.emplace(context, state, residual_, gas_, newtonVectors, &*carried_, operators_);
    if (options.oneTime && !state.eddyViscosity.empty() && context.mechanism.numReactions() > 0)
      step_.emplace(context, state, residual_, gas_, *carried_, operators_);
  }
  residual_.evaluate(state);
  measure_ = measure(state);
}

void SteadyIteration::saveOrLoad(const State& state, StateArchive& archive) {
  archive.shared("steady_courant", courant_);
  archive.cells("steady_haste", haste_, 1);
  archive.shared("steady_is_anew", isAnew_);
  archive.shared("steady_is_limited", isLimited_);
  archive.shared("steady_newton_waits", waits_);
  archive.shared("steady_newton_pause", pause_);
  archive.shared("steady_gas_alone", ofGasAlone_);
  mixing_.clear();
  gas_.saveOrLoad(archive);
  flow_.saveOrLoad(archive);
  if (step_) step_->saveOrLoad(archive);
  if (!archive.loading()) return;
  residual_.evaluate(state);
  measure_ = measure(state);
}

double SteadyIteration::flowCourant() const {
  return std::clamp(courant_, options_.leastFlowCourant, options_.mostFlowCourant);
}

// Mass over the pseudo-time: of the gas in a cell that much of what flows through, and a tenth of what is conducted,
// takes the place of it in an iteration.
void SteadyIteration::setInertia(const State& state) {
  const Mesh& m = context_.mesh;
  std::ranges::fill(inertia_, 0.0);
  const std::vector<double>& capacity = residual_.properties().heatCapacity;
  for (int face = 0; face < m.faces; ++face) {
    const double conducts = 0.1 * residual_.heatConduction().conductance(face);
    for (const int cell : {m.low[face], m.high[face]})
      if (cell >= 0 && cell < m.owned)
        inertia_[cell] += 0.5 * std::abs(state.massFlux[face]) + conducts / capacity[cell];
  }
  flowInertia_ = inertia_;
  for (std::size_t c = 0; c < inertia_.size(); ++c) inertia_[c] /= courant_ * haste_[c];
  for (double& value : flowInertia_) value /= flowCourant();
}

double SteadyIteration::massOf(const State& state) const {
  double mass = 0.0;
  for (int c = 0; c < context_.mesh.owned; ++c) mass += context_.mesh.volume[c] * state.density[c];
  MPI_Allreduce(MPI_IN_PLACE, &mass, 1, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  return mass;
}

// In a closed vessel by the thermodynamic pressure.
void SteadyIteration::keepMass(State& state, double mass) const {
  if (!context_.isClosed()) return;
  const double ratio = mass / massOf(state);
  state.thermodynamicPressure *= ratio;
  for (double& density : state.density) density *= ratio;
  for (double& carried : state.carried) carried *= ratio;
}

// By what the cells took of their last change.
void SteadyIteration::hurry() {
  for (std::size_t c = 0; c < haste_.size(); ++c) {
    const double share = gas_.shares()[c];
    haste_[c] = std::clamp(haste_[c] * (share < 1.0 ? std::max(share, mostSlowed) : catchesUp), leastHaste, 1.0);
  }
}

std::int64_t SteadyIteration::advanceCarried(State& state) {
  const double most = carried_->isByCell() ? mostSweptCourant : mostCarriedCourant;
  const double slower = flowCourant() / std::min(courant_, most);
  for (std::size_t c = 0; c < inertia_.size(); ++c) carriedInertia_[c] = slower * flowInertia_[c];
  std::int64_t held = 0;
  for (int pass = 0; pass < carriedPasses; ++pass) {
    residual_.evaluateCarried(state, pass > 0 ? FlowResidual::Gas::Same : FlowResidual::Gas::Changed);
    if (pass > 0 && carried_->isByCell() && ofCarried(state, through(state)) < carriedShare * measure_) break;
    held = carried_->advance(state, residual_, carriedInertia_);
  }
  return held;
}

SteadyIteration::Outcome SteadyIteration::attempt(State& state, bool mayCombine) {
  Outcome outcome;
  outcome.courant = courant_;
  const double last = measure_;
  try {
    setInertia(state);
    std::optional<GasUpdate::LoadAsUnknown> load;
    if (control_) load.emplace(*control_, *beside_);
    GasUpdate::Result gas;
    const bool isAtRest = !control_ && gas_.isAtRest(state, residual_, flowInertia_);
    if (!isAtRest) gas = gas_.advance(state, residual_, inertia_, load);
    if (control_) control_->scale(state, control_->load() + gas.loadChange);
    keepMass(state, massOf(*before_));
    outcome.gasIterations = gas.iterations;
    outcome.largestRise = gas.largestRise;
    outcome.limited = gas.limited;
    hurry();
    // After steps of one time the gas alone goes on where the flow rests: what one after the other makes of flow and
    // eddies grows.
    const bool isOfGasAlone = step_ && !mayCombine;
    for (int pass = 0; pass < flowPasses && !isOfGasAlone; ++pass) {
      const bool isSame = pass > 0 || (isAtRest && !context_.isClosed());
      residual_.evaluateFlow(state, isSame ? FlowResidual::Gas::Same : FlowResidual::Gas::Changed);
      const FlowUpdate::Result flow = flow_.advance(state, flowInertia_);
      outcome.flowIterations += flow.iterations;
      outcome.pressureIterations += flow.pressureIterations;
    }
    // One that moves next to nothing because its system was not solved would hold all combinations where it is.
    if (mayCombine && last < options_.accelerated && outcome.limited == 0 && gas.isSolved)
      accelerate(state);
    else
      mixing_.clear();
    if (carried_ && !isOfGasAlone) outcome.held = advanceCarried(state);
    residual_.evaluate(state);
    measure_ = outcome.measure = measure(state);
  } catch (const NumericsError& error) {
    outcome.why = error.what();
    return outcome;
  }
  if (measure_ > forgets * last) mixing_.clear();
  if (!(measure_ <= (isAnew_ ? toleratedFirst : tolerated) * last)) {
    outcome.why = "the residual grows";
    return outcome;
  }
  outcome.taken = true;
  isAnew_ = false;
  // Below its start it is too small for the residual to fall, too.
  const bool isQuiet = outcome.limited == 0 && measure_ <= last;
  const double least = !isQuiet ? leastGrowth : courant_ < options_.firstCourant ? growthAfterFailure : quietGrowth;
  courant_ *= std::clamp(last / measure_, least, mostGrowth);
  courant_ = std::min(courant_, options_.mostCourant);
  return outcome;
}

void SteadyIteration::takeBack(State& state, double measure) {
  state = *before_;
  if (control_) control_->setLoad(state, loadBefore_);
  residual_.evaluate(state);
  measure_ = measure;
}

SteadyIteration::Outcome SteadyIteration::iterate(State& state, Allowed allowed) {
  return last_ = tryOne(state, allowed);
}

SteadyIteration::Outcome SteadyIteration::tryOne(State& state, Allowed allowed) {
  before_ = state;
  if (control_) loadBefore_ = control_->load();
  const double last = measure_;
  int newtonIterations = 0;
  bool isTakenBack = false;
  if (step_ && last - ofCarried(state, through(state)) >= options_.inTime) return attemptInTime(state);
  if (step_ && !allowed.newtons) {
    const bool all = ofGasAlone_ == mostOfGasAlone;
    ofGasAlone_ = all ? 0 : ofGasAlone_ + 1;
    allowed = {.combined = all, .newtons = all};
  }
  if (newton_ && allowed.newtons && last < options_.accelerated && !isLimited_ && --waits_ < 0) {
    const Outcome outcome = attemptTogether(state);
    if (outcome.taken) return outcome;
    newtonIterations = outcome.newtonIterations;
    isTakenBack = true;
    takeBack(state, last);
    waitForNewton();
  }
  Outcome outcome;
  if (step_ && allowed.newtons) {
    outcome = attemptInTime(state);
    outcome.newtonIterations += newtonIterations;
    outcome.newtonTakenBack = isTakenBack;
    return outcome;
  }
  courant_ = std::min(courant_, options_.mostCourant);
  outcome = attempt(state, allowed.combined);
  outcome.newtonIterations = newtonIterations;
  outcome.newtonTakenBack = isTakenBack;
  isLimited_ = !outcome.taken || outcome.limited > 0;
  if (outcome.taken) return outcome;
  takeBack(state, last);
  mixing_.clear();
  isAnew_ = true;
  courant_ = std::max(courant_ * afterFailure, leastCourant);
  outcome.measure = last;
  return outcome;
}

}  // namespace lampblack::flow
