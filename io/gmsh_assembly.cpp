#include "io/gmsh_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/errors.hpp"
#include "core/rank_exchange.hpp"
#include "core/sorted_numbers.hpp"
#include "io/block_exchange.hpp"
#include "io/cell_orientation.hpp"
#include "io/gmsh_cells.hpp"
#include "io/gmsh_nodes.hpp"

namespace lampblack::io {
namespace {

constexpr double planeTolerance = 1e-9;  // of the extent of a plane mesh: rounding of coordinates as text

class GmshAssembly {
 public:
  GmshAssembly(MPI_Comm comm, GmshShare& share, const GmshPlan& plan, double scale)
      : comm_(comm), share_(share), plan_(plan), scale_(scale) {}

  MeshBlock make() {
    block_.dimension = plan_.dimension;
    block_.totalCells = plan_.cells;
    moveCells();
    directory_.emplace(comm_, share_.nodeTags, share_.firstNode);
    numberVertices();
    orient();
    nameFaces();
    dropEmptyPatches();
    pairPeriodic();
    return std::move(block_);
  }

 private:
  void moveCells();
  void numberVertices();
  void flatten(std::span<const std::int64_t> used);
  void orient();
  void nameFaces();
  void dropEmptyPatches();
  void pairPeriodic();
  // The permanent numbers of the vertices of each tag (sorted), -1 where no cell uses it. Collective. `whoAsks` gives
  // the words for a tag that no node has.
  template <typename WhoAsks>
  std::vector<std::int64_t> verticesOf(const std::vector<std::int64_t>& tags, const WhoAsks& whoAsks);
  // Positions of these tags, an error where one is not there.
  template <typename WhoAsks>
  std::vector<std::int64_t> positionsOf(const std::vector<std::int64_t>& tags, const WhoAsks& whoAsks);
  [[nodiscard]] std::string whoseCell(std::int64_t nodeTag) const;

