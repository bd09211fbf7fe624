// The elements of Gmsh that Lampblack has, and the names of those that it has not (Geuzaine and Remacle 2009; the
// reference manual of Gmsh, "MSH file format": the numbers of the types).
#pragma once

#include <cstdint>
#include <string>

#include "core/mesh_block.hpp"
#include "core/modules.hpp"

namespace lampblack::io {

// An element of first order.
struct GmshElementType {
  int type = 0;       // its number
  int dimension = 0;  // 0: a point, 1: a line
  int nodes = 0;
  CellShape shape = CellShape::Triangle;  // of dimensions 2 and 3
};

// Null if there is no such type of first order.
const GmshElementType* findGmshType(std::int64_t type);

// "triangle of second order (6 nodes)"; empty if this page does not know the type.
std::string nameOfOtherGmshType(std::int64_t type);

// "point", "curve", "surface" or "volume": what Gmsh calls the entities of a dimension.
const char* gmshEntityName(int dimension);

}  // namespace lampblack::io
