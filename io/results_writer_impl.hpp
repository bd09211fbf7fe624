// The inside of ResultsWriter, shared by its files alone.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/modules.hpp"
#include "io/block_exchange.hpp"
#include "io/disk_space.hpp"
#include "io/hdf5_file.hpp"
#include "io/results_writer.hpp"
#include "io/run_record.hpp"
#include "io/xdmf_file.hpp"

namespace lampblack::io {

namespace resultswriter {

inline constexpr std::int64_t resultsFormatVersion = 1;

inline std::string fromRankZero(std::string text, MPI_Comm comm) {
  int size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, comm);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, comm);
  return text;
}

// The same decision on all ranks, so that a mistake of one ends in the same error on all of them.
inline void requireOnAllRanks(MPI_Comm comm, bool good, const std::string& otherwise) {
  int flag = good ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &flag, 1, MPI_INT, MPI_MIN, comm);
  if (flag == 0) throw std::logic_error(otherwise);
}

inline std::filesystem::path partName(const std::filesystem::path& path) {
  return path.string() + ".part";
}

}  // namespace resultswriter

struct ResultsWriter::Implementation {
  Implementation(MPI_Comm communicator, std::filesystem::path finalPath, const MeshOutput& mesh, const FileStorage& how)
      : comm(communicator),
        path(std::move(finalPath)),
        storage(how),
        file(communicator, resultswriter::partName(path), storage),
        cells(communicator, mesh.globalCell, mesh.totalCells, storage.writers),
        exceptionsAtStart(std::uncaught_exceptions()) {
    MPI_Comm_rank(comm, &rank);
    if (mesh.totalCells == 0) return;
    describeMesh({mesh.dimension, mesh.corners, mesh.totalCells, mesh.totalVertices});
  }

  void describeMesh(const XdmfMesh& mesh) {
    std::filesystem::path beside = path;
    xdmf.emplace(beside.replace_extension(".xdmf"), mesh);
  }

  // Cells without the vertices that they repeat, each with the number of its kind in front, where there are several
  // kinds. Collective.
  void writeMixed(const MeshOutput& mesh) {
    const auto corners = static_cast<std::size_t>(mesh.corners);
    const std::vector<std::int64_t> block =
        cells.toBlock(std::span<const std::int64_t>(mesh.connectivity), mesh.corners);
    std::vector<std::int64_t> mixed;
    for (std::size_t cell = 0; cell < static_cast<std::size_t>(cells.count()); ++cell) {
      const std::size_t kind = mixed.size();
      mixed.push_back(0);
      for (std::size_t k = cell * corners; k < (cell + 1) * corners; ++k)
        if (k == cell * corners || block[k] != block[k - 1]) mixed.push_back(block[k]);
      mixed[kind] = topologyNumber(mesh.dimension, static_cast<int>(mixed.size() - kind - 1));
    }
    const auto count = static_cast<std::int64_t>(mixed.size());
    std::int64_t first = 0, total = 0;
    MPI_Exscan(&count, &first, 1, MPI_INT64_T, MPI_SUM, comm);
    if (rank == 0) first = 0;  // MPI_Exscan leaves it undefined
    MPI_Allreduce(&count, &total, 1, MPI_INT64_T, MPI_SUM, comm);
    if (total == cells.total() * (mesh.corners + 1)) return;
    file.write("/mesh/mixed", {total}, first, count, mixed.data());
    describe("/mesh/mixed", "1", "Cells one after the other: the number of the kind in XDMF, then the vertices");
    describeMesh({mesh.dimension, mesh.corners, mesh.totalCells, mesh.totalVertices, total});
  }

  MPI_Comm comm;
  std::filesystem::path path;
  FileStorage storage;
  hdf5::ParallelFile file;
  BlockExchange cells;
  std::optional<XdmfFile> xdmf;  // of rank 0
  std::vector<XdmfStep> steps;
  std::optional<XdmfStep> open;
  std::map<std::string, std::pair<std::string, std::string>> words;  // of each field: unit, description
  int rank = 0;
  int exceptionsAtStart;

  void copySteps(const std::filesystem::path& to, std::size_t first);

  void describe(const std::string& dataset, const std::string& unit, const std::string& description) {
    file.attribute(dataset, "unit", unit);
    file.attribute(dataset, "description", description);
  }

  // Values of the cells (or vertices) of `exchange`, stored in global order.
  template <typename T>
  void writeOrdered(const BlockExchange& exchange, const std::string& name, std::span<const T> values, int width,
                    const std::string& unit, const std::string& description) {
    const std::vector<T> block = exchange.toBlock(values, width);
    std::vector<std::int64_t> dims{exchange.total()};
    if (width > 1) dims.push_back(width);
    file.write(name, dims, exchange.first(), exchange.count(), block.data());
    describe(name, unit, description);
  }

  template <typename T>
  void cellField(const std::string& name, const std::string& unit, int components, std::span<const T> values,
                 const std::string& description) {
    if (!open) throw std::logic_error(fmt::format("field '{}' is written outside a step", name));
    if (name.empty() || name.find_first_of("/:") != std::string::npos) {
      throw std::logic_error(fmt::format("'{}' cannot name a field", name));
    }
    resultswriter::requireOnAllRanks(comm, components > 0 && values.size() % static_cast<std::size_t>(components) == 0,
                                     fmt::format("field '{}' does not have its components for each cell", name));
    std::vector<T> padded;
    if (components == 2) {
      padded.assign(values.size() / 2 * 3, T{0});
      for (std::size_t i = 0; i < values.size(); ++i) padded[i / 2 * 3 + i % 2] = values[i];
      values = padded;
      components = 3;
    }
    writeOrdered(cells, open->group + "/" + name, values, components, unit, description);
    open->fields.push_back({name, components, std::is_integral_v<T>});
    words[name] = {unit, description};
  }

  template <typename T>
  void dataset(const std::string& name, std::vector<std::int64_t> dims, std::span<const T> data,
               const std::string& unit, const std::string& description, int fromRank) {
    int count = static_cast<int>(dims.size());
    MPI_Bcast(&count, 1, MPI_INT, fromRank, comm);
    dims.resize(static_cast<std::size_t>(count));
    MPI_Bcast(dims.data(), count, MPI_INT64_T, fromRank, comm);
    const std::int64_t size = std::accumulate(dims.begin(), dims.end(), std::int64_t{1}, std::multiplies<>());
    resultswriter::requireOnAllRanks(comm, rank != fromRank || static_cast<std::int64_t>(data.size()) == size,
                                     fmt::format("dataset '{}' does not have as many values as its shape says", name));
    const std::int64_t rows = rank != fromRank ? 0 : dims.empty() ? 1 : dims[0];
    file.write(name, dims, 0, rows, data.data());
    describe(name, unit, description);
  }

  void describeRun(const RunInfo& run) {
    file.attribute("/", "file_type", std::string("lampblack results"));
    file.attribute("/", "format_version", resultswriter::resultsFormatVersion);
    file.attribute("/", "lampblack_version", run.version);
    file.attribute("/", "git_hash", run.gitHash);
    file.attribute("/", "date", resultswriter::fromRankZero(run.date.empty() ? utcNow() : run.date, comm));
    file.attribute("/", "deck", run.deckResolved);
  }

  // All steps that ended; `of` is the HDF5 file under the name it has now.
  void writeXdmf(const std::filesystem::path& of) {
    collectively(comm, [&] {
      if (rank == 0 && xdmf) xdmf->update(of.filename().string(), steps);
    });
  }
};

}  // namespace lampblack::io
