// k-epsilon that resolves the layers beside walls: rates of both layers by their shares, against numbers by a script
// from the published equations, and the limits at a wall and far from all.
#include "flow/models/turbulence/two_layers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr double gasViscosity = 1.5e-5;

TurbulentRates layeredRates(const char* model, const TurbulentCell& cell, bool resolves = true) {
  std::array<TurbulentRates, 1> rates;
  turbulenceModel(model, {.blendsLayers = resolves})->evaluate({&cell, 1}, rates);
  return rates[0];
}

double layeredNet(const TurbulentRates& rates, const TurbulentCell& cell, std::size_t variable) {
  return rates.source[variable] - rates.sink[variable] * cell.values[variable];
}

// Re_y 42, 211 and 843: the inner layer, between, and beyond.
TEST(TwoLayers, GiveTheRatesOfEachByItsShare) {
  struct Row {
    double k, epsilon, distance, strain, dilatation, eddies, rateOfK, rateOfEpsilon;
  };
  for (const Row& of : {Row{0.4, 700, 0.001, 3000, 50, 6.426352870856657e-05, 463.6283643589088, -15175759.34778001},
                        Row{0.4, 300, 0.005, 900, -20, 0.0001884589449657768, -79.37181917148307, -615761.8895780268},
                        Row{0.4, 60, 0.02, 300, 10, 0.00024, -41.06666666666666, -13190.4}}) {
    const TurbulentCell cell{.strain = of.strain,
                             .dilatation = of.dilatation,
                             .distance = of.distance,
                             .viscosity = gasViscosity,
                             .values = {of.k, of.epsilon}};
    const TurbulentRates rates = layeredRates("k_epsilon", cell);
    EXPECT_NEAR(rates.eddyViscosity / of.eddies, 1.0, 1e-10);
    EXPECT_NEAR((rates.diffusivity[0] - gasViscosity) / of.eddies, 1.0, 1e-10);
    EXPECT_NEAR((rates.diffusivity[1] - gasViscosity) * 1.3 / of.eddies, 1.0, 1e-10);
    EXPECT_NEAR(layeredNet(rates, cell, 0) / of.rateOfK, 1.0, 1e-9);
    EXPECT_NEAR(layeredNet(rates, cell, 1) / of.rateOfEpsilon, 1.0, 1e-9);
    // Eddies gain k by buoyancy in proportion to what there is of them.
    TurbulentCell buoyant = cell;
    buoyant.buoyancy = 5e5;
    const double gained = layeredNet(layeredRates("k_epsilon", buoyant), cell, 0) - layeredNet(rates, cell, 0);
    EXPECT_NEAR(gained / (5e5 * of.eddies), 1.0, 1e-9);
  }
}

// At the wall k decays by 2 nu/d^2, with which k ~ d^2 is in balance with its diffusion; without k, too.
TEST(TwoLayers, EndInTheViscousLayer) {
  for (const double k : {1e-4, 0.0}) {
    const double d = 1e-7, rate = 2.0 * gasViscosity / (d * d);
    const TurbulentCell cell{.strain = 1e4, .distance = d, .viscosity = gasViscosity, .values = {k, rate * k}};
    const TurbulentRates rates = layeredRates("k_epsilon", cell);
    EXPECT_NEAR(rates.sink[0] / rate, 1.0, 1e-4);
    EXPECT_NEAR(rates.source[1] / rates.sink[1], rate * k, 1e-4 * rate * k);
    EXPECT_LT(rates.eddyViscosity, 1e-6 * gasViscosity);
  }
}

// Where the damping has ended and the inner layer has not, eddies and dissipation are those of a logarithmic layer.
TEST(TwoLayers, MeetTheLogarithmicLayer) {
  const double k = 0.3, d = 150.0 * gasViscosity / std::sqrt(k), friction = std::pow(0.09, 0.25) * std::sqrt(k);
  const twolayers::Lengths of = twolayers::lengths(k, gasViscosity, d);
  EXPECT_LT(of.outer, 0.01);
  EXPECT_NEAR(k * of.decay / (std::pow(friction, 3) / (0.41 * d)), 1.0, 1e-9);
  EXPECT_NEAR(0.09 * std::sqrt(k) * of.eddies / (0.41 * friction * d), 1.0 - std::exp(-150.0 / 70.0), 1e-9);
}

TEST(TwoLayers, AreTheModelItselfFarFromWalls) {
  for (const char* model : {"k_epsilon", "realizable_k_epsilon"}) {
    TurbulentCell cell{.strain = 700.0,
                       .vorticity = 600.0,
                       .dilatation = 30.0,
                       .distance = std::numeric_limits<double>::infinity(),
                       .viscosity = gasViscosity,
                       .values = {0.3, 50.0}};
    const TurbulentRates own = layeredRates(model, cell, false);
    for (const double distance : {cell.distance, 0.1}) {
      cell.distance = distance;
      const TurbulentRates rates = layeredRates(model, cell);
      EXPECT_EQ(rates.eddyViscosity, own.eddyViscosity) << model;
      EXPECT_EQ(rates.source, own.source) << model;
      EXPECT_EQ(rates.sink, own.sink) << model;
    }
    cell.distance = 2e-3;
    EXPECT_NE(layeredRates(model, cell).eddyViscosity, own.eddyViscosity) << model;
  }
}

}  // namespace
}  // namespace lampblack::test
