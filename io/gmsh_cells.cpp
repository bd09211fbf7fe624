#include "io/gmsh_cells.hpp"

#include <algorithm>
#include <array>

namespace lampblack::io {
namespace {

constexpr std::array gmshTypes{
    GmshElementType{15, 0, 1},
    GmshElementType{1, 1, 2},
    GmshElementType{2, 2, 3, CellShape::Triangle},
    GmshElementType{3, 2, 4, CellShape::Quadrilateral},
    GmshElementType{4, 3, 4, CellShape::Tetrahedron},
    GmshElementType{5, 3, 8, CellShape::Hexahedron},
    GmshElementType{6, 3, 6, CellShape::Prism},
    GmshElementType{7, 3, 5, CellShape::Pyramid},
};

struct OtherGmshType {
  int type;
  const char* name;
};

constexpr std::array otherGmshTypes{
    OtherGmshType{8, "line of second order (3 nodes)"},
    OtherGmshType{9, "triangle of second order (6 nodes)"},
    OtherGmshType{10, "quadrilateral of second order (9 nodes)"},
    OtherGmshType{11, "tetrahedron of second order (10 nodes)"},
    OtherGmshType{12, "hexahedron of second order (27 nodes)"},
    OtherGmshType{13, "prism of second order (18 nodes)"},
    OtherGmshType{14, "pyramid of second order (14 nodes)"},
    OtherGmshType{16, "quadrilateral of second order (8 nodes)"},
    OtherGmshType{17, "hexahedron of second order (20 nodes)"},
    OtherGmshType{18, "prism of second order (15 nodes)"},
    OtherGmshType{19, "pyramid of second order (13 nodes)"},
    OtherGmshType{20, "triangle of third order (9 nodes)"},
    OtherGmshType{21, "triangle of third order (10 nodes)"},
    OtherGmshType{22, "triangle of fourth order (12 nodes)"},
    OtherGmshType{23, "triangle of fourth order (15 nodes)"},
    OtherGmshType{24, "triangle of fifth order (15 nodes)"},
    OtherGmshType{25, "triangle of fifth order (21 nodes)"},
    OtherGmshType{26, "line of third order (4 nodes)"},
    OtherGmshType{27, "line of fourth order (5 nodes)"},
    OtherGmshType{28, "line of fifth order (6 nodes)"},
    OtherGmshType{29, "tetrahedron of third order (20 nodes)"},
    OtherGmshType{30, "tetrahedron of fourth order (35 nodes)"},
    OtherGmshType{31, "tetrahedron of fifth order (56 nodes)"},
    OtherGmshType{36, "quadrilateral of third order (16 nodes)"},
    OtherGmshType{92, "hexahedron of third order (64 nodes)"},
    OtherGmshType{93, "hexahedron of fourth order (125 nodes)"},
};

}  // namespace

const GmshElementType* findGmshType(std::int64_t type) {
  const auto* found = std::find_if(gmshTypes.begin(), gmshTypes.end(),
                                   [&](const GmshElementType& known) { return known.type == type; });
  return found == gmshTypes.end() ? nullptr : &*found;
}

std::string nameOfOtherGmshType(std::int64_t type) {
  const auto* found = std::find_if(otherGmshTypes.begin(), otherGmshTypes.end(),
                                   [&](const OtherGmshType& known) { return known.type == type; });
  return found == otherGmshTypes.end() ? std::string() : std::string(found->name);
}

const char* gmshEntityName(int dimension) {
  constexpr std::array names{"point", "curve", "surface", "volume"};
  return names.at(static_cast<std::size_t>(dimension));
}

}  // namespace lampblack::io
