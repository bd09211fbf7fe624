#include "flow/steady/flame_steepness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "flow/models/reaction_operator.hpp"
#include "flow/peak.hpp"

namespace lampblack::flow {
namespace {

constexpr double burning = 0.3;    // of the largest heat release
constexpr double leastHeat = 1e4;  // W/m3

}  // namespace

std::optional<FlameSteepness> flameSteepness(const FlowContext& context, const State& state) {
  const Mesh& m = context.mesh;
  std::vector<double> temperature = state.temperature;
  context.halo.update(temperature, 1);
  std::vector<double> heat(static_cast<std::size_t>(m.owned)), enthalpies(static_cast<std::size_t>(state.species));
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::array<double, 3> most{0.0, none, none};  // heat release, less the lowest T, the highest
  for (int c = 0; c < m.owned; ++c) {
    heat[c] = heatRelease(context, state, static_cast<std::size_t>(c), enthalpies);
    most = {std::max(most[0], heat[c]), std::max(most[1], -temperature[c]), std::max(most[2], temperature[c])};
  }
  MPI_Allreduce(MPI_IN_PLACE, most.data(), 3, MPI_DOUBLE, MPI_MAX, m.comm);
  if (most[0] < leastHeat) return std::nullopt;
  const Peak steepest = peakOf(m, [&](int c) {
    double difference = 0.0;
    if (heat[c] < burning * most[0]) return difference;
    for (int i = m.faceStart[c]; i < m.faceStart[c + 1]; ++i) {
      const int face = m.faceOfCell[i];
      if (face < m.interiorFaces)
        difference = std::max(difference, std::abs(temperature[m.high[face]] - temperature[m.low[face]]));
    }
    return difference;
  });
  if (steepest.value <= 0.0) return std::nullopt;
  return FlameSteepness{steepest.value, (most[1] + most[2]) / steepest.value, steepest.place};
}

}  // namespace lampblack::flow
