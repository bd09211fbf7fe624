// The statistics of repeats against numbers worked out by hand, and what is said of them.
#include "particles/population/comparison/method_accumulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/modules.hpp"

namespace lampblack::particles {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// Three repeats of two rows (t = 0 and 2 s) and one bin; the moments of row r are values[r] times (1, 10, 100, 1000).
class PopulationStatisticsTest : public ::testing::Test {
 protected:
  PopulationStatisticsTest() {
    case_.times = {2, 1, 0};
    method_.name = "m";
    method_.type = "dsmc";
    method_.options = MonteCarloOptions{};
    case_.model.coagulation.emplace();
    frame_.rows = case_.times.rows();
    frame_.bins = {{1, 2}, {2}};
    frame_.exact.name = "given";
    frame_.exact.moments = {{1, 10, 100, 1000}, {2, 10, 200, 4000}};
  }

  std::vector<double> record(const FourMoments& first, const FourMoments& last, double number) const {
    std::vector<double> data(shape_.size(), 0.0);
    for (std::size_t k = 0; k < 4; ++k) {
      data[k] = first[k];
      data[6 + k] = last[k];
    }
    data[4] = data[10] = 1.5;
    data[5] = data[11] = 100;
    data[12] = number;
    data[13] = 0.5;      // s
    data[14] = noValue;  // does not gel
    data[15] = 7;        // coagulations
    data[20] = 3;        // fictitious: in the order of populationCounters
    return data;
  }

  MethodStatistics of(const std::vector<std::vector<double>>& records) {
    MethodAccumulator accumulator(case_, method_, frame_, shape_);
    for (const auto& data : records) accumulator.add(RepeatRecord(shape_, data));
    return accumulator.finish();
  }

  // M0 at the end: 2.2, 1.8 and 2.3, the exact value is 2. M1 is exact, M2 too large by 1 %, M3 is noisy.
  std::vector<std::vector<double>> threeRepeats() const {
    return {record({1, 10, 100, 1000}, {2.2, 10, 202, 3000}, 1), record({1, 10, 100, 1000}, {1.8, 10, 202, 4000}, 2),
            record({1, 10, 100, 1000}, {2.3, 10, 202, 5000}, 6)};
  }

