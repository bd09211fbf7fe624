// How many numerical particles the cells have room for.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "coupling/ensemble_operator.hpp"

namespace lampblack::coupling {

void EnsembleOperator::findRooms(const State& state) {
  if (options_.particlesAtEdges == 0) return;
  const auto owned = static_cast<std::size_t>(context_.mesh.owned);
  std::vector<std::array<double, 2>> present(owned);  // number and volume
  std::array<double, 2> most{};
  for (std::size_t cell = 0; cell < owned; ++cell) {
    const std::span<const double> amounts(&state.carried[amountsAt(state, static_cast<int>(cell))], amounts_.count());
    present[cell] = {amounts[AmountPlaces::number], particles_->volumeOf(amounts)};
    for (std::size_t k = 0; k < most.size(); ++k) most[k] = std::max(most[k], present[cell][k]);
  }
  MPI_Allreduce(MPI_IN_PLACE, most.data(), static_cast<int>(most.size()), MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
  const auto largest = static_cast<double>(options_.particles), least = static_cast<double>(options_.particlesAtEdges);
  rooms_.assign(owned, least);
  for (std::size_t cell = 0; cell < owned; ++cell)
    for (std::size_t k = 0; k < most.size(); ++k)
      if (most[k] > 0.0) rooms_[cell] = std::max(rooms_[cell], largest * std::sqrt(present[cell][k] / most[k]));
}

}  // namespace lampblack::coupling
