#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <stdexcept>

#include "core/modules.hpp"
#include "core/system_error.hpp"
#include "io/history.hpp"
#include "tests/io/read_all.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::io {
namespace {

namespace fs = std::filesystem;
using test::readAll;
using test::SampleMesh;

TEST(Results, HaveTheSameDatasetsOnAnyNumberOfRanks) {
  const test::SharedScratchFolder folder;
  test::writeSample(MPI_COMM_WORLD, folder.path() / "many.h5", {});
  if (test::worldRank() == 0) {
    test::writeSample(MPI_COMM_SELF, folder.path() / "one.h5", {});
    auto many = readAll(folder.path() / "many.h5");
    auto one = readAll(folder.path() / "one.h5");
    EXPECT_GT(many.size(), 12U);
    many.erase("mesh/owner");
    one.erase("mesh/owner");
    EXPECT_EQ(many, one);
  }
}

TEST(Results, StoreValuesInGlobalOrderWithTheirShape) {
  const test::SharedScratchFolder folder;
  test::writeSample(MPI_COMM_WORLD, folder.path() / "results.h5", {});
  if (test::worldRank() == 0) {
    const auto all = readAll(folder.path() / "results.h5");
    const auto& [shape, temperature] = all.at("steps/000020/temperature");
    EXPECT_EQ(shape, std::vector<hsize_t>{35});
    for (std::size_t cell = 0; cell < temperature.size(); ++cell) {
      EXPECT_EQ(temperature[cell], test::sampleTemperature(static_cast<std::int64_t>(cell), 0.02));
    }
    const auto& [velocityShape, velocity] = all.at("steps/000000/velocity");
    EXPECT_EQ(velocityShape, (std::vector<hsize_t>{35, 3}));
    EXPECT_EQ(velocity[4 * 3 + 1], test::sampleVelocity(4, 1));
    EXPECT_EQ(velocity[4 * 3 + 2], 0.0);
    EXPECT_EQ(all.at("history/steps").second, (std::vector<double>{1.0, 2.0, 3.0}));
    EXPECT_EQ(all.at("trajectories/0/size_distribution").first, (std::vector<hsize_t>{2, 3}));
    EXPECT_EQ(all.at("trajectories/0/size_distribution").second, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(all.at("empty").first, (std::vector<hsize_t>{0, 4}));
    EXPECT_FALSE(fs::exists(folder.path() / "results.h5.part"));
  }
}

TEST(Results, OfARunThatFailedStayReadableUnderTheTemporaryName) {
  const test::SharedScratchFolder folder;
  const MeshOutput mesh = SampleMesh{}.part(MPI_COMM_WORLD);
  {
    ResultsWriter results(MPI_COMM_WORLD, folder.path() / "results.h5", {}, mesh);
    results.beginStep(3, 0.5);
    results.cellField("density", "kg/m^3", 1, std::vector<double>(mesh.globalCell.size(), 1.2), "Density");
    results.endStep();
    results.beginStep(4, 0.6);
  }
  if (test::worldRank() == 0) {
    EXPECT_FALSE(fs::exists(folder.path() / "results.h5"));
    EXPECT_EQ(readAll(folder.path() / "results.h5.part").count("steps/000003/density"), 1U);
    std::ifstream xdmf(folder.path() / "results.xdmf");
    const std::string text{std::istreambuf_iterator<char>(xdmf), {}};
    EXPECT_THAT(text, testing::HasSubstr("results.h5.part:/steps/000003/density"));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("000004")));
  }
}

TEST(Results, RefuseAMeshThatMissesOrRepeatsCells) {
  const test::SharedScratchFolder folder;
  MeshOutput missing = SampleMesh{}.part(MPI_COMM_WORLD);
  missing.totalCells += 1;
  EXPECT_THROW(ResultsWriter(MPI_COMM_WORLD, folder.path() / "a.h5", {}, missing), std::logic_error);
  MeshOutput repeated = SampleMesh{}.part(MPI_COMM_WORLD);
  if (test::worldRank() == 0) repeated.globalCell[1] = repeated.globalCell[0];
  EXPECT_THROW(ResultsWriter(MPI_COMM_WORLD, folder.path() / "b.h5", {}, repeated), std::logic_error);
  MeshOutput lopsided = SampleMesh{}.part(MPI_COMM_WORLD);
  if (test::worldRank() == 0) lopsided.cellVolume.pop_back();
  EXPECT_THROW(ResultsWriter(MPI_COMM_WORLD, folder.path() / "c.h5", {}, lopsided), std::logic_error);
}

TEST(Results, ThatCannotBeMadeAreAnInputErrorOnAllRanks) {
  try {
    ResultsWriter results(MPI_COMM_WORLD, "/nowhere/results.h5", {}, SampleMesh{}.part(MPI_COMM_WORLD));
    FAIL() << "the file was made";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/results.h5.part: cannot be written: No such file or directory");
  }
}

TEST(Results, LeaveNoFileWhereNotEvenItsHeadHasRoom) {
  const test::SharedScratchFolder folder;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{10000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(ResultsWriter(MPI_COMM_WORLD, folder.path() / "results.h5", {}, SampleMesh{}.part(MPI_COMM_WORLD)),
               SystemError);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_FALSE(fs::exists(folder.path() / "results.h5.part"));
}

TEST(Results, RefuseFieldsOutsideAStepOrWithTheWrongSize) {
  const test::SharedScratchFolder folder;
  const MeshOutput mesh = SampleMesh{}.part(MPI_COMM_WORLD);
  ResultsWriter results(MPI_COMM_WORLD, folder.path() / "results.h5", {}, mesh);
  const std::vector<double> values(mesh.globalCell.size(), 1.0);
  EXPECT_THROW(results.cellField("a", "1", 1, values, ""), std::logic_error);
  EXPECT_THROW(results.endStep(), std::logic_error);
  results.beginStep(0, 0.0);
  EXPECT_THROW(results.cellField("a/b", "1", 1, values, ""), std::logic_error);
  EXPECT_THROW(results.cellField("a", "1", 1, std::vector<double>(values.size() + 1), ""), std::logic_error);
  EXPECT_THROW(results.beginStep(1, 0.0), std::logic_error);
}

TEST(History, IsACsvFileAndATable) {
  const test::SharedScratchFolder folder;
  ResultsWriter results(MPI_COMM_WORLD, folder.path() / "results.h5", {}, SampleMesh{}.part(MPI_COMM_WORLD));
  HistoryWriter history(MPI_COMM_WORLD, folder.path() / "history.csv",
                        {{"time", "s", "Time"}, {"peak_T", "K", "Peak"}});
  history.row(std::vector<double>{0.0, 300.0});
  history.row(std::vector<double>{0.1, 2300.5});
  history.writeTo(results);
  results.close();
  if (test::worldRank() == 0) {
    std::ifstream csv(folder.path() / "history.csv");
    const std::string text{std::istreambuf_iterator<char>(csv), {}};
    EXPECT_EQ(text, "time [s],peak_T [K]\n0,300\n0.1,2300.5\n");
    EXPECT_EQ(readAll(folder.path() / "results.h5").at("history/peak_T").second, (std::vector<double>{300.0, 2300.5}));
  }
}

}  // namespace
}  // namespace lampblack::io
