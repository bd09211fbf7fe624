// What flows through the faces, added to the cells.
#pragma once

#include <span>

#include "core/mesh.hpp"
#include "core/rooms.hpp"

namespace lampblack::flow {

// Adds what flows through each face in dt to the owned cells on its two sides: `flux` has `components` values a face,
// positive from low to high or outwards, `content` as many an owned cell.
void addFaceFluxes(const Mesh& m, std::span<const double> flux, int components, double dt, std::span<double> content);

}  // namespace lampblack::flow
