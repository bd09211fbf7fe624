#include "core/cell_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace lampblack {
namespace {

// How far a place is beyond the faces of a cell, each over the distance of the cell's centre from it: the largest,
// which is below zero inside, and -1 at the centre.
struct Beyond {
  double share = -std::numeric_limits<double>::infinity();
  bool isBoundary = false;  // of the face it is
};

Beyond beyondFaces(const Mesh& mesh, int cell, const Vector3& place) {
  Beyond most;
  for (int i = mesh.faceStart[cell]; i < mesh.faceStart[cell + 1]; ++i) {
    const int face = mesh.faceOfCell[i];
    const double sign = mesh.low[face] == cell ? 1.0 : -1.0;
    const Vector3 centre = mesh.faceCentreOf(cell, face);
    const Vector3 outwards = scaled(mesh.normal[face], sign);
    const double depth = dot(difference(centre, mesh.centre[cell]), outwards);
    const double share = dot(difference(place, centre), outwards) / depth;
    if (share > most.share) most = {share, mesh.high[face] < 0};
  }
  return most;
}

constexpr double rounding = 1e-9;
constexpr double gap = 0.05;  // between faces that are not plane

struct Surroundings {
  Vector3 lower{}, upper{};
  [[nodiscard]] bool has(const Vector3& place) const {
    for (std::size_t i = 0; i < 3; ++i)
      if (place[i] < lower[i] || place[i] > upper[i]) return false;
    return true;
  }
};

// Of a cell's corners, and a little around them.
Surroundings surroundingsOf(const Mesh& mesh, int cell) {
  Surroundings extent{mesh.centre[cell], mesh.centre[cell]};
  for (int i = mesh.cornerStart[cell]; i < mesh.cornerStart[cell + 1]; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = mesh.vertex[mesh.corner[i]][axis];
      extent.lower[axis] = std::min(extent.lower[axis], x);
      extent.upper[axis] = std::max(extent.upper[axis], x);
    }
  const double around = gap * length(difference(extent.upper, extent.lower));
  for (int axis = 0; axis < mesh.dimension; ++axis) {
    extent.lower[axis] -= around;
    extent.upper[axis] += around;
  }
  return extent;
}

}  // namespace

FoundCells findCells(const Mesh& mesh, std::span<const Vector3> places) {
  constexpr double nowhere = std::numeric_limits<double>::max();
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return places[i][0]; });

  // Of each place the cell it is least beyond; all that have it are as good as each other.
  std::vector<double> share(places.size(), nowhere);
  std::vector<int> best(places.size(), -1);
  for (int cell = 0; cell < mesh.owned; ++cell) {
    const Surroundings extent = surroundingsOf(mesh, cell);
    const auto first =
        std::ranges::lower_bound(order, extent.lower[0], {}, [&](std::size_t i) { return places[i][0]; });
    for (auto i = first; i != order.end() && places[*i][0] <= extent.upper[0]; ++i) {
      if (!extent.has(places[*i])) continue;
      const Beyond beyond = beyondFaces(mesh, cell, places[*i]);
      if (beyond.share > (beyond.isBoundary ? rounding : gap)) continue;
      const double value = std::max(beyond.share, rounding);
      const bool isBetter =
          value < share[*i] || (value == share[*i] && mesh.naturalCell[cell] < mesh.naturalCell[best[*i]]);
      if (!isBetter) continue;
      share[*i] = value;
      best[*i] = cell;
    }
  }
  std::vector<double> least = share;
  const int count = static_cast<int>(places.size());
  MPI_Allreduce(MPI_IN_PLACE, least.data(), count, MPI_DOUBLE, MPI_MIN, mesh.comm);
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  FoundCells found{std::vector<int>(places.size(), -1), std::vector<std::int64_t>(places.size(), none)};
  for (std::size_t i = 0; i < places.size(); ++i)
    if (best[i] >= 0 && share[i] == least[i]) found.naturalCell[i] = mesh.naturalCell[best[i]];
  MPI_Allreduce(MPI_IN_PLACE, found.naturalCell.data(), count, MPI_INT64_T, MPI_MIN, mesh.comm);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (found.naturalCell[i] == none)
      found.naturalCell[i] = -1;
    else if (best[i] >= 0 && mesh.naturalCell[best[i]] == found.naturalCell[i])
      found.cell[i] = best[i];
  }
  return found;
}

std::string meshExtentText(const Mesh& mesh, const Vector3& place) {
  std::array<double, 6> ends;
  ends.fill(-std::numeric_limits<double>::infinity());
  for (const Vector3& vertex : mesh.vertex)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ends[axis] = std::max(ends[axis], -vertex[axis]);
      ends[axis + 3] = std::max(ends[axis + 3], vertex[axis]);
    }
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), 6, MPI_DOUBLE, MPI_MAX, mesh.comm);
  const Surroundings extent{{-ends[0], -ends[1], -ends[2]}, {ends[3], ends[4], ends[5]}};
  std::string text = fmt::format("the mesh reaches from {} to {}", placeText(extent.lower, mesh.dimension),
                                 placeText(extent.upper, mesh.dimension));
  if (!extent.has(place)) return text;
  struct {
    double distance;
    int rank;
  } nearest{std::numeric_limits<double>::infinity(), mesh.rank};
  Vector3 centre{};
  for (int cell = 0; cell < mesh.owned; ++cell)
    if (const double distance = length(difference(mesh.centre[cell], place)); distance < nearest.distance) {
      nearest.distance = distance;
      centre = mesh.centre[cell];
    }
  MPI_Allreduce(MPI_IN_PLACE, &nearest, 1, MPI_DOUBLE_INT, MPI_MINLOC, mesh.comm);
  MPI_Bcast(centre.data(), 3, MPI_DOUBLE, nearest.rank, mesh.comm);
  return text +
         fmt::format(", but has no cell there; the nearest has its centre at {}", placeText(centre, mesh.dimension));
}

}  // namespace lampblack
