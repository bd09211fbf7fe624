#include "core/mesh_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/errors.hpp"
#include "core/ranks.hpp"
#include "core/shares.hpp"
#include "core/vector3.hpp"

namespace lampblack {
namespace {

constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t sidesOfACell = 8;  // at most

// A side without neighbour and patch.
struct BareSide {
  std::array<std::int64_t, 3> spot{};  // its place in units in which places that differ by rounding are one
  std::int64_t number = none;          // sidesOfACell times that of its cell, and which of its sides
};

Vector3 placeOf(const CellSet& cells, std::size_t cell, const CellSide& side) {
  Vector3 mean{};
  for (int i = 0; i < side.corners; ++i) {
    const auto corner = static_cast<std::size_t>(side.corner[static_cast<std::size_t>(i)]);
    mean = sum(mean, scaled(cells.placesOf(cell)[corner], 1.0 / side.corners));
  }
  return mean;
}

// Collective. m, in which places are compared: 1e-9 of the largest coordinate.
double unitOfPlaces(MPI_Comm comm, const CellSet& cells) {
  double most = 0.0;
  for (const Vector3& place : cells.places)
    for (const double x : place) most = std::max(most, std::abs(x));
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, comm);
  return most > 0.0 ? 1e-9 * most : 1.0;
}

std::vector<BareSide> bareSides(const CellSet& cells, double unit) {
  std::vector<BareSide> bare;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto shape = sidesOf(cells.shapes[c]);
    for (std::size_t s = 0; s < shape.size(); ++s) {
      if (cells.sidesOf(c)[s].neighbour >= 0 || cells.sidesOf(c)[s].patch >= 0) continue;
      const Vector3 place = placeOf(cells, c, shape[s]);
      BareSide& side = bare.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) side.spot[axis] = std::llround(place[axis] / unit);
      side.number = cells.numbers[c] * sidesOfACell + static_cast<std::int64_t>(s);
    }
  }
  return bare;
}

// Collective. The least number of a side that has another at its place; none: there is no such side. Sides of one place
// meet on one rank.
std::int64_t firstDouble(MPI_Comm comm, const std::vector<BareSide>& bare) {
  std::vector<std::vector<BareSide>> toRank(static_cast<std::size_t>(ranksOf(comm)));
  for (const BareSide& side : bare) {
    std::uint64_t mixed = 0;
    for (const std::int64_t x : side.spot) mixed = (mixed ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
    toRank[(mixed >> 32U) % toRank.size()].push_back(side);
  }
  std::vector<BareSide> met = sendToRanks(comm, toRank).values;
  std::ranges::sort(met, [](const BareSide& a, const BareSide& b) {
    return a.spot != b.spot ? a.spot < b.spot : a.number < b.number;
  });
  std::int64_t first = none;
  for (std::size_t i = 1; i < met.size(); ++i)
    if (met[i].spot == met[i - 1].spot) first = std::min(first, met[i - 1].number);
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT64_T, MPI_MIN, comm);
  return first;
}

}  // namespace

void requireBoundaries(MPI_Comm comm, const CellSet& cells, int dimension) {
  const std::vector<BareSide> bare = bareSides(cells, unitOfPlaces(comm, cells));
  std::int64_t first = none;
  for (const BareSide& side : bare) first = std::min(first, side.number);
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT64_T, MPI_MIN, comm);
  if (first == none) return;
  const std::int64_t twice = firstDouble(comm, bare), told = twice != none ? twice : first;
  collectively(comm, [&] {
    const auto cell = std::ranges::find(cells.numbers, told / sidesOfACell);
    if (cell == cells.numbers.end()) return;
    const auto c = static_cast<std::size_t>(cell - cells.numbers.begin());
    const std::string place = placeText(
        placeOf(cells, c, sidesOf(cells.shapes[c])[static_cast<std::size_t>(told % sidesOfACell)]), dimension);
    if (twice == none) throw InputError(fmt::format("the boundary face at {} belongs to no boundary", place));
    throw InputError(
        fmt::format("the cells on both sides of the face at {} have corners of their own there, so that it belongs "
                    "to no boundary; make the corners at one place one (in Gmsh: Coherence)",
                    place));
  });
}

}  // namespace lampblack
