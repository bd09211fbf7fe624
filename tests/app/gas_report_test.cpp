#include "app/shell/tools/gas_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/source_folder.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;
using ::testing::HasSubstr;

std::vector<std::string> shippedMechanisms() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(test::sourceFolder / "cases/mechanisms"))
    if (entry.path().extension() == ".yaml") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

class GasReports : public ::testing::TestWithParam<std::string> {};

void expectNumbers(const std::vector<double>& values) {
  for (const double value : values) EXPECT_TRUE(std::isfinite(value)) << value;
}

// A pure gas, all other species being absent, and all species at once; as they are and at equilibrium.
TEST_P(GasReports, AreNumbersInStatesAtTheEdge) {
  const Mechanism mechanism = Mechanism::fromFile(GetParam());
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> pure(n), all(n, 1.0 / static_cast<double>(n));
  pure[mechanism.findSpecies("H2").value_or(0)] = 1;
  for (const auto& X : {pure, all})
    for (const double T : {200.0, 4000.0})
      for (const double p : {0.1, 1e7}) {
        SCOPED_TRACE(std::to_string(T) + " K, " + std::to_string(p) + " Pa");
        for (auto gas : {gasReport(mechanism, T, p, X), gasAtEquilibrium(mechanism, T, p, X, "TP")}) {
          addTransport(mechanism, {}, false, gas);
          expectNumbers({gas.density, gas.cpMass, gas.enthalpyMass, gas.entropyMass});
          expectNumbers(gas.forwardConstants);
          expectNumbers(gas.reverseConstants);
          expectNumbers(gas.netProductionRates);
          if (!gas.transport) {
            EXPECT_NE(gas.transportNote, "");
            continue;
          }
          expectNumbers({gas.transport->viscosity, gas.transport->thermalConductivity});
          expectNumbers(gas.transport->mixtureDiffusion);
          expectNumbers(gas.transport->thermalDiffusion);
          EXPECT_GT(gas.transport->viscosity, 0);
        }
      }
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, GasReports, ::testing::ValuesIn(shippedMechanisms()),
                         [](const auto& param) { return std::filesystem::path(param.param).stem().string(); });

TEST(GasAtTheEdge, ThatHasNoNumbersIsAnError) {
  const Mechanism mechanism = Mechanism::fromFile(shippedMechanisms().front());
  std::vector<double> X(mechanism.numSpecies());
  X[mechanism.speciesIndex("H2")] = 1;
  EXPECT_THROW(gasReport(mechanism, 1e-300, 1e5, X), NumericsError);
  EXPECT_THROW(gasReport(mechanism, 300, 1e308, X), NumericsError);
}

TEST(GasAtTheEdge, OfTheDataIsWarnedOf) {
  const Mechanism mechanism = Mechanism::fromFile(test::sourcePath("cases/mechanisms/methane_gri30_53.yaml"));
  EXPECT_EQ(rangeWarning(mechanism, 1000), "");
  double lowest = 1e9;
  for (const Species& species : mechanism.allSpecies()) lowest = std::min(lowest, species.thermo.maxTemperature);
  const std::string warning = rangeWarning(mechanism, lowest + 1);
  EXPECT_THAT(warning, HasSubstr("narrowest"));
  EXPECT_THAT(warning, HasSubstr("extrapolated"));
  EXPECT_THAT(rangeWarning(mechanism, 100), HasSubstr("100 K is outside"));
}

}  // namespace
