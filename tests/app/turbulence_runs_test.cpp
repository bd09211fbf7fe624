// Runs with each model of turbulence: they go on from a checkpoint and onto other pieces of the mesh as if nothing had
// been, give the same on any number of ranks, and where there are no eddies the flow without a model.
#include "tests/app/turbulent_run.hpp"

namespace lampblack::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Warm gas between a cold wall and the middle of a channel, seven steps.
Deck turbulentDeck(const std::string& turbulence, const std::string& atInlet, double speed,
                   std::vector<std::string> more = {}) {
  more.insert(more.begin(), "checkpoint.steps=3");
  return test::flowDeck("perfect_gas_1.yaml",
                        fmt::format(R"(
turbulence: {{{}}}
mesh: {{geometry: planar, x: [{{to: 200 mm, cells: 6}}], y: [{{to: 20 mm, cells: 8, ratio: 10}}]}}
boundaries:
  in: {{type: inlet, side: x-min, velocity: {} m/s, temperature: 400 K, composition: "GAS: 1"{}}}
  out: {{type: outlet, side: x-max, temperature: 300 K, composition: "GAS: 1"}}
  wall: {{type: wall, side: y-min, temperature: 300 K}}
  middle: {{type: symmetry, side: y-max}}
initial: {{layer: none, composition: "GAS: 1", temperature: 300 K, formula: {{velocity_x: "{}*(y/0.02)^0.2"}}}}
time: {{end: {} ms, first_step: {} ms, maximum_step: {} ms}}
output: {{boundaries: [wall]}}
)",
                                    turbulence, speed, atInlet, speed, 5.0 / speed, 1.0 / speed, 1.0 / speed),
                        more);
}

// A model, and what stands beside its name.
class TurbulenceRuns : public testing::TestWithParam<std::string> {};

TEST_P(TurbulenceRuns, GoOnAndMoveAndDoNotDependOnRanks) {
  const test::SharedScratchFolder scratch;
  const Deck deck = turbulentDeck("model: " + GetParam() + ", eddy_viscosity_ratio: 20, energy: 0.5 m^2/s^2",
                                  ", turbulence_intensity: 0.05, turbulence_length: 2 mm", 20.0);
  const auto whole = scratch.path() / "whole";
  const test::Ran all = resultsOf({deck, whole});
  for (const TurbulenceModel::Variable& variable :
       turbulenceModel(GetParam().substr(0, GetParam().find(',')))->variables()) {
    const auto& values = all.fields.at("000005/" + variable.name);
    EXPECT_LT(*std::ranges::min_element(values), 0.9 * *std::ranges::max_element(values));
  }
  expectSameBits(resultsOf({deck, scratch.path() / "rest", whole}), all);
  expectSameFields(resultsOf({deck, scratch.path() / "moved", whole, true}), all, 1e-7);
  if (test::worldSize() == 1) return;
  MPI_Comm one = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, test::worldRank() == 0 ? 0 : MPI_UNDEFINED, 0, &one);
  expectSameFields(resultsOf({deck, scratch.path() / "one", {}, false, one}), all, 1e-7);
  if (one != MPI_COMM_NULL) MPI_Comm_free(&one);
}

// First centres are about 0.3 mm from the wall. What the start does not tell is not warned of.
TEST(TurbulenceRuns, ThinCellsAreToldBeforeARunBySpeedsOfTheStart) {
  const auto told = [](double speed, const std::vector<std::string>& more) {
    FlowLoop loop(MPI_COMM_WORLD,
                  readFlowCase(turbulentDeck("model: k_epsilon, eddy_viscosity_ratio: 20, energy: 0.01 m^2/s^2",
                                             ", turbulence_intensity: 0.05, turbulence_length: 2 mm", speed, more)));
    testing::internal::CaptureStderr();
    loop.warnOfStart();
    return testing::internal::GetCapturedStderr();
  };
  const std::string thin = told(1.0, {});
  if (test::worldRank() == 0) {
    EXPECT_THAT(thin, AllOf(HasSubstr("on 100 % of the walls"), HasSubstr("largest speed of the start, 1.1")));
  }
  EXPECT_EQ(told(20.0, {}), "");
  EXPECT_EQ(told(1.0, {"boundaries.wall.tangential_velocity=30 m/s"}), "");
  EXPECT_EQ(told(1.0, {"boundaries.wall.formula.tangential_velocity=30*t"}), "");
  EXPECT_EQ(told(1.0, {"turbulence.walls=automatic"}), "");
}

