// The history of a run: one row of numbers a step (or every few), to a CSV file that can be followed while the run goes
// on, and to the results file as a table at the end.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/results_writer.hpp"

namespace lampblack::io {

class HistoryWriter {
 public:
  // Rank 0 writes `path`, with a header "time [s],steps [1],...". InputError (rank 0) where it cannot be made.
  HistoryWriter(MPI_Comm comm, const std::filesystem::path& path, std::vector<Quantity> columns);

  // Collective. One value for each column, of one row or several; only rank 0's count. SystemError where the disk is
  // full: the file then ends with the last rows that were written as a whole.
  void row(std::span<const double> values);

  // The rows so far, row-major, on rank 0.
  [[nodiscard]] const std::vector<double>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<Quantity>& columns() const { return columns_; }

  // Collective: the same rows as a table of the results file.
  void writeTo(ResultsWriter& results, const std::string& path = "/history") const;

 private:
  void write(const std::string& lines);  // with their ends

  MPI_Comm comm_;
  std::filesystem::path path_;
  int rank_ = 0;
  std::uintmax_t size_ = 0;  // of the file, bytes
  std::vector<Quantity> columns_;
  std::vector<double> rows_;
  std::ofstream csv_;
};

}  // namespace lampblack::io
