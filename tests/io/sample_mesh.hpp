// A structured r-z mesh dealt out to ranks like cards, so that no rank owns neighbours: the worst case for writing in
// global order.
#pragma once

#include <mpi.h>

#include <cmath>

#include "io/results_writer.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

struct SampleMesh {
  std::int64_t nr = 5;
  std::int64_t nz = 7;
  double width = 5e-3;   // m
  double height = 8e-3;  // m

  [[nodiscard]] std::int64_t vertex(std::int64_t i, std::int64_t j) const { return j * (nr + 1) + i; }

  // Cells of this rank, in descending order to make the order matter.
  [[nodiscard]] MeshOutput part(MPI_Comm comm) const {
    int rank = 0;
    int ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &ranks);
    MeshOutput mesh;
    mesh.totalCells = nr * nz;
    mesh.totalVertices = (nr + 1) * (nz + 1);
    const double dr = width / static_cast<double>(nr);
    const double dz = height / static_cast<double>(nz);
    for (std::int64_t cell = mesh.totalCells - 1; cell >= 0; --cell) {
      if (cell * 7 % ranks != rank) continue;
      const std::int64_t i = cell % nr;
      const std::int64_t j = cell / nr;
      mesh.globalCell.push_back(cell);
      const double r = (static_cast<double>(i) + 0.5) * dr;
      const double z = (static_cast<double>(j) + 0.5) * dz;
      for (const double x : {r, z, 0.0}) mesh.cellCentre.push_back(x);
      mesh.cellVolume.push_back(2.0 * 3.14159265358979 * r * dr * dz);
      for (const std::int64_t v : {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}) {
        mesh.connectivity.push_back(v);
        mesh.globalVertex.push_back(v);
        mesh.vertexCoordinates.push_back(static_cast<double>(v % (nr + 1)) * dr);
        mesh.vertexCoordinates.push_back(static_cast<double>(v / (nr + 1)) * dz);
        mesh.vertexCoordinates.push_back(0.0);
      }
    }
    return mesh;
  }
};

// What the sample fields hold in a cell.
inline double sampleTemperature(std::int64_t cell, double time) {
  return 300.0 + static_cast<double>(cell) + time;
}
inline double sampleVelocity(std::int64_t cell, int component) {
  return 0.01 * static_cast<double>(cell) * (component == 0 ? 1.0 : -2.0);
}

// Two steps of two fields, a history, and a trajectory that the last rank owns.
inline void writeSample(MPI_Comm comm, const std::filesystem::path& path, const SampleMesh& sample,
                        const FileStorage& storage = {}) {
  int ranks = 1;
  int rank = 0;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  const MeshOutput mesh = sample.part(comm);
  const RunInfo run{"0.1.0", "abc", "problem: flow\n", "2024-01-01T00:00:00Z"};
  ResultsWriter results(comm, path, run, mesh, storage);
  for (const std::int64_t step : {0, 20}) {
    const double time = 1e-3 * static_cast<double>(step);
    std::vector<double> temperature;
    std::vector<double> velocity;
    std::vector<std::int64_t> level;
    for (const std::int64_t cell : mesh.globalCell) {
      temperature.push_back(sampleTemperature(cell, time));
      for (int c = 0; c < 2; ++c) velocity.push_back(sampleVelocity(cell, c));
      level.push_back(cell % 3);
    }
    results.beginStep(step, time);
    results.cellField("temperature", "K", 1, temperature, "Gas temperature");
    results.cellField("velocity", "m/s", 2, velocity, "Velocity (r, z, 0)");
    results.cellField("level", "1", 1, level, "An integer field");
    results.endStep();
  }
  const std::vector<double> rows{0.0, 1.0, 0.5, 2.0, 1.0, 3.0};
  results.table("/history", {{"time", "s", "Time"}, {"steps", "1", "Steps"}},
                rank == 0 ? std::span<const double>(rows) : std::span<const double>());
  const std::vector<double> sizes{1, 2, 3, 4, 5, 6};
  results.dataset("/trajectories/0/size_distribution", {2, 3},
                  rank == ranks - 1 ? std::span<const double>(sizes) : std::span<const double>(), "1/m^3",
                  "dN/dlog10 d", ranks - 1);
  results.dataset("/empty", {0, 4}, std::span<const double>(), "1", "Nothing at all");
  results.attribute("/trajectories/0", "start_m", 1e-3);
  results.close();
}

}  // namespace lampblack::test
