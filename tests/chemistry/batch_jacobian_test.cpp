#include "chemistry/kinetics/batch_jacobian.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "chemistry/kinetics/batch_jacobian_kernel.hpp"
#include "chemistry/kinetics/batch_kinetics_tables.hpp"
#include "chemistry/kinetics/batch_workspace.hpp"
#include "chemistry/kinetics/kinetics.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/kinetics_rate_types.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::measured;
using lampblack::test::RateTypes;
using Vector = Doubled<Doubled<PortableVector<16>>>;  // that of any processor
using Kernel = BatchJacobianKernel<Vector>;

constexpr std::size_t kLanes = batchLanes;

// Rates and derivatives of a block, with S in the order of the pattern.
class Block {
 public:
  explicit Block(const Mechanism& mechanism)
      : n_(mechanism.numSpecies()),
        tables_(mechanism),
        batch_(mechanism, tables_),
        table_(tables_),
        jacobian_(
            tables_, batch_.view(), batch_.numEntries(), table_,
            [this](std::size_t row, std::size_t column) { return place(row, column); },
            static_cast<std::uint32_t>(table_.pattern().numEntries() * kLanes)),
        rates_(batch_.view(), batch_.numEntries()),
        rows_({{&work_.slope, batch_.numEntries()},
               {&work_.byM, batch_.numEntries()},
               {&work_.columns, jacobian_.view().columns},
               {&work_.h, n_},
               {&work_.cp, n_},
               {&work_.cpSlope, n_},
               {&work_.wdot, n_ + 1},
               {&work_.byT, n_ + 1},
               {&work_.common, n_},
               {&work_.values, table_.pattern().numEntries() + 1}}) {}

  [[nodiscard]] double minTemperature() const { return batch_.view().minProductTemperature; }
  [[nodiscard]] const BatchJacobianWork& work() const { return work_; }

  // T by lane, c by species and lane.
  void evaluate(const std::vector<double>& T, const std::vector<double>& c) {
    Vector::D total{};
    for (std::size_t k = 0; k < n_; ++k) {
      const auto row = Vector::loadUnaligned(&c[k * kLanes]);
      Vector::store(rates_.work().c + k * kLanes, row);
      total += row;
    }
    const auto temperatures = Vector::loadUnaligned(T.data());
    Kernel::thermo<true>(batch_.view(), work_, temperatures);
    Kernel::run(batch_.view(), jacobian_.view(), rates_.work(), work_, temperatures, total);
  }

 private:
  [[nodiscard]] std::uint32_t place(std::size_t row, std::size_t column) const {
    const auto& pattern = table_.pattern();
    for (auto e = pattern.columnStart[column]; e < pattern.columnStart[column + 1]; ++e)
      if (static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(e)]) == row)
        return static_cast<std::uint32_t>(static_cast<std::size_t>(e) * kLanes);
    throw std::logic_error("not in the pattern");
  }

  std::size_t n_;
  KineticsTables tables_;
  BatchTables batch_;
  JacobianTable table_;
  BatchJacobianTables jacobian_;
  BatchWorkspace rates_;
  BatchJacobianWork work_{};
  BatchRows rows_;
};

