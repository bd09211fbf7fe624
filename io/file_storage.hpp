// How the fields of an HDF5 file are stored, and who of the ranks touches the file.
#pragma once

namespace lampblack::io {

struct FileStorage {
  static constexpr int mostCompression = 9;

  // 0: contiguous. 1 (fast) to 9 (small): fields in chunks, their bytes shuffled by place and deflated. No value
  // changes.
  int compression = 0;
  // Ranks that collect the fields of the others and write them; 0: each writes a share.
  int writers = 0;
};

}  // namespace lampblack::io