  PopulationCase case_;
  PopulationMethod method_;
  PopulationStatistics frame_;
  RepeatRecord::Shape shape_{2, 1, 1};
};

TEST_F(PopulationStatisticsTest, MeanAndStandardErrorAreThoseOfTheRepeats) {
  const MethodStatistics made = of(threeRepeats());
  // s^2 = ((0.1)^2 + (0.3)^2 + (0.2)^2) / 2 = 0.07
  EXPECT_NEAR(made.mean[1][0], 2.1, 1e-15);
  EXPECT_NEAR(made.error[1][0], std::sqrt(0.07 / 3), 1e-15);
  EXPECT_EQ(made.error[0][0], 0);
  EXPECT_NEAR(made.number[0][0], 3, 1e-15);
  EXPECT_NEAR(made.numberError[0][0], std::sqrt((4 + 1 + 9) / 2.0 / 3), 1e-15);
  EXPECT_EQ(made.geometricDeviation[1], 1.5);
  EXPECT_EQ(made.particles[1], 100);
  EXPECT_EQ(made.counters.coagulations, 21U);
  EXPECT_EQ(made.counters.fictitious, 9U);
  EXPECT_EQ(made.secondsPerRepeat, 0.5);
  EXPECT_NEAR(made.eventsPerSecond, 14, 1e-13);
}

TEST_F(PopulationStatisticsTest, SigmaIsTheMeanOfTheRootsOfTheTimeMeans) {
  const MethodStatistics made = of(threeRepeats());
  // Deviations of M0 at the end: 0.1, -0.1, 0.15. The trapezoidal rule gives half of the square as the time mean.
  EXPECT_NEAR(made.sigma[1][0], (0.1 + 0.1 + 0.15) / 3 / std::sqrt(2), 1e-15);
  EXPECT_NEAR(made.sigma[1][2], 0.01 / std::sqrt(2), 1e-15);
  EXPECT_EQ(made.sigma[1][1], 0);
  EXPECT_EQ(made.sigma[0][0], 0);
  EXPECT_NEAR(made.repeats[2].sigma[0], 0.15 / std::sqrt(2), 1e-15);
}

// Coagulation keeps the mass: of three rows the second is off by 3 %, the last by 1 %.
TEST_F(PopulationStatisticsTest, TheErrorOfTheMassIsTheLargestOfAllRows) {
  case_.times = {2, 2, 0};
  frame_.rows = case_.times.rows();
  frame_.exact.moments.assign(3, {1, 10, 100, 1000});
  shape_ = {3, 1, 1};
  std::vector<double> data(shape_.size(), 0.0);
  const double masses[] = {10, 10.3, 9.9};
  for (std::size_t row = 0; row < 3; ++row) {
    const double values[] = {1, masses[row], 100, 1000, 1.5, 100};
    std::copy(std::begin(values), std::end(values), data.begin() + static_cast<std::ptrdiff_t>(6 * row));
  }
  data[18] = 1;        // number
  data[19] = 0.5;      // s
  data[20] = noValue;  // does not gel
  EXPECT_NEAR(of({data}).repeats[0].massError, 0.03, 1e-15);
}

TEST_F(PopulationStatisticsTest, ZIsTheDeviationInStandardErrorsAndMissingWithoutScatter) {
  const MethodStatistics made = of(threeRepeats());
  EXPECT_NEAR(made.z[0], 0.1 / std::sqrt(0.07 / 3), 1e-14);
  EXPECT_NEAR(made.deviation[0], 0.05, 1e-15);
  EXPECT_TRUE(std::isnan(made.z[1]));
  EXPECT_TRUE(std::isnan(made.z[2]));
  EXPECT_NEAR(made.deviation[2], 0.01, 1e-15);
  EXPECT_NEAR(made.z[3], 0, 1e-15);
}

TEST_F(PopulationStatisticsTest, ADeviationWithoutScatterIsABias) {
  EXPECT_EQ(of(threeRepeats()).bias, BiasVerdict::biased);
  EXPECT_EQ(of(threeRepeats()).verdict, "biased: M2 off by 1.0e-02 without scatter");
  method_.unbiased = {true, true, false, true};
  EXPECT_EQ(of(threeRepeats()).bias, BiasVerdict::noBias);
  method_.unbiased = {false, false, false, false};
  EXPECT_EQ(of(threeRepeats()).bias, BiasVerdict::biasedAsKnown);
}

TEST_F(PopulationStatisticsTest, MassThatIsNotConservedIsToldUnlessOnlyItsMeanIsClaimed) {
  auto records = threeRepeats();
  records[0][6 + 1] = 10 * (1 + 1e-6);
  records[1][6 + 1] = 10 * (1 - 1e-6);
  method_.unbiased = {true, true, false, true};
  const MethodStatistics strict = of(records);
  EXPECT_NEAR(strict.massError, 1e-6, 1e-15);
  EXPECT_EQ(strict.verdict, "biased: M1 not conserved (1.0e-06)");
  method_.conservesMass = false;
  EXPECT_EQ(of(records).bias, BiasVerdict::noBias);
  // Where a process makes mass it is compared with the exact one.
  case_.model.nucleation.emplace();
  frame_.exact.moments[1][1] = 20;
  EXPECT_NEAR(of(records).massError, 0.5, 1e-6);
}

TEST_F(PopulationStatisticsTest, FarFromTheExactValueIsABias) {
  auto records = threeRepeats();
  for (auto& record : records) record[6] += 1;  // 1.1 / 0.153 = 7.2
  method_.unbiased = {true, true, false, true};
  EXPECT_EQ(of(records).verdict, "biased: M0 (z = 7.2)");
}

TEST_F(PopulationStatisticsTest, RowsAfterAGelationAreDropped) {
  auto records = threeRepeats();
  records[1][6] = records[1][12] = noValue;
  records[1][14] = 1.25;
  const MethodStatistics made = of(records);
  EXPECT_EQ(made.mean.size(), 1U);
  EXPECT_TRUE(made.number.empty());
  EXPECT_EQ(made.gelation, 1.25);
  EXPECT_EQ(made.verdict, "gels at t = 1.25 s");
}

TEST_F(PopulationStatisticsTest, WithoutAnExactSolutionOnlyTheMassIsJudged) {
  frame_.exact = {};
  const MethodStatistics made = of(threeRepeats());
  EXPECT_TRUE(std::isnan(made.sigma[1][0]));
  EXPECT_TRUE(std::isnan(made.z[0]));
  EXPECT_EQ(made.massError, 0);
  EXPECT_EQ(made.verdict, "no exact solution");
}

TEST_F(PopulationStatisticsTest, OneRepeatHasNoScatter) {
  const MethodStatistics made = of({threeRepeats()[0]});
  EXPECT_TRUE(std::isnan(made.error[1][0]));
  EXPECT_EQ(made.bias, BiasVerdict::none);
}

// Anything that starts from nothing: 0/0 is no deviation.
TEST_F(PopulationStatisticsTest, AnEmptyStartIsExact) {
  frame_.exact.moments[0] = {0, 0, 0, 0};
  const MethodStatistics made = of({record({0, 0, 0, 0}, {2, 10, 200, 4000}, 1)});
  EXPECT_EQ(made.sigma[1][0], 0);
}

TEST(PopulationTimes, RowsAreLinearOrLogarithmicAndEndExactly) {
  EXPECT_EQ((PopulationTimes{1, 4, 0}.rows()), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  const std::vector<double> rows = PopulationTimes{100, 3, 1}.rows();
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0], 0);
  EXPECT_EQ(rows[1], 1);
  EXPECT_NEAR(rows[2], 10, 1e-14);
  EXPECT_EQ(rows[3], 100);
}

}  // namespace
}  // namespace lampblack::particles
