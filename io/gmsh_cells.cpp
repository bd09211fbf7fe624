#include "io/gmsh_cells.hpp"

#include <algorithm>
#include <array>

namespace lampblack::io {
namespace {

// Corners come first, whatever the order; of some orders there are types with and without nodes inside.
constexpr std::array gmshTypes{
    GmshElementType{15, 0, 1, 0, 1},
    GmshElementType{1, 1, 2, 0, 1},
    GmshElementType{2, 2, 3, 0, 1, CellShape::Triangle},
    GmshElementType{3, 2, 4, 0, 1, CellShape::Quadrilateral},
    GmshElementType{4, 3, 4, 0, 1, CellShape::Tetrahedron},
    GmshElementType{5, 3, 8, 0, 1, CellShape::Hexahedron},
    GmshElementType{6, 3, 6, 0, 1, CellShape::Prism},
    GmshElementType{7, 3, 5, 0, 1, CellShape::Pyramid},
    GmshElementType{8, 1, 2, 1, 2},
    GmshElementType{9, 2, 3, 3, 2, CellShape::Triangle},
    GmshElementType{10, 2, 4, 5, 2, CellShape::Quadrilateral},
    GmshElementType{11, 3, 4, 6, 2, CellShape::Tetrahedron},
    GmshElementType{12, 3, 8, 19, 2, CellShape::Hexahedron},
    GmshElementType{13, 3, 6, 12, 2, CellShape::Prism},
    GmshElementType{14, 3, 5, 9, 2, CellShape::Pyramid},
    GmshElementType{16, 2, 4, 4, 2, CellShape::Quadrilateral},
    GmshElementType{17, 3, 8, 12, 2, CellShape::Hexahedron},
    GmshElementType{18, 3, 6, 9, 2, CellShape::Prism},
    GmshElementType{19, 3, 5, 8, 2, CellShape::Pyramid},
    GmshElementType{20, 2, 3, 6, 3, CellShape::Triangle},
    GmshElementType{21, 2, 3, 7, 3, CellShape::Triangle},
    GmshElementType{22, 2, 3, 9, 4, CellShape::Triangle},
    GmshElementType{23, 2, 3, 12, 4, CellShape::Triangle},
    GmshElementType{24, 2, 3, 12, 5, CellShape::Triangle},
    GmshElementType{25, 2, 3, 18, 5, CellShape::Triangle},
    GmshElementType{26, 1, 2, 2, 3},
    GmshElementType{27, 1, 2, 3, 4},
    GmshElementType{28, 1, 2, 4, 5},
    GmshElementType{29, 3, 4, 16, 3, CellShape::Tetrahedron},
    GmshElementType{30, 3, 4, 31, 4, CellShape::Tetrahedron},
    GmshElementType{31, 3, 4, 52, 5, CellShape::Tetrahedron},
    GmshElementType{36, 2, 4, 12, 3, CellShape::Quadrilateral},
    GmshElementType{37, 2, 4, 21, 4, CellShape::Quadrilateral},
    GmshElementType{39, 2, 4, 8, 3, CellShape::Quadrilateral},
    GmshElementType{40, 2, 4, 12, 4, CellShape::Quadrilateral},
    GmshElementType{90, 3, 6, 34, 3, CellShape::Prism},
    GmshElementType{91, 3, 6, 69, 4, CellShape::Prism},
    GmshElementType{92, 3, 8, 56, 3, CellShape::Hexahedron},
    GmshElementType{93, 3, 8, 117, 4, CellShape::Hexahedron},
};

}  // namespace

const GmshElementType* findGmshType(std::int64_t type) {
  const auto* found = std::find_if(gmshTypes.begin(), gmshTypes.end(),
                                   [&](const GmshElementType& known) { return known.type == type; });
  return found == gmshTypes.end() ? nullptr : &*found;
}

const char* gmshEntityName(int dimension) {
  constexpr std::array names{"point", "curve", "surface", "volume"};
  return names.at(static_cast<std::size_t>(dimension));
}

}  // namespace lampblack::io
