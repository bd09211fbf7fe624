// A kind of particles that no place knows (two_colours.hpp), in the places there are: a reactor, and the cells of a
// flow, which move it, go on from what was saved, and tell its sizes.
#include "tests/coupling/two_colours.hpp"

#include <gtest/gtest.h>

#include "chemistry/reactor/closed_reactor.hpp"
#include "core/state_backup.hpp"
#include "coupling/reactor_balance.hpp"
#include "coupling/reactor_population.hpp"
#include "coupling/split_gas.hpp"
#include "tests/coupling/cell_vessel.hpp"

namespace lampblack::test {
namespace {

constexpr double uptakeOfRed = 1e-14, carbonAtStart = TwoColours::carbonAtStart, eachNumber = TwoColours::eachNumber;

// Acetylene in cold nitrogen, which does not react.
TEST(TwoColours, InAReactorTakeUpWhatTheirLawSays) {
  const Mechanism& mechanism = ethylene().mechanism;
  const std::size_t n = mechanism.numSpecies(), acetylene = mechanism.speciesIndex("C2H2");
  GasState gas;
  gas.temperature = 500.0;
  gas.pressure = constants::oneAtmosphere;
  gas.Y = ethylene().massFractions("N2: 0.998, C2H2: 0.002");
  ReactorPopulation particles(TwoColours::some(mechanism, uptakeOfRed));
  ParticlesAtRest atRest(1, particles.elements());
  ClosedReactor reactor(mechanism, gas, ReactorSystem::Held::Density, TemperatureProfile(500.0), &atRest);
  SplitReactor::Gas own = splitGas(reactor, ReactorSystem::Held::Density);
  own.kept = {SplitReactor::Gas::Kept::temperature};
  SplitReactor::Options options;
  options.integrator = {1e-10, 1e-18, 0, 1000000};
  constexpr double end = 0.02, all = eachNumber * uptakeOfRed * (4.0 + 8.0 / 3.0);
  options.fixedStep = true;
  options.largestStep = end / 400;
  SplitReactor split(mechanism, own, particles, options);
  const std::vector<double> start = reactor.initialState();
  split.start(0, start);
  split.advance(end);
  const auto y = split.state();
  EXPECT_NEAR(y[acetylene] / start[acetylene] / std::exp(-all * end), 1.0, 1e-4);
  ReactorBalance balance(mechanism, atRest, atRest.unitElements(mechanism));
  const auto elements = [&](std::span<const double> at) {
    return balance.elements(at.first(n), at.subspan(n + 1, atRest.size()));
  };
  EXPECT_LT(largestImbalance(elements(start), elements(y)), 1e-13);
  EXPECT_GT(y[n + 1], 0.0);

  // Of classes by shade, the red have gained three times as much; distributions have all.
  const StochasticPopulation& kind = particles.population();
  ASSERT_EQ(kind.classedBy().size(), 1U);
  const std::vector<double> sums = kind.classSums(0, std::array{0.5});
  ASSERT_EQ(sums.size(), 8U);
  EXPECT_EQ(sums[0], 4.0 * eachNumber);
  EXPECT_EQ(sums[4], 8.0 * eachNumber);
  EXPECT_NEAR((sums[3] / sums[0] - carbonAtStart) / (sums[7] / sums[4] - carbonAtStart), 3.0, 1e-9);
  ASSERT_EQ(kind.distributions().size(), 1U);
  EXPECT_EQ(kind.distributions()[0].name, "");
  const SizeBins bins{-9.0, -6.0, 30};
  const std::vector<double> sizes = kind.distribution(0, bins);
  EXPECT_NEAR(std::accumulate(sizes.begin(), sizes.end(), 0.0) * bins.width() / (12.0 * eachNumber), 1.0, 1e-12);
  const std::vector<double> shades = kind.shareDistribution(0, 10);
  EXPECT_EQ(shades.front(), 40.0 * eachNumber);
  EXPECT_EQ(shades.back(), 80.0 * eachNumber);

  // A step that is taken back leaves no trace.
  const auto saved = particles.save();
  const std::vector<double> before = particles.content();
  particles.advance({{500.0, constants::oneAtmosphere, 0.7, 2.6e-5, 0.028}, std::array{1e-3, 0.0}}, 1e-3);
  EXPECT_NE(particles.content(), before);
  particles.restore(*saved);
  EXPECT_EQ(particles.content(), before);
}

struct Painted : CellVessel {
  Painted()
      : CellVessel(ethylene(),
                   [](const Vector3&) {
                     return Box::Local{{}, 500.0, ethylene().massFractions("N2: 0.99, C2H2: 0.01")};
                   },
                   std::make_shared<CellParticles>(ethylene().mechanism,
                                                   std::make_shared<TwoColours>(ethylene().mechanism, uptakeOfRed)),
                   {}) {
    for (int c = 0; c < box.mesh.owned; ++c)
      if (box.mesh.centre[at(c)][0] < 0.002)
        ensembles.initialise(state, c,
                             TwoColours::packed(TwoColours::someParticles(),
                                                packedOwner(static_cast<std::uint64_t>(box.mesh.naturalCell[at(c)]))));
  }
  // Of one colour, and those beyond the middle.
  [[nodiscard]] double numberOf(double colour, double beyond = 0.0) const {
    return integral(box.mesh, [&](int c) {
      double number = 0.0;
      if (box.mesh.centre[at(c)][0] > beyond)
        particles->rows().forEach(particles->rows().of(ensembles.populations()[at(c)]), [&](const double* row) {
          number += TwoColours::colourOf(row) == colour ? row[packedNumberAt] : 0.0;
        });
      return number;
    });
  }
};

TEST(TwoColours, InCellsMoveWithTheirColourAndKeepCarbonAndHydrogen) {
  Painted v;
  const double red = v.numberOf(TwoColours::red), blue = v.numberOf(TwoColours::blue);
  const double C = v.contentOf("C"), H = v.contentOf("H");
  for (int s = 0; s < 8; ++s) v.step();
  EXPECT_NEAR(v.contentOf("C") / C, 1.0, 1e-12);
  EXPECT_NEAR(v.contentOf("H") / H, 1.0, 1e-12);
  EXPECT_NEAR(v.numberOf(TwoColours::red) / red, 1.0, 1e-12);
  EXPECT_NEAR(v.numberOf(TwoColours::blue) / blue, 1.0, 1e-12);
  const AmountPlaces places = v.particles->amounts();
  const auto amount = [&](std::size_t place) {
    return integral(v.box.mesh, [&](int c) { return v.state.carried[at(c) * v.state.scalars.size() + place]; });
  };
  EXPECT_NEAR(amount(AmountPlaces::number) / (red + blue), 1.0, 1e-12);
  EXPECT_GT(amount(places.element(0)), 1.01 * carbonAtStart * (red + blue)) << "they have taken up acetylene";
  EXPECT_EQ(v.state.scalars[AmountPlaces::number].name, "paint_number");
}

TEST(TwoColours, InCellsGoOnToTheSameBits) {
  Painted v;
  for (int s = 0; s < 3; ++s) v.step();
  StateBackup kept(v.box.mesh.owned, v.box.mesh.faces);
  const double time = v.time;
  kept.save([&](StateArchive& archive) { v.saveOrLoad(archive); });
  for (int s = 0; s < 2; ++s) v.step();
  const auto populations = v.ensembles.populations();
  kept.restore([&](StateArchive& archive) { v.saveOrLoad(archive); });
  v.state.updateHalo(v.box.halo);
  v.time = time;
  v.begin();
  for (int s = 0; s < 2; ++s) v.step();
  EXPECT_EQ(v.ensembles.populations(), populations);
}

TEST(TwoColours, InCellsAreToldBySize) {
  Painted v;
  v.step();
  const MeshRegion whole(v.box.mesh, {-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0});
  const std::vector<double> rows = v.ensembles.regionRows(0, whole);
  double number = 0.0;
  for (std::size_t i = 0; i < rows.size(); i += 3) number += rows[i + 2] * std::log10(rows[i + 1] / rows[i]);
  EXPECT_NEAR(number * whole.volume() / (v.numberOf(TwoColours::red) + v.numberOf(TwoColours::blue)), 1.0, 1e-9);
}

}  // namespace
}  // namespace lampblack::test
