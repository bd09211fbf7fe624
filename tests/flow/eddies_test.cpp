// Times of reactions and of mixing, and fine structures, against their definitions.
#include <gtest/gtest.h>

#include "combustion_fixture.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/models/combustion/fine_structure_cells.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::test {
namespace {

using Kind = ChemicalTime::Kind;

TEST(ChemicalTimes, AreThoseOfOneReaction) {
  const double k = 200.0, density = 1.3, quarter = 0.25;
  const std::vector<double> Y{quarter, 1.0 - quarter};
  const auto timeOf = [&](Kind kind, const std::vector<std::string>& reactions, std::span<const double> of) {
    const Mechanism mechanism = twoGases(reactions);
    return ChemicalTime(mechanism, kind).of(700.0, density, of);
  };
  const std::vector<std::string> one{becomes(k)}, beside{becomes(k), becomes(0.0, false, "B => A")},
      twice{becomes(0.5 * k, true), becomes(0.5 * k, true)};
  const double time = 1.0 / (k * quarter);
  EXPECT_NEAR(timeOf(Kind::ReactionsOf6, one, Y), time, 1e-12 * time);
  EXPECT_NEAR(timeOf(Kind::WeightedReactions, one, Y), time, 1e-12 * time);
  // Of A; B, of which there is more, grows as fast as A falls and would take three times as long.
  EXPECT_NEAR(timeOf(Kind::SlowestSpecies, one, Y), 3.0 * time * quarter, 1e-12 * time);
  const std::vector<double> rich{0.9, 0.1};
  EXPECT_NEAR(timeOf(Kind::SlowestSpecies, one, rich), 1.0 / k, 1e-12 / k);
  EXPECT_NEAR(timeOf(Kind::ReactionsOf6, beside, Y), 2.0 * time, 1e-12 * time);
  EXPECT_NEAR(timeOf(Kind::WeightedReactions, beside, Y), time, 1e-12 * time);
  EXPECT_NEAR(timeOf(Kind::ReactionsOf6, twice, Y), 2.0 * time, 1e-12 * time);
  EXPECT_NEAR(timeOf(Kind::WeightedReactions, twice, Y), 2.0 * time, 1e-12 * time);
  // Slow, and none at all.
  const std::vector<std::string> slow{becomes(1e-3)};
  for (const Kind kind : {Kind::ReactionsOf6, Kind::WeightedReactions, Kind::SlowestSpecies}) {
    EXPECT_EQ(timeOf(kind, slow, Y), ChemicalTime::longest);
    EXPECT_EQ(timeOf(kind, {becomes(0.0)}, Y), ChemicalTime::longest);
  }
}

TEST(ChemicalTimes, WeighBothDirections) {
  const double k = 0.2;  // m^3/mol/s
  const Mechanism mechanism = twoGases({becomes(1e3 * k, false, "2 A <=> 2 B")});
  // Of equal gases the reverse constant is the forward one.
  const double density = 1.3, c = density * 0.5 / mechanism.molecularWeights()[0], w = 2.0 * k * c * c;
  const std::vector<double> Y{0.5, 0.5};
  EXPECT_NEAR(ChemicalTime(mechanism, Kind::WeightedReactions).of(700.0, density, Y), 2.0 * c * 2.0 * w / (2.0 * w * w),
              1e-9 * c / w);
  EXPECT_NEAR(ChemicalTime(mechanism, Kind::ReactionsOf6).of(700.0, density, Y), 2.0 * c / w, 1e-9 * c / w);
  EXPECT_EQ(ChemicalTime(mechanism, Kind::SlowestSpecies).of(700.0, density, Y), ChemicalTime::longest);
}

// Against differences, at constant pressure. Hydrogen's third bodies are left out.
TEST(ChemicalTimes, HaveSlopes) {
  const Mechanism mechanism =
      twoGases({becomes(40.0, false, "2 A <=> 2 B"), becomes(300.0), becomes(70.0, false, "B => A")});
  const Thermo thermo(mechanism);
  for (const Kind kind : {Kind::WeightedReactions, Kind::ReactionsOf6}) {
    ChemicalTime time(mechanism, kind);
    const std::vector<double> Y{0.3, 0.7};
    const double T = 700.0, p = 101325.0, small = 1e-5;
    const auto at = [&](double temperature, std::span<const double> of) {
      return std::log(time.of(temperature, thermo.density(temperature, p, of), of));
    };
    std::vector<double> slopes(3);
    time.slopes(T, thermo.density(T, p, Y), Y, slopes);
    for (std::size_t j = 0; j < 2; ++j) {
      std::vector<double> above = Y, below = Y;
      above[j] += small;
      below[j] -= small;
      const double slope = (at(T, above) - at(T, below)) / (2.0 * small);
      EXPECT_NEAR(slopes[j], slope, 1e-6 * std::abs(slope)) << j;
    }
    const double byT = (at(T + 0.1, Y) - at(T - 0.1, Y)) / 0.2;
    EXPECT_NEAR(slopes[2], byT, 1e-4 * std::abs(byT));
  }
  ChemicalTime slowest(mechanism, Kind::SlowestSpecies);
  std::vector<double> slopes(3, 1.0);
  slowest.slopes(700.0, 0.5, std::vector<double>{0.3, 0.7}, slopes);
  EXPECT_EQ(slopes, std::vector<double>(3, 0.0));
}

TEST(MixingTimes, GoByTheEddies) {
  const Eddies eddies{.energy = 8.0, .dissipation = 400.0, .viscosity = 2e-5, .eddyViscosity = 3.4e-4};
  const double kolmogorov = std::sqrt(2e-5 / 400.0), integral = 8.0 / 400.0;
  EXPECT_DOUBLE_EQ(mixingTime(eddies, MixingTime::Effective, 0.3), 0.3 * std::sqrt(3.6e-4 / 400.0));
  EXPECT_DOUBLE_EQ(mixingTime(eddies, MixingTime::Kolmogorov, 0.3), kolmogorov);
  EXPECT_DOUBLE_EQ(mixingTime(eddies, MixingTime::Geometric, 0.3), std::sqrt(kolmogorov * integral));
  EXPECT_DOUBLE_EQ(mixingTime(eddies, MixingTime::Integral, 0.5), 0.5 * integral);
  EXPECT_EQ(stirredShare(1e-3, mixingTime({8.0, 0.0, 2e-5, 0.0}, MixingTime::Effective, 0.3)), 0.0);
  EXPECT_DOUBLE_EQ(stirredShare(1e-3, 3e-3), 0.25);
  EXPECT_EQ(stirredShare(1e-3, 0.0), 1.0);
}

TEST(FineStructuresOfEddies, HaveTheSharesOfTheThreeVersions) {
  const Eddies eddies{.energy = 8.0, .dissipation = 400.0, .viscosity = 2e-5, .eddyViscosity = 3.4e-4};
  FineStructures fine;
  const double size = 2.1377 * std::pow(2e-5 * 400.0 / 64.0, 0.25);
  EXPECT_NEAR(fine.size(eddies), size, 1e-12);
  EXPECT_NEAR(fine.mixing(eddies), 0.4083 * std::sqrt(2e-5 / 400.0), 1e-15);
  EXPECT_DOUBLE_EQ(fine.share(0.5), 0.25 / 0.75);
  fine.powerBelow = 3.0;
  EXPECT_DOUBLE_EQ(fine.share(0.5), 0.25 / 0.875);
  fine.powerAbove = 3.0;
  EXPECT_DOUBLE_EQ(fine.share(0.5), 0.125 / 0.875);
  EXPECT_EQ(fine.share(0.99), 1.0);
  EXPECT_EQ(fine.share(1.5), 1.0);
  EXPECT_EQ(fine.share(fine.size({0.0, 400.0, 2e-5, 0.0})), 1.0);
}

}  // namespace
}  // namespace lampblack::test
