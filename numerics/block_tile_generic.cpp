// Tiles of dense blocks, compiled for any processor.
#include "numerics/block_tile.hpp"

namespace lampblack::numerics {

namespace {
typedef double Vector __attribute__((vector_size(16)));
}  // namespace

BlockTiles blockTilesGeneric() {
  BlockTiles tiles;
  addTiles<Vector, 1, 2>(tiles);
  return tiles;
}

}  // namespace lampblack::numerics
