// One checkpoint: the pieces of a StateArchive in an HDF5 file, in the global order of cells and faces, so that any
// number of ranks can read it; and what has to agree where it is read. The file is written under a temporary name and
// sealed (sealed_file.hpp). docs/formats.md describes the file. Everything is collective.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "io/block_exchange.hpp"
#include "io/hdf5_file.hpp"
#include "io/hdf5_reader.hpp"

namespace lampblack::io {

// Global numbers of this rank's owned cells and local faces.
struct StateNumbers {
  std::vector<std::int64_t> cells, faces;
  std::int64_t totalCells = 0, totalFaces = 0;
};

// What a run and a checkpoint must have in common, by name, in words.
using Fingerprint = std::vector<std::pair<std::string, std::string>>;

class CheckpointWriter : public StateArchive {
 public:
  // Begins `path`.part. Errors as of hdf5::ParallelFile; nothing is left then.
  CheckpointWriter(MPI_Comm comm, std::filesystem::path path, const StateNumbers& numbers,
                   const Fingerprint& fingerprint);
  ~CheckpointWriter() override;
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  using StateArchive::shared;
  [[nodiscard]] bool loading() const override { return false; }
  void cells(const std::string& name, std::vector<double>& values, int width) override;
  void faces(const std::string& name, std::vector<double>& values, int width) override;
  void rows(const std::string& name, std::vector<std::vector<double>>& values) override;
  void sums(const std::string& name, std::span<double> values) override;
  void shared(const std::string& name, std::vector<double>& values) override;
  void texts(const std::string& name, const std::vector<std::string>& values);

  // Gives the file its seal and its name. Without it nothing is left.
  void finish();

 private:
  void ordered(const BlockExchange& exchange, const std::string& name, const std::vector<double>& values, int width);

  MPI_Comm comm_;
  std::filesystem::path path_;
  BlockExchange cells_, faces_;
  std::size_t localCells_, localFaces_;
  hdf5::ParallelFile file_;
  int rank_ = 0, ranks_ = 1, exceptionsAtStart_;
};

class CheckpointReader : public StateArchive {
 public:
  // InputError where the file is not whole, another thing, or of another mesh, mechanism ... than `fingerprint`.
  CheckpointReader(MPI_Comm comm, const std::filesystem::path& path, const StateNumbers& numbers,
                   const Fingerprint& fingerprint);

  // The mesh has been partitioned anew: what this rank reads from now on. Collective.
  void renumber(const StateNumbers& numbers);

  using StateArchive::shared;
  [[nodiscard]] bool loading() const override { return true; }
  void cells(const std::string& name, std::vector<double>& values, int width) override;
  void faces(const std::string& name, std::vector<double>& values, int width) override;
  void rows(const std::string& name, std::vector<std::vector<double>>& values) override;
  void sums(const std::string& name, std::span<double> values) override;
  void shared(const std::string& name, std::vector<double>& values) override;
  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const;

  // The texts of a sealed file before anything else is asked of it.
  static std::vector<std::string> textsOf(MPI_Comm comm, const std::filesystem::path& path, const std::string& name);

 private:
  void ordered(const BlockExchange& exchange, const std::string& name, std::vector<double>& values, int width);
  // The dataset of a piece of the state; InputError where the file has none.
  [[nodiscard]] std::string kept(const std::string& name) const;
  // Of the rows of this rank's block of cells, as far as they can be right without the other ranks'; not collective.
  [[nodiscard]] std::vector<std::int64_t> lengthsOfBlock(const std::string& name, std::int64_t values) const;

  MPI_Comm comm_;
  BlockExchange cells_, faces_;
  std::unique_ptr<Hdf5Reader> file_;
  int rank_ = 0, ranks_ = 1;
};

}  // namespace lampblack::io
