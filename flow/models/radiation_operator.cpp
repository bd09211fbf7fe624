#include "flow/models/radiation_operator.hpp"

#include <utility>

namespace lampblack::flow {

RadiationOperator::RadiationOperator(const FlowContext& context, double surroundings, Absorption particles,
                                     ScalarRange of)
    : context_(context),
      radiation_(context.mechanism, surroundings),
      particles_(std::move(particles)),
      block_(std::move(of)),
      start_(static_cast<std::size_t>(context.mesh.owned)),
      loss_(start_),
      X_(context.mechanism.numSpecies()) {}

void RadiationOperator::evaluate(const State& state, std::span<double> loss) {
  const std::size_t n = X_.size();
  const std::size_t scalars = state.scalars.size();
  const auto first = static_cast<std::size_t>(block_.first), count = static_cast<std::size_t>(block_.count);
  for (std::size_t c = 0; c < loss.size(); ++c) {
    const double T = state.temperature[c];
    context_.thermo.massToMole({&state.Y[c * n], n}, X_);
    double absorption = radiation_.absorption(T, state.thermodynamicPressure, X_);
    if (particles_) absorption += particles_(T, {state.carried.data() + c * scalars + first, count});
    loss[c] = radiation_.loss(absorption, T);
  }
}

void RadiationOperator::addRates(const State& state, State::Balance& rates) {
  std::vector<double> loss(loss_.size());
  evaluate(state, loss);
  for (std::size_t c = 0; c < loss.size(); ++c) rates.enthalpy[c] -= loss[c];
}

// As the fourth power of the temperature.
void RadiationOperator::addSlopes(const State& state, const Slopes& slopes) {
  std::vector<double> loss(loss_.size());
  evaluate(state, loss);
  const std::size_t width = X_.size() + 1;
  for (std::size_t c = 0; c < loss.size(); ++c)
    slopes.gas[(c + 1) * width * width - 1] -= 4.0 * loss[c] / state.temperature[c];
}

// The heat is taken by transport.
void RadiationOperator::advance(State& state, double, double) {
  evaluate(state, loss_);
}

void RadiationOperator::endStep(State& state) {
  evaluate(state, loss_);
  start_ = loss_;
}

void RadiationOperator::endSweep(State& state) {
  for (std::size_t c = 0; c < loss_.size(); ++c) state.balance.enthalpy[c] -= 0.5 * (start_[c] + loss_[c]);
}

std::vector<Quantity> RadiationOperator::historyColumns() const {
  return {{"radiated_power", integralUnit(context_.mesh, "W"), "heat lost by radiation, per radian or metre of depth"}};
}

std::vector<double> RadiationOperator::historyValues(const State&) {
  double power = 0.0;
  for (std::size_t c = 0; c < loss_.size(); ++c) power += context_.mesh.volume[c] * loss_[c];
  MPI_Allreduce(MPI_IN_PLACE, &power, 1, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  return {power};
}

void RadiationOperator::fields(const State&, const FieldSink& sink) const {
  sink({"radiation_loss", "W/m^3", "heat lost by radiation"}, loss_);
}

}  // namespace lampblack::flow
