#include "flow/discretisation/face_fluxes.hpp"

#include <cstddef>

namespace lampblack::flow {

void addFaceFlux(const Mesh& m, int face, std::span<const double> row, double dt, std::span<double> content) {
  const std::size_t n = row.size();
  const int low = m.low[face];
  const int high = m.high[face];
  if (low < m.owned) {
    double* c = &content[static_cast<std::size_t>(low) * n];
    for (std::size_t k = 0; k < n; ++k) c[k] -= dt * row[k];
  }
  if (high >= 0 && high < m.owned) {
    double* c = &content[static_cast<std::size_t>(high) * n];
    for (std::size_t k = 0; k < n; ++k) c[k] += dt * row[k];
  }
}

void addFaceFluxes(const Mesh& m, std::span<const double> flux, int components, double dt, std::span<double> content) {
  const auto n = static_cast<std::size_t>(components);
  for (int face = 0; face < m.faces; ++face) addFaceFlux(m, face, flux.subspan(face * n, n), dt, content);
}

}  // namespace lampblack::flow