// The largest difference from Kinetics in a block of states, of the largest derivative in the column (by T: of all).
double differenceFromKinetics(const Mechanism& mechanism) {
  Block block(mechanism);
  Kinetics kinetics(mechanism);
  const std::size_t n = mechanism.numSpecies(), entries = kinetics.jacobianPattern().numEntries();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  double worst = 0;
  for (int round = 0; round < 6; ++round) {
    std::vector<double> T(kLanes), c(n * kLanes);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double coldest = std::max(block.minTemperature(), 200.0);
      T[lane] = coldest * std::pow(3900.0 / coldest, uniform(random));
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k)
        sum += c[k * kLanes + lane] =
            round % 3 == 1 && random() % 3 == 0 ? 0.0 : std::pow(10.0, -12.0 * uniform(random));
      const double p = std::pow(10.0, 2.0 + 5.0 * uniform(random));
      for (std::size_t k = 0; k < n; ++k) c[k * kLanes + lane] *= p / (constants::gasConstant * T[lane] * sum);
    }
    block.evaluate(T, c);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      std::vector<double> own(n), wdot(n), values(entries), common(n), byT(n);
      for (std::size_t k = 0; k < n; ++k) own[k] = c[k * kLanes + lane];
      kinetics.netProductionRatesAndSparseJacobian(T[lane], own, wdot, values, common, byT);
      const auto compare = [&](const double* rows, const std::vector<double>& reference, std::size_t begin,
                               std::size_t end, double size) {
        for (std::size_t i = begin; i < end; ++i)
          if (size > 0) worst = std::max(worst, std::abs(rows[i * kLanes + lane] - reference[i]) / size);
      };
      const auto largest = [](const std::vector<double>& of, std::size_t begin, std::size_t end) {
        double result = 0;
        for (std::size_t i = begin; i < end; ++i) result = std::max(result, std::abs(of[i]));
        return result;
      };
      const auto& work = block.work();
      compare(work.common, common, 0, n, largest(common, 0, n));
      compare(work.byT, byT, 0, n, largest(byT, 0, n));
      // Rates are differences of large ones: of the size of the derivative by T times T.
      compare(work.wdot, wdot, 0, n, largest(byT, 0, n) * T[lane]);
      const auto& start = kinetics.jacobianPattern().columnStart;
      for (std::size_t j = 0; j < n; ++j) {
        const auto begin = static_cast<std::size_t>(start[j]), end = static_cast<std::size_t>(start[j + 1]);
        compare(work.values, values, begin, end, largest(values, begin, end));
      }
    }
  }
  return worst;
}

// The tolerance of BatchKinetics against Kinetics: round-off of exponents of up to 500, magnified where large rates
// cancel.
TEST(BatchJacobian, AgreesWithKineticsInEveryMechanism) {
  for (const char* name : {"hydrogen_h2o2_10", "methane_drm19_21", "ethylene_bisetti2012_47", "methane_gri30_53",
                           "ethylene_abf2000_101", "ethylene_narayanaswamy2010_158"}) {
    const auto mechanism = Mechanism::fromFile(test::sourcePath(std::string("cases/mechanisms/") + name + ".yaml"));
    const double difference = differenceFromKinetics(mechanism);
    EXPECT_LT(difference, 1e-10) << name;
    measured("derivatives in lanes against one by one, of the largest in the column", difference);
  }
}

TEST(BatchJacobian, AgreesWithKineticsForEveryFallOff) {
  for (const auto& reaction : {RateTypes::sriFalloff(), RateTypes::activated(), RateTypes::tsangFalloff()})
    EXPECT_LT(differenceFromKinetics(RateTypes::withOnly(reaction)), 1e-10) << reaction.equation;
}

TEST(BatchJacobian, LeavesRarerRatesToKinetics) {
  const auto isCovered = [](const Mechanism& mechanism) {
    const KineticsTables tables(mechanism);
    return BatchJacobianTables::covers(tables, BatchTables(mechanism, tables).view());
  };
  EXPECT_TRUE(isCovered(RateTypes::withOnly(RateTypes::sriFalloff())));
  for (const auto& reaction :
       {RateTypes::pressureLog(), RateTypes::chebyshev(), RateTypes::linearBurke(), RateTypes::blowersMasel()[0]})
    EXPECT_FALSE(isCovered(RateTypes::withOnly(reaction))) << reaction.equation;
  EXPECT_FALSE(isCovered(RateTypes::mechanism()));  // with orders that are no whole numbers
  const auto rare = RateTypes::withOnly(RateTypes::pressureLog());
  EXPECT_THROW(Block{rare}, std::logic_error);
}

}  // namespace