// A model and how it meets walls; empty: none.
class IdleRestarts : public testing::TestWithParam<std::string> {
 protected:
  // `first` ends where a checkpoint of `further` has been; a run that goes on from there has nothing to do.
  static void expectTheSame(const std::vector<std::string>& first, const std::vector<std::string>& further) {
    const test::SharedScratchFolder scratch;
    const bool isLaminar = GetParam().empty();
    const auto run = [&](const char* name, std::vector<std::string> settings,
                         const std::optional<std::filesystem::path>& restart = {}) {
      if (isLaminar) settings.emplace_back("turbulence={model: none}");
      const std::string start = ", eddy_viscosity_ratio: 20, energy: 0.5 m^2/s^2";
      test::runFlow(turbulentDeck("model: " + (isLaminar ? "sst" : GetParam()) + start,
                                  isLaminar ? "" : ", turbulence_intensity: 0.05, turbulence_length: 2 mm",
                                  isLaminar ? 0.2 : 20.0, settings),
                    scratch.path() / name, restart);
      MPI_Barrier(MPI_COMM_WORLD);
    };
    run("first", first);
    const Hdf5Reader expected(scratch.path() / "first/results.h5");
    const auto steps = static_cast<int>(expected.numbers("/history/step").back());
    std::vector<std::string> settings = further;
    settings.push_back(fmt::format("checkpoint.steps={}", steps));
    run("further", settings);
    run("idle", first, scratch.path() / fmt::format("further/checkpoint/step_{:06}.h5", steps));
    expectSameBits(test::readBack(scratch.path() / "idle/results.h5"),
                   test::readBack(scratch.path() / "first/results.h5"));
    const Hdf5Reader found(scratch.path() / "idle/results.h5");
    ASSERT_EQ(expected.numbers("/walls/wall/step").back(), steps);
    for (const std::string& column : expected.names("/walls/wall"))
      EXPECT_EQ(found.numbers("/walls/wall/" + column), expected.numbers("/walls/wall/" + column)) << column;
  }
};

TEST_P(IdleRestarts, OfASteadyRunHaveItsFieldsAndWalls) {
  const auto until = [](const char* residual) {
    return std::vector<std::string>{fmt::format(
        "time={{mode: steady, first_step: 0.05 ms, maximum_step: 0.2 ms, steady: {{residual: {}}}}}", residual)};
  };
  // Iterations go another way where the residual that is wanted is far below; those of sst pass over 1e-4.
  expectTheSame(until("1e-3"), until(GetParam().starts_with("sst") ? "1e-6" : "1e-4"));
}

// Steps of 2^-14 s, which add up to the end without round-off; the last has no row in the checkpoint.
TEST_P(IdleRestarts, OfARunInTimeHaveItsFieldsAndWalls) {
  const auto until = [](double steps) {
    constexpr double step = 0.00006103515625;
    return std::vector<std::string>{
        fmt::format("time={{end: {} s, first_step: {} s, maximum_step: {} s}}", steps * step, step, step),
        "output.history_steps=2"};
  };
  expectTheSame(until(3.0), until(8.0));
}

// Nothing but round-off: nu_t is 1e-30 of the viscosity.
class RunsWithoutEddies : public testing::TestWithParam<std::string> {};

TEST_P(RunsWithoutEddies, AreLaminarFlows) {
  const test::SharedScratchFolder scratch;
  const test::Ran laminar = resultsOf({turbulentDeck("model: none", "", 1.0), scratch.path() / "laminar"});
  const test::Ran without =
      resultsOf({turbulentDeck("model: " + GetParam() + ", eddy_viscosity_ratio: 1e-30, energy: 1e-35 m^2/s^2",
                               ", turbulence_intensity: 1e-17, eddy_viscosity_ratio: 1e-30", 1.0),
                 scratch.path() / "without"});
  for (const auto& [name, values] : laminar.fields) {
    const std::vector<double>& others = without.fields.at(name);
    const auto [low, high] = std::ranges::minmax(values);
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(others[i], values[i], 1e-11 * (high - low)) << name;
  }
}

std::vector<std::string> eachModel() {
  std::vector<std::string> names;
  for (const TurbulenceRow& row : turbulenceModels()) names.emplace_back(row.name);
  return names;
}

std::string nameOf(const testing::TestParamInfo<std::string>& parameter) {
  std::string name = parameter.param;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_'; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(One, TurbulenceRuns,
                         testing::Values("k_epsilon", "sst, walls: automatic", "k_epsilon, walls: automatic"), nameOf);
INSTANTIATE_TEST_SUITE_P(One, IdleRestarts,
                         testing::Values("", "sa", "k_epsilon", "sst, walls: automatic", "k_epsilon, walls: automatic"),
                         [](const auto& of) { return of.param.empty() ? "laminar" : nameOf(of); });
INSTANTIATE_TEST_SUITE_P(Long, TurbulenceRuns, testing::ValuesIn(eachModel()), nameOf);
INSTANTIATE_TEST_SUITE_P(Long, RunsWithoutEddies, testing::ValuesIn(eachModel()), nameOf);

