// Whether a steady state lasts: disturbances of a gas between two walls, which are known exactly.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/problems/flow/disturbed_flow.hpp"
#include "app/problems/flow/flow_mesh.hpp"
#include "core/modules.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/app/flow_runs.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double height = 4e-3;  // m
constexpr int cells = 12;

// Gas of 300 K between a wall that moves along itself and one at rest.
Deck betweenWalls(const std::vector<std::string>& overrides) {
  return test::flowDeck("perfect_gas_1.yaml", R"(
mesh: {geometry: planar, x: [{to: 2 mm, cells: 3}], y: [{to: 4 mm, cells: 12}]}
boundaries:
  low: {type: wall, side: y-min, temperature: 300 K}
  high: {type: wall, side: y-max, temperature: 300 K, tangential_velocity: 0.1 m/s}
  left: {type: periodic, side: x-min}
  right: {type: periodic, side: x-max}
initial: {layer: none, composition: "GAS: 1", temperature: 300 K}
time: {mode: steady, steady: {time: 0.1 s, stability: {time: 10 ms}}}
)",
                        overrides);
}

struct Told {
  std::vector<double> rates, frequencies, errors, velocity;
  std::string json;
  double viscosity = 0.0, conductivity = 0.0;
};

Told told(const std::filesystem::path& path, const std::vector<std::string>& overrides = {}) {
  const RunRecord record = test::runFlow(betweenWalls(overrides), path);
  const Hdf5Reader results(path / "results.h5");
  const std::string last = "/steps/" + results.names("/steps").back() + "/";
  Told told{{}, {}, {}, results.numbers(last + "velocity"), record.resultsJson};
  told.viscosity = results.numbers(last + "viscosity").front();
  told.conductivity = results.numbers(last + "conductivity").front();
  if (!results.has("/stability")) return told;
  told.rates = results.numbers("/stability/growth_rate");
  told.frequencies = results.numbers("/stability/frequency");
  told.errors = results.numbers("/stability/error");
  return told;
}

// Of a wave sin(k y) on cells of even height, whose walls are where it is zero: k^2.
double squareOf(double k) {
  const double h = height / cells;
  return std::pow(2.0 / h * std::sin(0.5 * k * h), 2);
}

TEST(SteadyStability, TellsTheRatesAtWhichMomentumAndHeatGoToTheWalls) {
  const test::SharedScratchFolder scratch;
  const Told found = told(scratch.path() / "found");
  ASSERT_GE(found.rates.size(), 4U);
  const FlowCase flowCase = readFlowCase(betweenWalls({}));
  const Thermo thermo(*flowCase.mechanism);
  const std::vector<double> Y{1.0};
  const double density = thermo.density(300.0, flowCase.pressure, Y), capacity = thermo.cpMass(300.0, Y);
  const double nu = found.viscosity / density, alpha = found.conductivity / (density * capacity);
  const double gamma = 1.0 / (1.0 - constants::gasConstant / (flowCase.mechanism->molecularWeights()[0] * capacity));
  // A layer that is warmer raises the pressure of the vessel, and with it all temperatures: tan x = -x/(gamma - 1), x
  // half the height in units of the wave's length over 2 pi.
  double low = 0.5 * std::numbers::pi + 1e-9, high = std::numbers::pi;
  while (high - low > 1e-12) {
    const double x = 0.5 * (low + high);
    (std::tan(x) < -x / (gamma - 1.0) ? low : high) = x;
  }
  const double pi = std::numbers::pi / height;
  const double expected[] = {nu * squareOf(pi), alpha * squareOf(2.0 * low / height), nu * squareOf(2.0 * pi),
                             alpha * squareOf(2.0 * pi)};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(-found.rates[i] / expected[i], 1.0, i == 1 ? 0.015 : 0.01) << i;
    EXPECT_EQ(found.frequencies[i], 0.0) << i;
    EXPECT_GT(found.errors[i], 0.0) << i;
    EXPECT_LT(found.errors[i], 0.03 * expected[i]) << i;
  }
  EXPECT_THAT(found.json, AllOf(HasSubstr("\"stable\": true"), HasSubstr("\"growth_rates_per_s\": "),
                                HasSubstr("\"frequencies_hz\": "), HasSubstr("\"errors_per_s\": ")));

  // Ten times the disturbance, and a tenth; and the state is what it is without.
  for (const char* size : {"1e-3", "1e-5"}) {
    const Told other = told(scratch.path() / size, {std::string("time.steady.stability.disturbance=") + size});
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(other.rates[i] / found.rates[i], 1.0, 2e-3) << size << ' ' << i;
  }
  const Told without = told(scratch.path() / "without", {"time.steady={time: 0.1 s}"});
  EXPECT_EQ(without.velocity, found.velocity);
  EXPECT_THAT(without.json, testing::Not(HasSubstr("stability")));
  EXPECT_TRUE(without.rates.empty());
}

// The same bits again, whatever was marched in between; and all that flows is part of what is marched.
TEST(SteadyStability, MarchesFromWhatItIsGiven) {
  FlowCase flowCase = readFlowCase(betweenWalls({"initial.formula={velocity_x: '25*y'}"}));
  const Thermo thermo(*flowCase.mechanism);
  Transport transport(*flowCase.mechanism, flowCase.transport.averaged());
  FlowDomain domain(makeMesh(MPI_COMM_WORLD, flowCase), flowCase, thermo, transport, flowCase.chemistry);
  domain.setStart(flowCase);
  domain.beginBudget(flowCase);
  DisturbedFlow disturbed(domain, flowCase, thermo, transport, 1e-3, 1e-3);
  const MarchedFlow marched = disturbed.marched();
  const std::vector<double>& flux = domain.state.massFlux;
  const auto isClose = [](double a, double b) { return std::abs(a - b) <= 1e-3 * std::abs(b) + 1e-12; };
  ASSERT_GT(std::ranges::max(flux), 1e-5);
  EXPECT_NE(std::search(marched.state.begin(), marched.state.end(), flux.begin(), flux.end(), isClose),
            marched.state.end());
  std::vector<double> first = marched.state, second = first, other = first;
  marched.march(first);
  for (double& value : other) value *= 1.001;
  marched.march(other);
  marched.march(second);
  EXPECT_EQ(first, second);
  EXPECT_NE(first, other);
}

}  // namespace
}  // namespace lampblack::app
