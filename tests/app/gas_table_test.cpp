// A table of a gas over time: which columns count, in which units, and what is no such table.
#include "app/problems/prescribed_gas/gas_table.hpp"

#include <gtest/gtest.h>

#include "app/problems/prescribed_gas/prescribed_gas_case.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/messages.hpp"
#include "tests/scratch.hpp"
#include "tests/world.hpp"

namespace lampblack::app {
namespace {

using testing::HasSubstr;

const Mechanism& hydrogen() {
  static const Mechanism mechanism = Mechanism::fromFile(test::sourcePath("cases/mechanisms/hydrogen_h2o2_10.yaml"));
  return mechanism;
}

GasHistory historyOf(const std::string& text) {
  const test::ScratchFolder folder;
  return readGasTable(folder.file("gas.csv", text), hydrogen());
}

std::string refusalOf(const std::string& text) {
  try {
    static_cast<void>(historyOf(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GasTable, ColumnsMayStandInAnyOrderAndUnit) {
  const GasHistory gas = historyOf(
      "X_O2 [1],p [kPa],place,time [ms],\"X_H2\",temperature [degC],X_XENON\n"
      "0.25,100,here,1,0.75,26.85,0.5\n0.5,50,there,3,0.5,126.85,0\n");
  ASSERT_EQ(gas.time.size(), 2u);
  EXPECT_NEAR(gas.time[1], 3e-3, 1e-18);
  EXPECT_NEAR(gas.temperature[0], 300, 1e-9);
  EXPECT_NEAR(gas.temperature[1], 400, 1e-9);
  EXPECT_NEAR(gas.pressure[1], 5e4, 1e-9);
  const std::size_t n = hydrogen().numSpecies();
  ASSERT_EQ(gas.fractions.size(), 2 * n);
  double sum = 0;
  for (const double x : gas.fractions) sum += x;
  EXPECT_EQ(gas.fractions[hydrogen().speciesIndex("H2")], 0.75);
  EXPECT_EQ(gas.fractions[n + hydrogen().speciesIndex("O2")], 0.5);
  EXPECT_EQ(sum, 2);  // none else
}

// As other programs and spreadsheets write them.
TEST(GasTable, NamesMayBeInAnyCaseAndPressureIsAlsoP) {
  const std::string rows = "0,300,1,1\n1,400,2,1\n";
  for (const std::string names : {"Time[s],T[K],P[bar],X_H2", "TIME, Temperature, P [bar], X_H2"}) {
    const GasHistory gas = historyOf(names + "\n" + rows);
    EXPECT_EQ(gas.time, (std::vector<double>{0, 1})) << names;
    EXPECT_EQ(gas.temperature, (std::vector<double>{300, 400})) << names;
    EXPECT_NEAR(gas.pressure[1], 2e5, 1e-9) << names;
  }
}

// The rate stands between a row and the next; the column may have its former name, with a note by the first rank.
TEST(GasTable, HasTheNumberLossRateByEitherName) {
  for (const std::string name : {"number_loss_rate", "thinning", "Thinning"}) {
    const bool isFormer = name != "number_loss_rate";
    testing::internal::CaptureStderr();
    const GasHistory gas = historyOf("t,T,p,X_H2," + name + " [1/s]\n0,300,1e5,1,20\n1,300,1e5,1,0\n");
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_EQ(gas.numberLossRate, std::vector<double>{20}) << name;
    EXPECT_EQ(told.find("the column thinning is called number_loss_rate since version 0.2") != std::string::npos,
              isFormer && test::worldRank() == 0)
        << told;
  }
  EXPECT_THAT(refusalOf("t,T,p,X_H2,thinning,number_loss_rate\n0,300,1e5,1,2,2\n"),
              HasSubstr("two columns say the same, 'thinning' and 'number_loss_rate'; leave one out"));
}

// A fraction that is passed over would be missing in the gas.
TEST(GasTable, PassesOverNoFractionInSilence) {
  const GasHistory gas = historyOf("t,T,p,X_H2,x_O2\n0,300,1e5,0.75,0.25\n");
  EXPECT_EQ(gas.fractions[hydrogen().speciesIndex("O2")], 0.25);
  EXPECT_THAT(refusalOf("t,T,p,X_H2,y_OH\n0,300,1e5,1,0.1\n"),
              HasSubstr("'y_OH' is of mass fractions; write mole fractions, \"X_OH"));
  EXPECT_EQ(refusalOf("t,T,p,X_H2,Y_H2\n0,300,1e5,1,1\n"), "accepted") << "it is there by its mole fraction";
  testing::internal::CaptureStderr();
  static_cast<void>(historyOf("t,Temperature,p,X_H2,O2,X_XENON,place\n0,300,1e5,1,0.1,0,here\n"));
  const std::string told = testing::internal::GetCapturedStderr();
  const bool tells = test::worldRank() == 0;
  EXPECT_EQ(told.find("not known here are left out: O2, place;") != std::string::npos, tells) << told;
  EXPECT_EQ(told.find("does not have are left out: XENON") != std::string::npos, tells) << told;
}

TEST(GasTable, SaysWhatIsMissingOrWrong) {
  EXPECT_THAT(refusalOf("T,p,X_H2\n300,1e5,1\n"), HasSubstr("expected a column 'time' or 't'"));
  EXPECT_THAT(refusalOf("t,p,X_H2\n0,1e5,1\n"),
              HasSubstr("expected a column 'temperature' or 'T', as \"temperature [K]\""));
  EXPECT_THAT(refusalOf("t,T,X_H2\n0,300,1\n"), HasSubstr("as \"pressure [Pa]\""));
  EXPECT_THAT(refusalOf("t,T,p,Y_H2 [1]\n0,300,1e5,1\n"),
              HasSubstr("of species that the mechanism has; found 't', 'T', 'p', 'Y_H2 [1]'"));
  EXPECT_THAT(refusalOf("t,p,X_H2,t\n0,1e5,1,1\n"), HasSubstr("two columns say the same, 't' and 't'"));
  EXPECT_THAT(refusalOf("t,T,p,X_KRYPTON\n0,300,1e5,1\n"), HasSubstr("expected columns of mole fractions"));
  EXPECT_THAT(refusalOf("t [m],T,p,X_H2\n0,300,1e5,1\n"), HasSubstr("'t' is in m"));
  EXPECT_THAT(refusalOf("t,T,p,X_H2\n0,300,1e5,much\n"), HasSubstr("line 2: expected a finite number as 'X_H2'"));
  EXPECT_THAT(refusalOf("t,T,p,X_H2\n0,300,1e5\n"), HasSubstr("gas.csv"));
  EXPECT_THAT(refusalOf("t,time,T,p,X_H2\n0,0,300,1e5,1\n"), HasSubstr("two columns say the same, 't' and 'time'"));
  EXPECT_THAT(refusalOf("t,T,p,X_H2,X_H2\n0,300,1e5,1,1\n"), HasSubstr("two columns are called 'X_H2'"));
  EXPECT_THAT(refusalOf("t,T,p,X_H2\n"), HasSubstr("no rows"));
}

// The shipped case, and rows where the deck wants them.
TEST(PrescribedGasCase, TheShippedDeckHasItsRows) {
  const auto deck =
      Deck::load(test::sourceFolder / "cases/particles_along/premixed_ethylene_abf/deck.yaml",
                 {"output.interval=10 ms", "output.times=[4 ms, 20 ms]", "gas.end=25 ms"}, prescribedGasSchema());
  const PrescribedGasCase along = readPrescribedGasCase(deck);
  std::vector<double> times;
  for (const std::size_t point : along.recorded) times.push_back(along.path.points[point].time);
  ASSERT_EQ(times.size(), 5u);
  const double expected[] = {0, 4e-3, 10e-3, 20e-3, 25e-3};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(times[i], expected[i], 1e-15);
  EXPECT_EQ(along.recorded.back() + 1, along.path.points.size());
  ASSERT_TRUE(along.ensemble);
  const auto population = along.ensemble->make(0);
  const SootModelOptions& soot = dynamic_cast<const SootEnsemble&>(*population).ensemble().options().soot;
  EXPECT_EQ(soot.inceptionBy, InceptionBy::monomers);
  EXPECT_NEAR(soot.monomerMass, 3.2e-25, 1e-39);
  EXPECT_NEAR(soot.monomerDiameter, 7.11e-10, 1e-22);
  EXPECT_TRUE(soot.heavyParticles);
  EXPECT_EQ(soot.slip, SlipLaw::air);
  EXPECT_NEAR(soot.siteDensity, 2.3e19, 1e6);
  ASSERT_TRUE(soot.surface.closeByO2);
  EXPECT_EQ(soot.surface.closeByO2->A, 2.1e12);
  EXPECT_EQ(soot.surface.closeByO2->E, 7.47);
  EXPECT_EQ(soot.surface.oxidation.A, 2.2e12);
  EXPECT_TRUE(soot.surface.bounded);
}

}  // namespace
}  // namespace lampblack::app
