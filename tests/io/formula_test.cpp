// Formulas of a deck.
#include "io/formula.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"

namespace lampblack::test {
namespace {

using testing::HasSubstr;

TEST(Formula, HasItsVariablesInTheirOrder) {
  const Formula parabola("2*0.3*(1 - (r/5e-3)^2) + t - z", {"r", "z", "t"});
  EXPECT_NEAR(parabola(std::array{2e-3, 0.25, 4.0}), 0.6 * (1.0 - 0.16) + 4.0 - 0.25, 1e-15);
  EXPECT_EQ(Formula("x < 0.5 ? 1 : 2", {"x"})(std::array{0.4}), 1.0);
  EXPECT_EQ(Formula("x < 0.5 ? 1 : 2", {"x"})(std::array{0.6}), 2.0);
  EXPECT_NEAR(Formula("sin(2*pi*x)", {"x"})(std::array{0.25}), 1.0, 1e-15);
  EXPECT_NEAR(Formula("max(0, tanh(x), exp(-x))", {"x"})(std::array{1.0}), std::tanh(1.0), 1e-15);
}

TEST(Formula, SaysWhatIsWrong) {
  EXPECT_THAT(messageOf<InputError>([] {
                Formula("2*radius", {"r", "t"});
              }),
              testing::AllOf(HasSubstr("2*radius"), HasSubstr("radius"), HasSubstr("its variables are r, t")));
  EXPECT_THAT(messageOf<InputError>([] { Formula("(1 + r", {"r"}); }), HasSubstr("cannot be read"));
  EXPECT_THAT(messageOf<InputError>([] { Formula("", {"r"}); }), HasSubstr("cannot be read"));
  EXPECT_THAT(messageOf<InputError>([] { Formula("r, 2", {"r"}); }), HasSubstr("one expression"));
  const Formula pole("1/r", {"r", "t"});
  EXPECT_THAT(messageOf<InputError>([&] {
                pole(std::array{0.0, 3.0});
              }),
              HasSubstr("no finite number at r = 0, t = 3"));
}

}  // namespace
}  // namespace lampblack::test
