// Ensembles along streamlines do not depend on which rank marches them: the same bits on any number of ranks.
#include "app/problems/flow/trajectories.hpp"

#include <gmock/gmock.h>
#include <hdf5.h>

#include <map>
#include <memory>

#include "app/problems/flow/flow_mesh.hpp"
#include "app/problems/flow/flow_output.hpp"
#include "app/problems/prescribed_gas/gas_table.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "coupling/given_gas.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "particles/stochastic/population_path.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/messages.hpp"
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

// Soot along trajectories, of PAH that the flame's mechanism has.
MakePopulation ridersOf(const test::Flame& flame, std::uint64_t seed, std::size_t particles) {
  EnsembleOptions options;
  options.particles = particles;
  options.splitTolerance = 0.05;
  options.seed = seed;
  options.soot.pah = {{"A2", 10, 8, 2.0e-3}};
  return [&mechanism = flame.context.mechanism, options](std::uint64_t owner) {
    EnsembleOptions own = options;
    own.owner = owner;
    return std::make_unique<SootEnsemble>(mechanism, own);
  };
}

// More than ranks, so that a rank has several; the last leaves the domain early.
const std::vector<Vector3> fiveStarts{{1e-3, 4.5e-3}, {2e-3, 4.2e-3}, {3e-3, 3.8e-3}, {1e-3, 3e-3}, {13.9e-3, 4e-3}};

void writeTrajectories(MPI_Comm comm, const fs::path& path, std::uint64_t seed,
                       const std::vector<Vector3>& starts = fiveStarts) {
  test::Flame flame(comm, test::sootingGas);
  flame.flowCase.trajectories->make = ridersOf(flame, seed, 64);
  flame.flowCase.trajectories->starts = starts;
  flame.flowCase.trajectories->duration = 2e-3;
  ResultsWriter results(comm, path, {}, meshOutput(flame.mesh));
  Trajectories(flame.flowCase).run(flame.context, flame.state, flame.properties, results, nullptr);
  results.close();
}

TEST(Trajectories, TwoThatStartAtOnePlaceHaveRandomNumbersOfTheirOwn) {
  const test::SharedScratchFolder folder;
  writeTrajectories(MPI_COMM_WORLD, folder.path() / "twins.h5", 7, {{1e-3, 4.5e-3}, {1e-3, 4.5e-3}});
  if (test::worldRank() == 0) {
    const Datasets twins = readTrajectories(folder.path() / "twins.h5");
    EXPECT_EQ(twins.at("0/temperature"), twins.at("1/temperature")) << "the same path";
    EXPECT_NE(twins.at("0/soot_number_density"), twins.at("1/soot_number_density"))
        << "but not the same random numbers";
  }
}

// The table of a path's gas gives a path again on which the same particles come to the same: of the whole of it, gas
// and what thins particles.
TEST(Trajectories, TheTableOfTheGasIsThePath) {
  const test::SharedScratchFolder scratch;
  const RunFolder folder = RunFolder::prepare(scratch.path() / "run", false, MPI_COMM_WORLD);
  test::Flame flame(MPI_COMM_WORLD, test::sootingGas);
  TrajectoryRequest& request = *flame.flowCase.trajectories;
  request.starts = {{1e-3, 4.5e-3}, {2e-3, 4.2e-3}};
  request.duration = 10e-3;
  request.gasTables = true;
  request.make = ridersOf(flame, 1, 6000);
  ResultsWriter results(MPI_COMM_WORLD, folder.results(), {}, meshOutput(flame.mesh));
  Trajectories(flame.flowCase).run(flame.context, flame.state, flame.properties, results, &folder);
  results.close();
  MPI_Barrier(MPI_COMM_WORLD);
  const Datasets all = readTrajectories(folder.results());
  for (const std::size_t id : {0, 1}) {
    if (static_cast<int>(id) % test::worldSize() != test::worldRank()) continue;
    const GasHistory gas = readGasTable(folder.table("streamline_" + std::to_string(id)), flame.context.mechanism);
    const std::string name = std::to_string(id) + "/";
    ASSERT_EQ(gas.time.size(), all.at(name + "time").size());
    ASSERT_EQ(gas.numberLossRate.size() + 1, gas.time.size());
    for (std::size_t i = 0; i < gas.time.size(); ++i) {
      EXPECT_NEAR(gas.temperature[i], all.at(name + "temperature")[i], 1e-9);
      EXPECT_NEAR(gas.pressure[i] / flame.flowCase.pressure, 1, 1e-12);
    }
    const auto population = request.make(id);
    std::vector<std::string> species;
    for (const std::size_t k : population->species()) species.push_back(flame.context.mechanism.speciesName(k));
    const ParticlePath path = givenPath(flame.context.mechanism, gas, species, GasViscosity::transport);
    const PathResult again = marchPath(*population, path);
    const double number = all.at(name + "soot_number_density").back();
    ASSERT_GT(number, 0);
    ASSERT_EQ(population->columns()[1].name, "soot_number_density");
    EXPECT_NEAR(again.records.back().values[1] / number, 1, 0.05) << id;
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
    EXPECT_EQ(all.at("1/soot_number_density"), std::vector<double>{0.0});
    EXPECT_GT(all.at("1/temperature").at(0), 200.0);
  }
}

