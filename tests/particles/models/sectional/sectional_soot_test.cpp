// The sectional soot model at one state: budgets of elements, the Jacobian, shapes, options.
#include "particles/models/sectional/sectional_soot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"
#include "tests/particles/models/sectional/sectional_soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

using namespace test;
using Nucleation = SectionalSootOptions::Nucleation;
using Aggregation = SectionalSootOptions::Aggregation;

// Atoms of C, H and O in the species of the gas.
struct Atoms {
  double C, H, O;
};
std::vector<Atoms> atomsOf(const SectionalSoot& model) {
  std::vector<Atoms> atoms = {{0, 1, 0}, {0, 2, 0}, {0, 1, 1}, {0, 2, 1}, {0, 0, 2}, {2, 2, 0}, {1, 0, 1}};
  for (const auto& pah : model.options().soot.pah)
    atoms.push_back({static_cast<double>(pah.carbon), static_cast<double>(pah.hydrogen), 0});
  return atoms;
}

class SectionalElements : public ::testing::TestWithParam<std::tuple<Nucleation, Aggregation, bool, double>> {
 protected:
  SectionalSootOptions options() const {
    SectionalSootOptions wanted = twoPahWithEverything();
    wanted.nucleation = std::get<0>(GetParam());
    wanted.aggregation = std::get<1>(GetParam());
    wanted.carbonisation = std::get<2>(GetParam());
    wanted.factor = std::get<3>(GetParam());
    wanted.growthScheme =
        wanted.factor < 2 ? SectionalSootOptions::GrowthScheme::limited : SectionalSootOptions::GrowthScheme::upwind;
    wanted.fragmentation.active = wanted.aggregation == Aggregation::aggregates;
    return wanted;
  }
};

TEST_P(SectionalElements, AreConservedToRoundOff) {
  const SectionalSoot model(options());
  const auto atoms = atomsOf(model);
  for (unsigned seed = 0; seed < 5; ++seed) {
    const SectionGas gas(1400 + 100 * seed, sooting({3e-6, 1e-6}));
    const auto y = randomState(model, seed);
    const auto f = sourcesOf(model, gas.gas, y);
    double C = 0, H = 0, O = 0, sizeC = 0, sizeH = 0, sizeO = 0;
    const auto add = [](double& total, double& size, double value) {
      total += value;
      size += std::abs(value);
    };
    for (std::size_t k = 0; k < atoms.size(); ++k) {
      add(C, sizeC, atoms[k].C * f.exchange[k]);
      add(H, sizeH, atoms[k].H * f.exchange[k]);
      add(O, sizeO, atoms[k].O * f.exchange[k]);
    }
    for (std::size_t i = 0; i < model.scalars().size(); ++i) {
      add(C, sizeC, model.scalars()[i].massOf("C") * f.scalars[i] / model.options().soot.carbonWeight);
      add(H, sizeH, model.scalars()[i].massOf("H") * f.scalars[i] / model.options().soot.hydrogenWeight);
    }
    // Rounding of a few hundred terms.
    EXPECT_NEAR(C, 0, 1e-13 * sizeC);
    EXPECT_NEAR(H, 0, 1e-13 * sizeH);
    EXPECT_NEAR(O, 0, 1e-13 * sizeO);
    EXPECT_GT(sizeH, 0);
  }
}

