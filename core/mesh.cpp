#include "core/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include "core/cell_geometry.hpp"
#include "core/errors.hpp"
#include "core/least_squares.hpp"
#include "core/mesh_connect.hpp"
#include "core/mesh_distribution.hpp"
#include "core/paired_slopes.hpp"
#include "core/sorted_numbers.hpp"

namespace lampblack {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

class MeshBuilder {
 public:
  MeshBuilder(Mesh& mesh, DistributedCells cells) : mesh_(mesh), cells_(std::move(cells)) {}

  void run() {
    orderCells();
    collectively(mesh_.comm, [&] { measureCells(); });
    // What is not needed any more goes before there is more: this is where a mesh takes most memory.
    orderFaces();
    cells_.owned.sides = {};
    keepCorners();
    cells_.owned.vertices = {};
    measureFaces();
    cells_ = {};
    keepDeviations();
    linkCellsToFaces();
    weighGradients();
  }

 private:
  // A local cell in the set it came in.
  struct Place {
    const CellSet& set;
    std::size_t index;
    [[nodiscard]] CellShape shape() const { return set.shapes[index]; }
    [[nodiscard]] std::span<const Vector3> corners() const { return set.placesOf(index); }
  };
  [[nodiscard]] Place of(int cell) const {
    return cell < mesh_.owned ? Place{cells_.owned, at(cell)} : Place{cells_.halo, at(cell - mesh_.owned)};
  }

  void orderCells() {
    Mesh& m = mesh_;
    m.owned = static_cast<int>(cells_.owned.size());
    m.cells = m.owned + static_cast<int>(cells_.halo.size());
    m.naturalCell.reserve(at(m.cells));
    m.naturalCell.assign(cells_.owned.numbers.begin(), cells_.owned.numbers.end());
    m.naturalCell.insert(m.naturalCell.end(), cells_.halo.numbers.begin(), cells_.halo.numbers.end());
    m.haloRank = cells_.haloOwner;
  }

  void measureCells() {
    Mesh& m = mesh_;
    m.centre.reserve(at(m.cells));
    m.volume.reserve(at(m.cells));
    if (m.dimension == 2) m.planarArea.reserve(at(m.cells));
    for (int c = 0; c < m.cells; ++c) {
      const Place cell = of(c);
      const CellMeasures measures = measureCell(cell.shape(), cell.corners());
      if (!(measures.size > 0.0) || !(measures.shape > 0.0))
        throw InputError(
            fmt::format("cell {} of the mesh (counted from zero), a {} at {}, is folded: a corner lies inside out, or "
                        "two corners are "
                        "one; repair the mesh there",
                        m.naturalCell[at(c)], nameOf(cell.shape()), placeText(measures.centre, m.dimension)));
      m.centre.push_back(measures.centre);
      m.volume.push_back(measures.size);
      if (m.dimension == 2) m.planarArea.push_back(measures.size);
      if (!m.axisymmetric()) continue;
      for (const Vector3& corner : cell.corners())
        if (corner[0] < 0.0)
          throw InputError(fmt::format("an axisymmetric mesh needs radii of zero or more, and has a vertex at {}",
                                       placeText(corner, 2)));
      m.volume.back() = m.planarArea.back() * m.centre.back()[0];
    }
  }

  // A face by its cells, before it has metrics.
  struct Link {
    int low, high;  // high is -1 on the boundary
    signed char lowSide, highSide;
    int patch;
    std::int64_t number;
  };

