// What decks of aggregates of spheres become, and what is refused.
#include "app/problems/aggregates/aggregates_case.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "app/problems/aggregates/aggregates_output.hpp"
#include "core/errors.hpp"
#include "particles/aggregates/aggregates_repeat.hpp"
#include "particles/trees/tree_material.hpp"
#include "tests/messages.hpp"
#include "tests/scratch.hpp"

namespace lampblack::app {
namespace {

using testing::HasSubstr;

AggregatesCase readAggregates(const std::string& more, const std::filesystem::path& beside = "deck.yaml") {
  return readAggregatesCase(Deck::parse("problem: aggregates\nspheres: {radius: 10 nm, density: 1800 kg/m^3}\n" + more,
                                        beside, {}, aggregatesSchema()));
}

std::string refusedAggregates(const std::string& more) {
  return test::messageOf<InputError>([&] { (void)readAggregates(more); });
}

const std::string inHotGas = "gas: {temperature: 1500 K}\ntime: {end: 1 s, outputs: 4}\n";
const std::string someSintering = "sintering: {mechanism: constant, prefactor: 0.1}\n";

TEST(AggregatesCase, RowsOfWhatIsBuiltAndOfItsTime) {
  const AggregatesCase doubled = readAggregates("build: {by: equal_pairs, doublings: 3, aggregates: 5}");
  EXPECT_EQ(doubled.sizes(), (std::vector<std::size_t>{1, 2, 4, 8}));
  EXPECT_EQ(doubled.rows(), 4U);
  EXPECT_EQ(doubled.timeOf(3), 0);
  const AggregatesCase single = readAggregates("build: {by: single_spheres, spheres: 10}\n" + inHotGas + someSintering);
  EXPECT_EQ(single.sizes(), (std::vector<std::size_t>{1, 2, 4, 8, 10}));
  EXPECT_EQ(single.rows(), 9U);
  EXPECT_EQ(single.timeOf(4), 0);
  EXPECT_DOUBLE_EQ(single.timeOf(5), 0.25);
  EXPECT_DOUBLE_EQ(single.timeOf(8), 1);
  const AggregatesCase colliding = readAggregates(
      "build: {by: collisions, number: 1e16 1/m^3}\ngas: {temperature: 1500 K}\n"
      "time: {end: 1 s, outputs: 3, spacing: logarithmic, first: 0.01 s}");
  EXPECT_EQ(colliding.rows(), 4U);
  EXPECT_NEAR(colliding.times[2], 0.1, 1e-15);
  EXPECT_EQ(colliding.population.material.sintering.mechanism, SinteringMechanism::none);
}

TEST(AggregatesCase, SilicaHasItsLawAndDensity) {
  const AggregatesCase made = readAggregatesCase(Deck::parse(
      "problem: aggregates\nspheres: {radius: 10 nm, material: silica}\nbuild: {by: equal_pairs}\n" + inHotGas,
      "deck.yaml", {}, aggregatesSchema()));
  EXPECT_EQ(made.population.material.density, silica().density);
  EXPECT_EQ(made.population.material.sintering.mechanism, SinteringMechanism::viscousFlow);
  EXPECT_EQ(made.population.material.sintering.prefactor, silica().sintering.prefactor);
}

TEST(AggregatesCase, RefusesWhatHasNoMeaning) {
  const std::string build = "build: {by: equal_pairs}\n", collisions = "build: {by: collisions, number: 1e16 1/m^3}\n";
  EXPECT_THAT(refusedAggregates(collisions), HasSubstr("give the section 'gas'"));
  EXPECT_THAT(refusedAggregates(collisions + "gas: {temperature: 1500 K}"), HasSubstr("give the section 'time'"));
  EXPECT_THAT(refusedAggregates(build + "gas: {temperature: 1500 K}"), HasSubstr("give the section 'time'"));
  EXPECT_THAT(refusedAggregates(build + "time: {end: 1 s}"), HasSubstr("give the section 'gas'"));
  EXPECT_THAT(refusedAggregates(build + someSintering), HasSubstr("give the section 'gas'"));
  EXPECT_THAT(refusedAggregates(build + inHotGas + "sintering: {mechanism: constant}"), HasSubstr("'prefactor'"));
  EXPECT_THAT(refusedAggregates("build: {by: collisions}\n" + inHotGas), HasSubstr("there are no particles"));
  EXPECT_THAT(refusedAggregates(build + "gas: {temperature: 1500 K, births: 1e15 1/m^3/s}\ntime: {end: 1 s}"),
              HasSubstr("only where build.by is 'collisions'"));
  EXPECT_THAT(refusedAggregates(collisions + "gas: {temperature: 1500 K, births: 1e15 1/m^3/s}\ntime: {end: 1 s}"),
              HasSubstr("'births' and 'birth_diameter' belong together"));
  EXPECT_THAT(refusedAggregates(build + "gas: {pressure: 1 atm}\ntime: {end: 1 s}"), HasSubstr("either 'temperature'"));
  EXPECT_THAT(refusedAggregates(build + "gas: {file: a.csv, growth: 1 nm/s}\ntime: {end: 1 s}"),
              HasSubstr("'gas.file' says this"));
  EXPECT_THAT(refusedAggregates("build: {by: single_spheres, doublings: 3}"), HasSubstr("doublings"));
  EXPECT_THAT(refusedAggregates(build + inHotGas), HasSubstr("nothing happens in it"));
  EXPECT_THAT(refusedAggregates("build: {by: collisions, number: 1e16 1/m^3, collision_size: lines}\n" + inHotGas),
              HasSubstr("'kernel: free_molecular' alone"));
}

TEST(AggregatesCase, AGasFromATable) {
  const test::ScratchFolder scratch;
  const auto write = [&](const std::string& text) {
    std::ofstream(scratch.path() / "gas.csv") << text;
    return readAggregates("build: {by: collisions}\ngas: {file: gas.csv, birth_diameter: 2 nm}\ntime: {end: 1 s}",
                          scratch.path() / "deck.yaml")
        .gas;
  };
  const AggregatesGas gas = write(
      "time [ms],temperature [K],pressure [atm],births [1/cm^3/s],growth [nm/s]\n0,1000,1,1e10,0\n10,2000,1,0,4\n");
  EXPECT_DOUBLE_EQ(gas.at(0.0025).temperature, 1250);
  EXPECT_DOUBLE_EQ(gas.at(7).temperature, 2000);
  EXPECT_DOUBLE_EQ(gas.birthsAt(0.005), 0.5e16);
  EXPECT_DOUBLE_EQ(gas.growthAt(0.005), 2e-9);
  EXPECT_DOUBLE_EQ(gas.nextChange(0.001), 0.01);
  EXPECT_EQ(gas.nextChange(0.01), HUGE_VAL);
  EXPECT_NEAR(gas.at(0).viscosity, 1.458e-6 * std::pow(1000, 1.5) / 1110.4, 1e-15);
  EXPECT_NEAR(gas.at(0).density, 101325 * 0.02897 / (8.314462618 * 1000), 1e-9);
  const auto refusal = [&](const std::string& text) { return test::messageOf<InputError>([&] { (void)write(text); }); };
  const std::string head = "time,temperature,pressure,births\n";
  EXPECT_THAT(refusal("time,temperature\n0,1000\n"), HasSubstr("expected a column 'pressure'"));
  EXPECT_THAT(refusal(head), HasSubstr("no rows"));
  EXPECT_THAT(refusal(head + "0,0,1e5,1\n"), HasSubstr("line 2: 'temperature' has to be above zero"));
  EXPECT_THAT(refusal(head + "0,1000,1e5,-1\n"), HasSubstr("'births' has to be at least zero"));
  EXPECT_THAT(refusal(head + "1,1000,1e5,1\n1,1000,1e5,1\n"), HasSubstr("line 3: times have to rise"));
  EXPECT_THAT(refusal("time,temperature,pressure,births,x\n0,1000,1e5,1,1\n"), HasSubstr("the column 'x'"));
}

// Rows of repeats become means and errors.
TEST(AggregatesCase, RowsOfARepeatAndTheirMeans) {
  AggregatesCase made = readAggregates("build: {by: equal_pairs, doublings: 2, aggregates: 20}\nrepeats: 2");
  const std::size_t width = aggregateQuantities().size();
  const auto at = [&](const std::string& name) {
    const auto& all = aggregateQuantities();
    return static_cast<std::size_t>(std::ranges::find(all, name, &Quantity::name) - all.begin());
  };
  std::vector<double> rows(2 * made.rows() * width);
  std::vector<SphereAggregate> last;
  for (const std::uint64_t repeat : {0U, 1U})
    runAggregates(made, repeat, std::span(rows).subspan(repeat * made.rows() * width, made.rows() * width),
                  repeat == 0 ? &last : nullptr);
  EXPECT_EQ(last.size(), 12U);
  EXPECT_EQ(last[0].count(), 4U);
  EXPECT_DOUBLE_EQ(rows[2 * width + at("spheres")], 4);
  EXPECT_DOUBLE_EQ(rows[width + at("coordination")], 1);
  EXPECT_NEAR(rows[width + at("gyration")], std::sqrt(1.6) * 1e-8, 1e-21);
  EXPECT_NEAR(rows[width + at("gyration_points")], 1e-8, 1e-21);
  EXPECT_NEAR(rows[width + at("length")], 4e-8, 1e-20);
  EXPECT_NEAR(rows[at("shadow")], M_PI * 1e-16, 1e-28);
  EXPECT_NEAR(rows[at("mobility_diameter")], 2e-8, 1e-20);
  EXPECT_NEAR(rows[width + at("shadow")], 1.8488 * M_PI * 1e-16, 0.03 * M_PI * 1e-16);
  EXPECT_TRUE(std::isnan(rows[2 * width + at("fractal_dimension")]));  // none has output.fit_from spheres
  EXPECT_TRUE(std::isnan(rows[2 * width + at("number")]));
  made.fitFrom = 1;
  runAggregates(made, 0, std::span(rows).first(made.rows() * width), nullptr);
  EXPECT_DOUBLE_EQ(rows[2 * width + at("fitted")], 60);  // of all three sizes
  EXPECT_NEAR(rows[2 * width + at("fractal_dimension")], 2, 0.5);
  EXPECT_GE(rows[width + at("lines")], 1);
  const Table table = aggregateHistory(made, rows);
  const std::vector<double>& history = table.rows;
  const std::size_t columns = table.columns.size(), first = 2 + 4 * at("gyration");
  ASSERT_EQ(history.size(), made.rows() * columns);
  const double a = rows[2 * width + at("gyration")], b = rows[(made.rows() + 2) * width + at("gyration")];
  EXPECT_NE(a, b);
  EXPECT_NEAR(history[2 * columns + first], 0.5 * (a + b), 1e-22);
  EXPECT_NEAR(history[2 * columns + first + 1], 0.5 * std::abs(a - b), 1e-22);
}

}  // namespace
}  // namespace lampblack::app
