// What ensembles exchange with the gas of a flame, and where their paths start.
#include "coupling/flame_coupling.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "core/modules.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "particles/models/soot_model.hpp"
#include "tests/flow/flame/streams.hpp"

namespace lampblack::coupling {
namespace {

const Mechanism& abf() {
  static const Mechanism mechanism = shippedMechanism("ethylene_abf2000_101.yaml");
  return mechanism;
}

// From the left along all points, from the right to a place between two of them.
std::vector<FlameEnsemblePath> twoPaths(const std::vector<double>& z) {
  std::vector<FlameEnsemblePath> paths(2);
  double time = 0;
  for (const double at : z) {
    GasSample point;
    point.time = time;
    paths[0].path.path.points.push_back(point);
    paths[0].path.z.push_back(at);
    time += 1e-3 * (1 + 100 * at);
  }
  paths[1].options.fromRight = true;
  time = 0;
  for (const double at : {z.back(), z[z.size() - 2], 0.3 * z[z.size() - 2] + 0.7 * z[z.size() - 3]}) {
    GasSample point;
    point.time = time;
    paths[1].path.path.points.push_back(point);
    paths[1].path.z.push_back(at);
    time += 2e-3;
  }
  double value = 1;
  for (FlameEnsemblePath& path : paths) {
    const std::size_t points = path.path.path.points.size();
    path.material = "soot";
    path.columns = {{"soot_number_density", "1/m^3", "of no use here"}, {"soot_volume_fraction", "1", "of use"}};
    path.values.resize(2);
    path.values[0].mean.assign(points, 1e12);
    for (std::size_t k = 0; k < points; ++k) path.values[1].mean.push_back(1e-8 * (value += 0.3));
    for (std::size_t k = 0; k + 1 < points; ++k) {
      PathExchange x;
      x.gas.resize(SootSpecies::fixed + 1);
      x.gas[SootSpecies::C2H2] = -1e-3 * (value += 0.7);
      x.gas[SootSpecies::OH] = -2e-5 * value;
      x.gas[SootSpecies::fixed] = -3e-5 * value;
      x.elements = {2e-5 * (value + 0.1), 1e-6 * (value + 0.1)};
      value += 0.1;
      path.exchange.push_back(x);
    }
  }
  return paths;
}

// Each interval's exchange, over its time, times its length: what particles take on their way per area of the flame.
TEST(FlameCoupling, TheGasOfAFlameGivesWhatParticlesTakeAlongTheirPaths) {
  FlameProfile profile{{abf().numSpecies(), 0}, {0, 1e-3, 1.5e-3, 3e-3, 7e-3, 8e-3}, {}};
  profile.x.assign(profile.size(), 0.0);
  for (std::size_t i = 0; i < profile.points(); ++i)
    profile.at(i, FlameLayout::temperature) = 1000 + 100 * static_cast<double>(i);
  const auto paths = twoPaths(profile.z);
  EnsembleOptions options;
  options.soot.pah = {{"A2", 10, 8, 2e-3}};
  const FlameExchange exchange = exchangeOf(abf(), SootEnsemble(abf(), options), profile, paths);

  double carbon = 0, hydrogen = 0, acetylene = 0, hydroxyl = 0, naphthalene = 0;
  for (const FlameEnsemblePath& path : paths)
    for (std::size_t k = 0; k < path.exchange.size(); ++k) {
      const auto &from = path.path.path.points[k], &to = path.path.path.points[k + 1];
      const double part = std::abs(path.path.z[k + 1] - path.path.z[k]) / (to.time - from.time);
      carbon += part * path.exchange[k].elements[0];
      hydrogen += part * path.exchange[k].elements[1];
      acetylene +=
          part * path.exchange[k].gas[SootSpecies::C2H2] * abf().molecularWeights()[abf().speciesIndex("C2H2")];
      hydroxyl += part * path.exchange[k].gas[SootSpecies::OH] * abf().molecularWeights()[abf().speciesIndex("OH")];
      naphthalene +=
          part * path.exchange[k].gas[SootSpecies::fixed] * abf().molecularWeights()[abf().speciesIndex("A2")];
    }
  // As the flame's control volumes see it: each point has half of the intervals on both sides.
  const auto integral = [&](auto&& value) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < profile.points(); ++i)
      sum += 0.5 * (profile.z[i + 1] - profile.z[i]) * (value(i) + value(i + 1));
    return sum;
  };
  const auto ofSpecies = [&](const char* name) {
    return integral(
        [&, k = abf().speciesIndex(name)](std::size_t i) { return exchange.species[i * abf().numSpecies() + k]; });
  };
  EXPECT_NEAR(integral([&](std::size_t i) { return exchange.elements[2 * i]; }) / carbon, 1, 1e-12);
  EXPECT_NEAR(integral([&](std::size_t i) { return exchange.elements[2 * i + 1]; }) / hydrogen, 1, 1e-12);
  EXPECT_NEAR(ofSpecies("C2H2") / acetylene, 1, 1e-12);
  EXPECT_NEAR(ofSpecies("OH") / hydroxyl, 1, 1e-12);
  EXPECT_NEAR(ofSpecies("A2") / naphthalene, 1, 1e-12);

