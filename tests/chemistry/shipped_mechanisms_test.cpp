// Every mechanism the project ships: published sizes, and rates that are finite and conserve the elements.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "chemistry/kinetics/kinetics.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::sourcePath;

struct Shipped {
  const char* file;
  std::size_t species, reactions;
  bool transport;
};

constexpr Shipped kShipped[] = {
    {"ethylene_abf2000_101.yaml", 101, 544, true},
    {"ethylene_bisetti2012_47.yaml", 47, 224, true},
    {"ethylene_km2_202.yaml", 202, 1350, true},
    {"ethylene_narayanaswamy2010_158.yaml", 158, 1049, true},
    {"heptane_yoo2011_88.yaml", 88, 729, true},
    {"hydrogen_h2o2_10.yaml", 10, 29, true},
    {"hydrogen_sandiego_9.yaml", 9, 21, true},
    {"methane_drm19_21.yaml", 21, 84, true},
    {"methane_gri30_53.yaml", 53, 325, true},
    {"methane_teos_29.yaml", 29, 92, true},
    {"perfect_gas_1.yaml", 1, 0, true},
    {"perfect_gas_soot_9.yaml", 9, 0, true},
    {"silica_teos_29.yaml", 29, 59, false},
};

class ShippedMechanism : public ::testing::TestWithParam<Shipped> {
 protected:
  Mechanism mechanism = Mechanism::fromFile(sourcePath(std::string("cases/mechanisms/") + GetParam().file));
};

TEST_P(ShippedMechanism, HasThePublishedSize) {
  EXPECT_EQ(mechanism.numSpecies(), GetParam().species);
  EXPECT_EQ(mechanism.numReactions(), GetParam().reactions);
  EXPECT_FALSE(mechanism.description().empty());
  for (const auto& species : mechanism.allSpecies())
    EXPECT_EQ(species.transport.has_value(), GetParam().transport) << species.name;
}

TEST_P(ShippedMechanism, RatesConserveElements) {
  Kinetics kinetics(mechanism);
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> c(n), wdot(n);
  for (std::size_t k = 0; k < n; ++k) c[k] = 0.1 + 0.7 * static_cast<double>((k * 7) % 11);
  double worst = 0;
  for (const double T : {200.0, 300.0, 1000.0, 1000.1, 2500.0, 4000.0}) {
    kinetics.netProductionRates(T, c, wdot);
    for (std::size_t i = 0; i < mechanism.numElements(); ++i) {
      double sum = 0, size = 0;
      for (std::size_t k = 0; k < n; ++k) {
        ASSERT_TRUE(std::isfinite(wdot[k])) << mechanism.speciesName(k) << " at " << T;
        sum += wdot[k] * mechanism.atoms(k, i);
        size += std::abs(wdot[k]) * mechanism.atoms(k, i);
      }
      if (size > 0) raise(worst, sum / size);
    }
  }
  measured("sum over species, of the sum of magnitudes", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(ShippedMechanisms, AreAllTested) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(sourcePath("cases/mechanisms")))
    if (entry.path().extension() == ".yaml") ++files;
  EXPECT_EQ(files, std::size(kShipped));
}

INSTANTIATE_TEST_SUITE_P(Files, ShippedMechanism, ::testing::ValuesIn(kShipped), [](const auto& tested) {
  const std::string file = tested.param.file;
  return file.substr(0, file.find('.'));
});

}  // namespace
