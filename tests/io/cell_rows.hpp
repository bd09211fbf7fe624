// Rows of any lengths of cells that are dealt to ranks in no order, for the tests of what writes and moves them.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "tests/every_module.hpp"

namespace lampblack::test {

constexpr std::int64_t rowCells = 47;

// Of the global number of a cell. Some are empty, of those some in a row; most values are in a few cells.
struct RowsOfCells {
  std::function<std::int64_t(std::int64_t)> length = [](std::int64_t cell) {
    constexpr std::int64_t lengths[] = {0, 1, 0, 0, 17, 2, 1};
    return cell % 13 == 12 ? 300 : lengths[cell % 7];
  };
  [[nodiscard]] std::vector<double> row(std::int64_t cell) const {
    std::vector<double> values(static_cast<std::size_t>(length(cell)));
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = 1e7 * static_cast<double>(cell + 1) + static_cast<double>(i);
    return values;
  }
  [[nodiscard]] std::vector<std::vector<double>> rows(const std::vector<std::int64_t>& cells) const {
    std::vector<std::vector<double>> rows;
    for (const std::int64_t cell : cells) rows.push_back(row(cell));
    return rows;
  }
};

// This rank's cells, the highest first. Another `deal` deals them to other ranks.
inline std::vector<std::int64_t> dealtCells(MPI_Comm comm, int deal) {
  int ranks = 1, rank = 0;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  std::vector<std::int64_t> cells;
  for (std::int64_t cell = rowCells; cell-- > 0;)
    if ((cell * cell + deal * (cell / 3)) % 11 % ranks == rank) cells.push_back(cell);
  return cells;
}

}  // namespace lampblack::test
