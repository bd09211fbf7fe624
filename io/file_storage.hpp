// How the fields of an HDF5 file are stored, and who of the ranks touches the file.
#pragma once

namespace lampblack::io {

struct FileStorage {
  static constexpr int mostCompression = 9;

  // 0: contiguous. 1 (fast) to 9 (small): fields in chunks, their bytes shuffled by place and deflated. No value
  // changes.
  int compression = 0;
  // Ranks that collect what the others have and write it ("aggregators" of MPI-IO); 0: as many as MPI chooses.
  int writers = 0;
};

}  // namespace lampblack::io
