// What is in an HDF5 file, read without the project's own reader.
#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lampblack::test {

// Every dataset of a file as raw bytes with its shape, by path; read serially.
inline std::map<std::string, std::pair<std::vector<hsize_t>, std::vector<double>>> readAll(
    const std::filesystem::path& path) {
  std::map<std::string, std::pair<std::vector<hsize_t>, std::vector<double>>> all;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_GE(file, 0) << path;
  const auto visit = [](hid_t root, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const hid_t dataset = H5Dopen2(root, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    std::vector<hsize_t> dims(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(dataset);
    (*static_cast<decltype(all)*>(data))[name] = {dims, values};
    return 0;
  };
  H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, visit, &all);
  H5Fclose(file);
  return all;
}

}  // namespace lampblack::test
