#include "flow/steady/load_control.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lampblack::flow {
namespace {

constexpr double mostOfLoadInIteration = 0.1;  // what an iteration changes of it

}  // namespace

void LoadControl::scale(State& state, double load) {
  const double ratio = load / context_.load;
  for (std::vector<double>* all : {&state.velocity, &state.swirl, &state.massFlux})
    for (double& value : *all) value *= ratio;
  // With gravity most of the pressure may be that of the weight, which has no load.
  if (context_.gravity == Vector3{0.0, 0.0, 0.0})
    for (double& value : state.pressure) value *= ratio * ratio;
  context_.load = load;
}

double LoadControl::lengthOf(const std::vector<double>& difference) const {
  const Mesh& m = context_.mesh;
  std::array<double, 2> sums{};
  for (int c = 0; c < m.owned; ++c) {
    sums[0] += m.volume[c] * difference[c] * difference[c];
    sums[1] += m.volume[c];
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, m.comm);
  return std::sqrt(sums[0] / sums[1]);
}

void LoadControl::require(const std::vector<double>& from, const std::vector<double>& along, double length) {
  const Mesh& m = context_.mesh;
  from_ = from;
  length_ = length;
  double volume = 0.0;
  for (int c = 0; c < m.owned; ++c) volume += m.volume[c];
  MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, m.comm);
  const double size = volume * lengthOf(along);
  weights_.resize(along.size());
  for (std::size_t c = 0; c < along.size(); ++c) weights_[c] = m.volume[c] * along[c] / size;
}

double LoadControl::weighed(const std::function<double(std::size_t)>& value) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < weights_.size(); ++c) sum += weights_[c] * value(c);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  return sum;
}

double LoadControl::left(const State& state) const {
  return length_ - weighed([&](std::size_t c) { return state.temperature[c] - from_[c]; });
}

double LoadControl::change(double wanted, double slope) const {
  const double most = mostOfLoadInIteration * context_.load;
  // Where the load changes next to nothing, it is left as it is.
  return std::abs(slope) > 0.0 ? std::clamp(wanted / slope, -most, most) : 0.0;
}

}  // namespace lampblack::flow
