#include "core/mesh_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/errors.hpp"
#include "core/gather.hpp"
#include "core/halo_exchange.hpp"

namespace lampblack {
namespace {

constexpr std::int64_t mostParts = 1000;

// Cells of this rank, halo included, that hang together here.
class LocalParts {
 public:
  explicit LocalParts(const Mesh& mesh) : parent_(static_cast<std::size_t>(mesh.cells)) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (int face = 0; face < mesh.interiorFaces; ++face) {
      const auto f = static_cast<std::size_t>(face);
      parent_[rootOf(static_cast<std::size_t>(mesh.low[f]))] = rootOf(static_cast<std::size_t>(mesh.high[f]));
    }
  }
  std::size_t rootOf(std::size_t cell) {
    while (parent_[cell] != cell) cell = parent_[cell] = parent_[parent_[cell]];
    return cell;
  }

 private:
  std::vector<std::size_t> parent_;
};

// The smallest permanent number of all cells that a local cell hangs together with.
std::vector<double> firstCellsOf(const Mesh& mesh) {
  HaloExchange halo(mesh);
  LocalParts parts(mesh);
  const auto cells = static_cast<std::size_t>(mesh.cells);
  std::vector<double> first(mesh.naturalCell.begin(), mesh.naturalCell.end());  // exact below 2^53
  for (int changed = 1; changed != 0;) {
    for (std::size_t c = 0; c < cells; ++c) {
      double& ofRoot = first[parts.rootOf(c)];
      ofRoot = std::min(ofRoot, first[c]);
    }
    changed = 0;
    for (std::size_t c = 0; c < cells; ++c) {
      const double& ofRoot = first[parts.rootOf(c)];
      if (first[c] > ofRoot) changed = 1;
      first[c] = ofRoot;
    }
    halo.update(first, 1);
    MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, mesh.comm);
  }
  return first;
}

}  // namespace

std::vector<MeshPart> partsOf(const Mesh& mesh) {
  const std::vector<double> first = firstCellsOf(mesh);
  const auto owned = static_cast<std::size_t>(mesh.owned);
  struct Begin {
    std::int64_t cell;
    Vector3 place;
  };
  std::vector<Begin> mine;
  for (std::size_t c = 0; c < owned; ++c)
    if (static_cast<std::int64_t>(first[c]) == mesh.naturalCell[c])
      mine.push_back({mesh.naturalCell[c], mesh.centre[c]});
  auto total = static_cast<std::int64_t>(mine.size());
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_INT64_T, MPI_SUM, mesh.comm);
  collectively(mesh.comm, [&] {
    if (total > mostParts)
      throw InputError(
          fmt::format("the mesh falls into {} parts that do not touch; expected cells that share the "
                      "vertices of their common sides",
                      total));
  });

  std::vector<Begin> begins = gatheredFromAll<Begin>(mesh.comm, mine);
  std::ranges::sort(begins, {}, &Begin::cell);

  const auto partOf = [&](std::size_t cell) {
    return static_cast<std::size_t>(
        std::ranges::lower_bound(begins, static_cast<std::int64_t>(first[cell]), {}, &Begin::cell) - begins.begin());
  };
  const std::size_t patches = mesh.patches.size();
  std::vector<std::int64_t> cells(begins.size(), 0);
  std::vector<char> has(begins.size() * patches, 0);
  for (std::size_t c = 0; c < owned; ++c) ++cells[partOf(c)];
  for (auto face = static_cast<std::size_t>(mesh.interiorFaces); face < static_cast<std::size_t>(mesh.faces); ++face)
    has[partOf(static_cast<std::size_t>(mesh.low[face])) * patches +
        static_cast<std::size_t>(mesh.patch[face - static_cast<std::size_t>(mesh.interiorFaces)])] = 1;
  MPI_Allreduce(MPI_IN_PLACE, cells.data(), static_cast<int>(cells.size()), MPI_INT64_T, MPI_SUM, mesh.comm);
  MPI_Allreduce(MPI_IN_PLACE, has.data(), static_cast<int>(has.size()), MPI_CHAR, MPI_MAX, mesh.comm);
  std::vector<MeshPart> parts;
  for (std::size_t p = 0; p < begins.size(); ++p) {
    const auto of = has.begin() + static_cast<std::ptrdiff_t>(p * patches);
    parts.push_back(
        {cells[p], begins[p].cell, begins[p].place, std::vector<char>(of, of + static_cast<std::ptrdiff_t>(patches))});
  }
  return parts;
}

}  // namespace lampblack
