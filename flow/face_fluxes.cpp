#include "flow/face_fluxes.hpp"

#include <cstddef>

namespace lampblack::flow {

void addFaceFluxes(const Mesh& m, std::span<const double> flux, int components, double dt, std::span<double> content) {
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    const double* f = flux.data() + static_cast<std::ptrdiff_t>(face) * components;
    if (low < m.owned) {
      double* c = content.data() + static_cast<std::ptrdiff_t>(low) * components;
      for (int k = 0; k < components; ++k) c[k] -= dt * f[k];
    }
    if (high >= 0 && high < m.owned) {
      double* c = content.data() + static_cast<std::ptrdiff_t>(high) * components;
      for (int k = 0; k < components; ++k) c[k] += dt * f[k];
    }
  }
}

}  // namespace lampblack::flow
