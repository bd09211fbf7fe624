// How results are stored: compressed or not, and by how many ranks.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>

#include "core/modules.hpp"
#include "core/system_error.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/io/read_all.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::io {
namespace {

namespace fs = std::filesystem;
using test::readAll;
using test::SampleMesh;

// Large enough for a chunk, and with values that repeat.
const SampleMesh large{60, 70};

// Of a dataset.
int filtersOf(const fs::path& path, const char* dataset) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t opened = H5Dopen2(file, dataset, H5P_DEFAULT);
  const hid_t creation = H5Dget_create_plist(opened);
  const int filters = H5Pget_nfilters(creation);
  H5Pclose(creation);
  H5Dclose(opened);
  H5Fclose(file);
  return filters;
}

TEST(StoredResults, CompressedHaveTheSameValuesInASmallerFileOfTheSameLayout) {
  const test::SharedScratchFolder folder;
  for (const int compression : {0, 1, 6, 9})
    test::writeSample(MPI_COMM_WORLD, folder.path() / fmt::format("{}.h5", compression), large, {compression, 0});
  if (test::worldRank() != 0) return;
  test::writeSample(MPI_COMM_SELF, folder.path() / "one.h5", large, {6, 0});
  auto plain = readAll(folder.path() / "0.h5");
  for (const char* name : {"1.h5", "6.h5", "9.h5"}) {
    EXPECT_EQ(readAll(folder.path() / name), plain);
    EXPECT_LT(fs::file_size(folder.path() / name), fs::file_size(folder.path() / "0.h5") / 2);
  }
  auto one = readAll(folder.path() / "one.h5");
  plain.erase("mesh/owner");
  one.erase("mesh/owner");
  EXPECT_EQ(one, plain);
  EXPECT_EQ(filtersOf(folder.path() / "0.h5", "/steps/000020/velocity"), 0);
  EXPECT_EQ(filtersOf(folder.path() / "6.h5", "/steps/000020/velocity"), 2);
  EXPECT_EQ(filtersOf(folder.path() / "6.h5", "/history/time"), 0);  // too small to gain
  // Read a piece at a time, as a restart does.
  const Hdf5Reader reader(folder.path() / "6.h5");
  const auto rows = reader.rows("/steps/000020/temperature", 1000, 17);
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_EQ(rows[i], test::sampleTemperature(1000 + static_cast<std::int64_t>(i), 0.02));
}

// Several chunks, with blocks of the ranks that begin within them: 131 1xx values, and as many rows of three.
TEST(StoredResults, OfSeveralChunksAreWholeWithNumbersThatDoNotPack) {
  const test::SharedScratchFolder folder;
  const SampleMesh sample{401, 327};
  const MeshOutput mesh = sample.part(MPI_COMM_WORLD);
  const auto valueOf = [](std::int64_t cell, int component) {
    return std::sin(1e3 * static_cast<double>(cell) + 17.0 * component);
  };
  std::vector<double> scalar, vector;
  for (const std::int64_t cell : mesh.globalCell) {
    scalar.push_back(valueOf(cell, 0));
    for (int c = 0; c < 3; ++c) vector.push_back(valueOf(cell, c));
  }
  for (const int compression : {0, 1}) {
    ResultsWriter results(MPI_COMM_WORLD, folder.path() / fmt::format("{}.h5", compression), {}, mesh,
                          {compression, 0});
    results.beginStep(1, 0.0);
    results.cellField("scalar", "1", 1, scalar, "");
    results.cellField("vector", "1", 3, vector, "");
    results.endStep();
    results.close();
  }
  if (test::worldRank() != 0) return;
  const auto all = readAll(folder.path() / "1.h5");
  const auto& found = all.at("steps/000001/vector").second;
  ASSERT_EQ(found.size(), static_cast<std::size_t>(3 * sample.nr * sample.nz));
  std::int64_t wrong = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    wrong += found[i] == valueOf(static_cast<std::int64_t>(i / 3), static_cast<int>(i % 3)) ? 0 : 1;
  for (std::size_t i = 0; i < found.size() / 3; ++i)
    wrong += all.at("steps/000001/scalar").second[i] == valueOf(static_cast<std::int64_t>(i), 0) ? 0 : 1;
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(readAll(folder.path() / "0.h5"), all);
}

