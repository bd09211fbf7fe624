// Tiles of dense blocks, compiled for AVX-512 (F).
#include "numerics/block_tile.hpp"

namespace lampblack::numerics {

namespace {
typedef double Vector __attribute__((vector_size(64)));
}  // namespace

BlockTiles blockTilesAvx512() {
  BlockTiles tiles;
  addTiles<Vector, 1, 16>(tiles);
  addTiles<Vector, 2, 12>(tiles);
  addTiles<Vector, 3, 8>(tiles);
  return tiles;
}

}  // namespace lampblack::numerics
