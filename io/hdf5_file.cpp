#include "io/hdf5_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "io/disk_space.hpp"

namespace lampblack::io::hdf5 {
namespace {

// More than what HDF5 adds for itself in an operation: a header, names, entries of heaps and B-trees.
constexpr std::int64_t note = std::int64_t{4} << 10;
// Kept for the blocks of those heaps and trees, which double now and then as a group grows, and for closing the file.
constexpr std::int64_t margin = std::int64_t{64} << 10;
// Claimed besides where there is room, so that few operations have to claim.
constexpr std::int64_t plenty = std::int64_t{1} << 20;

// Values of a chunk at most: 512 KiB of them. HDF5 needs all of a chunk for any of its values, and keeps 1 MiB of
// chunks of a dataset by default, so that readers of a part of a field take each chunk apart once. Smaller chunks pack
// no better and make the index of large fields longer. The size does not depend on the ranks, so that files do not
// either; a chunk that is of several ranks' blocks is compressed by one of them.
constexpr std::int64_t valuesInChunk = std::int64_t{1} << 16;
// Below that the index of the chunks (2 KiB at least) takes what is gained.
constexpr std::int64_t leastCompressed = std::int64_t{8} << 10;

std::int64_t dividedUp(std::int64_t whole, std::int64_t part) {
  return (whole + part - 1) / part;
}

// For what MPI-IO collects itself. ROMIO and OMPIO read the number of ranks that write by the same key, and pass over
// what only the other knows; OMPIO collects nothing where each rank's piece is in one, as of fields.
class Hints {
 public:
  explicit Hints(int writers) {
    if (writers == 0) return;
    MPI_Info_create(&info_);
    MPI_Info_set(info_, "cb_nodes", std::to_string(writers).c_str());
    MPI_Info_set(info_, "collective_buffering", "true");
    MPI_Info_set(info_, "romio_cb_write", "enable");
  }
  ~Hints() {
    if (info_ != MPI_INFO_NULL) MPI_Info_free(&info_);
  }
  Hints(const Hints&) = delete;
  Hints& operator=(const Hints&) = delete;
  [[nodiscard]] MPI_Info info() const { return info_; }

 private:
  MPI_Info info_ = MPI_INFO_NULL;
};

// Finds out on rank 0, with plain C, whether the file can be made: MPI-IO's own complaints say little.
void probe(MPI_Comm comm, const std::filesystem::path& path) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  collectively(comm, [&] {
    if (rank != 0) return;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) refuseWrite(path, errno);
    std::fclose(file);
    try {
      claimSpace(path, 0, margin);
    } catch (const SystemError&) {
      std::error_code ignored;
      std::filesystem::remove(path, ignored);  // nothing that could be read
      throw;
    }
  });
}

}  // namespace

ParallelFile::ParallelFile(MPI_Comm comm, const std::filesystem::path& path, const FileStorage& storage)
    : comm_(comm), name_(path.string()), compression_(storage.compression) {
  collectively(comm, [&] {
    if (compression_ > 0 && H5Zfilter_avail(H5Z_FILTER_DEFLATE) <= 0)
      throw InputError(name_ + ": the HDF5 library was built without compression (deflate)");
  });
  const Hints hints(storage.writers);
  probe(comm, path);
  MPI_Comm_rank(comm, &rank_);
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make HDF5 access properties");
  check(H5Pset_fapl_mpio(access, comm, hints.info()), "use MPI-IO");
  check(H5Pset_coll_metadata_write(access, true), "write metadata collectively");
  check(H5Pset_all_coll_metadata_ops(access, true), "read metadata collectively");
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST), "choose the file format");
  file_ = Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "create " + name_);

  linkCreation_ = Handle(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "make HDF5 link properties");
  check(H5Pset_create_intermediate_group(linkCreation_, 1), "make groups on the way");
  check(H5Pset_char_encoding(linkCreation_, H5T_CSET_UTF8), "name in UTF-8");
  transfer_ = Handle(H5Pcreate(H5P_DATASET_XFER), H5Pclose, "make HDF5 transfer properties");
  check(H5Pset_dxpl_mpio(transfer_, H5FD_MPIO_COLLECTIVE), "transfer collectively");
}

