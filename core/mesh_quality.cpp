#include "core/mesh_quality.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "core/cell_geometry.hpp"

namespace lampblack {
namespace {

constexpr double degreesPerRadian = 180.0 / std::numbers::pi;

std::size_t indexAt(int index) {
  return static_cast<std::size_t>(index);
}

// Of this rank: `value` may be measured with the other sign, for the smallest.
void considerWorst(MeshQuality::Worst& worst, double value, std::int64_t number, const Vector3& place) {
  if (worst.number >= 0 && (value < worst.value || (value == worst.value && number > worst.number))) return;
  worst = {value, number, place};
}

// Longest edge times largest side over the size, of the regular cell: edges of one length.
double regularAspect(CellShape shape) {
  switch (shape) {
    case CellShape::Triangle:
      return 4.0 / std::numbers::sqrt3;
    case CellShape::Tetrahedron:
      return 3.0 * std::numbers::sqrt3 / std::numbers::sqrt2;
    case CellShape::Pyramid:
      return 6.0 / std::numbers::sqrt2;
    case CellShape::Prism:
      return 4.0 / std::numbers::sqrt3;
    default:
      return 1.0;
  }
}

double aspectRatioOf(CellShape shape, std::span<const Vector3> corners, double size) {
  double edge = 0.0, largest = 0.0;
  for (const CellSide& side : sidesOf(shape)) {
    largest = std::max(largest, measureSide(shape, side, corners).size);
    for (int i = 0; i < side.corners; ++i) {
      const Vector3& from = corners[indexAt(side.corner[indexAt(i)])];
      const Vector3& to = corners[indexAt(side.corner[indexAt((i + 1) % side.corners)])];
      edge = std::max(edge, length(difference(to, from)));
    }
  }
  return edge * largest / size / regularAspect(shape);
}

double sizeOf(const Mesh& m, int cell) {
  return m.dimension == 2 ? m.planarArea[indexAt(cell)] : m.volume[indexAt(cell)];
}

// Three reductions. What several ranks have (a face between two) is the same on all of them.
void agreeOnWorst(MPI_Comm comm, std::span<MeshQuality::Worst* const> all) {
  const std::size_t n = all.size();
  constexpr double nothing = std::numeric_limits<double>::lowest();
  std::vector<double> values(n), places(3 * n, nothing);
  std::vector<std::int64_t> numbers(n, std::numeric_limits<std::int64_t>::max());
  for (std::size_t i = 0; i < n; ++i) values[i] = all[i]->number < 0 ? nothing : all[i]->value;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(n), MPI_DOUBLE, MPI_MAX, comm);
  for (std::size_t i = 0; i < n; ++i)
    if (all[i]->number >= 0 && all[i]->value == values[i]) numbers[i] = all[i]->number;
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(n), MPI_INT64_T, MPI_MIN, comm);
  for (std::size_t i = 0; i < n; ++i)
    if (all[i]->value == values[i] && all[i]->number == numbers[i])
      std::ranges::copy(all[i]->place, places.begin() + static_cast<std::ptrdiff_t>(3 * i));
  MPI_Allreduce(MPI_IN_PLACE, places.data(), static_cast<int>(3 * n), MPI_DOUBLE, MPI_MAX, comm);
  for (std::size_t i = 0; i < n; ++i)
    if (values[i] != nothing) *all[i] = {values[i], numbers[i], {places[3 * i], places[3 * i + 1], places[3 * i + 2]}};
}

std::string whereIs(const MeshQuality::Worst& worst, int dimension) {
  return "at " + placeText(worst.place, dimension);
}

}  // namespace