  MPI_Comm comm_;
  GmshShare& share_;
  const GmshPlan& plan_;
  double scale_;
  MeshBlock block_;
  std::vector<std::int64_t> elementTags_;  // of this rank's cells
  std::vector<std::int64_t> usedTags_;     // nodes of this rank's cells
  std::vector<std::array<double, 3>> usedPlaces_;
  std::vector<std::int64_t> usedVertices_;
  std::vector<std::int64_t> vertexOfNode_;  // of this rank's share of nodes; -1: no cell uses it
  std::optional<GmshNodeDirectory> directory_;
};

// Cells were given out in portions; now each goes to the rank that its number says.
void GmshAssembly::moveCells() {
  GmshShare::Elements& elements = share_.elements[static_cast<std::size_t>(plan_.dimension)];
  int corners = 0;
  for (const GmshRun& run : elements.runs) corners = std::max(corners, findGmshType(run.type)->nodes);
  MPI_Allreduce(MPI_IN_PLACE, &corners, 1, MPI_INT, MPI_MAX, comm_);

  // Where no cell has a group, the numbers among those without one are those among all. Of a cell: its shape, the tag
  // of its element, those of its nodes.
  const int width = 2 + corners;
  std::vector<std::int64_t> numbers, values;
  const std::int64_t* at = elements.numbers.data();
  for (const GmshRun& run : elements.runs) {
    const GmshElementType& type = *findGmshType(run.type);
    if (plan_.groupedOnly && run.group == 0) {
      at += run.count * (type.nodes + 1);
      continue;
    }
    for (std::int64_t i = 0; i < run.count; ++i, at += type.nodes + 1) {
      numbers.push_back(run.first + i);
      values.push_back(static_cast<std::int64_t>(type.shape));
      values.insert(values.end(), at, at + type.nodes + 1);
      values.resize(numbers.size() * static_cast<std::size_t>(width), -1);
    }
  }
  elements = {};
  const BlockExchange exchange(comm_, numbers, plan_.cells);
  if (!exchange.coversOnce()) throw std::logic_error("not every cell of the mesh went to one rank");
  const std::vector<std::int64_t> mine = exchange.toBlock(values, width);
  block_.firstCell = exchange.first();
  for (std::size_t i = 0; i < mine.size(); i += static_cast<std::size_t>(width)) {
    const auto shape = static_cast<CellShape>(mine[i]);
    block_.shapes.push_back(shape);
    elementTags_.push_back(mine[i + 1]);
    for (int k = 0; k < cornersOf(shape); ++k) block_.corners.push_back(mine[i + 2 + static_cast<std::size_t>(k)]);
  }
}

template <typename WhoAsks>
std::vector<std::int64_t> GmshAssembly::positionsOf(const std::vector<std::int64_t>& tags, const WhoAsks& whoAsks) {
  std::vector<std::int64_t> positions = directory_->positionsOf(tags);
  collectively(comm_, [&] {
    const auto missing = std::ranges::find(positions, -1);
    if (missing == positions.end()) return;
    const std::int64_t tag = tags[static_cast<std::size_t>(missing - positions.begin())];
    throw InputError(fmt::format(
        "{} the node {}, which is not in the section $Nodes; the file is damaged: save it again", whoAsks(tag), tag));
  });
  return positions;
}

template <typename WhoAsks>
std::vector<std::int64_t> GmshAssembly::verticesOf(const std::vector<std::int64_t>& tags, const WhoAsks& whoAsks) {
  const BlockExchange exchange(comm_, positionsOf(tags, whoAsks), share_.totalNodes);
  return exchange.fromBlock(vertexOfNode_, 1);
}

std::string GmshAssembly::whoseCell(std::int64_t nodeTag) const {
  std::size_t corner = 0;
  for (std::size_t cell = 0; cell < block_.shapes.size(); ++cell) {
    for (int k = 0; k < cornersOf(block_.shapes[cell]); ++k)
      if (block_.corners[corner++] == nodeTag)
        return fmt::format("section $Elements: the element {} names", elementTags_[cell]);
  }
  return "an element names";
}

void GmshAssembly::numberVertices() {
  usedTags_ = sortedOnce(block_.corners);
  const std::vector<std::int64_t> positions = positionsOf(usedTags_, [&](std::int64_t tag) { return whoseCell(tag); });
  const BlockExchange exchange(comm_, positions, share_.totalNodes);
  const std::vector<std::int64_t> used =
      exchange.toBlock(std::span<const std::int64_t>(std::vector<std::int64_t>(positions.size(), 1)), 1);

  std::int64_t mine = std::accumulate(used.begin(), used.end(), std::int64_t{0});
  MPI_Exscan(&mine, &block_.firstVertex, 1, MPI_INT64_T, MPI_SUM, comm_);
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  if (rank == 0) block_.firstVertex = 0;  // MPI_Exscan leaves it undefined
  MPI_Allreduce(&mine, &block_.totalVertices, 1, MPI_INT64_T, MPI_SUM, comm_);

  for (double& x : share_.nodePlaces) x *= scale_;
  if (plan_.dimension == 2) flatten(used);
  std::int64_t next = block_.firstVertex;
  for (std::size_t i = 0; i < used.size(); ++i) {
    vertexOfNode_.push_back(used[i] != 0 ? next++ : -1);
    const double* x = &share_.nodePlaces[3 * i];
    if (used[i] != 0) block_.vertices.push_back({x[0], x[1], x[2]});
  }

  usedVertices_ = exchange.fromBlock(vertexOfNode_, 1);
  const std::vector<double> places = exchange.fromBlock(share_.nodePlaces, 3);
  for (std::size_t i = 0; i < usedTags_.size(); ++i)
    usedPlaces_.push_back({places[3 * i], places[3 * i + 1], places[3 * i + 2]});
  share_.nodePlaces = {};
}

// A plane mesh lies in a plane z = constant, which becomes zero.
void GmshAssembly::flatten(std::span<const std::int64_t> used) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<double, 6> bounds{far, far, far, far, far, far};  // least, and the largest with the other sign
  for (std::size_t i = 0; i < used.size(); ++i) {
    for (std::size_t k = 0; used[i] != 0 && k < 3; ++k) {
      bounds[k] = std::min(bounds[k], share_.nodePlaces[3 * i + k]);
      bounds[3 + k] = std::min(bounds[3 + k], -share_.nodePlaces[3 * i + k]);
    }
    share_.nodePlaces[3 * i + 2] = 0;
  }
  MPI_Allreduce(MPI_IN_PLACE, bounds.data(), 6, MPI_DOUBLE, MPI_MIN, comm_);
  const auto extent = [&](std::size_t k) { return -bounds[3 + k] - bounds[k]; };
  if (!(extent(2) > planeTolerance * std::max(extent(0), extent(1)))) return;
  collectively(comm_, [&] {
    throw InputError(
        fmt::format("the mesh has cells of two dimensions only, and they do not lie in a plane z = constant: z goes "
                    "from {:.6g} m to "
                    "{:.6g} m; turn a plane mesh into the x-y plane, and of a body in space save its volumes, too (in "
                    "Gmsh: Mesh, 3D)",
                    bounds[2], -bounds[5]));
  });
}

// Corners get their permanent numbers and the order that their shape asks for.
void GmshAssembly::orient() {
  std::int64_t folded = 0;
  std::string first;
  std::size_t start = 0;
  for (std::size_t cell = 0; cell < block_.shapes.size(); ++cell) {
    const CellShape shape = block_.shapes[cell];
    const std::span<std::int64_t> corners(&block_.corners[start], static_cast<std::size_t>(cornersOf(shape)));
    start += corners.size();
    std::array<std::array<double, 3>, 8> places{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::size_t index = indexIn(usedTags_, corners[k]);
      corners[k] = usedVertices_[index];
      places[k] = usedPlaces_[index];
    }
    const CellOrientation orientation = orientationOf(shape, std::span(places.data(), corners.size()));
    if (orientation == CellOrientation::Mirrored) mirror(shape, corners);
    if (orientation != CellOrientation::Folded || folded++ > 0) continue;
    first = fmt::format("cell {}, a {} (element {} of the file) with a corner at ({:.6g}, {:.6g}, {:.6g}) m",
                        block_.firstCell + static_cast<std::int64_t>(cell), nameOf(shape), elementTags_[cell],
                        places[0][0], places[0][1], places[0][2]);
  }
  std::int64_t all = 0;
  MPI_Allreduce(&folded, &all, 1, MPI_INT64_T, MPI_SUM, comm_);
  collectively(comm_, [&] {
    if (folded == 0) return;
    throw InputError(
        fmt::format("section $Elements: {} folded or flat, which no order of corners mends; the first is "
                    "{}; mesh again, finer there or with other settings",
                    all == 1 ? "1 cell is" : fmt::format("{} cells are", all), first));
  });
  elementTags_ = {};
  usedTags_ = {};
  usedPlaces_ = {};
  usedVertices_ = {};
}

void GmshAssembly::nameFaces() {
  const GmshShare::Elements& elements = share_.elements[static_cast<std::size_t>(plan_.dimension - 1)];
  // Calls work(tag, nodes, group) for each face with a physical group.
  const auto eachFace = [&](const auto& work) {
    const std::int64_t* at = elements.numbers.data();
    for (const GmshRun& run : elements.runs) {
      const auto nodes = static_cast<std::size_t>(findGmshType(run.type)->nodes);
      for (std::int64_t i = 0; i < run.count; ++i, at += nodes + 1)
        if (run.group != 0) work(at[0], std::span<const std::int64_t>(at + 1, nodes), run.group);
    }
  };
  std::vector<std::int64_t> tags;
  eachFace([&](std::int64_t, std::span<const std::int64_t> nodes, std::int64_t) {
    tags.insert(tags.end(), nodes.begin(), nodes.end());
  });
  tags = sortedOnce(tags);
  const std::vector<std::int64_t> vertices = verticesOf(tags, [&](std::int64_t missing) {
    std::int64_t element = 0;
    eachFace([&](std::int64_t tag, std::span<const std::int64_t> nodes, std::int64_t) {
      if (std::ranges::find(nodes, missing) != nodes.end()) element = tag;
    });
    return fmt::format("section $Elements: the element {} names", element);
  });

  block_.patches = plan_.groupNames;  // of those with the same name, only the first gets faces
  eachFace([&](std::int64_t, std::span<const std::int64_t> nodes, std::int64_t group) {
    MeshBlock::NamedFace face;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      face.vertices[k] = vertices[indexIn(tags, nodes[k])];
      if (face.vertices[k] < 0) return;  // of no cell
    }
    const std::string& name = plan_.groupNames[indexIn(plan_.groups, group)];
    face.patch = static_cast<int>(std::ranges::find(block_.patches, name) - block_.patches.begin());
    block_.named.push_back(face);
  });
  share_.elements = {};
}

