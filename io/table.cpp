#include "io/table.hpp"

#include "io/history.hpp"

namespace lampblack::io {

void Table::writeHistory(MPI_Comm comm, const std::filesystem::path& path, ResultsWriter& results) const {
  HistoryWriter history(comm, path, columns);
  history.row(rows);
  history.writeTo(results);
}

void Table::recordLast(JsonWriter& json, std::size_t from) const {
  for (std::size_t c = from; c < columns.size(); ++c) json.field("final_" + columns[c].name, last(c));
}

}  // namespace lampblack::io
