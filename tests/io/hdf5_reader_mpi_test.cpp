// What the results writer writes, the reader reads; what is wrong with a file is said with file and dataset.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "core/errors.hpp"
#include "io/hdf5_reader.hpp"
#include "io/results_writer.hpp"
#include "tests/every_module.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::io {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Hdf5ReaderTest : public ::testing::Test {
 protected:
  Hdf5ReaderTest() {
    if (test::worldRank() == 0) std::ofstream(folder_ / "text.h5") << "this is no HDF5 file\n";
    ResultsWriter results(MPI_COMM_WORLD, folder_ / "results.h5", {"1.2", "abc", "problem: none", "today"});
    const std::vector<double> values{1.5, std::numeric_limits<double>::denorm_min(), -3, 4, 5, 6};
    const std::vector<std::int64_t> counts{7, 8};
    results.dataset("/flame/values", {3, 2}, values, "m", "values");
    results.dataset("/flame/counts", {2}, counts, "1", "counts");
    results.texts("/flame/species", {"H2", "", "C10H8-µ"}, "names");
    results.texts("/flame/nothing", {}, "no names");
    results.attribute("/flame", "type", std::string("free"));
    results.attribute("/flame", "speed", 2.25);
    results.close();
    MPI_Barrier(MPI_COMM_WORLD);
  }
  template <typename Work>
  static std::string messageOf(Work work) {
    try {
      work();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no InputError";
  }
  test::SharedScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
};

TEST_F(Hdf5ReaderTest, WhatWasWrittenIsReadToTheLastBit) {
  const Hdf5Reader reader(folder_ / "results.h5");
  EXPECT_THAT(reader.numbers("/flame/values", {3, 2}),
              ElementsAre(1.5, std::numeric_limits<double>::denorm_min(), -3, 4, 5, 6));
  EXPECT_THAT(reader.numbers("/flame/counts"), ElementsAre(7, 8));
  EXPECT_THAT(reader.texts("/flame/species"), ElementsAre("H2", "", "C10H8-µ"));
  EXPECT_TRUE(reader.texts("/flame/nothing").empty());
  EXPECT_EQ(reader.textAttribute("/flame", "type"), "free");
  EXPECT_EQ(reader.textAttribute("/flame/values", "unit"), "m");
  EXPECT_EQ(reader.numberAttribute("/flame", "speed"), 2.25);
  EXPECT_THAT(reader.names("/flame"), ElementsAre("counts", "nothing", "species", "values"));
  EXPECT_TRUE(reader.names("/missing").empty());
  EXPECT_FALSE(reader.has("/flame/z"));
  EXPECT_FALSE(reader.has("/missing/z"));
}

TEST_F(Hdf5ReaderTest, WhatIsWrongNamesFileAndDataset) {
  const auto open = [](const fs::path& path) { return messageOf([&] { Hdf5Reader reader(path); }); };
  EXPECT_THAT(open(folder_ / "missing.h5"), HasSubstr("missing.h5: there is no such file"));
  EXPECT_THAT(open(folder_), HasSubstr("this is not a file"));
  EXPECT_THAT(open(folder_ / "text.h5"), HasSubstr("text.h5: cannot be read as HDF5"));
  const Hdf5Reader reader(folder_ / "results.h5");
  const auto read = [&](const std::string& path) {
    return messageOf([&] { static_cast<void>(reader.numbers(path)); });
  };
  EXPECT_THAT(read("/flame/z"), HasSubstr("results.h5: holds no dataset /flame/z"));
  EXPECT_THAT(read("/flame"), HasSubstr("/flame cannot be read"));
  EXPECT_THAT(read("/flame/species"), HasSubstr("/flame/species does not hold numbers"));
  EXPECT_THAT(messageOf([&] { static_cast<void>(reader.numbers("/flame/values", {6})); }),
              HasSubstr("/flame/values has the shape (3, 2), expected (6)"));
  EXPECT_THAT(messageOf([&] { static_cast<void>(reader.texts("/flame/values")); }), HasSubstr("does not hold texts"));
  EXPECT_THAT(messageOf([&] { static_cast<void>(reader.textAttribute("/flame", "speed")); }), HasSubstr("is no text"));
  EXPECT_THAT(messageOf([&] { static_cast<void>(reader.numberAttribute("/flame", "size")); }),
              HasSubstr("/flame has no attribute 'size'"));
}

}  // namespace
}  // namespace lampblack::io