  // The faces of owned cells by number, interior ones first, so that a cell meets its faces in the same order on any
  // number of ranks.
  void orderFaces() {
    Mesh& m = mesh_;
    // Faces that point out of owned cells are numbered as these are: only those from halo cells stand elsewhere.
    std::vector<Link> inside, fromHalo, surface;
    inside.reserve(cells_.owned.sides.size() / 2 + 1);
    for (int c = 0; c < m.owned; ++c) {
      const auto sides = cells_.owned.sidesOf(at(c));
      for (std::size_t s = 0; s < sides.size(); ++s) {
        const CellSet::Side& side = sides[s];
        const auto own = static_cast<signed char>(s);
        if (side.neighbour < 0)
          surface.push_back({c, -1, own, -1, side.patch, side.face});
        else if (side.isLow != 0)
          inside.push_back({c, localOf(c, side), own, side.neighbourSide, -1, side.face});
        else if (side.owner != m.rank)
          fromHalo.push_back({localOf(c, side), c, side.neighbourSide, own, -1, side.face});
      }
    }
    std::ranges::sort(fromHalo, {}, &Link::number);
    const std::size_t ofOwned = inside.size();
    inside.insert(inside.end(), fromHalo.begin(), fromHalo.end());
    std::ranges::inplace_merge(inside, inside.begin() + static_cast<std::ptrdiff_t>(ofOwned), {}, &Link::number);
    m.interiorFaces = static_cast<int>(inside.size());
    m.faces = m.interiorFaces + static_cast<int>(surface.size());
    for (auto* ints : {&m.low, &m.high}) ints->reserve(at(m.faces));
    for (auto* sides : {&m.lowSide, &m.highSide}) sides->reserve(at(m.faces));
    m.faceNumber.reserve(at(m.faces));
    for (const auto* links : {&inside, &surface})
      for (const Link& link : *links) {
        m.low.push_back(link.low);
        m.high.push_back(link.high);
        m.lowSide.push_back(link.lowSide);
        m.highSide.push_back(link.highSide);
        m.faceNumber.push_back(link.number);
        if (link.high < 0) m.patch.push_back(link.patch);
      }
  }

  // Local index of what lies beyond a side of an owned cell.
  [[nodiscard]] int localOf(int cell, const CellSet::Side& side) const {
    const Mesh& m = mesh_;
    if (side.owner == m.rank) {
      // Where no number between the two is missing here, there is nothing to look for.
      const std::int64_t guess = cell + side.neighbour - m.naturalCell[at(cell)];
      if (guess >= 0 && guess < m.owned && m.naturalCell[static_cast<std::size_t>(guess)] == side.neighbour)
        return static_cast<int>(guess);
      return m.findOwned(side.neighbour);
    }
    const auto [first, last] = std::ranges::equal_range(m.haloRank, side.owner);
    const auto begin = m.naturalCell.begin() + m.owned;
    const auto found =
        std::lower_bound(begin + (first - m.haloRank.begin()), begin + (last - m.haloRank.begin()), side.neighbour);
    return static_cast<int>(found - m.naturalCell.begin());
  }

  [[nodiscard]] SideMeasures measure(int cell, int side) const {
    const Place place = of(cell);
    return measureSide(place.shape(), sidesOf(place.shape())[at(side)], place.corners());
  }

  void measureFaces() {
    Mesh& m = mesh_;
    for (auto* vectors : {&m.faceCentre, &m.normal, &m.step}) vectors->reserve(at(m.faces));
    for (auto* numbers : {&m.area, &m.distance, &m.lowWeight}) numbers->reserve(at(m.faces));
    if (m.axisymmetric()) m.planarLength.reserve(at(m.faces));
    m.betweenOpposite.assign(at(m.faces), 0);
    for (int face = 0; face < m.faces; ++face) {
      const SideMeasures side = measure(m.low[at(face)], m.lowSide[at(face)]);
      m.faceCentre.push_back(side.centre);
      m.normal.push_back(side.normal);
      if (m.axisymmetric()) m.planarLength.push_back(side.size);
      m.area.push_back(m.axisymmetric() ? side.size * side.centre[0] : side.size);
      const Vector3 fromLow = difference(side.centre, m.centre[at(m.low[at(face)])]);
      const double toLow = dot(fromLow, side.normal);
      double toHigh = 0.0;
      Vector3 step = fromLow;
      if (const int high = m.high[at(face)]; high >= 0) {
        // Of a periodic pair the other side is elsewhere.
        const Vector3 there = measure(high, m.highSide[at(face)]).centre;
        const Vector3 toCentre = difference(m.centre[at(high)], there);
        toHigh = dot(toCentre, side.normal);
        step = sum(step, toCentre);
        if (hasOppositeSides(of(m.low[at(face)]).shape()) && hasOppositeSides(of(high).shape()))
          m.betweenOpposite[at(face)] = 1;
      }
      m.step.push_back(step);
      m.distance.push_back(toLow + toHigh);
      m.lowWeight.push_back(toHigh / (toLow + toHigh));
    }
  }

