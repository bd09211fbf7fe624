// One HDF5 file that all ranks of a communicator write together: groups, attributes and datasets of which each rank
// holds a contiguous slab. Everything here is collective.
//
// HDF5 over MPI-IO cannot leave a full disk: its closing crashes or waits for ever. So the room that an operation may
// need is claimed on the disk before HDF5 is asked to take it. Where there is none, all ranks raise the same
// SystemError, and the file is as it was before the operation: it can be closed, and read.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/file_storage.hpp"
#include "io/hdf5_handle.hpp"

namespace lampblack::io::hdf5 {

class ParallelFile {
 public:
  // Creates or replaces the file. InputError, the same on all ranks, where that is not possible or this HDF5 cannot
  // compress.
  ParallelFile(MPI_Comm comm, const std::filesystem::path& path, const FileStorage& storage = {});

  // A dataset of shape `dims`; this rank writes the rows [firstRow, firstRow + rows) of the first dimension (rows may
  // be 0). Missing groups on the way are made. A scalar has no dims and is written by the ranks with rows > 0.
  void write(const std::string& path, const std::vector<std::int64_t>& dims, std::int64_t firstRow, std::int64_t rows,
             const double* data);
  void write(const std::string& path, const std::vector<std::int64_t>& dims, std::int64_t firstRow, std::int64_t rows,
             const std::int64_t* data);

  // The same in portions: a dataset whose place is there, its values are not yet, and then rows of it as often as it
  // takes. Nothing is left to write of an empty one.
  void make(const std::string& path, const std::vector<std::int64_t>& dims);
  void fill(const std::string& path, std::int64_t firstRow, std::int64_t rows, const double* data);

  // Rows of a dataset of this file: those that this rank asks for.
  [[nodiscard]] std::vector<double> read(const std::string& path, std::int64_t firstRow, std::int64_t rows,
                                         std::int64_t width) const;

  // A list of texts, the same on all ranks, stored with the length of the longest.
  void write(const std::string& path, const std::vector<std::string>& texts);

  // Makes a group and those above it; nothing where it exists.
  void group(const std::string& path);

  // Attributes of a group or dataset that exists; "/" is the file itself. A later value replaces an earlier one.
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, double value);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);

  void flush();
  void close();
  // Whether an operation found no room on the disk. close() works then, and is safe on the way of that exception.
  [[nodiscard]] bool full() const { return full_; }
  // Leaves the file as it is; for when the other ranks cannot take part any more.
  void abandon() { file_.release(); }
  [[nodiscard]] bool isOpen() const { return file_.isOpen(); }

 private:
  void writeAny(const std::string& path, const std::vector<std::int64_t>& dims, std::int64_t firstRow,
                std::int64_t rows, const void* data, hid_t fileType, hid_t memoryType);
  Handle makeAny(const std::string& path, const std::vector<std::int64_t>& dims, hid_t fileType,
                 const std::string& what);
  void fillAny(const Handle& dataset, std::int64_t firstRow, std::int64_t rows, const void* data, hid_t memoryType,
               const std::string& what);
  void attributeAny(const std::string& path, const std::string& name, hid_t fileType, hid_t memoryType,
                    const void* value);

  // Whether values of this shape are worth compressing; then makes `creation` do so. Returns what they may take on the
  // disk, in bytes.
  std::int64_t layOut(const std::vector<std::int64_t>& dims, std::int64_t valueSize, hid_t creation,
                      const std::string& what) const;
  // Room for `bytes` of values and what HDF5 notes about them.
  void claim(std::int64_t bytes, const std::string& what);

  QuietErrors quiet_;
  MPI_Comm comm_;
  std::string name_;
  int compression_;
  // Bytes of the file: in use, at most; and with their place on the disk.
  std::int64_t end_ = 0, claimed_ = 0;
  bool full_ = false;
  int rank_ = 0;
  Handle file_;
  Handle linkCreation_;
  Handle transfer_;
};

}  // namespace lampblack::io::hdf5
