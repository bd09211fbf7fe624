#include "io/hdf5_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/errors.hpp"

namespace lampblack::io {
namespace {

using hdf5::Handle;

// What HDF5 could not do is the file's fault here.
void need(bool good, const std::string& file, const std::string& problem) {
  if (!good) throw InputError(fmt::format("{}: {}", file, problem));
}

Handle taken(hid_t id, Handle::Close closer, const std::string& file, const std::string& what) {
  if (id < 0) throw InputError(fmt::format("{}: {} cannot be read: {}", file, what, hdf5::lastError()));
  return {id, closer, what};
}

std::vector<std::int64_t> extents(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> dims(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return {dims.begin(), dims.end()};
}

// Number of values of a dataset: no more than there are bytes for in the file, so that a damaged extent asks for no
// memory that is not there. Deflate, the strongest of HDF5's usual filters, packs 1032 bytes into one.
std::size_t countOf(hid_t dataset, std::size_t valueSize, const std::string& file, const std::string& path) {
  const Handle space = taken(H5Dget_space(dataset), H5Sclose, file, path);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  need(count >= 0 && valueSize > 0, file, path + " has no shape");
  const Handle creation = taken(H5Dget_create_plist(dataset), H5Pclose, file, path);
  const double packed = H5Pget_nfilters(creation) > 0 ? 1032 : 1;
  const auto stored = static_cast<double>(H5Dget_storage_size(dataset));
  need(static_cast<double>(count) * static_cast<double>(valueSize) <= packed * stored, file,
       fmt::format("{} claims {} values, which the file does not hold", path, count));
  return static_cast<std::size_t>(count);
}

// Fixed-length text of a file as a string: it ends where it was padded.
std::string trimmed(const char* text, std::size_t size) {
  return {text, static_cast<std::size_t>(std::find(text, text + size, '\0') - text)};
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : name_(path.string()) {
  std::error_code error;
  need(std::filesystem::exists(path, error), name_, "there is no such file");
  need(std::filesystem::is_regular_file(path, error), name_, "this is not a file");
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) throw InputError(fmt::format("{}: cannot be read as HDF5: {}", name_, hdf5::lastError()));
  file_ = Handle(file, H5Fclose, "open " + name_);
}

bool Hdf5Reader::has(const std::string& path) const {
  // H5Lexists wants every group on the way to exist.
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    if (part.size() > 1 && H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

bool Hdf5Reader::hasAttribute(const std::string& path, const std::string& name) const {
  return has(path) && H5Aexists_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
  std::vector<std::string> names;
  if (!has(group)) return names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  const herr_t status =
      H5Literate_by_name(file_, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names, H5P_DEFAULT);
  need(status >= 0, name_, group + " is not a group");
  return names;
}

Handle Hdf5Reader::open(const std::string& path) const {
  need(has(path), name_, "holds no dataset " + path);
  return taken(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, name_, path);
}

std::vector<std::int64_t> Hdf5Reader::shape(const std::string& path) const {
  const Handle dataset = open(path);
  return extents(taken(H5Dget_space(dataset), H5Sclose, name_, path));
}

std::vector<double> Hdf5Reader::numbers(const std::string& path) const {
  const Handle dataset = open(path);
  const Handle type = taken(H5Dget_type(dataset), H5Tclose, name_, path);
  const H5T_class_t kind = H5Tget_class(type);
  need(kind == H5T_FLOAT || kind == H5T_INTEGER, name_, path + " does not hold numbers");
  const std::size_t count = countOf(dataset, H5Tget_size(type), name_, path);
  std::vector<double> values(count, std::numeric_limits<double>::quiet_NaN());
  if (values.empty()) return values;
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw InputError(fmt::format("{}: {} cannot be read: {}", name_, path, hdf5::lastError()));
  return values;
}

std::vector<double> Hdf5Reader::numbers(const std::string& path, const std::vector<std::int64_t>& expected) const {
  const auto found = shape(path);
  need(found == expected, name_,
       fmt::format("{} has the shape ({}), expected ({})", path, fmt::join(found, ", "), fmt::join(expected, ", ")));
  return numbers(path);
}

std::vector<double> Hdf5Reader::rows(const std::string& path, std::int64_t first, std::int64_t count) const {
  const Handle dataset = open(path);
  const Handle space = taken(H5Dget_space(dataset), H5Sclose, name_, path);
  const auto whole = extents(space);
  need(!whole.empty() && first >= 0 && count >= 0 && first + count <= whole[0], name_, path + " has too few rows");
  if (count == 0) return {};
  std::vector<hsize_t> start(whole.size(), 0);
  std::vector<hsize_t> block(whole.begin(), whole.end());
  start[0] = static_cast<hsize_t>(first);
  block[0] = static_cast<hsize_t>(count);
  hsize_t size = 1;
  for (const hsize_t extent : block) size *= extent;
  const Handle memory = taken(H5Screate_simple(1, &size, nullptr), H5Sclose, name_, path);
  std::vector<double> values(size);
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr) < 0 ||
      H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) < 0)
    throw InputError(fmt::format("{}: {} cannot be read: {}", name_, path, hdf5::lastError()));
  return values;
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path) const {
  const Handle dataset = open(path);
  const Handle type = taken(H5Dget_type(dataset), H5Tclose, name_, path);
  need(H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0, name_, path + " does not hold texts");
  const std::size_t size = H5Tget_size(type);
  const std::size_t count = countOf(dataset, size, name_, path);
  std::vector<char> buffer(count * size);
  if (count > 0 && H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer.data()) < 0)
    throw InputError(fmt::format("{}: {} cannot be read: {}", name_, path, hdf5::lastError()));
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) texts.push_back(trimmed(buffer.data() + i * size, size));
  return texts;
}

Handle Hdf5Reader::openAttribute(const std::string& path, const std::string& name) const {
  need(hasAttribute(path, name), name_, fmt::format("{} has no attribute '{}'", path, name));
  return taken(H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name_,
               "the attribute " + name);
}

std::string Hdf5Reader::textAttribute(const std::string& path, const std::string& name) const {
  const Handle attribute = openAttribute(path, name);
  const Handle type = taken(H5Aget_type(attribute), H5Tclose, name_, "the attribute " + name);
  need(H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0, name_,
       fmt::format("the attribute '{}' of {} is no text", name, path));
  std::vector<char> buffer(H5Tget_size(type));
  need(H5Aread(attribute, type, buffer.data()) >= 0, name_, fmt::format("the attribute '{}' cannot be read", name));
  return trimmed(buffer.data(), buffer.size());
}

double Hdf5Reader::numberAttribute(const std::string& path, const std::string& name) const {
  const Handle attribute = openAttribute(path, name);
  const Handle type = taken(H5Aget_type(attribute), H5Tclose, name_, "the attribute " + name);
  const H5T_class_t kind = H5Tget_class(type);
  const Handle space = taken(H5Aget_space(attribute), H5Sclose, name_, "the attribute " + name);
  need((kind == H5T_FLOAT || kind == H5T_INTEGER) && H5Sget_simple_extent_npoints(space) == 1, name_,
       fmt::format("the attribute '{}' of {} is no number", name, path));
  double value = 0;
  need(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) >= 0, name_,
       fmt::format("the attribute '{}' cannot be read", name));
  return value;
}

}  // namespace lampblack::io