TEST_P(SectionalElements, JacobianIsThatOfDifferences) {
  const SectionalSoot model(options());
  const SectionGas gas(1650, sooting({3e-6, 1e-6}));
  const std::size_t S = model.scalars().size(), G = model.gasSpecies().size(), R = S + G, C = R + 1;
  const auto y = randomState(model, 7);
  std::vector<double> J(R * C);
  model.jacobian(gas.gas, y, J);
  for (std::size_t c = 0; c < C; ++c) {
    auto value = [&](double relative) {
      auto changed = y;
      auto concentrations = gas.concentrations;
      ParticleGas g = gas.gas;
      g.concentrations = concentrations;
      if (c < S)
        changed[c] *= 1 + relative;
      else if (c < R)
        concentrations[c - S] *= 1 + relative;
      else
        g.temperature *= 1 + relative;
      auto f = sourcesOf(model, g, changed);
      f.scalars.insert(f.scalars.end(), f.exchange.begin(), f.exchange.end());
      return f.scalars;
    };
    constexpr double h = 2e-4;
    const auto p1 = value(h), m1 = value(-h), p2 = value(2 * h), m2 = value(-2 * h);
    const auto f = value(0);
    const double x = c < S ? y[c] : c < R ? gas.concentrations[c - S] : gas.gas.temperature;
    for (std::size_t r = 0; r < R; ++r) {
      const double difference = (8 * (p1[r] - m1[r]) - (p2[r] - m2[r])) / (12 * h);
      // Differences of fourth order are good to the rounding of the terms over h, which are larger than their sums.
      const double size = std::max({std::abs(p2[r]), std::abs(m2[r]), std::abs(f[r])});
      EXPECT_NEAR(J[r * C + c] * x, difference, 2e-6 * std::abs(difference) + 1e-10 * size)
          << "row " << r << " column " << c;
    }
  }
}

TEST_P(SectionalElements, NegativeDensitiesAndConcentrationsCountAsZero) {
  const SectionalSoot model(options());
  SectionGas gas(1650, sooting({3e-6, 1e-6}));
  auto y = randomState(model, 9);
  auto zero = y;
  for (const std::size_t i : {std::size_t{0}, std::size_t{5}, y.size() - 1}) {
    y[i] = -1e3 * y[i];
    zero[i] = 0;
  }
  gas.concentrations[4] = gas.concentrations[7] = 0;
  const auto expected = sourcesOf(model, gas.gas, zero);
  gas.concentrations[4] = gas.concentrations[7] = -1;
  const auto f = sourcesOf(model, gas.gas, y);
  for (std::size_t i = 0; i < f.scalars.size(); ++i) EXPECT_EQ(f.scalars[i], expected.scalars[i]);
  for (std::size_t i = 0; i < f.exchange.size(); ++i) EXPECT_EQ(f.exchange[i], expected.exchange[i]);
  const std::size_t C = y.size() + gas.concentrations.size() + 1;
  std::vector<double> J((C - 1) * C);
  model.jacobian(gas.gas, y, J);
  for (const double v : J) EXPECT_TRUE(std::isfinite(v));
  for (std::size_t r = 0; r + 1 < C; ++r) EXPECT_EQ(J[r * C + 5], 0);
  std::fill(y.begin(), y.end(), 0);
  model.jacobian(gas.gas, y, J);
  for (const double v : J) EXPECT_TRUE(std::isfinite(v));
}

INSTANTIATE_TEST_SUITE_P(Variants, SectionalElements,
                         ::testing::Combine(::testing::Values(Nucleation::pah, Nucleation::dimer),
                                            ::testing::Values(Aggregation::aggregates, Aggregation::spheres),
                                            ::testing::Bool(), ::testing::Values(2.0, 1.5)));