  // Absorption is 700 f_v T (1/m): of both populations where both are.
  const auto fractionAt = [&](std::size_t path, std::size_t k) { return paths[path].values[1].mean[k]; };
  EXPECT_NEAR(exchange.absorption[1] / (700 * fractionAt(0, 1) * 1100), 1, 1e-12);
  EXPECT_NEAR(exchange.absorption[5] / (700 * (fractionAt(0, 5) + fractionAt(1, 0)) * 1500), 1, 1e-12);
}

// Takes the carbon of acetylene and gives hydrogen, at rates that tell which concentration and which scalar they are
// of.
class Taking final : public CarriedModel {
 public:
  Taking() {
    std::vector<double> elements(abf().numElements(), 0.0);
    elements[abf().elementIndex("C")] = 3.0;
    elements[abf().elementIndex("H")] = 0.5;
    scalars_.push_back({{"amount", "1/m^3", "test"}, 1e-3, 0.0, elements});
    elements.assign(elements.size(), 0.0);
    elements[abf().elementIndex("C")] = 7.0;
    scalars_.push_back({{"other", "1/m^3", "test"}, 2e-3, 0.0, elements});
    exchanged_ = {abf().speciesIndex("H2"), abf().speciesIndex("C2H2")};
  }
  [[nodiscard]] std::string material() const override { return "test"; }
  [[nodiscard]] const std::vector<Scalar>& scalars() const override { return scalars_; }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return exchanged_; }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) override {
    rates[0] = 2.0 * densities[0];
    rates[1] = 5.0 * densities[1];
    exchange[0] = 11.0 * gas.concentrations[0];
    exchange[1] = -13.0 * gas.concentrations[1];
  }
  void jacobian(const ParticleGas&, std::span<const double>, const CarriedJacobian&) override {}
  ParticleAdvance advance(const CarrierGas&, double, std::span<double>, std::span<double>,
                          std::span<const double>) override {
    return {};
  }
  void diffusivities(const ParticleGas&, std::span<const double>, std::span<double>) override {}
  void enthalpies(double, std::span<double>, std::span<double>) override {}
  double absorption(double temperature, std::span<const double> densities) override {
    return temperature * (densities[0] + 2.0 * densities[1]);
  }

 private:
  std::vector<Scalar> scalars_;
  std::vector<std::size_t> exchanged_;
};

