// Tiles of dense blocks, compiled for AVX2 with FMA.
#include "numerics/block_tile.hpp"

namespace lampblack::numerics {

namespace {
typedef double Vector __attribute__((vector_size(32)));
}  // namespace

BlockTiles blockTilesAvx2() {
  BlockTiles tiles;
  addTiles<Vector, 1, 6>(tiles);
  return tiles;
}

}  // namespace lampblack::numerics