TEST(StoredResults, OfStepsThatWereSavedCompressedGoOnCompressed) {
  const test::SharedScratchFolder folder;
  const MeshOutput mesh = large.part(MPI_COMM_WORLD);
  const std::vector<double> density(mesh.globalCell.size(), 1.2);
  const auto step = [&](ResultsWriter& results, std::int64_t number) {
    results.beginStep(number, 0.1 * static_cast<double>(number));
    results.cellField("density", "kg/m^3", 1, density, "Density");
    results.endStep();
  };
  {
    ResultsWriter results(MPI_COMM_WORLD, folder.path() / "first.h5", {}, mesh, {6, 0});
    step(results, 1);
    step(results, 2);
    results.saveSteps(folder.path() / "saved.h5", 0);
    step(results, 3);
    results.close();
  }
  {
    ResultsWriter results(MPI_COMM_WORLD, folder.path() / "second.h5", {}, mesh, {6, 0});
    results.loadSteps(folder.path() / "saved.h5");
    step(results, 3);
    results.close();
  }
  if (test::worldRank() != 0) return;
  EXPECT_EQ(filtersOf(folder.path() / "saved.h5", "/steps/000002/density"), 2);
  EXPECT_EQ(filtersOf(folder.path() / "second.h5", "/steps/000002/density"), 2);
  EXPECT_EQ(readAll(folder.path() / "first.h5"), readAll(folder.path() / "second.h5"));
  const auto text = [&](const char* name) {
    std::ifstream file(folder.path() / name);
    std::string all{std::istreambuf_iterator<char>(file), {}};
    for (std::size_t at = all.find("first.h5"); at != std::string::npos; at = all.find("first.h5"))
      all.replace(at, 8, "second.h5");
    return all;
  };
  EXPECT_EQ(text("first.xdmf"), text("second.xdmf"));
  EXPECT_THAT(text("second.xdmf"), testing::HasSubstr(">second.h5:/steps/000003/density<"));
}

// A disk (here: a limit on the file's size) that is full at any place between the head and the whole: what ended before
// is there, whatever is compressed, and whether it packs or not.
TEST(StoredResults, OnAFullDiskKeepTheStepsBeforeCompressedOrNot) {
  const test::SharedScratchFolder folder;
  const MeshOutput mesh = large.part(MPI_COMM_WORLD);
  std::vector<double> values;
  for (const std::int64_t cell : mesh.globalCell) values.push_back(std::sin(1e3 * static_cast<double>(cell)));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const int compression : {0, 6})
    for (const rlim_t bytes : {500'000, 600'000, 700'000, 800'000, 900'000}) {
      const fs::path path = folder.path() / fmt::format("{}_{}.h5", compression, bytes);
      const rlimit small{bytes, before.rlim_max};
      setrlimit(RLIMIT_FSIZE, &small);
      std::size_t steps = 0;
      bool full = false;
      try {
        ResultsWriter results(MPI_COMM_WORLD, path, {}, mesh, {compression, 0});
        while (steps < 40) {
          results.beginStep(static_cast<std::int64_t>(steps), 0.0);
          results.cellField("values", "1", 1, values, "");
          results.endStep();
          ++steps;
        }
      } catch (const SystemError&) {
        full = true;
      }
      setrlimit(RLIMIT_FSIZE, &before);
      EXPECT_TRUE(full);
      if (test::worldRank() == 0) {
        const auto all = readAll(path.string() + ".part");
        std::int64_t wrong = 0;
        for (std::size_t s = 0; s < steps; ++s) {
          const auto& read = all.at(fmt::format("steps/{:06}/values", s)).second;
          for (std::size_t i = 0; i < read.size(); ++i)
            wrong += read[i] == std::sin(1e3 * static_cast<double>(i)) ? 0 : 1;
        }
        EXPECT_EQ(wrong, 0) << path;
      }
      MPI_Barrier(MPI_COMM_WORLD);
    }
}

// Bytes that this process gave to write(), by the kernel's count.
double bytesWritten() {
  std::ifstream io("/proc/self/io");
  std::string word;
  double count = 0.0;
  while (io >> word)
    if (word == "wchar:") io >> count;
  return count;
}

TEST(StoredResults, OfSomeWritersAreWrittenByNoMoreRanksAndTheSame) {
  const test::SharedScratchFolder folder;
  const SampleMesh sample{300, 400};
  const MeshOutput mesh = sample.part(MPI_COMM_WORLD);
  std::vector<double> values;
  for (const std::int64_t cell : mesh.globalCell) values.push_back(std::sin(static_cast<double>(cell)));
  for (int writers = 0; writers <= test::worldSize(); ++writers)
    for (const int compression : {0, 1}) {
      ResultsWriter results(MPI_COMM_WORLD, folder.path() / fmt::format("{}_{}.h5", writers, compression), {}, mesh,
                            {compression, writers});
      const double start = bytesWritten();
      results.beginStep(1, 0.0);
      results.cellField("values", "1", 1, values, "");
      results.endStep();
      const double field = 300 * 400 * 8;
      // Numbers that do not pack.
      int busy = bytesWritten() - start > 0.2 * field ? 1 : 0;
      MPI_Allreduce(MPI_IN_PLACE, &busy, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
      // Without the key MPI may collect as it likes.
      if (writers > 0) {
        EXPECT_GE(busy, 1);
        EXPECT_LE(busy, writers);
      }
      results.close();
      if (test::worldRank() != 0) continue;
      const auto found = readAll(folder.path() / fmt::format("{}_{}.h5", writers, compression));
      EXPECT_EQ(found, readAll(folder.path() / "0_0.h5"));
    }
}

}  // namespace
}  // namespace lampblack::io