// Through cells of other shapes and with other axes: places by the names of the axes, as many columns as there are.
std::string pathsDeck(const std::string& geometry, const std::string& axes, const std::string& more,
                      const std::string& start, const std::string& sides) {
  const std::string gas = "temperature: 1600 K, composition: \"C2H2: 0.1, H2: 0.1, H: 0.001, N2: 0.8\"";
  return "problem: flow\nmechanism: " + test::sourcePath("cases/mechanisms/ethylene_bisetti2012_47.yaml") +
         "\nmesh: {geometry: " + geometry + ", " + axes + more + "}\nboundaries:\n  in: {type: inlet, side: x-min, " +
         "velocity: 2 m/s, " + gas + "}\n  out: {type: outlet, side: x-max, " + gas + "}\n" + sides +
         "time: {end: 1 us}\ninitial: {layer: none, " + gas +
         "}\nparticles: {description: two_equation_dimer, pah: [A2]}\n" +
         "trajectories: {duration: 1 ms, time_step: 50 us, particles: 64, start: [" + start + "]}\n";
}
const std::string axesOfPlane = "x: [{to: 6 mm, cells: 6}], y: [{to: 4 mm, cells: 4}]";
const std::string sidesOfPlane =
    "  low: {type: wall, side: y-min, slip: true}\n  high: {type: wall, side: y-max, slip: true}\n";

FlowCase pathsCase(const std::string& text) {
  return readFlowCase(Deck::parse(text, "deck.yaml", {}, flowSchema()));
}

struct Starts {
  explicit Starts(const std::string& text)
      : flowCase(pathsCase(text)),
        mesh(makeMesh(MPI_COMM_WORLD, flowCase)),
        halo(mesh),
        thermo(*flowCase.mechanism),
        transport(*flowCase.mechanism),
        context{mesh, halo, *flowCase.mechanism, thermo, transport, flowCase.boundaries} {}
  FlowCase flowCase;
  Mesh mesh;
  HaloExchange halo;
  Thermo thermo;
  Transport transport;
  FlowContext context;
};

TEST(Trajectories, StartByTheAxesOfTheMesh) {
  const auto startOf = [](const std::string& text) { return pathsCase(text).trajectories->starts.at(0); };
  EXPECT_EQ(startOf(pathsDeck("planar", axesOfPlane, "", "{x: 1 mm, y: 2 mm}", sidesOfPlane)),
            (Vector3{1e-3, 2e-3, 0.0}));
  EXPECT_EQ(startOf(pathsDeck("planar", axesOfPlane, "", "{r: 1 mm, z: 2 mm}", sidesOfPlane)),
            (Vector3{1e-3, 2e-3, 0.0}));
  EXPECT_EQ(startOf(pathsDeck(
                "space", axesOfPlane, ", z: [{to: 3 mm, cells: 3}]", "{x: 1 mm, y: 2 mm, z: 2.5 mm}",
                sidesOfPlane + "  ends: {type: periodic, side: z-min}\n  ends2: {type: periodic, side: z-max}\n")),
            (Vector3{1e-3, 2e-3, 2.5e-3}));
  for (const auto& [start, expected] : {std::pair{"{x: 1 mm}", "needs the key 'y'"},
                                        std::pair{"{x: 1 mm, y: 2 mm, z: 1 mm}", "the axes of this mesh are x and y"},
                                        std::pair{"{r: 1 mm, y: 2 mm}", "the axes of this mesh are x and y"}})
    EXPECT_THAT(test::messageOf<InputError>(
                    [&, from = start] { startOf(pathsDeck("planar", axesOfPlane, "", from, sidesOfPlane)); }),
                testing::HasSubstr(expected));
}

TEST(Trajectories, StartWhereThereAreCells) {
  const std::string solid = ", solids: {rod: {x: [2 mm, 3 mm], y: [1 mm, 3 mm]}}",
                    sides = sidesOfPlane + "  rod: {type: wall, solid: rod}\n";
  const auto check = [&](const std::string& start) {
    Starts starts(pathsDeck("planar", axesOfPlane, solid, start, sides));
    Trajectories(starts.flowCase).check(starts.context);
  };
  EXPECT_NO_THROW(check("{x: 1.5 mm, y: 2 mm}"));
  for (const auto& [start, expected] :
       {std::pair{"{x: 2.5 mm, y: 2 mm}", "has no cell there"}, std::pair{"{x: 9 mm, y: 2 mm}", "outside the mesh"},
        std::pair{"{x: 6 mm, y: 2 mm}", "lies on the outlet 'out'"}})
    EXPECT_THAT(test::messageOf<InputError>([&, from = start] { check(from); }),
                testing::AllOf(testing::HasSubstr("trajectories.start[0]"), testing::HasSubstr(expected)));
}

