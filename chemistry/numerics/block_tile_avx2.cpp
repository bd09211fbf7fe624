// Tiles of dense blocks, compiled for AVX2 with FMA.
#include "chemistry/numerics/block_tile.hpp"

namespace lampblack::chemistry {

namespace {
typedef double Vector __attribute__((vector_size(32)));
}  // namespace

BlockTiles blockTilesAvx2() {
  BlockTiles tiles;
  addTiles<Vector, 1, 6>(tiles);
  return tiles;
}

}  // namespace lampblack::chemistry
