// The parts of a mesh that do not touch: between them there is no face that two cells share.
#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh.hpp"

namespace lampblack {

struct MeshPart {
  std::int64_t cells = 0;
  std::int64_t firstCell = 0;  // smallest permanent number of its cells
  Vector3 place{};             // m, centre of that cell
  std::vector<char> patches;   // of Mesh::patches, whether it has faces of each
};

// Collective. All parts by their first cells, the same on any number of ranks; walls of no thickness part a mesh,
// periodic faces do not. InputError, on all ranks, for more than 1000 parts. The ranks exchange one number a halo cell,
// some times: as often as a part crosses from one rank to the next and back.
std::vector<MeshPart> partsOf(const Mesh& mesh);

}  // namespace lampblack
