#include "flow/stepping/time_step.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace lampblack::flow {

double convectiveTimeStep(const Mesh& m, const State& state, double courant) {
  std::vector<double> outflow(m.owned, 0.0);
  for (int face = 0; face < m.faces; ++face) {
    const double flux = state.massFlux[face];
    const int up = flux >= 0.0 ? m.low[face] : m.high[face];
    if (up >= 0 && up < m.owned) outflow[up] += std::abs(flux) / state.density[up];
  }
  double rate = 0.0;  // 1/s
  for (int c = 0; c < m.owned; ++c) rate = std::max(rate, outflow[c] / m.volume[c]);
  for (int c = 0; state.swirls && c < m.owned; ++c) rate = std::max(rate, std::abs(state.swirl[c]) / m.centre[c][0]);
  MPI_Allreduce(MPI_IN_PLACE, &rate, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  return rate > 0.0 ? courant / rate : std::numeric_limits<double>::infinity();
}

double residenceTime(const Mesh& m, const State& state) {
  std::array<double, 2> sums{};  // kg, kg/s
  for (int c = 0; c < m.owned; ++c) sums[0] += m.volume[c] * state.density[c];
  for (int face = m.interiorFaces; face < m.faces; ++face) sums[1] += std::max(-state.massFlux[face], 0.0);
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, m.comm);
  return sums[1] > 0.0 ? sums[0] / sums[1] : std::numeric_limits<double>::infinity();
}

}  // namespace lampblack::flow
