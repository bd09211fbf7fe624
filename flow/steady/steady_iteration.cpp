#include "flow/steady/steady_iteration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

constexpr double mostGrowth = 1.5;   // of the Courant number, from one iteration to the next
constexpr double leastGrowth = 0.5;  // the same
// Growth of what is left, in an iteration that is taken: more, and the iterations run away. What the first ones take of
// the mass of a flow that is not steady is left of its momentum.
constexpr double tolerated = 100.0;
constexpr double afterFailure = 0.25;
constexpr double leastCourant = 1e-3;
// A cell whose change has to be limited goes slower than others in the next iteration, by the share that was taken, and
// catches up when it has not to be.
constexpr double mostSlowed = 0.25, catchesUp = 1.5, leastHaste = 1e-4;

}  // namespace

SteadyIteration::SteadyIteration(const FlowContext& context, const State& state, Options options,
                                 std::vector<Operator*> operators)
    : context_(context),
      options_(options),
      operators_(std::move(operators)),
      residual_(context, state, options.scheme, operators_),
      gas_(context, state, operators_),
      flow_(context, state, residual_),
      courant_(options.firstCourant),
      inertia_(static_cast<std::size_t>(context.mesh.owned)),
      haste_(inertia_.size(), 1.0) {
  residual_.evaluate(state);
  measure_ = measure(state);
}

void SteadyIteration::saveOrLoad(const State& state, StateArchive& archive) {
  archive.shared("steady_courant", courant_);
  archive.cells("steady_haste", haste_, 1);
  if (!archive.loading()) return;
  residual_.evaluate(state);
  measure_ = measure(state);
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
  for (double& value : flowInertia_) value /= std::min(courant_, options_.mostFlowCourant);
}

double SteadyIteration::measure(const State& state) const {
  const Mesh& m = context_.mesh;
  const FlowResidual::Rates& rates = residual_.rates();
  const auto n = static_cast<std::size_t>(state.species), d = static_cast<std::size_t>(state.dimension);
  enum { Mass, Fluxes, Momentum, Heat, Species, Through, Equations };
  std::array<double, Equations> sums{};
  std::array<double, 3> ends{0.0, -1e300, -1e300};
  for (int face = 0; face < m.faces; ++face) {
    if (m.low[face] >= m.owned) continue;
    sums[Fluxes] += std::abs(rates.massFlux[face]);
    sums[Through] += std::abs(state.massFlux[face]);
  }
  std::vector<double> enthalpies(n);
  for (int cell = 0; cell < m.owned; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    sums[Mass] += std::abs(rates.mass[c]);
    double speed = 0.0;
    for (std::size_t i = 0; i < d; ++i) {
      sums[Momentum] += std::abs(rates.momentum[c * d + i]);
      speed += std::abs(state.velocity[c * d + i]);
    }
    context_.thermo.speciesEnthalpies(state.temperature[c], enthalpies);
    double heat = rates.enthalpy[c] - state.enthalpy[c] * rates.mass[c];
    for (std::size_t k = 0; k < n; ++k) {
      const double left = rates.species[c * n + k] - state.Y[c * n + k] * rates.mass[c];
      heat -= enthalpies[k] * left;
      sums[Species] += std::abs(left);
    }
    sums[Heat] += std::abs(heat) / residual_.properties().heatCapacity[c];
    ends = {std::max(ends[0], speed), std::max(ends[1], state.temperature[c]),
            std::max(ends[2], -state.temperature[c])};
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), Equations, MPI_DOUBLE, MPI_SUM, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), 3, MPI_DOUBLE, MPI_MAX, m.comm);
  const double through = std::max(sums[Through], 1e-300);
  return (sums[Mass] + sums[Fluxes] + sums[Momentum] / std::max(ends[0], 1e-300) +
          sums[Heat] / std::max(ends[1] + ends[2], 1e-3 * ends[1]) + sums[Species]) /
         through;
}

SteadyIteration::Outcome SteadyIteration::attempt(State& state) {
  Outcome outcome;
  outcome.courant = courant_;
  const double last = measure_;
  try {
    setInertia(state);
    const GasUpdate::Result gas = gas_.advance(state, residual_, inertia_);
    outcome.gasIterations = gas.iterations;
    outcome.largestRise = gas.largestRise;
    outcome.limited = gas.limited;
    for (std::size_t c = 0; c < haste_.size(); ++c) {
      const double share = gas_.shares()[c];
      haste_[c] = std::clamp(haste_[c] * (share < 1.0 ? std::max(share, mostSlowed) : catchesUp), leastHaste, 1.0);
    }
    residual_.evaluateFlow(state);
    const FlowUpdate::Result flow = flow_.advance(state, flowInertia_);
    outcome.flowIterations = flow.iterations;
    outcome.pressureIterations = flow.pressureIterations;
    residual_.evaluate(state);
    measure_ = outcome.measure = measure(state);
  } catch (const NumericsError& error) {
    outcome.why = error.what();
    return outcome;
  }
  if (!(measure_ <= tolerated * last)) {
    outcome.why = "the residual grows";
    return outcome;
  }
  outcome.taken = true;
  courant_ *= std::clamp(last / measure_, leastGrowth, mostGrowth);
  courant_ = std::min(courant_, options_.mostCourant);
  return outcome;
}

SteadyIteration::Outcome SteadyIteration::iterate(State& state) {
  before_ = state;
  const double last = measure_;
  Outcome outcome = attempt(state);
  if (outcome.taken) return outcome;
  state = *before_;
  courant_ = std::max(courant_ * afterFailure, leastCourant);
  residual_.evaluate(state);
  measure_ = outcome.measure = last;
  return outcome;
}

}  // namespace lampblack::flow
