#include "io/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "core/modules.hpp"

namespace lampblack::io {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;

TEST(Progress, PrintsALineEveryFewSecondsToALog) {
  std::ostringstream out;
  const auto start = Progress::Clock::now();
  Progress progress(out, false, 0.0, 10.0, start);
  for (int i = 1; i <= 10; ++i) progress.update(i, i, 1.0, "Tmax 2000 K", start + seconds(i));
  progress.finish(start + seconds(11));
  const std::string text = out.str();
  // At 1 s (the first), 6 s, and 10 s, which finish() still prints.
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_THAT(text, HasSubstr("step      6  t 6 s  dt 1 s   60.0 %  to go 4.00 s  Tmax 2000 K\n"));
  EXPECT_THAT(text, HasSubstr("100.0 %"));
}

TEST(Progress, SaysNothingOfShortRuns) {
  std::ostringstream out;
  const auto start = Progress::Clock::now();
  Progress progress(out, false, 0.0, 8.0, start, seconds(5));
  progress.say("swa, repeat 2 of 8", 4.0 / 3, "", start + seconds(4));
  EXPECT_FALSE(progress.due(start + seconds(4)));
  progress.finish(start + seconds(4));
  EXPECT_EQ(out.str(), "");
  EXPECT_TRUE(progress.due(start + seconds(6)));
  progress.say("swa, repeat 2 of 8", 2.0, "", start + seconds(6));
  EXPECT_EQ(out.str(), "swa, repeat 2 of 8   25.0 %  to go 18 s\n");
  EXPECT_FALSE(progress.due(start + seconds(7)));
}

TEST(Progress, DoesNotCountYears) {
  std::ostringstream out;
  const auto start = Progress::Clock::now();
  Progress progress(out, false, 0.0, 1e300, start);
  for (int i = 1; i <= 30; ++i) progress.update(i, i, 1, "", start + seconds(i));
  EXPECT_THAT(out.str(), HasSubstr("0.0 %  to go more than a year\n"));
}

TEST(Progress, SaysNothingOfTheTimeToGoAtTheFirstStep) {
  std::ostringstream out;
  const auto start = Progress::Clock::now();
  Progress progress(out, false, 0.0, 1.0, start);
  progress.update(1, 1e-5, 1e-5, "Tmax 2000 K", start + seconds(1));
  EXPECT_EQ(out.str(), "step      1  t 1e-05 s  dt 1e-05 s    0.0 %  Tmax 2000 K\n");
}

TEST(Progress, KeepsOneLineOnATerminal) {
  std::ostringstream out;
  const auto start = Progress::Clock::now();
  Progress progress(out, true, 0.0, 10.0, start);
  progress.update(1, 1.0, 1.0, "a long remark", start + seconds(1));
  progress.update(2, 2.0, 1.0, "", start + seconds(2));
  EXPECT_EQ(out.str().find('\n'), std::string::npos);
  const std::size_t second = out.str().rfind('\r');
  EXPECT_GE(out.str().size() - second, second) << "the shorter line has to cover the longer one";
  progress.finish();
  EXPECT_EQ(out.str().back(), '\n');
}

}  // namespace
}  // namespace lampblack::io
