// The finite-volume mesh as flat arrays, made once from the shares of a MeshBlock: owned cells first, then one layer of
// halo cells; interior faces first, then boundary faces. Everything a flux loop needs is an array here.
//
// Geometry. `Planar`: two- or three-dimensional, a plane of unit depth. `Axisymmetric`: coordinate 0 is the radius r,
// coordinate 1 the axial position z, and all metrics are per radian: volumes are the integral of r dA, face areas are
// length times r. The planar areas are kept beside them for what acts on planes (hoop stress).
//
// Places and vectors have three components, of which only the first `dimension` are not zero.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/box_mesh.hpp"
#include "core/cell_set.hpp"
#include "core/mesh_block.hpp"
#include "core/partition.hpp"
#include "core/vector3.hpp"

namespace lampblack {

class Mesh {
 public:
  // Collective. Every rank owns at least one cell. InputError, on all ranks, when there are fewer cells than ranks, a
  // radius is negative, a cell is folded, or a boundary face belongs to no patch.
  Mesh(MPI_Comm comm, MeshBlock block, Geometry geometry, const Partition& partition = {});
  // The same of a box, which stands in `box` from then on.
  Mesh(MPI_Comm comm, const MeshSpec& spec, const Partition& partition = {});

  MPI_Comm comm;
  int rank = 0;
  int ranks = 1;
  Geometry geometry = Geometry::Planar;
  int dimension = 2;
  std::optional<MeshSpec> box;  // what it was made from, where it is a box
  std::vector<std::string> patches;
  std::int64_t totalCells = 0, totalFaces = 0, totalVertices = 0;

  // Cells: [0, owned) are this rank's, [owned, cells) are halo.
  int owned = 0;
  int cells = 0;
  std::vector<std::int64_t> naturalCell;  // permanent number, the same on any number of ranks
  std::vector<int> haloRank;              // owner of cell owned + i
  std::vector<Vector3> centre;            // m
  std::vector<double> volume;             // m^3 (planar: per metre depth) or m^3/rad
  std::vector<double> planarArea;         // m^2, of a plane cell

  // Faces: [0, interiorFaces) lie between two local cells, of which at least one is owned; the rest are boundary faces
  // of owned cells. The unit normal points from `low` to `high`, or out of the domain; `low` has the smaller number
  // (of a periodic pair the cell whose face is the image), so that two ranks compute a shared face's flux in the same
  // order, to the last bit.
  int interiorFaces = 0;
  int faces = 0;
  std::vector<int> low;
  std::vector<int> high;                 // -1 on boundary faces
  std::vector<std::int64_t> faceNumber;  // permanent, 0 to totalFaces - 1; a face between two ranks is local to both
  std::vector<Vector3> normal;
  std::vector<double> area;                    // metric area
  std::vector<double> planarLength;            // m, of an axisymmetric mesh's; empty otherwise
  [[nodiscard]] double size(int face) const {  // m^2, or m in a plane
    return axisymmetric() ? planarLength[static_cast<std::size_t>(face)] : area[static_cast<std::size_t>(face)];
  }
  std::vector<Vector3> faceCentre;  // m, as `low` has it
  std::vector<Vector3> step;        // m, from the centre of `low` to that of `high`, or to the boundary face's
  std::vector<double> distance;     // m, of the two along the normal
  std::vector<double> lowWeight;    // linear interpolation weight of `low` at the face
  std::vector<int> patch;           // of boundary faces, index face - interiorFaces

  // Where the steps are not along the normals, or do not meet the faces' centres, on any rank: what is missing from
  // fluxes and values that go by the two cells alone. Empty otherwise.
  std::vector<Vector3> oblique;       // normal - step/distance, of length tan(angle), at most mostOblique
  std::vector<Vector3> offset;        // m, from where the step meets the face to its centre
  std::vector<char> betweenOpposite;  // with `offset`: whether both cells have opposite sides, as those of layers do
  // 76 degrees. What is cut is missing from the fluxes on any number of cells: a flame on triangles at 74 degrees, cut
  // at 60, was as wrong on fine cells as on coarse ones.
  static constexpr double mostOblique = 4.0;
  std::int64_t facesBeyond = 0;  // of all ranks, those that are cut to it
  [[nodiscard]] bool isOblique() const { return !oblique.empty(); }
  [[nodiscard]] bool isSkewed() const { return !offset.empty(); }
  // m, length of a face's step.
  [[nodiscard]] double spacing(int face) const {
    const auto f = static_cast<std::size_t>(face);
    return isOblique() ? length(step[f]) : distance[f];
  }

  // Faces of each cell in compressed rows: faceOfCell[faceStart[c] .. faceStart[c+1]). An owned cell has all its faces,
  // in an order that does not depend on the ranks; a halo cell has those it shares with owned cells.
  std::vector<int> faceStart;
  std::vector<int> faceOfCell;
  // Which of its sides a face is to `low` and to `high`, so that two ranks can speak of one face of a cell.
  std::vector<signed char> lowSide, highSide;
  static constexpr int mostSides = 6;

  // Gradients in owned cells none of whose faces is a boundary's (core/least_squares.hpp): where a cell's weights begin
  // in `gradientWeight`, one for each of its faces; -1 for the others, which depend on what is known at the boundary.
  std::vector<int> gradientRow;
  std::vector<Vector3> gradientWeight;

  // The owned cells' corners, for what draws them or looks for places in them.
  std::vector<CellShape> shape;
  std::vector<int> cornerStart;            // of each owned cell in `corner`, and the end
  std::vector<int> corner;                 // in the arrays below
  std::vector<std::int64_t> vertexNumber;  // permanent, increasing
  std::vector<Vector3> vertex;             // m

  [[nodiscard]] bool axisymmetric() const { return geometry == Geometry::Axisymmetric; }
  [[nodiscard]] int boundaryFaces() const { return faces - interiorFaces; }
  [[nodiscard]] const std::string& patchName(int face) const {
    return patches[static_cast<std::size_t>(patch[static_cast<std::size_t>(face - interiorFaces)])];
  }
  // m, as this cell, one of the face's two, has it. A face may be known as its image on the other side of a periodic
  // mesh has it, from where the step leads to `high`.
  [[nodiscard]] Vector3 faceCentreOf(int cell, int face) const {
    const auto f = static_cast<std::size_t>(face);
    if (low[f] == cell) return faceCentre[f];
    const Vector3 fromLow = difference(faceCentre[f], centre[static_cast<std::size_t>(low[f])]);
    return sum(centre[static_cast<std::size_t>(cell)], difference(fromLow, step[f]));
  }
  // m, from where a cell has one of its faces to where the cell beyond has it; zero but for periodic ones.
  [[nodiscard]] Vector3 shiftBeyond(int cell, int face) const;
  // Local index of a cell among the owned ones by its permanent number, or -1.
  [[nodiscard]] int findOwned(std::int64_t natural) const;

 private:
  void build(MeshBlock block, const Partition& partition);
};

}  // namespace lampblack
