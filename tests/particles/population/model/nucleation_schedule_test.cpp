#include "particles/population/model/nucleation_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "core/random.hpp"

namespace lampblack::particles {
namespace {

using Source = NucleationOptions::Source;

NucleationOptions table() {
  NucleationOptions options;
  options.source = Source::table;
  options.times = {1, 2, 4, 5, 6, 8};
  options.rates = {0, 3, 3, 0, 0, 5};  // silent from 5 to 6
  return options;
}

// Simpson's rule between the points of the table is exact for the linear rate.
double integrated(const NucleationSchedule& schedule, double from, double to, int steps) {
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double a = from + (to - from) * k / steps, b = from + (to - from) * (k + 1) / steps;
    sum += (b - a) / 6 * (schedule.rate(a) + 4 * schedule.rate(0.5 * (a + b)) + schedule.rate(b));
  }
  return sum;
}

TEST(NucleationSchedule, CumulativeIsTheIntegralOfTheRate) {
  const NucleationSchedule ofTable(table());
  // Steps of 1/64 end at the points of the table.
  for (const double end : {0.5, 1.25, 2.0, 3.5, 4.75, 5.5, 7.0, 8.0}) {
    EXPECT_NEAR(ofTable.cumulative(end), integrated(ofTable, 0, end, static_cast<int>(64 * end)), 1e-13) << end;
  }
  EXPECT_DOUBLE_EQ(ofTable.cumulative(8), 1.5 + 6 + 1.5 + 0 + 5);
  EXPECT_DOUBLE_EQ(ofTable.cumulative(100), 14);

  NucleationOptions precursor;
  precursor.source = Source::precursor;
  precursor.rateConstant = 0.3;
  precursor.precursor = 50;
  const NucleationSchedule decaying(precursor);
  EXPECT_NEAR(decaying.cumulative(2), 50 * (1 - std::exp(-0.6)), 1e-13);
  EXPECT_NEAR(decaying.cumulative(2), integrated(decaying, 0, 2, 1000), 1e-11);
}

TEST(NucleationSchedule, InverseIsTheInverse) {
  NucleationOptions constant;
  constant.rate = 7;
  NucleationOptions precursor;
  precursor.source = Source::precursor;
  precursor.rateConstant = 5e-6;
  precursor.precursor = 1e5;
  for (const auto& [options, most] : {std::pair{constant, 100.0}, {precursor, 1e5}, {table(), 14.0}}) {
    const NucleationSchedule schedule(options);
    RandomStream random(1, 0, 0);
    for (int k = 0; k < 1000; ++k) {
      const double number = most * random.uniform();
      const double time = schedule.timeOf(number);
      // A time near a zero of the rate is as good as its rounding times the rate allows.
      ASSERT_NEAR(schedule.cumulative(time), number, 1e-13 * most) << number;
    }
  }
}

TEST(NucleationSchedule, NothingAppearsWhereTheRateIsZero) {
  const NucleationSchedule schedule(table());
  for (int k = 1; k < 2000; ++k) {
    const double time = schedule.timeOf(14.0 * k / 2000);
    EXPECT_TRUE((time > 1 && time <= 5) || (time >= 6 && time <= 8)) << time;
  }
  EXPECT_EQ(schedule.timeOf(14.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(schedule.timeOf(20.0), std::numeric_limits<double>::infinity());

  NucleationOptions off;
  EXPECT_EQ(NucleationSchedule(off).timeOf(1), std::numeric_limits<double>::infinity());
  NucleationOptions finite;
  finite.source = Source::precursor;
  finite.rateConstant = 1;
  finite.precursor = 10;
  EXPECT_EQ(NucleationSchedule(finite).timeOf(10), std::numeric_limits<double>::infinity());
}

TEST(NucleationSchedule, ATableHasToIncrease) {
  NucleationOptions options = table();
  options.times[2] = options.times[1];
  EXPECT_THROW(NucleationSchedule{options}, InputError);
  options = table();
  options.rates.pop_back();
  EXPECT_THROW(NucleationSchedule{options}, InputError);
  options.times = {1};
  options.rates = {1};
  EXPECT_THROW(NucleationSchedule{options}, InputError);
}

}  // namespace
}  // namespace lampblack::particles
