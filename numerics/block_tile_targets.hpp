// Products of tiles for dense blocks, one set an instruction set, each in a file compiled for it. To be called only
// where the processor has these instructions.
#pragma once

#include <cstddef>

#include "core/modules.hpp"

namespace lampblack::numerics {

// C (rows x columns, column-major) -= A B, or = A B. A has `packs` times eight rows, zero beyond `rows`, stored one
// column after the other on a cache line; `columns` and `packs` are in the place of the function. B may be C where one
// tile has all of its rows.
using BlockTile = void (*)(bool subtract, std::size_t rows, std::size_t k, const double* A, const double* B,
                           std::size_t ldb, double* C, std::size_t ldc);

struct BlockTiles {
  static constexpr std::size_t mostPacks = 3, mostColumns = 16;
  std::size_t packs = 0;                        // most of a tile
  std::size_t columns[mostPacks] = {};          // most of a tile of one, two, three packs: what fits into registers
  BlockTile tile[mostPacks][mostColumns] = {};  // of packs - 1, columns - 1
};

BlockTiles blockTilesGeneric();
BlockTiles blockTilesAvx2();
BlockTiles blockTilesAvx512();

}  // namespace lampblack::numerics