const std::string sstAtStart = "model: sst, eddy_viscosity_ratio: 20, energy: 0.5 m^2/s^2";
const std::string sstAtInlet = ", turbulence_intensity: 0.05, turbulence_length: 2 mm";

// Of another model the checkpoint is refused by both names, though its variables have the same names; as the start of
// a flow its results serve.
TEST(TurbulenceStarts, FromARunOfAnotherModel) {
  const test::SharedScratchFolder scratch;
  const auto earlier = scratch.path() / "earlier";
  const Deck sst = turbulentDeck(sstAtStart, sstAtInlet, 20.0, {"output.species=[all]"});
  const test::Ran before = resultsOf({sst, earlier});
  const std::string refused = test::messageOf<InputError>([&] {
    test::runFlow(turbulentDeck("model: k_omega, energy: 0.3 m^2/s^2", sstAtInlet, 20.0), scratch.path() / "on",
                  earlier);
  });
  EXPECT_THAT(refused, HasSubstr("of another turbulence model (its own: sst; of the deck: k_omega)"));
  EXPECT_TRUE(test::sameOnAllRanks(refused));
  const auto startOf = [&](const std::string& model) {
    return resultsOf({turbulentDeck("energy: 0.3 m^2/s^2, model: " + model, sstAtInlet, 20.0,
                                    {"initial={layer: none, flow: {results: " + earlier.string() + "}}"}),
                      scratch.path() / model});
  };
  const test::Ran same = startOf("k_omega"), otherwise = startOf("k_epsilon");
  for (const char* field : {"/turbulent_kinetic_energy", "/omega_root", "/eddy_viscosity", "/temperature"}) {
    const std::vector<double>&was = before.fields.at("000005" + std::string(field)),
          &is = same.fields.at("000000" + std::string(field));
    for (std::size_t c = 0; c < was.size(); ++c) EXPECT_NEAR(is[c], was[c], 1e-9 * std::abs(was[c])) << field << c;
  }
  // Epsilon is not there, and k alone is no start.
  for (const double k : otherwise.fields.at("000000/turbulent_kinetic_energy")) EXPECT_NEAR(k, 0.3, 1e-12);
}

// A formula whose energy is below zero at a face: with the face's place.
TEST(TurbulenceStarts, NeedEnergyAboveZeroAtEachFaceOfAnInlet) {
  const test::SharedScratchFolder scratch;
  const std::string message = test::messageOf<InputError>([&] {
    test::runFlow(
        turbulentDeck(sstAtStart, ", formula: {turbulent_kinetic_energy: \"0.5 - 30*y\", turbulent_dissipation: \"2\"}",
                      20.0),
        scratch.path() / "out");
  });
  EXPECT_THAT(message, AllOf(HasSubstr("boundaries.in: at (0, 0.01"), HasSubstr("are to be above zero, found -0.")));
  EXPECT_TRUE(test::sameOnAllRanks(message));
}

// The message has the place and the variables.
TEST(TurbulenceStarts, EndWhereEddiesAreTooViscous) {
  const test::SharedScratchFolder scratch;
  const std::string message = test::messageOf<NumericsError>([&] {
    test::runFlow(turbulentDeck(sstAtStart + ", largest_eddy_viscosity_ratio: 19", sstAtInlet, 20.0),
                  scratch.path() / "out");
  });
  EXPECT_THAT(message, AllOf(HasSubstr("in the cell at ("), HasSubstr("the eddy viscosity is "),
                             HasSubstr(" more than 19 (turbulence.largest_eddy_viscosity_ratio), "
                                       "turbulent_kinetic_energy 0.5"),
                             HasSubstr("omega_root 0.0")));
  EXPECT_TRUE(test::sameOnAllRanks(message));
}

// In steady mode an iteration that leads there is taken back.
TEST(TurbulenceStarts, TakeIterationsBackWhereEddiesAreTooViscous) {
  const test::SharedScratchFolder scratch;
  const std::string taken = test::messageOf<NumericsError>([&] {
    test::runFlow(
        turbulentDeck("model: sst, energy: 0.5 m^2/s^2, eddy_viscosity_ratio: 1, largest_eddy_viscosity_ratio: 40",
                      sstAtInlet, 20.0,
                      {"time={mode: steady, first_step: 1 us, maximum_step: 1 us, steady: {steps: 2, returns: 1}}"}),
        scratch.path() / "out");
  });
  EXPECT_THAT(taken, AllOf(HasSubstr("in 6 steps in time and 2 iterations (the last of which: in the cell at ("),
                           HasSubstr(" more than 40 (turbulence.largest_eddy_viscosity_ratio)")));
  EXPECT_TRUE(test::sameOnAllRanks(taken));
}

}  // namespace
}  // namespace lampblack::app
