// How far cells are from the nearest of some boundary faces, in parallel, without any rank that has all of these faces.
//
// Each cell beside such a face knows it, and cells tell their neighbours of the few nearest faces they know, sweep by
// sweep, until nobody learns anything new; a face travels with its corners, so that each distance is that of the cell's
// centre from the face itself, however far it has come. Where cells are large against the faces, or lie askew, a face
// may fail to reach a cell that it is nearest to: what the sweeps find is at most a bound from above, and nearly always
// the distance. So each cell is looked at once more, on its own rank and on those whose faces may be nearer by the box
// around them all: the distance is exact.
#pragma once

#include <span>
#include <vector>

#include "core/halo_exchange.hpp"
#include "core/mesh.hpp"

namespace lampblack {

// Distance (m) of each owned cell's centre from the nearest face of these patches (indices in Mesh::patches); of an
// axisymmetric mesh in the plane of r and z, which is the distance from the surface of revolution. Straight through
// what is not part of the mesh. Images across periodic sides count as well, but they come by the sweeps alone. The same
// on any number of ranks. Collective, with an exchange of halos a sweep and as many sweeps as cells lie between the
// walls and the cell farthest from them. InputError on all ranks where some cell is not connected with any such face.
std::vector<double> wallDistance(const Mesh& mesh, HaloExchange& halo, std::span<const int> patches);

}  // namespace lampblack
