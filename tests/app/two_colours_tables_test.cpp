// What a run writes of a kind of particles that nothing here knows (two_colours.hpp): history, classes, distributions.
#include <gtest/gtest.h>

#include <numeric>

#include "app/problems/reactor/reactor_case.hpp"
#include "app/problems/reactor/reactor_driver.hpp"
#include "core/modules.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/coupling/two_colours.hpp"
#include "tests/shared_scratch.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app {
namespace {

using test::TwoColours;

ReactorCase paintedCase() {
  const std::string deck =
      "problem: reactor\nmechanism: " + test::sourcePath("cases/mechanisms/ethylene_bisetti2012_47.yaml") +
      "\nreactor: {type: constant_volume, energy: isothermal}\n"
      "initial: {temperature: 500 K, composition: \"N2: 0.998, C2H2: 0.002\"}\n"
      "time: {end: 2 ms}\noutput: {interval: 1 ms}\n";
  ReactorCase painted = readReactorCase(Deck::parse(deck, "deck.yaml", {}, reactorSchema()));
  ReactorPopulations of;
  of.make = [mechanism = painted.mechanism](std::uint64_t owner) {
    auto population = TwoColours::some(*mechanism, 1e-14);
    population->dilute(owner == 0 ? 0.9 : 1.1);
    return population;
  };
  const auto kind = of.make(0);
  of.material = kind->material();
  of.elements = kind->elements();
  of.species = kind->species();
  of.repeats = 2;
  of.bins = {-9.0, -6.0, 30};
  of.classes = {{0, {0.5}}};
  painted.ensemble = std::move(of);
  painted.couplingChange = 0.05;
  return painted;
}

TEST(TwoColours, InTheTablesOfAReactor) {
  const test::SharedScratchFolder scratch;
  const ReactorCase painted = paintedCase();
  const RunFolder folder = RunFolder::prepare(scratch.path() / "run", false, MPI_COMM_WORLD);
  const auto driver = ensembleReactorDriver(painted);
  driver->run(MPI_COMM_WORLD, folder);
  ResultsWriter results(MPI_COMM_WORLD, folder.results(), {});
  driver->write(results);
  results.close();
  const Hdf5Reader file(folder.results());
  const double number = 12.0 * TwoColours::eachNumber;
  // Means of the repeats, which differ by a tenth on both sides.
  EXPECT_NEAR(file.numbers("/history/paint_number_density").at(2) / number, 1.0, 1e-12);
  EXPECT_NEAR(file.numbers("/history/paint_number_density_error").at(2) / (0.1 * number), 1.0, 1e-12);
  const auto fractions = file.numbers("/history/paint_volume_fraction");
  EXPECT_NEAR(fractions.at(0) / (number * TwoColours::carbonAtStart / TwoColours::density), 1.0, 1e-12);
  EXPECT_GT(fractions.at(2), fractions.at(1));
  EXPECT_LT(file.numbers("/history/element_imbalance").at(2), 1e-12);
  // Four of twelve are red, and have gained three times as much as the blue ones.
  EXPECT_EQ(file.shape("/classes/shade/fraction").at(0), 6);
  EXPECT_NEAR(file.numbers("/classes/shade/fraction").at(4), 4.0 / 12.0, 1e-12);
  const auto carbon = file.numbers("/classes/shade/carbon");
  EXPECT_NEAR((carbon.at(4) - carbon.at(0)) / (carbon.at(5) - carbon.at(1)), 3.0, 1e-9);
  // A row of each distribution is the number.
  const auto sizes = file.numbers("/particles/size_distribution");
  EXPECT_NEAR(std::accumulate(sizes.end() - 30, sizes.end(), 0.0) * 0.1 / number, 1.0, 1e-12);
  const auto shades = file.numbers("/particles/shade_distribution");
  EXPECT_NEAR(shades.at(100) / 50.0 / (number * 4.0 / 12.0), 1.0, 1e-12);
  EXPECT_NEAR(shades.at(149) / 50.0 / (number * 8.0 / 12.0), 1.0, 1e-12);
}

}  // namespace
}  // namespace lampblack::app
