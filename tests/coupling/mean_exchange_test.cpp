// What particles take in the mean, as sources of a steady gas.
#include "coupling/mean_exchange.hpp"

#include <gtest/gtest.h>

#include "tests/coupling/cell_vessel.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class MeanExchangeOfABox : public testing::Test {
 protected:
  MeanExchangeOfABox()
      : box_(closedBox(0.004, 3, 1), fourWalls(), {}, MPI_COMM_WORLD, ethylene()),
        state_(box_.stateWith(
            {},
            [](const Vector3& x) {
              return Box::Local{{}, 1500.0 + 1e5 * x[0], ethylene().massFractions("N2: 0.9, A2: 0.01, H2: 0.09")};
            })),
        exchange_(box_.context, species_),
        cells_(at(box_.mesh.owned)) {}

  // In `time`, in every cell: A2 goes, H2 comes, and heat.
  void approach(double time) {
    std::vector<double> gained;
    for (std::size_t c = 0; c < cells_; ++c) gained.insert(gained.end(), {-0.002, 0.006, 50.0});
    exchange_.approach(state_, gained, time);
  }
  State::Balance rates() const {
    State::Balance balance;
    balance.enthalpy.resize(cells_);
    exchange_.addTo(state_, balance);
    return balance;
  }
  double& massFraction(std::size_t species) { return state_.Y[species]; }  // of the first cell
  static double massOf(std::size_t species) { return ethylene().mechanism.molecularWeights()[species]; }

  const std::vector<std::size_t> species_{ethylene().mechanism.speciesIndex("A2"),
                                          ethylene().mechanism.speciesIndex("H2")};
  Box box_;
  State state_;
  MeanExchange exchange_;
  std::size_t cells_;
};

TEST_F(MeanExchangeOfABox, IsNothingAtFirst) {
  for (const double rate : rates().exchanged) EXPECT_EQ(rate, 0.0);
}

// The second time by the whole, where what particles take did not depend on what they took the first time.
TEST_F(MeanExchangeOfABox, GoesHalfOfTheWayAndThenAsFarAsThatTells) {
  for (const double part : {0.5, 1.0}) {
    approach(0.1);
    if (cells_ == 0) continue;
    const State::Balance balance = rates();
    ASSERT_EQ(balance.exchangedSpecies, species_);
    EXPECT_NEAR(balance.exchanged[0], -part * 0.02 * massOf(species_[0]), 1e-15);
    EXPECT_NEAR(balance.exchanged[1], part * 0.06 * massOf(species_[1]), 1e-15);
    EXPECT_NEAR(balance.enthalpy[0], part * 500.0, 1e-10);
  }
}

// Where particles take less after they took more, a step is what leads to what they would then take: with rates y of
// g(y) = 2 - y it is half.
TEST_F(MeanExchangeOfABox, GoesLessFarWhereParticlesAnswer) {
  for (const double of : {2.0, 1.0, 1.0}) {
    approach(0.1 / of);
    if (cells_ == 0) continue;
    EXPECT_NEAR(rates().exchanged[1], 0.06 * massOf(species_[1]), 1e-15);
  }
}

// In proportion, so that no gas gives what it does not have; what is made does not depend on what there is.
TEST_F(MeanExchangeOfABox, TakesOfWhatIsThere) {
  approach(0.1);
  if (cells_ == 0) return;
  const double before = rates().exchanged[0], madeBefore = rates().exchanged[1];
  massFraction(species_[0]) *= 0.3;
  massFraction(species_[1]) *= 0.3;
  EXPECT_NEAR(rates().exchanged[0] / before, 0.3, 1e-12);
  EXPECT_EQ(rates().exchanged[1], madeBefore);
  // What is not there is not taken in proportion to it.
  massFraction(species_[0]) = 0.0;
  EXPECT_EQ(rates().exchanged[0], 0.0);
}

TEST_F(MeanExchangeOfABox, HasTheSlopesOfItsRates) {
  approach(0.1);
  if (cells_ == 0) return;
  const std::size_t width = at(state_.species) + 1;
  std::vector<double> slopes(cells_ * width * width);
  exchange_.addSlopes({slopes, {}}, state_.species);
  const double before = rates().exchanged[0];
  double& Y = massFraction(species_[0]);
  const double step = 1e-3 * Y;
  Y += step;
  EXPECT_NEAR(slopes[species_[0] * width + species_[0]], (rates().exchanged[0] - before) / step, 1e-9);
  double others = 0.0;
  for (std::size_t i = 0; i < width * width; ++i)
    if (i != species_[0] * width + species_[0]) others += std::abs(slopes[i]);
  EXPECT_EQ(others, 0.0);
}

}  // namespace
}  // namespace lampblack::test