void ParallelFile::claim(std::int64_t bytes, const std::string& what) {
  if (end_ + bytes + note + margin <= claimed_) {
    end_ += bytes + note;
    return;
  }
  // Afterwards the file is as long as what is in use.
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), what);
  std::int64_t room[2] = {0, 0};  // in use, claimed
  try {
    collectively(comm_, [&] {
      if (rank_ != 0) return;
      room[0] = static_cast<std::int64_t>(std::filesystem::file_size(name_));
      const std::int64_t needed = room[0] + bytes + note + margin;
      const std::string keeps =
          fmt::format("It was about to {}; what was complete before is readable in {}", what, name_);
      room[1] = needed + plenty;
      try {
        claimSpace(name_, room[0], room[1]);
      } catch (const SystemError&) {
        room[1] = needed;
        claimSpace(name_, room[0], room[1], keeps);
      }
    });
  } catch (const SystemError&) {
    full_ = true;
    throw;
  }
  MPI_Bcast(room, 2, MPI_INT64_T, 0, comm_);
  end_ = room[0] + bytes + note;
  claimed_ = room[1];
}

std::int64_t ParallelFile::layOut(const std::vector<std::int64_t>& dims, std::int64_t valueSize, hid_t creation,
                                  const std::string& what) const {
  std::int64_t bytes = valueSize;
  for (const std::int64_t extent : dims) bytes *= extent;
  if (compression_ == 0 || dims.empty() || bytes < leastCompressed) return bytes;
  // Chunks of whole rows, all alike, with as little as can be beyond the last row: HDF5 stores that too.
  const std::int64_t rowValues = bytes / valueSize / dims[0];
  const std::int64_t chunks = dividedUp(dims[0], std::max<std::int64_t>(valuesInChunk / rowValues, 1));
  std::vector<hsize_t> chunk(dims.begin(), dims.end());
  chunk[0] = static_cast<hsize_t>(dividedUp(dims[0], chunks));
  check(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), what);
  check(H5Pset_shuffle(creation), what);
  check(H5Pset_deflate(creation, static_cast<unsigned>(compression_)), what);
  // A chunk that does not become smaller is stored as it is. Before it is written HDF5 gives it the place of a
  // compressed empty one (a thousandth), which is free again then; and nodes of the index, each half full or more.
  const std::int64_t chunkBytes = static_cast<std::int64_t>(chunk[0]) * rowValues * valueSize;
  return chunks * (chunkBytes + chunkBytes / 500 + 512) + note;
}

void ParallelFile::writeAny(const std::string& path, const std::vector<std::int64_t>& dims, std::int64_t firstRow,
                            std::int64_t rows, const void* data, hid_t fileType, hid_t memoryType) {
  const std::string what = fmt::format("write {} to {}", path, name_);
  Handle dataset = makeAny(path, dims, fileType, what);
  fillAny(dataset, firstRow, rows, data, memoryType, what);
  dataset.close(what);
}

Handle ParallelFile::makeAny(const std::string& path, const std::vector<std::int64_t>& dims, hid_t fileType,
                             const std::string& what) {
  Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  claim(layOut(dims, static_cast<std::int64_t>(H5Tget_size(fileType)), creation, what), what);
  const std::vector<hsize_t> shape(dims.begin(), dims.end());
  const int rank = static_cast<int>(shape.size());
  Handle space(shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, shape.data(), nullptr), H5Sclose, what);
  check(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), what);
  // Time stamps would make two files with the same data differ.
  check(H5Pset_obj_track_times(creation, false), what);
  return {H5Dcreate2(file_, path.c_str(), fileType, space, linkCreation_, creation, H5P_DEFAULT), H5Dclose, what};
}

void ParallelFile::fillAny(const Handle& dataset, std::int64_t firstRow, std::int64_t rows, const void* data,
                           hid_t memoryType, const std::string& what) {
  const Handle space(H5Dget_space(dataset), H5Sclose, what);
  const int rank = H5Sget_simple_extent_ndims(space);
  check(rank, what);
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  if (rank > 0) check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), what);

  std::vector<hsize_t> block = shape;
  hsize_t values = 1;
  if (!block.empty()) {
    block[0] = static_cast<hsize_t>(rows);
    for (const hsize_t extent : block) values *= extent;
    for (const hsize_t extent : shape) {
      if (extent == 0) return;  // an empty dataset: it exists, and no rank has anything to write
    }
  } else if (rows == 0) {
    values = 0;
  }
  Handle memory(H5Screate_simple(1, &values, nullptr), H5Sclose, what);
  if (values == 0) {
    check(H5Sselect_none(space), what);
    check(H5Sselect_none(memory), what);
  } else if (!block.empty()) {
    std::vector<hsize_t> start(block.size(), 0);
    start[0] = static_cast<hsize_t>(firstRow);
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), what);
  }
  const double nothing = 0.0;  // some MPI-IO layers dislike a null pointer even for no bytes
  check(H5Dwrite(dataset, memoryType, memory, space, transfer_, data != nullptr ? data : &nothing), what);
}

void ParallelFile::make(const std::string& path, const std::vector<std::int64_t>& dims) {
  const std::string what = fmt::format("write {} to {}", path, name_);
  makeAny(path, dims, H5T_IEEE_F64LE, what).close(what);
}

