#include "io/history.hpp"

#include <cerrno>
#include <stdexcept>

#include "io/csv.hpp"
#include "io/disk_space.hpp"

namespace lampblack::io {

HistoryWriter::HistoryWriter(MPI_Comm comm, const std::filesystem::path& path, std::vector<Quantity> columns)
    : comm_(comm), path_(path), columns_(std::move(columns)) {
  MPI_Comm_rank(comm, &rank_);
  if (rank_ != 0) return;
  csv_.open(path, std::ios::trunc);
  write(csvHeader(columns_));
}

void HistoryWriter::write(const std::string& lines) {
  errno = 0;
  csv_ << lines << std::flush;
  if (csv_) {
    size_ += lines.size();
    return;
  }
  const int error = errno;
  std::error_code ignored;
  std::filesystem::resize_file(path_, size_, ignored);
  refuseWrite(path_, error, "What was written to it before is whole");
}

void HistoryWriter::row(std::span<const double> values) {
  collectively(comm_, [&] {
    if (rank_ != 0) return;
    const std::size_t width = columns_.size();
    if (values.size() % width != 0) throw std::logic_error("a row of the history does not fit its columns");
    rows_.insert(rows_.end(), values.begin(), values.end());
    write(csvRows(values, width));
  });
}

void HistoryWriter::writeTo(ResultsWriter& results, const std::string& path) const {
  results.table(path, columns_, rows_);
}

}  // namespace lampblack::io
