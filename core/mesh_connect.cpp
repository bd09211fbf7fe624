#include "core/mesh_connect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

#include "core/errors.hpp"
#include "core/mesh_surface.hpp"
#include "core/rank_exchange.hpp"
#include "core/shares.hpp"
#include "core/sorted_numbers.hpp"
#include "core/vertex_owner.hpp"

namespace lampblack {
namespace {

// A face as one that knows of it tells it to the rank where all that know of it meet.
struct Meeting {
  std::array<std::int64_t, 4> key{-1, -1, -1, -1};  // its vertices (originals of images), sorted
  std::int64_t cell = -1;                           // -1: its name
  std::int16_t side = 0, patch = -1;
  std::int8_t isImage = 0;  // all its vertices are images
  std::array<char, 3> filler{};
};

// What a side learns.
struct Found {
  std::int64_t cell, neighbour;
  std::int16_t side, neighbourSide, patch;
  std::int8_t isLow, isTriple;
};

std::array<std::int64_t, 4> sorted(std::array<std::int64_t, 4> key) {
  std::ranges::sort(key);
  return key;
}

std::int64_t smallestVertex(const std::array<std::int64_t, 4>& key) {
  return *std::ranges::find_if(key, [](std::int64_t vertex) { return vertex >= 0; });
}

// Tells the sides that meet in one face, all that have one key, about each other. `isThinWall`: MeshBlock's.
void introduce(std::span<const Meeting> all, const Shares& cells, std::span<const char> isThinWall,
               std::vector<std::vector<Found>>& toRank) {
  std::vector<const Meeting*> sides;
  std::int16_t patch = -1, wall = -1;
  for (const Meeting& one : all) {
    if (one.cell >= 0)
      sides.push_back(&one);
    else if (patch < 0)
      patch = one.patch;
    if (one.cell < 0 && wall < 0 && !isThinWall.empty() && isThinWall[static_cast<std::size_t>(one.patch)] != 0)
      wall = one.patch;
  }
  // The two sides of a periodic pair lie apart, with nothing between them.
  if (wall >= 0 && sides.size() == 2 && sides[0]->isImage == sides[1]->isImage) {
    for (const Meeting* own : sides)
      toRank[static_cast<std::size_t>(cells.rankOf(own->cell))].push_back({own->cell, -1, own->side, -1, wall, 1, 0});
    return;
  }
  for (const Meeting* own : sides) {
    Found found{own->cell, -1, own->side, -1, patch, 1, static_cast<std::int8_t>(sides.size() > 2 ? 1 : 0)};
    if (sides.size() == 2) {
      const Meeting& other = *(own == sides[0] ? sides[1] : sides[0]);
      const bool isLow = own->isImage != other.isImage ? own->isImage != 0 : own->cell < other.cell;
      found = {own->cell, other.cell, own->side, other.side, -1, static_cast<std::int8_t>(isLow ? 1 : 0), 0};
    }
    toRank[static_cast<std::size_t>(cells.rankOf(own->cell))].push_back(found);
  }
}

class Connector {
 public:
  Connector(MPI_Comm comm, const MeshBlock& block)
      : comm_(comm), block_(block), cellShares_(comm, block.firstCell, block.totalCells), owner_(comm, block) {
    MPI_Comm_size(comm, &ranks_);
  }

