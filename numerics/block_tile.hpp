// The innermost loop of products of dense blocks: a tile of C (a few vectors of rows, a few columns) stays in registers
// while the sum over k runs. One instruction set a file; everything has internal linkage and nothing of the standard
// library is used, so that no function of one is taken for another's (as in kinetics/batch_kinetics_simd.hpp).
#pragma once

#include "core/modules.hpp"
#include "numerics/block_tile_targets.hpp"

namespace lampblack::numerics {
namespace {

// Rows come in packs of eight doubles; Vector is as wide as the registers.
template <class Vector, int Packs, int Columns>
void tile(bool subtract, std::size_t rows, std::size_t k, const double* A, const double* B, std::size_t ldb, double* C,
          std::size_t ldc) {
  constexpr int lanes = sizeof(Vector) / sizeof(double);
  constexpr int vectors = Packs * 8 / lanes;
  typedef Vector Unaligned __attribute__((aligned(8), may_alias));
  Vector sum[Columns][vectors] = {};
  for (std::size_t p = 0; p < k; ++p, A += Packs * 8) {
    Vector a[vectors];
#pragma GCC unroll 16
    for (int v = 0; v < vectors; ++v) a[v] = *reinterpret_cast<const Vector*>(A + v * lanes);
#pragma GCC unroll 16
    for (int j = 0; j < Columns; ++j) {
      const double b = B[static_cast<std::size_t>(j) * ldb + p];
#pragma GCC unroll 16
      for (int v = 0; v < vectors; ++v) sum[j][v] += a[v] * b;
    }
  }
  for (int j = 0; j < Columns; ++j, C += ldc) {
    if (rows == Packs * 8) {
      for (int v = 0; v < vectors; ++v) {
        auto* c = reinterpret_cast<Unaligned*>(C + v * lanes);
        *c = subtract ? *c - sum[j][v] : sum[j][v];
      }
    } else {
      for (std::size_t i = 0; i < rows; ++i) {
        const double value = sum[j][i / lanes][i % lanes];
        C[i] = subtract ? C[i] - value : value;
      }
    }
  }
}

template <class Vector, int Packs, int Columns>
void fillTiles(BlockTiles& tiles) {
  tiles.tile[Packs - 1][Columns - 1] = &tile<Vector, Packs, Columns>;
  if constexpr (Columns > 1) fillTiles<Vector, Packs, Columns - 1>(tiles);
}

// Tiles of this many packs and at most this many columns.
template <class Vector, int Packs, int Columns>
void addTiles(BlockTiles& tiles) {
  tiles.packs = Packs;
  tiles.columns[Packs - 1] = Columns;
  fillTiles<Vector, Packs, Columns>(tiles);
}

}  // namespace
}  // namespace lampblack::numerics
