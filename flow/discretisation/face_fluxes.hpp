// What flows through the faces, added to the cells.
#pragma once

#include <span>

#include "core/mesh.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

// Adds what flows through each face in dt to the owned cells on its two sides: `flux` has `components` values a face,
// positive from low to high or outwards, `content` as many an owned cell.
void addFaceFluxes(const Mesh& m, std::span<const double> flux, int components, double dt, std::span<double> content);

// The same for one face: a row of fluxes, or one.
void addFaceFlux(const Mesh& m, int face, std::span<const double> row, double dt, std::span<double> content);
inline void addFaceFlux(const Mesh& m, int face, double flux, double dt, std::span<double> content) {
  if (m.low[face] < m.owned) content[m.low[face]] -= dt * flux;
  if (m.high[face] >= 0 && m.high[face] < m.owned) content[m.high[face]] += dt * flux;
}

}  // namespace lampblack::flow