void GmshAssembly::dropEmptyPatches() {
  std::vector<std::int64_t> faces(block_.patches.size(), 0);
  for (const MeshBlock::NamedFace& face : block_.named) ++faces[static_cast<std::size_t>(face.patch)];
  MPI_Allreduce(MPI_IN_PLACE, faces.data(), static_cast<int>(faces.size()), MPI_INT64_T, MPI_SUM, comm_);
  std::vector<std::string> kept;
  std::vector<int> number(faces.size(), -1);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] == 0) continue;
    number[i] = static_cast<int>(kept.size());
    kept.push_back(block_.patches[i]);
  }
  block_.patches = std::move(kept);
  for (MeshBlock::NamedFace& face : block_.named) face.patch = number[static_cast<std::size_t>(face.patch)];
}

// Points stand in several links of the file: each pair goes to the rank of its first vertex's block, to stand once.
void GmshAssembly::pairPeriodic() {
  const std::vector<std::int64_t> tags = sortedOnce(share_.periodic);
  const std::vector<std::int64_t> vertices =
      verticesOf(tags, [](std::int64_t) { return std::string("section $Periodic names"); });
  std::vector<int> destinations;
  std::vector<std::int64_t> pairs;
  int ranks = 1;
  MPI_Comm_size(comm_, &ranks);
  for (std::size_t i = 0; i < share_.periodic.size(); i += 2) {
    const std::int64_t a = vertices[indexIn(tags, share_.periodic[i])];
    const std::int64_t b = vertices[indexIn(tags, share_.periodic[i + 1])];
    if (a < 0 || b < 0 || a == b) continue;
    destinations.push_back(blockOf(a, block_.totalVertices, ranks));
    pairs.insert(pairs.end(), {a, b});
  }
  share_.periodic = {};
  const std::vector<std::int64_t> mine = RankExchange(comm_, destinations).send(pairs, 2);
  for (std::size_t i = 0; i < mine.size(); i += 2) block_.periodic.emplace_back(mine[i], mine[i + 1]);
  std::ranges::sort(block_.periodic);
  block_.periodic.erase(std::unique(block_.periodic.begin(), block_.periodic.end()), block_.periodic.end());
}

}  // namespace

MeshBlock assembleGmsh(MPI_Comm comm, GmshShare& share, const GmshPlan& plan, double scale) {
  return GmshAssembly(comm, share, plan, scale).make();
}

}  // namespace lampblack::io
