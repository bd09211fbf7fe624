// Reads an HDF5 file that is there already, for instance the results of an earlier run: datasets of numbers and texts,
// attributes. Everything that can be wrong with the file - missing, damaged, not what was expected - is the user's to
// mend: an InputError that names file and dataset. Not collective; each rank opens the file for itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/hdf5_handle.hpp"

namespace lampblack::io {

class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);

  // Whether there is a group or dataset of this absolute path ("/flame/z").
  [[nodiscard]] bool has(const std::string& path) const;
  [[nodiscard]] bool hasAttribute(const std::string& path, const std::string& name) const;
  // Names in a group, sorted; empty where there is none.
  [[nodiscard]] std::vector<std::string> names(const std::string& group) const;

  // Extents of a dataset; none of a scalar.
  [[nodiscard]] std::vector<std::int64_t> shape(const std::string& path) const;
  // All values, row-major. `numbers` takes integers too.
  [[nodiscard]] std::vector<double> numbers(const std::string& path) const;
  // The same, which have to have this shape.
  [[nodiscard]] std::vector<double> numbers(const std::string& path, const std::vector<std::int64_t>& shape) const;
  // The rows [first, first + count) of the first dimension.
  [[nodiscard]] std::vector<double> rows(const std::string& path, std::int64_t first, std::int64_t count) const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& path) const;
  [[nodiscard]] std::string textAttribute(const std::string& path, const std::string& name) const;
  [[nodiscard]] double numberAttribute(const std::string& path, const std::string& name) const;

  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  [[nodiscard]] hdf5::Handle open(const std::string& path) const;
  [[nodiscard]] hdf5::Handle openAttribute(const std::string& path, const std::string& name) const;

  hdf5::QuietErrors quiet_;
  std::string name_;
  hdf5::Handle file_;
};

}  // namespace lampblack::io
