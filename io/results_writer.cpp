#include "io/results_writer.hpp"

#include <fmt/format.h>

#include <exception>
#include <stdexcept>

#include "io/results_writer_impl.hpp"

namespace lampblack::io {
using namespace resultswriter;

ResultsWriter::ResultsWriter(MPI_Comm comm, std::filesystem::path path, const RunInfo& run, const MeshOutput& mesh,
                             const FileStorage& storage) {
  const std::size_t n = mesh.globalCell.size();
  const int corners = mesh.corners;
  requireOnAllRanks(comm, isTopology(mesh.dimension, corners), "a mesh to write has cells of a kind that there is not");
  requireOnAllRanks(comm,
                    mesh.connectivity.size() == n * static_cast<std::size_t>(corners) && mesh.cellVolume.size() == n &&
                        mesh.cellCentre.size() == 3 * n && (mesh.owner.empty() || mesh.owner.size() == n) &&
                        mesh.vertexCoordinates.size() == 3 * mesh.globalVertex.size(),
                    "the arrays of a mesh to write do not fit each other");
  self_ = std::make_unique<Implementation>(comm, std::move(path), mesh, storage);
  requireOnAllRanks(comm, self_->cells.coversOnce(), "a mesh to write has to have each cell on exactly one rank");
  const BlockExchange vertices(comm, mesh.globalVertex, mesh.totalVertices, storage.writers);
  requireOnAllRanks(comm, vertices.covers(), "a mesh to write has to have each vertex on a rank");

  self_->describeRun(run);
  hdf5::ParallelFile& file = self_->file;
  file.group("/mesh");
  file.attribute("/mesh", "dimension", static_cast<std::int64_t>(mesh.dimension));
  file.attribute("/mesh", "cells", mesh.totalCells);
  file.attribute("/mesh", "vertices", mesh.totalVertices);
  const auto write = [&]<typename T>(const BlockExchange& exchange, const char* name, const std::vector<T>& values,
                                     int width, const char* unit, const char* description) {
    self_->writeOrdered(exchange, fmt::format("/mesh/{}", name), std::span<const T>(values), width, unit, description);
  };
  write(vertices, "vertices", mesh.vertexCoordinates, 3, "m", "Coordinates of the vertices");
  write(
      self_->cells, "cells", mesh.connectivity, corners, "1",
      mesh.dimension == 2 ? "Vertices of each cell, counter-clockwise" : "Vertices of each cell, in the order of VTK");
  self_->writeMixed(mesh);
  write(self_->cells, "cellVolume", mesh.cellVolume, 1, "m^3", "Volume of each cell");
  write(self_->cells, "cellCentre", mesh.cellCentre, 3, "m", "Centre of each cell");
  std::vector<std::int64_t> owner(mesh.owner.begin(), mesh.owner.end());
  if (mesh.owner.empty()) owner.assign(n, self_->rank);
  write(self_->cells, "owner", owner, 1, "1", "Rank that owned each cell at the start");
  file.group("/steps");
  file.flush();
}

ResultsWriter::ResultsWriter(MPI_Comm comm, std::filesystem::path path, const RunInfo& run)
    : self_(std::make_unique<Implementation>(comm, std::move(path), MeshOutput{}, FileStorage{})) {
  self_->describeRun(run);
  self_->file.flush();
}

ResultsWriter::~ResultsWriter() {
  if (!self_ || !self_->file.isOpen()) return;
  if (std::uncaught_exceptions() > self_->exceptionsAtStart && !self_->file.full()) {
    self_->file.abandon();
    return;
  }
  try {
    closePartial();
  } catch (const std::exception&) {
    // What ended with endStep() is on disk already; a destructor has nobody to tell.
    self_->file.abandon();
  }
}

void ResultsWriter::renumber(std::span<const std::int64_t> globalCell) {
  self_->cells = BlockExchange(self_->comm, globalCell, self_->cells.total(), self_->storage.writers);
  requireOnAllRanks(self_->comm, self_->cells.coversOnce(),
                    "a mesh to write has to have each cell on exactly one rank");
}

void ResultsWriter::beginStep(std::int64_t step, double time) {
  if (self_->open) throw std::logic_error("a step of the results is begun before the last one ended");
  self_->open = XdmfStep{fmt::format("/steps/{:06}", step), time, {}};
  self_->file.group(self_->open->group);
  self_->file.attribute(self_->open->group, "step", step);
  self_->file.attribute(self_->open->group, "time", time);
}

void ResultsWriter::cellField(const std::string& name, const std::string& unit, int components,
                              std::span<const double> ownedValues, const std::string& description) {
  self_->cellField(name, unit, components, ownedValues, description);
}

void ResultsWriter::cellField(const std::string& name, const std::string& unit, int components,
                              std::span<const std::int64_t> ownedValues, const std::string& description) {
  self_->cellField(name, unit, components, ownedValues, description);
}

void ResultsWriter::endStep() {
  if (!self_->open) throw std::logic_error("a step of the results is ended that was not begun");
  self_->steps.push_back(std::move(*self_->open));
  self_->open.reset();
  self_->file.flush();
  self_->writeXdmf(partName(self_->path));
}

void ResultsWriter::table(const std::string& path, const std::vector<Quantity>& columns, std::span<const double> rows) {
  if (columns.empty()) throw std::logic_error("a table has no columns");
  const std::size_t width = columns.size();
  requireOnAllRanks(self_->comm, self_->rank != 0 || rows.size() % width == 0,
                    fmt::format("table '{}' does not have whole rows", path));
  const std::size_t count = rows.size() / width;
  self_->file.group(path);
  std::vector<double> column(count);
  for (std::size_t c = 0; c < width; ++c) {
    for (std::size_t r = 0; r < count; ++r) column[r] = rows[r * width + c];
    dataset(path + "/" + columns[c].name, {static_cast<std::int64_t>(count)}, column, columns[c].unit,
            columns[c].description);
  }
}

void ResultsWriter::dataset(const std::string& path, const std::vector<std::int64_t>& dims,
                            std::span<const double> data, const std::string& unit, const std::string& description,
                            int fromRank) {
  self_->dataset(path, dims, data, unit, description, fromRank);
}

void ResultsWriter::dataset(const std::string& path, const std::vector<std::int64_t>& dims,
                            std::span<const std::int64_t> data, const std::string& unit, const std::string& description,
                            int fromRank) {
  self_->dataset(path, dims, data, unit, description, fromRank);
}

void ResultsWriter::texts(const std::string& path, const std::vector<std::string>& values,
                          const std::string& description) {
  self_->file.write(path, values);
  self_->describe(path, "1", description);
}

namespace {

// A dataset that is there is found as a link; H5Lexists of a dataset path is also true, so no group is made over it.
template <typename T>
void setAttribute(hdf5::ParallelFile& file, const std::string& path, const std::string& name, const T& value) {
  file.group(path);
  file.attribute(path, name, value);
}

}  // namespace

void ResultsWriter::attribute(const std::string& path, const std::string& name, const std::string& value) {
  setAttribute(self_->file, path, name, value);
}
void ResultsWriter::attribute(const std::string& path, const std::string& name, double value) {
  setAttribute(self_->file, path, name, value);
}
void ResultsWriter::attribute(const std::string& path, const std::string& name, std::int64_t value) {
  setAttribute(self_->file, path, name, value);
}

void ResultsWriter::close() {
  if (!self_->file.isOpen()) return;
  if (self_->open) throw std::logic_error("the results are closed inside a step");
  self_->file.close();
  collectively(self_->comm, [this] {
    if (self_->rank != 0) return;
    std::error_code error;
    std::filesystem::rename(partName(self_->path), self_->path, error);
    if (error) refuseWrite(self_->path, error.value());
  });
  self_->writeXdmf(self_->path);
}

void ResultsWriter::closePartial() {
  if (!self_->file.isOpen()) return;
  self_->open.reset();
  self_->file.close();
  self_->writeXdmf(partName(self_->path));
}

}  // namespace lampblack::io
