// The finite-volume mesh as flat arrays, made once from a distributed DMPlex box: owned cells first, then one layer of
// halo cells; interior faces first, then boundary faces. Everything a flux loop needs is an array here.
//
// Geometry. `Planar`: two-dimensional, unit depth. `Axisymmetric`: coordinate 0 is the radius r, coordinate 1 the axial
// position z, and all metrics are per radian: volumes are the integral of r dA, face areas are length times r. The
// planar measures are kept beside them for what acts on planes (pressure gradient, hoop stress).
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lampblack {

enum class Geometry { Planar, Axisymmetric };

// A part of the box's surface: the faces of one side whose centre lies in [from, to] along the other axis (m).
struct BoundaryPatch {
  std::string name;
  int axis = 0;        // 0 or 1: the axis the side is normal to
  bool atMax = false;  // side at the low or high end of that axis
  double from = -1e300;
  double to = 1e300;
};

struct MeshSpec {
  Geometry geometry = Geometry::Planar;
  std::array<std::vector<double>, 2> vertices;  // m, increasing along each axis
  std::vector<BoundaryPatch> patches;           // first match wins; a face without a patch is an InputError
  // Along an axis: what leaves at one end comes in at the other. Such an axis has three cells or more and no patches.
  std::array<bool, 2> periodic{false, false};
};

class Mesh {
 public:
  // Collective. `cellWeight` (one per cell in natural order, or empty for equal weights) is the expected cost that
  // METIS balances. Every rank owns at least one cell. InputError, on all ranks, when an axis has no cells, there are
  // fewer cells than ranks, a radius is negative, or a boundary face belongs to no patch.
  Mesh(MPI_Comm comm, MeshSpec spec, const std::vector<double>& cellWeight = {});

  MPI_Comm comm;
  int rank = 0;
  int ranks = 1;
  MeshSpec spec;
  std::int64_t totalCells = 0;
  std::array<int, 2> cellsAlong{0, 0};

  // Cells: [0, owned) are this rank's, [owned, cells) are halo.
  int owned = 0;
  int cells = 0;
  std::vector<std::int64_t> naturalCell;      // i + j * cellsAlong[0], the same on any number of ranks
  std::vector<int> haloRank;                  // owner of cell owned + i
  std::vector<std::array<double, 2>> centre;  // m
  std::vector<double> volume;                 // m^3 (planar: per metre depth) or m^3/rad
  std::vector<double> planarArea;             // m^2

  // Faces: [0, interiorFaces) lie between two local cells, of which at least one is owned; the rest are boundary faces
  // of owned cells. The unit normal points from `low` to `high`, or out of the domain; `low` is before `high` on the
  // axis (of a periodic pair the cell at the upper end), so that two ranks compute a shared face's flux in the same
  // order, to the last bit.
  int interiorFaces = 0;
  int faces = 0;
  std::vector<int> low;
  std::vector<int> high;                          // -1 on boundary faces
  std::vector<int> normalAxis;                    // axis of the normal
  std::vector<double> normalSign;                 // +1 or -1 along that axis
  std::vector<double> area;                       // metric area
  std::vector<double> planarLength;               // m
  std::vector<double> distance;                   // m, centre to centre, or centre to boundary face
  std::vector<double> lowWeight;                  // linear interpolation weight of `low` at the face
  std::vector<std::array<double, 2>> faceCentre;  // m
  std::vector<int> patch;                         // of boundary faces, index face - interiorFaces

  // Faces of each cell in compressed rows: faceOfCell[faceStart[c] .. faceStart[c+1]). An owned cell has all its faces,
  // in an order that does not depend on the ranks; a halo cell has those it shares with owned cells.
  std::vector<int> faceStart;
  std::vector<int> faceOfCell;

  [[nodiscard]] bool axisymmetric() const { return spec.geometry == Geometry::Axisymmetric; }
  [[nodiscard]] int boundaryFaces() const { return faces - interiorFaces; }
  [[nodiscard]] const std::string& patchName(int face) const {
    return spec.patches[static_cast<std::size_t>(patch[static_cast<std::size_t>(face - interiorFaces)])].name;
  }
  // Rank-independent numbers of the local faces, 0 to totalFaces() - 1: those normal to axis 0 row by row, then those
  // normal to axis 1. A face between two ranks is local to both.
  [[nodiscard]] std::vector<std::int64_t> naturalFaces() const;
  [[nodiscard]] std::int64_t totalFaces() const;
  // Local index of a natural cell among the owned ones, or -1.
  [[nodiscard]] int findOwned(std::int64_t natural) const;
};

}  // namespace lampblack