// The transfer model sees the concentrations and densities of a point; what it takes is booked in kg of the species it
// names.
TEST(FlameCoupling, TheTransferModelTakesWhatItNamesAtEachPoint) {
  const std::size_t n = abf().numSpecies(), H2 = abf().speciesIndex("H2"), C2H2 = abf().speciesIndex("C2H2");
  FlameProfile profile{{n, 2}, {0, 1e-3}, {}};
  profile.x.assign(profile.size(), 0.0);
  GasOfFlame gas;
  gas.carrier.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    profile.at(i, FlameLayout::firstSpecies + H2) = 0.1 + 0.1 * static_cast<double>(i);
    profile.at(i, FlameLayout::firstSpecies + C2H2) = 0.4;
    profile.at(i, profile.layout.firstScalar()) = 6.0;
    profile.at(i, profile.layout.firstScalar() + 1) = 8.0;
    gas.carrier[i].density = 0.25;
    gas.carrier[i].temperature = 1500.0;
  }
  Taking model;
  const FlameExchange e = exchangeOfTransfer(abf(), model, std::array<std::string, 2>{"H", "C"}, profile, gas);
  EXPECT_NEAR(e.species[H2] / (11.0 * 0.25 * 0.1), 1.0, 1e-12);
  EXPECT_NEAR(e.species[n + H2] / (11.0 * 0.25 * 0.2), 1.0, 1e-12);
  EXPECT_NEAR(e.species[n + C2H2] / (-13.0 * 0.25 * 0.4), 1.0, 1e-12);
  for (std::size_t k = 0; k < 2 * n; ++k) {
    const double expected = k % n == H2 || k % n == C2H2 ? e.species[k] : 0.0;
    EXPECT_EQ(e.species[k], expected) << k;
  }
  const double first = 6.0 * 1e-3 * 0.25, second = 8.0 * 2e-3 * 0.25;  // densities, per m3
  ASSERT_EQ(e.elements.size(), 4U);
  EXPECT_NEAR(e.elements[3] / (2.0 * first * 3.0 + 5.0 * second * 7.0), 1.0, 1e-12);
  EXPECT_NEAR(e.elements[2] / (2.0 * first * 0.5), 1.0, 1e-12);
  EXPECT_NEAR(e.absorption[1] / (1500.0 * (first + 2.0 * second)), 1.0, 1e-12);
}

// A third of what is asked for anew, two thirds of what there was; half-way between its points the old is their mean.
TEST(FlameCoupling, TheGasIsGivenThePopulationLessTheTransferModel) {
  const std::size_t n = abf().numSpecies(), k = abf().speciesIndex("C2H2");
  FlameProfile profile{{n, 0}, {0, 1e-3, 2e-3}, {}};
  profile.x.assign(profile.size(), 0.0);
  for (std::size_t i = 0; i < 3; ++i) profile.at(i, FlameLayout::temperature) = 1500;
  GivenExchange old;
  old.z = {0, 2e-3};
  old.species.assign(2 * n, 0.0);
  old.species[k] = 6;
  old.species[n + k] = 12;
  old.absorption = {3, 9};
  old.enthalpy = {300, 600};
  FlameExchange population(profile.z, n, 2), transfer(profile.z, n, 2);
  for (std::size_t i = 0; i < 3; ++i) {
    population.species[i * n + k] = 5;
    transfer.species[i * n + k] = 2;
    population.absorption[i] = 7;
    transfer.absorption[i] = 1;
  }
  // Of the point in the middle alone.
  population.elements[2] = 4e-3;
  transfer.elements[2] = 1e-3;
  population.elements[3] = 5e-4;
  transfer.elements[3] = 3e-4;
  const GivenExchange given =
      relaxed(old, profile, std::array<ElementEnthalpy, 2>{sootCarbonEnthalpy, sootHydrogenEnthalpy}, population,
              transfer, 1.0 / 3);
  EXPECT_EQ(given.z, profile.z);
  ASSERT_EQ(given.species.size(), 3 * n);
  EXPECT_NEAR(given.species[n + k], 2.0 / 3 * 9 + 1, 1e-12);
  EXPECT_EQ(given.species[n + k + 1], 0);
  EXPECT_NEAR(given.absorption[1], 2.0 / 3 * 6 + 2, 1e-12);
  const double toSoot = 3e-3 * sootCarbonEnthalpy(1500).first + 2e-4 * sootHydrogenEnthalpy(1500).first;
  ASSERT_GT(2e-4 * sootHydrogenEnthalpy(1500).first, 100);
  EXPECT_NEAR(given.enthalpy[1], 2.0 / 3 * 450 - toSoot / 3, 1e-9);
  EXPECT_NEAR(given.enthalpy[0], 2.0 / 3 * 300, 1e-9);
  EXPECT_NEAR(given.enthalpy[2], 2.0 / 3 * 600, 1e-9);
}

}  // namespace
}  // namespace lampblack::coupling
