// The elements of Gmsh that Lampblack has (Geuzaine and Remacle 2009; the reference manual of Gmsh, "MSH file format":
// the numbers of the types). Elements of higher order are known by their corners.
#pragma once

#include <cstdint>

#include "core/mesh_block.hpp"
#include "core/modules.hpp"

namespace lampblack::io {

struct GmshElementType {
  int type = 0;       // its number
  int dimension = 0;  // 0: a point, 1: a line
  int nodes = 0;      // its corners
  int between = 0;    // nodes behind the corners, of order 2 and higher
  int order = 1;
  CellShape shape = CellShape::Triangle;  // of dimensions 2 and 3
};

// Null if there is no such type.
const GmshElementType* findGmshType(std::int64_t type);

// "point", "curve", "surface" or "volume": what Gmsh calls the entities of a dimension.
const char* gmshEntityName(int dimension);

}  // namespace lampblack::io