  ConnectedCells run() {
    placeCorners();
    meet();
    refuseTriples();
    requireBoundaries(comm_, result_.cells, block_.dimension);
    result_.totalFaces = numberFaces();
    result_.totalVertices = owner_.total();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::size_t cellCount() const { return block_.shapes.size(); }

  // Corners of the cells with their places; what they are images of is kept beside.
  void placeCorners() {
    CellSet& cells = result_.cells;
    std::vector<std::int64_t> namedVertices;
    for (const MeshBlock::NamedFace& face : block_.named)
      std::ranges::copy_if(face.vertices, std::back_inserter(namedVertices),
                           [](std::int64_t vertex) { return vertex >= 0; });
    std::vector<std::int64_t> wanted = sortedOnce(block_.corners);
    if (const auto others = sortedOnce(namedVertices); !std::ranges::includes(wanted, others)) {
      wanted.insert(wanted.end(), others.begin(), others.end());
      wanted = sortedOnce(wanted);
    }
    const std::vector<VertexOwner::Vertex> known = owner_.vertices(wanted);

    CellSet::Amount all;
    for (const CellShape shape : block_.shapes) all.add(shape);
    cells.resize(all);
    if (owner_.hasImages()) original_.resize(cells.vertices.size());
    CornerFinder finder(wanted);
    CellSet::Amount next;
    for (std::size_t c = 0; c < cellCount(); ++c) {
      cells.numbers[c] = block_.firstCell + static_cast<std::int64_t>(c);
      cells.shapes[c] = block_.shapes[c];
      const auto first = static_cast<std::size_t>(next.corners);
      next.add(cells.shapes[c]);
      cells.cornerStart[c + 1] = next.corners;
      cells.sideStart[c + 1] = next.sides;
      for (std::size_t corner = first; corner < static_cast<std::size_t>(next.corners); ++corner) {
        const VertexOwner::Vertex& vertex = known[finder.indexOf(corner - first, block_.corners[corner])];
        cells.vertices[corner] = vertex.number;
        cells.places[corner] = vertex.place;
        if (owner_.hasImages()) original_[corner] = vertex.original;
      }
    }
    for (const MeshBlock::NamedFace& face : block_.named) {
      Meeting meeting;
      meeting.patch = static_cast<std::int16_t>(face.patch);
      for (std::size_t i = 0; i < 4; ++i)
        if (face.vertices[i] >= 0) meeting.key[i] = known[indexIn(wanted, face.vertices[i])].original;
      meeting.key = sorted(meeting.key);
      named_.push_back(meeting);
    }
  }

  // What a side tells where its face's other knowers are.
  [[nodiscard]] Meeting meetingOf(std::size_t cell, std::size_t side) const {
    const CellSet& cells = result_.cells;
    const auto first = static_cast<std::size_t>(cells.cornerStart[cell]);
    const CellSide& shape = sidesOf(cells.shapes[cell])[side];
    Meeting meeting;
    meeting.cell = cells.numbers[cell];
    meeting.side = static_cast<std::int16_t>(side);
    meeting.isImage = 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(shape.corners); ++i) {
      const std::size_t corner = first + static_cast<std::size_t>(shape.corner[i]);
      meeting.key[i] = owner_.hasImages() ? original_[corner] : block_.corners[corner];
      if (meeting.key[i] == block_.corners[corner]) meeting.isImage = 0;
    }
    meeting.key = sorted(meeting.key);
    return meeting;
  }

  // Faces meet in portions: those whose smallest vertex lies in the same part of its owner's share.
  [[nodiscard]] std::size_t portionOf(std::int64_t vertex, std::size_t portions) const {
    const Shares& shares = owner_.shares();
    const int rank = shares.rankOf(vertex);
    return static_cast<std::size_t>(vertex - shares.first(rank)) * portions /
           static_cast<std::size_t>(shares.count(rank));
  }

  void meet() {
    const CellSet& cells = result_.cells;
    struct OwnSide {
      std::int32_t cell, side;
    };
    // Sides by portion.
    const std::size_t portions = portionsOf(comm_, cells.sides.size());
    std::vector<std::size_t> start(portions + 2, 0);
    const auto eachSide = [&](auto&& visit) {
      for (std::size_t c = 0; c < cellCount(); ++c)
        for (std::size_t s = 0; s < cells.sidesOf(c).size(); ++s)
          visit(c, s, portions == 1 ? 0 : portionOf(smallestVertex(meetingOf(c, s).key), portions));
    };
    eachSide([&](std::size_t, std::size_t, std::size_t portion) { ++start[portion + 2]; });
    for (std::size_t p = 2; p < start.size(); ++p) start[p] += start[p - 1];
    std::vector<OwnSide> order(start.back());
    eachSide([&](std::size_t c, std::size_t s, std::size_t portion) {
      order[start[portion + 1]++] = {static_cast<std::int32_t>(c), static_cast<std::int32_t>(s)};
    });
    const auto portionOfNamed = [&](const Meeting& name) { return portionOf(smallestVertex(name.key), portions); };
    std::ranges::sort(named_, {}, portionOfNamed);

    for (std::size_t portion = 0; portion < portions; ++portion) {
      std::vector<std::vector<Meeting>> toRank(static_cast<std::size_t>(ranks_));
      const auto send = [&](const Meeting& meeting) {
        toRank[static_cast<std::size_t>(owner_.shares().rankOf(smallestVertex(meeting.key)))].push_back(meeting);
      };
      for (std::size_t i = start[portion]; i < start[portion + 1]; ++i)
        send(meetingOf(static_cast<std::size_t>(order[i].cell), static_cast<std::size_t>(order[i].side)));
      std::ranges::for_each(std::ranges::equal_range(named_, portion, {}, portionOfNamed), send);
      introduceAll(sendToRanks(comm_, toRank));
    }
    original_ = {};
    named_ = {};
  }

