#include "flow/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lampblack::flow {

StepControl::StepControl(const FlowContext& context, double tolerance, int sweeps)
    : context_(context), tolerance_(tolerance), sweeps_(sweeps) {
  if (sweeps < 2) throw std::logic_error("StepControl needs two sweeps");
}

void StepControl::advance(State& state, double, double dt) {
  ++sweep_;
  const auto owned = static_cast<std::size_t>(context_.mesh.owned);
  const std::size_t fractions = owned * static_cast<std::size_t>(state.species);
  if (sweep_ == sweeps_ - 1) {
    temperature_.assign(state.temperature.begin(), state.temperature.begin() + static_cast<std::ptrdiff_t>(owned));
    Y_.assign(state.Y.begin(), state.Y.begin() + static_cast<std::ptrdiff_t>(fractions));
  }
  if (sweep_ < sweeps_) return;
  sweep_ = 0;
  step_ = dt;
  error_ = 0.0;
  for (std::size_t c = 0; c < owned; ++c)
    error_ = std::max(error_, std::abs(state.temperature[c] - temperature_[c]) / state.temperature[c]);
  for (std::size_t i = 0; i < fractions; ++i) error_ = std::max(error_, std::abs(state.Y[i] - Y_[i]));
  MPI_Allreduce(MPI_IN_PLACE, &error_, 1, MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
}

double StepControl::largestStep(const State&) {
  if (step_ <= 0.0) return std::numeric_limits<double>::infinity();
  // A sweep has the error step^(sweeps) after those before it.
  const double factor = 0.9 * std::pow(tolerance_ / std::max(error_, 1e-6 * tolerance_), 1.0 / sweeps_);
  return step_ * std::max(factor, 0.2);
}

void StepControl::saveOrLoad(StateArchive& archive) {
  archive.shared("step_error", error_);
  archive.shared("step_of_error", step_);
  if (archive.loading()) sweep_ = 0;  // of a step that was broken off
}

std::vector<Quantity> StepControl::historyColumns() const {
  return {
      {"step_error", "1", "largest change of a cell's temperature, relative, or of a mass fraction by the last sweep"}};
}

std::vector<double> StepControl::historyValues(const State&) {
  return {error_};
}

}  // namespace lampblack::flow
