#include "io/history.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "io/csv.hpp"

namespace lampblack {

HistoryWriter::HistoryWriter(MPI_Comm comm, const std::filesystem::path& path, std::vector<TableColumn> columns)
    : columns_(std::move(columns)) {
  MPI_Comm_rank(comm, &rank_);
  if (rank_ != 0) return;
  csv_.open(path, std::ios::trunc);
  csv_ << csvHeader(columns_) << std::flush;
  if (!csv_) throw InputError(fmt::format("{}: the history cannot be written", path.string()));
}

void HistoryWriter::row(std::span<const double> values) {
  if (rank_ != 0) return;
  if (values.size() != columns_.size()) throw std::logic_error("a row of the history does not fit its columns");
  rows_.insert(rows_.end(), values.begin(), values.end());
  for (std::size_t c = 0; c < values.size(); ++c) csv_ << (c > 0 ? "," : "") << fmt::format("{}", values[c]);
  csv_ << std::endl;
  if (!csv_) throw NumericsError("the history cannot be written any more; is the disk full?");
}

void HistoryWriter::writeTo(ResultsWriter& results, const std::string& path) const {
  results.table(path, columns_, rows_);
}

}  // namespace lampblack