  // What the steps deviate by from the normals and from the faces' centres; nothing where that is round-off.
  void keepDeviations() {
    Mesh& m = mesh_;
    std::array<double, 2> largest{0.0, 0.0};
    double beyond = 0.0;
    for (std::size_t face = 0; face < at(m.faces); ++face) {
      const auto [oblique, offset] = deviationsAt(face);
      largest[0] = std::max(largest[0], length(oblique));
      largest[1] = std::max(largest[1], length(offset));
      // A face between two ranks is of both.
      const bool isShared = m.high[face] >= 0 && (m.low[face] >= m.owned || m.high[face] >= m.owned);
      if (m.distance[face] * std::hypot(1.0, Mesh::mostOblique) < length(m.step[face])) beyond += isShared ? 0.5 : 1.0;
    }
    MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, m.comm);
    MPI_Allreduce(MPI_IN_PLACE, &beyond, 1, MPI_DOUBLE, MPI_SUM, m.comm);
    m.facesBeyond = std::llround(beyond);
    // Most meshes have neither, so that they are found twice rather than kept in vain.
    if (largest[0] > 0.0) m.oblique.reserve(at(m.faces));
    if (largest[1] > 0.0)
      m.offset.reserve(at(m.faces));
    else
      m.betweenOpposite = {};
    for (std::size_t face = 0; face < at(m.faces); ++face) {
      if (largest[0] == 0.0 && largest[1] == 0.0) break;
      const auto [oblique, offset] = deviationsAt(face);
      if (largest[0] > 0.0) m.oblique.push_back(oblique);
      if (largest[1] > 0.0) m.offset.push_back(offset);
    }
  }

  // `oblique` and `offset` of a face; a step that is along the normal but for round-off becomes so.
  std::pair<Vector3, Vector3> deviationsAt(std::size_t face) {
    constexpr double roundOff = 1e-11;
    Mesh& m = mesh_;
    const Vector3 across = scaled(m.step[face], 1.0 / m.distance[face]);
    Vector3 oblique = difference(m.normal[face], across);
    if (length(oblique) < roundOff) {
      oblique = {};
      m.step[face] = scaled(m.normal[face], m.distance[face]);
    }
    if (const double size = length(oblique); size > Mesh::mostOblique)
      oblique = scaled(oblique, Mesh::mostOblique / size);
    Vector3 offset{};
    if (m.high[face] >= 0) {
      const Vector3 meets = sum(m.centre[at(m.low[face])], scaled(m.step[face], 1.0 - m.lowWeight[face]));
      offset = difference(m.faceCentre[face], meets);
      if (length(offset) < roundOff * m.distance[face]) offset = {};
    }
    return {oblique, offset};
  }

  // The rows of faceOfCell, each in face order.
  void linkCellsToFaces() {
    Mesh& m = mesh_;
    const auto eachSide = [&](auto&& visit) {
      for (int face = 0; face < m.faces; ++face) {
        visit(face, m.low[at(face)]);
        if (m.high[at(face)] >= 0) visit(face, m.high[at(face)]);
      }
    };
    std::vector<int> next(at(m.cells) + 1, 0);
    eachSide([&](int, int cell) { ++next[at(cell) + 1]; });
    std::partial_sum(next.begin(), next.end(), next.begin());
    m.faceStart = next;
    m.faceOfCell.resize(at(next.back()));
    eachSide([&](int face, int cell) { m.faceOfCell[at(next[at(cell)]++)] = face; });
  }

