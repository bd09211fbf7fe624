// Mixing of an engine's particles: variance, shape, what is conserved.
#include "chemistry/reactor/engine/engine_mixing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/chemistry/engine_particles.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::engineGas;
using lampblack::test::hydrogen;

struct MixingMoments {
  double mean = 0, variance = 0, fourth = 0, least = 1, most = 0;
};

// Of a species' mass fraction, by mass.
MixingMoments momentsOf(const EngineGas& gas, const char* name = "O2") {
  const std::size_t k = hydrogen().speciesIndex(name);
  MixingMoments m;
  double mass = 0;
  for (std::size_t i = 0; i < gas.count(); ++i) mass += gas.mass[i], m.mean += gas.mass[i] * gas.Y(i)[k];
  m.mean /= mass;
  for (std::size_t i = 0; i < gas.count(); ++i) {
    const double apart = gas.Y(i)[k] - m.mean;
    m.variance += gas.mass[i] / mass * apart * apart;
    m.fourth += gas.mass[i] / mass * std::pow(apart, 4);
    m.least = std::min(m.least, gas.Y(i)[k]);
    m.most = std::max(m.most, gas.Y(i)[k]);
  }
  return m;
}

EngineGas streams() {
  EngineGas gas = engineGas({{400, "N2: 1"},
                             {600, "O2: 1"},
                             {500, "O2: 1, N2: 3"},
                             {1500, "H2O: 1"},
                             {700, "O2: 1, AR: 1"},
                             {350, "H2: 1"},
                             {800, "O2: 2, N2: 1"},
                             {900, "AR: 1"}});
  for (std::size_t i = 0; i < gas.count(); ++i) gas.mass[i] *= 1 + 0.5 * static_cast<double>(i % 3);
  return gas;
}

void expectConserved(const EngineGas& before, const EngineGas& after) {
  const Thermo thermo(hydrogen());
  const std::vector<double> was = elementsOf(hydrogen(), before), is = elementsOf(hydrogen(), after);
  for (std::size_t e = 0; e < was.size(); ++e) EXPECT_NEAR(is[e], was[e], 1e-14 * was[e]);
  const double size = totalsOf(thermo, before).capacity * 1000;
  EXPECT_NEAR(enthalpyOf(thermo, after), enthalpyOf(thermo, before), 1e-12 * size);
}

TEST(EngineMixing, IemTakesTheVarianceAndKeepsTheShape) {
  const Thermo thermo(hydrogen());
  const EngineGas before = streams();
  EngineGas gas = before;
  RandomStream random(1, 0, 0);
  EngineMixing mixing(thermo, EngineMixingModel::iem, 2);
  const double grown = mixing.advance(0.004, 0.008, random, gas) + mixing.advance(0.004, 0.008, random, gas);
  const MixingMoments was = momentsOf(before), is = momentsOf(gas);  // C t/tau = 2
  EXPECT_NEAR(is.variance / was.variance, 0.135335, 1e-6);
  EXPECT_NEAR(is.fourth / (is.variance * is.variance), was.fourth / (was.variance * was.variance), 1e-11);
  EXPECT_NEAR(is.mean, was.mean, 1e-15);
  EXPECT_NEAR(volumeOf(thermo, gas) - volumeOf(thermo, before), grown, 1e-14 * volumeOf(thermo, gas));
  expectConserved(before, gas);
}

// Two streams: the enthalpy is linear, the temperature is not.
TEST(EngineMixing, EnthalpyIsWhatMixes) {
  const Thermo thermo(hydrogen());
  EngineGas gas = engineGas({{400, "H2O: 1"}, {2000, "N2: 1"}});
  const double half = 0.5 * (thermo.enthalpyMass(400, gas.Y(0)) + thermo.enthalpyMass(2000, gas.Y(1)));
  RandomStream random(1, 0, 0);
  EngineMixing(thermo, EngineMixingModel::iem, 2).advance(100, 1, random, gas);
  EXPECT_NEAR(thermo.enthalpyMass(gas.temperature[0], gas.Y(0)), half, 1e-9 * std::abs(half));
  EXPECT_NEAR(gas.temperature[0], gas.temperature[1], 1e-9);
  EXPECT_GT(std::abs(gas.temperature[0] - 1200), 10);
}

// Mean of many ensembles within 3.3 errors of the decay; no value beyond those at the start.
void expectDecay(EngineMixingModel model, const EngineGas& start) {
  const Thermo thermo(hydrogen());
  const MixingMoments was = momentsOf(start);
  constexpr int ensembles = 1000;
  double sum = 0, squares = 0;
  for (int e = 0; e < ensembles; ++e) {
    EngineGas gas = start;
    RandomStream random(7, static_cast<std::uint64_t>(e), 0);
    EngineMixing mixing(thermo, model, 2);
    mixing.advance(0.3, 1, random, gas);
    mixing.advance(0.2, 1, random, gas);
    const MixingMoments is = momentsOf(gas);
    ASSERT_NEAR(is.mean, was.mean, 1e-14);
    ASSERT_GE(is.least, was.least - 1e-15);
    ASSERT_LE(is.most, was.most + 1e-15);
    if (e == 0) expectConserved(start, gas);
    sum += is.variance / was.variance;
    squares += is.variance / was.variance * is.variance / was.variance;
  }
  const double mean = sum / ensembles, error = std::sqrt((squares / ensembles - mean * mean) / ensembles);
  EXPECT_NEAR(mean, std::exp(-1.0), 3.3 * error);
  EXPECT_LT(error, 0.02);
}

TEST(EngineMixing, CurlTakesTheVariance) {
  expectDecay(EngineMixingModel::curl, streams());
}

TEST(EngineMixing, ModifiedCurlTakesTheVariance) {
  expectDecay(EngineMixingModel::modifiedCurl, streams());
}

TEST(EngineMixing, OneParticleOrNoModelChangesNothing) {
  const Thermo thermo(hydrogen());
  EngineGas gas = streams();
  RandomStream random(1, 0, 0);
  EXPECT_EQ(EngineMixing(thermo, EngineMixingModel::none, 2).advance(1, 1, random, gas), 0);
  EXPECT_EQ(gas.massFractions, streams().massFractions);
  EngineGas one = engineGas({{400, "N2: 1"}});
  EXPECT_EQ(EngineMixing(thermo, EngineMixingModel::curl, 2).advance(1, 1, random, one), 0);
}

}  // namespace