MeshQuality::MeshQuality(const Mesh& m) : dimension(m.dimension), totalFaces(m.totalFaces), facesBeyond(m.facesBeyond) {
  std::array<double, 8> sums{};  // cells by shape, angles, faces
  std::vector<Vector3> corners;
  for (int c = 0; c < m.owned; ++c) {
    const std::int64_t number = m.naturalCell[indexAt(c)];
    const double size = sizeOf(m, c);
    sums[static_cast<std::size_t>(m.shape[indexAt(c)])] += 1.0;
    considerWorst(smallest, -size, number, m.centre[indexAt(c)]);
    considerWorst(largest, size, number, m.centre[indexAt(c)]);
    corners.clear();
    for (int k = m.cornerStart[indexAt(c)]; k < m.cornerStart[indexAt(c) + 1]; ++k)
      corners.push_back(m.vertex[indexAt(m.corner[indexAt(k)])]);
    considerWorst(aspect, aspectRatioOf(m.shape[indexAt(c)], corners, size), number, m.centre[indexAt(c)]);
  }
  for (int face = 0; face < m.faces; ++face) {
    const std::size_t f = indexAt(face);
    const std::int64_t number = m.faceNumber[f];
    const Vector3 along = scaled(m.normal[f], m.distance[f]);
    const double turned = degreesPerRadian * std::atan2(length(difference(m.step[f], along)), m.distance[f]);
    considerWorst(angle, turned, number, m.faceCentre[f]);
    // A face between two ranks is of both.
    const bool isShared = m.high[f] >= 0 && (m.low[f] >= m.owned || m.high[f] >= m.owned);
    sums[6] += isShared ? 0.5 * turned : turned;
    sums[7] += isShared ? 0.5 : 1.0;
    if (m.high[f] < 0) continue;
    const double low = sizeOf(m, m.low[f]), high = sizeOf(m, m.high[f]);
    considerWorst(growth, std::max(low, high) / std::min(low, high), number, m.faceCentre[f]);
    const double size = m.dimension == 3 ? std::sqrt(m.size(face)) : m.size(face);
    considerWorst(skewness, m.isSkewed() ? length(m.offset[f]) / size : 0.0, number, m.faceCentre[f]);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  for (std::size_t s = 0; s < cells.size(); ++s) cells[s] = std::llround(sums[s]);
  meanAngle = sums[6] / sums[7];
  const std::array<MeshQuality::Worst*, 6> all{&smallest, &largest, &aspect, &angle, &growth, &skewness};
  agreeOnWorst(m.comm, all);
  smallest.value = -smallest.value;
}

std::vector<std::string> MeshQuality::lines() const {
  std::vector<std::string> kinds;
  for (std::size_t s = 0; s < cells.size(); ++s)
    if (cells[s] > 0) {
      const std::string name = nameOf(static_cast<CellShape>(s));
      const bool isHedron = name.ends_with("hedron");  // of Greek: its plural is too
      kinds.push_back(fmt::format("{} {}", cells[s],
                                  cells[s] == 1 ? name
                                  : isHedron    ? name.substr(0, name.size() - 2) + "a"
                                                : name + "s"));
    }
  const char* unit = dimension == 3 ? "m^3" : "m^2";
  std::string first =
      fmt::format("mesh: {} of {:.3g} to {:.3g} {}", fmt::join(kinds, ", "), smallest.value, largest.value, unit);
  // Neighbours of one size, cells as long as wide: beyond round-off.
  constexpr double one = 1.0 + 1e-9;
  if (growth.value > one) first += fmt::format("; neighbours differ by {:.3g} at most", growth.value);
  if (aspect.value > one) first += fmt::format("; aspect ratio {:.3g} at most", aspect.value);
  constexpr double degreesOfRoundOff = 1e-5;
  if (angle.value < degreesOfRoundOff && skewness.value < one - 1.0) {
    if (growth.value <= one && aspect.value <= one) return {first + "; all cells are perfect"};
    return {first + "; all faces are orthogonal"};
  }
  std::string second =
      fmt::format("faces are turned from the steps between cells by {:.1f} degrees at most, {}, and {:.1f} on the mean",
                  angle.value, whereIs(angle, dimension), meanAngle);
  if (skewness.value > 0.0)
    second += fmt::format("; steps miss their centres by {:.3g} of their size at most, {}", skewness.value,
                          whereIs(skewness, dimension));
  return {first, second};
}

std::vector<std::string> MeshQuality::warnings() const {
  std::vector<std::string> found;
  if (facesBeyond > 0)
    found.push_back(fmt::format(
        "{} of the mesh's {} faces are turned by more than {:.0f} degrees from the steps between their cells, by "
        "{:.1f} "
        "at most, {}: what diffuses and presses along them counts as at {:.0f} degrees; better shaped cells are more "
        "accurate",
        facesBeyond, totalFaces, degreesPerRadian * std::atan(Mesh::mostOblique), angle.value,
        whereIs(angle, dimension), degreesPerRadian * std::atan(Mesh::mostOblique)));
  if (growth.value > mostGrowth)
    found.push_back(
        fmt::format("neighbouring cells of the mesh differ in size by a factor of {:.3g}, {}: expected {:.0f} at most; "
                    "let cells grow in more steps",
                    growth.value, whereIs(growth, dimension), mostGrowth));
  if (skewness.value > mostSkewness)
    found.push_back(
        fmt::format("a step between two cells of the mesh misses the centre of their face by {:.3g} of its size, {}: "
                    "expected {:.0f} "
                    "at most; better shaped cells are more accurate",
                    skewness.value, whereIs(skewness, dimension), mostSkewness));
  if (aspect.value > mostAspect)
    found.push_back(
        fmt::format("a cell of the mesh has the aspect ratio {:.3g}, {}: expected {:.0f} at most; implicit solvers "
                    "converge slowly on such cells",
                    aspect.value, whereIs(aspect, dimension), mostAspect));
  return found;
}

}  // namespace lampblack