  void weighGradients() {
    Mesh& m = mesh_;
    const auto stepFrom = [&](int cell, int face) {
      return scaled(m.step[at(face)], m.low[at(face)] == cell ? 1.0 : -1.0);
    };
    const auto facesOf = [&](int c) {
      return std::span<const int>{&m.faceOfCell[at(m.faceStart[at(c)])],
                                  at(m.faceStart[at(c) + 1] - m.faceStart[at(c)])};
    };
    const auto isInside = [&](int c) {
      return std::ranges::all_of(facesOf(c), [&](int face) { return m.high[at(face)] >= 0; });
    };
    std::size_t weights = 0;
    for (int c = 0; c < m.owned; ++c) weights += isInside(c) ? facesOf(c).size() : 0;
    m.gradientWeight.reserve(weights);
    m.gradientRow.reserve(at(m.owned));
    for (int c = 0; c < m.owned; ++c) {
      m.gradientRow.push_back(isInside(c) ? static_cast<int>(m.gradientWeight.size()) : -1);
      if (!isInside(c)) continue;
      const std::span<const int> faces = facesOf(c);
      if (std::array<Vector3, Mesh::mostSides> paired; pairedSlopes(m, c, paired)) {
        m.gradientWeight.insert(m.gradientWeight.end(), paired.begin(), paired.begin() + std::ssize(faces));
        continue;
      }
      LeastSquares squares;
      for (const int face : faces) squares.add(stepFrom(c, face));
      squares.finish(m.dimension);
      for (const int face : faces) m.gradientWeight.push_back(squares.weight(stepFrom(c, face)));
    }
  }

  void keepCorners() {
    Mesh& m = mesh_;
    const CellSet& owned = cells_.owned;
    m.shape = owned.shapes;
    m.cornerStart.assign(owned.cornerStart.begin(), owned.cornerStart.end());
    m.vertexNumber = sortedOnce(owned.vertices);
    m.vertex.resize(m.vertexNumber.size());
    m.corner.reserve(owned.vertices.size());
    CornerFinder finder(m.vertexNumber);
    for (std::size_t c = 0; c < owned.size(); ++c)
      for (std::size_t i = 0; i < owned.verticesOf(c).size(); ++i) {
        const std::size_t vertex = finder.indexOf(i, owned.verticesOf(c)[i]);
        m.corner.push_back(static_cast<int>(vertex));
        m.vertex[vertex] = owned.placesOf(c)[i];
      }
  }

  Mesh& mesh_;
  DistributedCells cells_;
};

}  // namespace

Mesh::Mesh(MPI_Comm communicator, MeshBlock block, Geometry meshGeometry, const Partition& partition)
    : comm(communicator), geometry(meshGeometry) {
  build(std::move(block), partition);
}

Mesh::Mesh(MPI_Comm communicator, const MeshSpec& spec, const Partition& partition)
    : comm(communicator), geometry(spec.geometry), box(spec) {
  build(boxBlock(comm, spec), partition);
}

void Mesh::build(MeshBlock block, const Partition& partition) {
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  dimension = block.dimension;
  patches = block.patches;
  totalCells = block.totalCells;
  collectively(comm, [&] {
    if (!partition.weight.empty() && partition.weight.size() != block.shapes.size())
      throw std::invalid_argument(
          fmt::format("Mesh: {} cell weights for {} cells", partition.weight.size(), block.shapes.size()));
    if (axisymmetric() && dimension != 2) throw InputError("an axisymmetric mesh lies in a plane");
  });
  ConnectedCells connected = connect(comm, block);
  block = {};
  totalFaces = connected.totalFaces;
  totalVertices = connected.totalVertices;
  std::vector<int> owner = ownersOf(comm, connected.cells, dimension, partition);
  DistributedCells distributed = distribute(comm, std::move(connected.cells), totalCells, owner);
  owner = {};
  MeshBuilder(*this, std::move(distributed)).run();
}

Vector3 Mesh::shiftBeyond(int cell, int face) const {
  const std::size_t f = at(face);
  if (high[f] < 0) return {};
  // A periodic mesh has three cells or more along its axis; else the difference is round-off.
  const Vector3 shift = difference(centre[at(high[f])], sum(centre[at(low[f])], step[f]));
  if (length(shift) < 0.5 * length(step[f])) return {};
  return scaled(shift, low[f] == cell ? 1.0 : -1.0);
}

int Mesh::findOwned(std::int64_t natural) const {
  // Owned cells are ordered by number.
  const auto end = naturalCell.begin() + owned;
  const auto it = std::lower_bound(naturalCell.begin(), end, natural);
  return it == end || *it != natural ? -1 : static_cast<int>(it - naturalCell.begin());
}

}  // namespace lampblack