  // Collective. Sides that have met here learn of each other.
  void introduceAll(Received<Meeting> met) {
    std::ranges::sort(met.values, [](const Meeting& a, const Meeting& b) {
      return a.key != b.key     ? a.key < b.key
             : a.cell != b.cell ? a.cell < b.cell
             : a.side != b.side ? a.side < b.side
                                : a.patch < b.patch;
    });
    std::vector<std::vector<Found>> back(static_cast<std::size_t>(ranks_));
    for (std::size_t i = 0; i < met.values.size();) {
      std::size_t end = i;
      while (end < met.values.size() && met.values[end].key == met.values[i].key) ++end;
      introduce({&met.values[i], end - i}, cellShares_, block_.isThinWall, back);
      i = end;
    }
    met = {};
    for (const Found& one : sendToRanks(comm_, back).values) {
      CellSet::Side& side = sideAt(one.cell, one.side);
      side.neighbour = one.neighbour;
      side.neighbourSide = static_cast<std::int8_t>(one.neighbourSide);
      side.patch = one.patch;
      side.isLow = one.isLow;
      if (one.isTriple != 0) triples_.push_back(one.cell - block_.firstCell);
    }
  }

  [[nodiscard]] bool isOwn(std::int64_t cell) const {
    return cell >= block_.firstCell && cell < block_.firstCell + static_cast<std::int64_t>(cellCount());
  }

  CellSet::Side& sideAt(std::int64_t cell, std::int64_t side) {
    CellSet& cells = result_.cells;
    const auto c = static_cast<std::size_t>(cell - block_.firstCell);
    return cells.sides[static_cast<std::size_t>(cells.sideStart[c] + side)];
  }

  void refuseTriples() const {
    collectively(comm_, [&] {
      if (!triples_.empty())
        throw InputError(fmt::format("three cells of the mesh share one face, one of them cell {} (counted from zero)",
                                     block_.firstCell + *std::ranges::min_element(triples_)));
    });
  }

  // Each face by the cell it points out of; the other cell is told. Returns how many there are.
  std::int64_t numberFaces() {
    CellSet& cells = result_.cells;
    const std::int64_t own =
        std::ranges::count_if(cells.sides, [](const CellSet::Side& side) { return side.isLow != 0; });
    std::int64_t next = 0, total = 0;
    MPI_Exscan(&own, &next, 1, MPI_INT64_T, MPI_SUM, comm_);
    MPI_Allreduce(&own, &total, 1, MPI_INT64_T, MPI_SUM, comm_);
    struct Told {
      std::int64_t cell, side, face;
    };
    std::vector<std::vector<Told>> toRank(static_cast<std::size_t>(ranks_));
    for (CellSet::Side& side : cells.sides) {
      if (side.isLow == 0) continue;
      side.face = next++;
      if (isOwn(side.neighbour))
        sideAt(side.neighbour, side.neighbourSide).face = side.face;
      else if (side.neighbour >= 0)
        toRank[static_cast<std::size_t>(cellShares_.rankOf(side.neighbour))].push_back(
            {side.neighbour, side.neighbourSide, side.face});
    }
    for (const Told& told : sendToRanks(comm_, toRank).values) sideAt(told.cell, told.side).face = told.face;
    return total;
  }

  MPI_Comm comm_;
  const MeshBlock& block_;
  Shares cellShares_;
  VertexOwner owner_;
  int ranks_ = 1;
  std::vector<std::int64_t> original_;  // of each corner
  std::vector<Meeting> named_;
  std::vector<std::int64_t> triples_;
  ConnectedCells result_;
};

}  // namespace

ConnectedCells connect(MPI_Comm comm, const MeshBlock& block) {
  return Connector(comm, block).run();
}

}  // namespace lampblack
