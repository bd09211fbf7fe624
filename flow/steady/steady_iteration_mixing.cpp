// The combination of iterations whose change is least (Anderson's acceleration: Walker and Ni 2011).
#include <algorithm>
#include <array>

#include "flow/steady/steady_iteration.hpp"

namespace lampblack::flow {

std::vector<double> SteadyIteration::unknownsOf(const State& state) const {
  std::vector<double> all;
  for (const std::vector<double>* field :
       {&state.Y, &state.temperature, &state.velocity, &state.swirl, &state.pressure, &state.massFlux})
    all.insert(all.end(), field->begin(), field->end());
  return all;
}

// Over the squares of the fields' ranges, a cell as its volume.
std::vector<double> SteadyIteration::weights(const State& state) const {
  const Mesh& m = context_.mesh;
  std::vector<double> all;
  const auto add = [&](std::span<const double> values, std::size_t components) {
    if (values.empty()) return;
    std::array<double, 2> ends{-1e300, -1e300};
    for (std::size_t i = 0; i < static_cast<std::size_t>(m.owned) * components; ++i)
      ends = {std::max(ends[0], values[i]), std::max(ends[1], -values[i])};
    MPI_Allreduce(MPI_IN_PLACE, ends.data(), 2, MPI_DOUBLE, MPI_MAX, m.comm);
    const double range = ends[0] + ends[1];
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t cell = i / components;
      all.push_back(cell < static_cast<std::size_t>(m.owned) && range > 0.0 ? m.volume[cell] / (range * range) : 0.0);
    }
  };
  const auto n = static_cast<std::size_t>(state.species), d = static_cast<std::size_t>(state.dimension);
  add(state.Y, n);
  add(state.temperature, 1);
  add(state.velocity, d);
  add(state.swirl, 1);
  add(state.pressure, 1);
  all.insert(all.end(), state.massFlux.size(), 0.0);  // follow from velocities and pressure
  return all;
}

void SteadyIteration::accelerate(State& state) {
  std::vector<double> before = unknownsOf(*before_), found = unknownsOf(state), squares = weights(state);
  if (control_) {
    before.push_back(loadBefore_);
    found.push_back(control_->load());
    squares.push_back(0.0);  // follows from the temperatures
  }
  mixing_.mix(before, found, squares);
  if (control_) control_->setLoad(state, found.back());
  auto from = found.cbegin();
  for (std::vector<double>* field :
       {&state.Y, &state.temperature, &state.velocity, &state.swirl, &state.pressure, &state.massFlux}) {
    std::copy_n(from, field->size(), field->begin());
    from += static_cast<std::ptrdiff_t>(field->size());
  }
  inEachCell(context_.mesh, [&](int cell) { followGas(context_, state, cell); });
  keepMass(state, massOf(*before_));
  for (Operator* op : operators_) op->setDiffusivities(state);
  state.updateHalo(context_.halo);
}

}  // namespace lampblack::flow