// In space beside a solid: gas and position of the points, one column an axis, and where a path ends.
Datasets pathsBesideASolid(const fs::path& folder, double timeStep, double duration) {
  Starts flow(
      pathsDeck("space", axesOfPlane, ", z: [{to: 3 mm, cells: 3}], solids: {rod: {x: [3 mm, 4 mm], y: [0 mm, 1 mm]}}",
                "{x: 1 mm, y: 3.2 mm, z: 1.3 mm}, {x: 1 mm, y: 0.5 mm, z: 1.3 mm}",
                sidesOfPlane + "  front: {type: symmetry, side: z-min}\n  back: {type: symmetry, side: z-max}\n" +
                    "  rod: {type: wall, solid: rod}\n"));
  flow.flowCase.trajectories->timeStep = timeStep;
  flow.flowCase.trajectories->duration = duration;
  State state(flow.mesh, flow.flowCase.mechanism->numSpecies(),
              {CarriedOperator::blockOf(*flow.flowCase.carried, flow.flowCase.boundaries)});
  setMixingLayer(flow.context, flow.flowCase.initial, state);
  for (int c = 0; c < flow.mesh.cells; ++c) state.velocity[3 * static_cast<std::size_t>(c)] = 2.0;
  GasProperties properties;
  properties.update(flow.context, state);
  ResultsWriter results(MPI_COMM_WORLD, folder / "results.h5", {}, meshOutput(flow.mesh));
  Trajectories(flow.flowCase).run(flow.context, state, properties, results, nullptr);
  results.close();
  return test::worldRank() == 0 ? readTrajectories(folder / "results.h5") : Datasets{};
}

TEST(Trajectories, InSpaceBesideASolid) {
  const test::SharedScratchFolder folder;
  Datasets all = pathsBesideASolid(folder.path(), 5e-5, 1e-3);
  if (test::worldRank() != 0) return;
  for (const std::string id : {"0", "1"}) {
    ASSERT_EQ(all[id + "/time"].size(), 21U);
    ASSERT_EQ(all[id + "/position"].size(), 63U);
    EXPECT_NEAR(all[id + "/position"][62], 1.3e-3, 1e-12);
    for (const double T : all[id + "/temperature"]) EXPECT_NEAR(T, 1600.0, 1e-9);
  }
  EXPECT_NEAR(all["0/position"][60], 3e-3, 1e-12) << "1 ms at 2 m/s";
  EXPECT_NEAR(all["0/position"][61], 3.2e-3, 1e-12);
  EXPECT_LT(all["1/position"][60], 3e-3) << "the rod holds the gas beside it";
  EXPECT_GT(all["1/position"][60], 2.5e-3);
}

TEST(Trajectories, OneThatMeetsAWallEndsThere) {
  const test::SharedScratchFolder folder;
  testing::internal::CaptureStderr();
  Datasets all = pathsBesideASolid(folder.path(), 1.2e-3, 2.4e-3);  // steps so long that they end in the rod
  const std::string warning = testing::internal::GetCapturedStderr();
  if (test::worldRank() != 0) return;
  EXPECT_EQ(all["0/time"].size(), 3U);
  EXPECT_EQ(all["1/time"].size(), 1U);
  EXPECT_THAT(warning, testing::HasSubstr("trajectory 1 from (0.001, 0.0005, 0.0013) m meets the wall 'rod' at (0.003, "
                                          "0.0005, 0.0013) m after 0 s: it ends there, without particles"));
}

TEST(Trajectories, AreTheSameBitsOnAnyNumberOfRanks) {
  const test::SharedScratchFolder folder;
  writeTrajectories(MPI_COMM_WORLD, folder.path() / "all.h5", 7);
  if (test::worldRank() == 0) {
    writeTrajectories(MPI_COMM_SELF, folder.path() / "one.h5", 7);
    writeTrajectories(MPI_COMM_SELF, folder.path() / "other_seed.h5", 8);
    const Datasets all = readTrajectories(folder.path() / "all.h5");
    const Datasets one = readTrajectories(folder.path() / "one.h5");
    EXPECT_EQ(all.size(), 5U * 18U);
    EXPECT_EQ(all, one);
    // The random numbers are really the seed's.
    EXPECT_NE(one, readTrajectories(folder.path() / "other_seed.h5"));
    for (const std::string id : {"0", "1", "2", "3"}) {
      EXPECT_EQ(one.at(id + "/time").size(), 41U) << "2 ms in steps of 50 us, and the start";
      EXPECT_EQ(one.at(id + "/soot_number_density").front(), 0.0);
      EXPECT_GT(one.at(id + "/soot_number_density").back(), 0.0);
      EXPECT_GT(one.at(id + "/soot_mean_diameter").back(), 0.5e-9);
    }
    EXPECT_LT(one.at("4/time").size(), 41U) << "leaves the domain";
    EXPECT_NE(one.at("0/soot_number_density"), one.at("1/soot_number_density"));
  }
}

}  // namespace
}  // namespace lampblack::app