void ParallelFile::fill(const std::string& path, std::int64_t firstRow, std::int64_t rows, const double* data) {
  const std::string what = fmt::format("write {} to {}", path, name_);
  Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, what);
  fillAny(dataset, firstRow, rows, data, H5T_NATIVE_DOUBLE, what);
  dataset.close(what);
}

void ParallelFile::write(const std::string& path, const std::vector<std::int64_t>& dims, std::int64_t firstRow,
                         std::int64_t rows, const double* data) {
  writeAny(path, dims, firstRow, rows, data, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE);
}

void ParallelFile::write(const std::string& path, const std::vector<std::int64_t>& dims, std::int64_t firstRow,
                         std::int64_t rows, const std::int64_t* data) {
  writeAny(path, dims, firstRow, rows, data, H5T_STD_I64LE, H5T_NATIVE_INT64);
}

std::vector<double> ParallelFile::read(const std::string& path, std::int64_t firstRow, std::int64_t rows,
                                       std::int64_t width) const {
  const std::string what = fmt::format("read {} of {}", path, name_);
  const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, what);
  const Handle space(H5Dget_space(dataset), H5Sclose, what);
  const auto size = static_cast<hsize_t>(rows * width);
  const Handle memory(H5Screate_simple(1, &size, nullptr), H5Sclose, what);
  std::vector<double> values(static_cast<std::size_t>(size));
  if (size == 0) {
    check(H5Sselect_none(space), what);
    check(H5Sselect_none(memory), what);
  } else {
    const hsize_t start[2] = {static_cast<hsize_t>(firstRow), 0};
    const hsize_t count[2] = {static_cast<hsize_t>(rows), static_cast<hsize_t>(width)};
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr), what);
  }
  double nothing = 0.0;
  check(H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, space, transfer_, size > 0 ? values.data() : &nothing), what);
  return values;
}

void ParallelFile::write(const std::string& path, const std::vector<std::string>& texts) {
  std::size_t size = 1;
  for (const std::string& text : texts) size = std::max(size, text.size());
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  check(H5Tset_size(type, size), "size a text type");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "pad a text type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "set a text's encoding");
  std::vector<char> buffer(std::max<std::size_t>(texts.size() * size, 1), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i)
    std::copy(texts[i].begin(), texts[i].end(), buffer.begin() + static_cast<std::ptrdiff_t>(i * size));
  const auto count = static_cast<std::int64_t>(texts.size());
  writeAny(path, {count}, 0, rank_ == 0 ? count : 0, buffer.data(), type, type);
}

void ParallelFile::group(const std::string& path) {
  // H5Lexists wants every group on the way to exist, so the path is looked at piece by piece.
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    if (part.size() > 1) {
      const htri_t exists = H5Lexists(file_, part.c_str(), H5P_DEFAULT);
      check(exists, fmt::format("look for {} in {}", part, name_));
      if (exists == 0) {
        claim(0, fmt::format("make {} in {}", part, name_));
        Handle made(H5Gcreate2(file_, part.c_str(), linkCreation_, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                    fmt::format("make {} in {}", part, name_));
      }
    }
    if (end == std::string::npos) return;
  }
}

void ParallelFile::attributeAny(const std::string& path, const std::string& name, hid_t fileType, hid_t memoryType,
                                const void* value) {
  const std::string what = fmt::format("write the attribute {} of {} to {}", name, path, name_);
  claim(static_cast<std::int64_t>(H5Tget_size(fileType)), what);
  Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose, what);
  const htri_t exists = H5Aexists(object, name.c_str());
  check(exists, what);
  if (exists > 0) check(H5Adelete(object, name.c_str()), what);
  Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
  Handle attribute(H5Acreate2(object, name.c_str(), fileType, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  check(H5Awrite(attribute, memoryType, value), what);
}

void ParallelFile::attribute(const std::string& path, const std::string& name, const std::string& value) {
  // Attributes in the object header end at 64 KiB: longer texts are cut there rather than lost.
  std::string text = value.substr(0, 60000);
  if (value.size() > 60000) text += "\n# cut";
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  check(H5Tset_size(type, text.size() + 1), "size a text type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "set a text's encoding");
  attributeAny(path, name, type, type, text.c_str());
}

void ParallelFile::attribute(const std::string& path, const std::string& name, double value) {
  attributeAny(path, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void ParallelFile::attribute(const std::string& path, const std::string& name, std::int64_t value) {
  attributeAny(path, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void ParallelFile::flush() {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flush " + name_);
  claimed_ = 0;  // that gave back what lies beyond the last byte in use
}

void ParallelFile::close() {
  file_.close("close " + name_);
}

}  // namespace lampblack::io::hdf5
