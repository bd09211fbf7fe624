// Ensembles along streamlines do not depend on which rank marches them: the same bits on any number of ranks.
#include "app/flow/trajectories.hpp"

#include <hdf5.h>

#include <map>

#include "app/flow/flow_output.hpp"
#include "core/rooms.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

namespace fs = std::filesystem;
using Datasets = std::map<std::string, std::vector<double>>;

// Every dataset below /trajectories.
Datasets readTrajectories(const fs::path& path) {
  Datasets all;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t group = H5Gopen2(file, "/trajectories", H5P_DEFAULT);
  const auto visit = [](hid_t root, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const hid_t dataset = H5Dopen2(root, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    std::vector<double>& values = (*static_cast<Datasets*>(data))[name];
    values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(dataset);
    return 0;
  };
  H5Ovisit(group, H5_INDEX_NAME, H5_ITER_INC, visit, &all);
  H5Gclose(group);
  H5Fclose(file);
  return all;
}

// More than ranks, so that a rank has several; the last leaves the domain early.
const std::vector<Vector3> fiveStarts{
    {1e-3, 4.5e-3}, {2e-3, 4.2e-3}, {3e-3, 3.8e-3}, {1e-3, 3e-3}, {13.9e-3, 4e-3}};

void writeTrajectories(MPI_Comm comm, const fs::path& path, std::uint64_t seed,
                       const std::vector<Vector3>& starts = fiveStarts) {
  test::Flame flame(comm, test::sootingGas);
  flame.flowCase.seed = seed;
  flame.flowCase.trajectories->starts = starts;
  flame.flowCase.trajectories->duration = 2e-3;
  ResultsWriter results(comm, path, {}, meshOutput(flame.mesh));
  runTrajectories(flame.context, flame.flowCase, flame.state, flame.properties, results);
  results.close();
}

TEST(Trajectories, TwoThatStartAtOnePlaceHaveRandomNumbersOfTheirOwn) {
  const test::SharedScratchFolder folder;
  writeTrajectories(MPI_COMM_WORLD, folder.path() / "twins.h5", 7, {{1e-3, 4.5e-3}, {1e-3, 4.5e-3}});
  if (test::worldRank() == 0) {
    const Datasets twins = readTrajectories(folder.path() / "twins.h5");
    EXPECT_EQ(twins.at("0/temperature"), twins.at("1/temperature")) << "the same path";
    EXPECT_NE(twins.at("0/number_density"), twins.at("1/number_density")) << "but not the same random numbers";
  }
}

TEST(Trajectories, OneThatLeavesAtOnceHasOneRowWithoutParticles) {
  const test::SharedScratchFolder folder;
  // Half a micrometre from the outlet, and steps of 50 us at 0.1 m/s and more.
  writeTrajectories(MPI_COMM_WORLD, folder.path() / "results.h5", 7, {{1e-3, 4.5e-3}, {13.9999995e-3, 4e-3}});
  if (test::worldRank() == 0) {
    const Datasets all = readTrajectories(folder.path() / "results.h5");
    EXPECT_EQ(all.at("0/time").size(), 41U);
    EXPECT_EQ(all.at("1/time"), std::vector<double>{0.0});
    EXPECT_EQ(all.at("1/number_density"), std::vector<double>{0.0});
    EXPECT_GT(all.at("1/temperature").at(0), 200.0);
  }
}

TEST(Trajectories, AreTheSameBitsOnAnyNumberOfRanks) {
  const test::SharedScratchFolder folder;
  writeTrajectories(MPI_COMM_WORLD, folder.path() / "all.h5", 7);
  if (test::worldRank() == 0) {
    writeTrajectories(MPI_COMM_SELF, folder.path() / "one.h5", 7);
    writeTrajectories(MPI_COMM_SELF, folder.path() / "other_seed.h5", 8);
    const Datasets all = readTrajectories(folder.path() / "all.h5");
    const Datasets one = readTrajectories(folder.path() / "one.h5");
    EXPECT_EQ(all.size(), 5U * 9U);
    EXPECT_EQ(all, one);
    // The random numbers are really the seed's.
    EXPECT_NE(one, readTrajectories(folder.path() / "other_seed.h5"));
    for (const std::string id : {"0", "1", "2", "3"}) {
      EXPECT_EQ(one.at(id + "/time").size(), 41U) << "2 ms in steps of 50 us, and the start";
      EXPECT_EQ(one.at(id + "/number_density").front(), 0.0);
      EXPECT_GT(one.at(id + "/number_density").back(), 0.0);
      EXPECT_GT(one.at(id + "/mean_diameter").back(), 0.5e-9);
    }
    EXPECT_LT(one.at("4/time").size(), 41U) << "leaves the domain";
    EXPECT_NE(one.at("0/number_density"), one.at("1/number_density"));
  }
}

}  // namespace
}  // namespace lampblack::app