TEST(SectionalSoot, ShapesOfOnePrimaryAndOfMany) {
  SectionalSootOptions options = pyrene();
  const SectionalSoot model(options);
  const std::size_t n = model.sections(), i = 20;
  const SectionGas gas(1600, sooting({1e-6}));
  std::vector<double> y(2 * n, 0);
  y[i] = y[n + i] = 1e14;
  auto p = model.properties(gas.gas, y);
  const double sphere = std::cbrt(6 * model.pivots()[i] / (constants::pi * 1800));
  EXPECT_NEAR(p.primaryDiameter, sphere, 1e-12 * sphere);
  EXPECT_NEAR(p.mobilityDiameter, sphere, 1e-12 * sphere);
  EXPECT_NEAR(p.gyrationDiameter, sphere * std::sqrt(0.6), 1e-12 * sphere);
  EXPECT_NEAR(p.surfaceArea, 1e14 * constants::pi * sphere * sphere, 1e-12 * p.surfaceArea);
  y[n + i] = 40e14;
  p = model.properties(gas.gas, y);
  const double primary = sphere / std::cbrt(40.0), mobility = primary * std::pow(40, 0.45);
  EXPECT_NEAR(p.primariesPerAggregate, 40, 1e-6);
  EXPECT_NEAR(p.primaryDiameter, primary, 1e-8 * primary);
  EXPECT_NEAR(p.mobilityDiameter, mobility, 1e-8 * mobility);
  EXPECT_NEAR(p.gyrationDiameter, mobility / (std::pow(40, -0.2) + 0.4), 1e-8 * mobility);
  EXPECT_NEAR(p.surfaceArea, 40e14 * constants::pi * primary * primary, 1e-8 * p.surfaceArea);
  std::vector<double> D(2 * n);
  model.diffusivities(gas.gas, y, D);
  const double lambda = meanFreePath(gas.gas);
  const double expected = constants::boltzmann * 1600 / (3 * constants::pi * gas.gas.viscosity * mobility) *
                          slipCorrection(2 * lambda / mobility);
  EXPECT_NEAR(D[i], expected, 1e-8 * expected);
  EXPECT_EQ(D[n + i], D[i]);
  // Primaries never get smaller than nuclei, and there is at least one.
  y[n + i] = 1e30;
  p = model.properties(gas.gas, y);
  EXPECT_NEAR(p.primariesPerAggregate, model.pivots()[i] / model.pivots()[0], 1e-6 * p.primariesPerAggregate);
  y[n + i] = 0;
  EXPECT_EQ(model.properties(gas.gas, y).primariesPerAggregate, 1);
}

// A grid is judged by moments: the number, the surface, the carbon and its second moment, and the primaries.
TEST(SectionalSoot, GridsAreJudgedByMomentsOfTheSections) {
  SectionalSootOptions options = pyrene();
  const SectionalSoot model(options);
  const std::size_t n = model.sections();
  std::vector<double> y(model.scalars().size(), 0.0);
  double moments[4] = {}, primaries = 0;
  const double powers[4] = {0, 2.0 / 3, 1, 2};
  for (std::size_t i = 0; i < n; ++i) {
    y[i] = 1e15 / static_cast<double>(1 + i);
    y[n + i] = 3 * y[i];
    primaries += y[n + i];
    // In units of 1e17 particles of 1e-20 kg.
    for (int k = 0; k < 4; ++k) moments[k] += y[i] / 1e17 * std::pow(model.pivots()[i] / 1e-20, powers[k]);
  }
  const auto sums = model.gridSums();
  ASSERT_EQ(sums.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    double sum = 0;
    for (std::size_t s = 0; s < y.size(); ++s) sum += sums[k][s] * y[s];
    const double expected = k < 4 ? moments[k] : primaries / 1e17;
    EXPECT_NEAR(sum / expected, 1, 1e-12);
  }
}

TEST(SectionalSoot, WrongOptionsAreNamed) {
  const auto fails = [](auto&& change, const std::string& word) {
    SectionalSootOptions options = pyrene();
    change(options);
    EXPECT_THAT(messageOf<InputError>([&] { const SectionalSoot model(options); }), ::testing::HasSubstr(word));
  };
  fails([](auto& o) { o.sections = 1; }, "1 sections");
  fails([](auto& o) { o.factor = 1; }, "ratio");
  fails([](auto& o) { o.soot.pah.clear(); }, "nucleus");
  fails([](auto& o) { o.nucleusCarbon = 40; }, "32");
  fails([](auto& o) { o.kernel = CollisionKernelType::additive; }, "kernel");
  fails(
      [](auto& o) {
        o.fragmentation.active = true;
        o.aggregation = Aggregation::spheres;
      },
      "spheres");
}

}  // namespace
}  // namespace lampblack::particles
