// Moves values of cells or faces of a mesh from their present ranks to their new ranks.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/packed_rows.hpp"
#include "io/block_exchange.hpp"

namespace lampblack::io {

// Making and using it is collective. A copy is cheap.
class Redistribution {
 public:
  // Global numbers of what this rank has and of what it will have, of 0..total-1.
  Redistribution(MPI_Comm comm, std::span<const std::int64_t> from, std::span<const std::int64_t> to,
                 std::int64_t total);

  // `width` values for each present number; returns the values of the new numbers.
  [[nodiscard]] std::vector<double> operator()(const std::vector<double>& values, int width) const;
  // Of a row for each number. Each goes straight to the rank that will have it: of both there has to be one
  // (std::logic_error).
  [[nodiscard]] PackedRows operator()(const PackedRows& rows) const;

 private:
  MPI_Comm comm_;
  std::int64_t arrivals_;
  std::shared_ptr<const BlockExchange> leaving_, arriving_;
};

}  // namespace lampblack::io
