// A flame is read from a results file or refused with InputError; nothing else. What is read is a flame: a rising grid
// and finite unknowns of the right number.
//
// The input is not the file itself: damaged bytes of HDF5's own structures are HDF5's business. It says what stands in
// the file, entry by entry, and HDF5 writes that in memory and onto the disk: entries may be missing, there twice, of
// another kind, shape or size, links instead of data.
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/problems/flame/flame_file.hpp"
#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/scratch.hpp"

namespace {

// Words of the input: what remains of it in order, then zeros.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  [[nodiscard]] bool empty() const { return at_ == end_; }
  std::uint8_t next() { return empty() ? std::uint8_t{0} : *at_++; }
  double number() {
    static const double odd[] = {0, 1, -1, 0.5, 1e300, 1e-320, NAN, INFINITY};
    const std::uint8_t word = next();
    return word < 8 ? odd[word] : word;
  }

 private:
  const std::uint8_t *at_, *end_;
};

const char* const names[] = {"z", "unknowns", "globals", "species", "scalars"};

void writeTexts(hid_t group, const char* name, std::size_t count, std::size_t size, bool variable, Bytes& bytes) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, variable ? H5T_VARIABLE : size);
  const hsize_t extent = count;
  const hid_t space = H5Screate_simple(1, &extent, nullptr);
  const hid_t set = H5Dcreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (variable) {
    const std::vector<const char*> texts(count, "H2");
    if (set >= 0) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data());
  } else {
    std::vector<std::uint8_t> texts(count * size);
    for (auto& letter : texts) letter = bytes.next();
    if (set >= 0) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data());
  }
  if (set >= 0) H5Dclose(set);
  H5Sclose(space);
  H5Tclose(type);
}

void writeNumbers(hid_t group, const char* name, const std::vector<hsize_t>& shape, hid_t type, bool chunked,
                  bool filled, Bytes& bytes) {
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  if (shape.empty()) space = H5Screate(filled ? H5S_SCALAR : H5S_NULL);
  if (chunked && !shape.empty()) {
    H5Pset_chunk(creation, static_cast<int>(shape.size()), std::vector<hsize_t>(shape.size(), 4).data());
    H5Pset_deflate(creation, 1);
  }
  const hid_t set = H5Dcreate2(group, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  std::size_t count = 1;
  for (const hsize_t n : shape) count *= static_cast<std::size_t>(n);
  if (filled && set >= 0 && count < 4096) {
    std::vector<double> values(count);
    // Rising, unless the input says otherwise: a grid is to be found now and then.
    double value = 0;
    for (double& v : values) v = bytes.empty() ? value += 1 : bytes.number();
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  if (set >= 0) H5Dclose(set);
  H5Sclose(space);
  H5Pclose(creation);
}

void writeEntry(hid_t group, Bytes& bytes) {
  const char* name = names[bytes.next() % 5];
  const std::uint8_t kind = bytes.next();
  switch (kind % 8) {
    case 0:
    case 1: {  // texts
      const std::size_t count = bytes.next() % 8;
      writeTexts(group, name, count, 1 + bytes.next() % 16, kind >= 128, bytes);
      break;
    }
    case 2:
      H5Gclose(H5Gcreate2(group, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      break;
    case 3:
      H5Lcreate_soft(kind >= 128 ? "/flame/restart" : name, group, name, H5P_DEFAULT, H5P_DEFAULT);
      break;
    default: {  // numbers
      std::vector<hsize_t> shape(kind % 4);
      for (hsize_t& n : shape) n = bytes.next();
      // Far more than the file has room for, as a damaged extent may claim.
      const bool filled = kind < 192;
      if (!filled && !shape.empty()) shape[0] <<= 32;
      const hid_t types[] = {H5T_NATIVE_DOUBLE, H5T_NATIVE_INT, H5T_NATIVE_FLOAT, H5T_STD_U8BE};
      writeNumbers(group, name, shape, types[kind / 16 % 4], kind / 8 % 2 == 1, filled, bytes);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lampblack;
  using namespace lampblack::app;
  const test::ScratchFolder folder;
  const std::string path = (folder.path() / "results.h5").string();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (file < 0) throw std::runtime_error("cannot write " + path);
  H5Gclose(H5Gcreate2(file, "/flame", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  const hid_t group = H5Gcreate2(file, "/flame/restart", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  Bytes bytes(data, std::min<std::size_t>(size, 4096));
  const std::size_t entries = bytes.next() % 8;
  for (std::size_t i = 0; i < entries; ++i) writeEntry(group, bytes);
  H5Gclose(group);
  H5Fclose(file);
  try {
    const FlameProfile flame = readFlameProfile(path).profile;
    const auto finite = [](const std::vector<double>& v) {
      return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
    };
    if (flame.x.size() != flame.size() || !finite(flame.x) || !finite(flame.z) ||
        !std::is_sorted(flame.z.begin(), flame.z.end()))
      throw std::runtime_error("what was read is no flame");
  } catch (const InputError&) {
  }
  return 0;
}
