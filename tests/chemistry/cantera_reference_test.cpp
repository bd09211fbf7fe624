// Thermodynamics and rates against Cantera's tables (tests/chemistry/data), which are in kmol and have 13 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::Table;

double order(const std::vector<StoichiometricTerm>& terms) {
  double sum = 0;
  for (const auto& t : terms) sum += t.coefficient;
  return sum;
}

struct Reference {
  const char* tables;
  const char* mechanism;
};

class CanteraReference : public ::testing::TestWithParam<Reference> {
 protected:
  Table table(const std::string& kind) const {
    return Table(std::string("kinetics_") + GetParam().tables + "_" + kind + ".csv");
  }
  std::vector<double> concentrations(const Table& states, std::size_t s) const {
    auto c = states.moleFractions(s, mechanism);
    const double total = states.number(s, "p") / (constants::gasConstant * states.number(s, "T"));
    for (double& value : c) value *= total;
    return c;
  }

  Mechanism mechanism =
      Mechanism::fromFile(lampblack::test::sourcePath(std::string("cases/mechanisms/") + GetParam().mechanism));
};

TEST_P(CanteraReference, Thermodynamics) {
  const Thermo thermo(mechanism);
  const auto states = table("states"), mixture = table("mixture"), species = table("species");
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> Y(n), cp(n), h(n), entropy(n);
  double worst = 0, worstCp = 0, worstEnthalpy = 0, worstEntropy = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const double T = states.number(s, "T"), p = states.number(s, "p");
    thermo.moleToMass(states.moleFractions(s, mechanism), Y);
    raise(worst, thermo.meanMolecularWeight(Y) * 1e3 / mixture.number(s, "W") - 1);
    raise(worst, thermo.density(T, p, Y) / mixture.number(s, "rho") - 1);
    raise(worst, thermo.cpMass(T, Y) / mixture.number(s, "cp") - 1);
    raise(worstEnthalpy, (thermo.enthalpyMass(T, Y) - mixture.number(s, "h")) / (mixture.number(s, "cp") * T));
    raise(worstEntropy, thermo.entropyMass(T, p, Y) / mixture.number(s, "s") - 1);
    thermo.speciesCp(T, cp);
    thermo.speciesEnthalpies(T, h);
    thermo.speciesEntropies(T, entropy);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t row = s * n + k;
      ASSERT_EQ(species.text(row, "species"), mechanism.speciesName(k));
      const double W = 1e3 * mechanism.molecularWeights()[k];
      raise(worstCp, cp[k] * W / species.number(row, "cp") - 1);
      raise(worstEntropy, entropy[k] * W / species.number(row, "s") - 1);
      raise(worstEnthalpy, (h[k] * W - species.number(row, "h")) / (species.number(row, "cp") * T));
    }
  }
  measured("mixture weight, density and heat capacity", worst);
  measured("species heat capacity", worstCp);
  measured("enthalpy, of cp T", worstEnthalpy);
  measured("entropy, mixture and species", worstEntropy);
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(worstCp, 1e-12);
  EXPECT_LT(worstEnthalpy, 1e-11);
  EXPECT_LT(worstEntropy, 1e-12);
}

// Rate constants exclude [M] there as here; those of fall-off reactions are effective.
TEST_P(CanteraReference, RateConstants) {
  Kinetics kinetics(mechanism);
  const auto states = table("states"), reactions = table("reactions");
  const std::size_t n = mechanism.numReactions();
  ASSERT_EQ(reactions.size(), states.size() * n);
  std::vector<double> kf(n), kr(n), qf(n), qr(n);
  double worstForward = 0, worstReverse = 0, worstProgress = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const double T = states.number(s, "T");
    const auto c = concentrations(states, s);
    kinetics.rateConstants(T, c, kf, kr);
    kinetics.ratesOfProgress(T, c, qf, qr);
    for (std::size_t r = 0; r < n; ++r) {
      const auto& reaction = mechanism.reaction(r);
      const double extra = reaction.type == Reaction::Type::ThreeBody ? 1 : 0;
      const double kmolForward = std::pow(1e3, order(reaction.reactants) + extra - 1);
      const double kmolReverse = std::pow(1e3, order(reaction.products) + extra - 1);
      const std::size_t row = s * n + r;
      raise(worstForward, kf[r] * kmolForward / reactions.number(row, "kf") - 1);
      const double reverse = reactions.number(row, "kr");
      if (reverse > 1e-280) raise(worstReverse, kr[r] * kmolReverse / reverse - 1);
      const double gross = 1e3 * (reactions.number(row, "qf") + reactions.number(row, "qr"));
      if (gross > 1e-280) {
        raise(worstProgress, (qf[r] - 1e3 * reactions.number(row, "qf")) / gross);
        raise(worstProgress, (qr[r] - 1e3 * reactions.number(row, "qr")) / gross);
      }
    }
  }
  measured("forward rate constants", worstForward);
  measured("reverse rate constants", worstReverse);
  measured("rates of progress", worstProgress);
  EXPECT_LT(worstForward, 1e-10);
  EXPECT_LT(worstReverse, 1e-9);
  EXPECT_LT(worstProgress, 1e-9);
}

TEST_P(CanteraReference, NetProductionRates) {
  Kinetics kinetics(mechanism);
  const auto states = table("states"), species = table("species");
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> wdot(n);
  double worst = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    kinetics.netProductionRates(states.number(s, "T"), concentrations(states, s), wdot);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t row = s * n + k;
      const double gross = 1e3 * std::max(species.number(row, "creation"), species.number(row, "destruction"));
      const double difference = wdot[k] - 1e3 * species.number(row, "net");
      if (gross > 1e-280)
        raise(worst, difference / gross);
      else
        EXPECT_LT(std::abs(difference), 1e-280) << mechanism.speciesName(k);
    }
  }
  measured("net rates, of the species' gross rate", worst);
  EXPECT_LT(worst, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Tables, CanteraReference,
                         ::testing::Values(Reference{"h2o2", "hydrogen_h2o2_10.yaml"},
                                           Reference{"gri30", "methane_gri30_53.yaml"}),
                         [](const auto& tested) { return std::string(tested.param.tables); });

}  // namespace
