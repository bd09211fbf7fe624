// Of several errors all ranks throw that with the smallest number; and what ranks agree on in one reduction.
#include "core/first_error.hpp"

#include <gtest/gtest.h>

#include <array>
#include <csignal>

#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

TEST(FirstError, IsThatOfTheSmallestNumberOnAnyRank) {
  const int last = worldSize() - 1;
  const auto error = [](std::int64_t number) {
    return std::make_exception_ptr(NumericsError("number " + std::to_string(number)));
  };
  // Numbers beyond 32 bits fall with the rank.
  const std::int64_t own = (std::int64_t{1} << 40) + 7 - worldRank();
  const std::string expected = "number " + std::to_string((std::int64_t{1} << 40) + 7 - last);
  EXPECT_EQ(messageOf<NumericsError>([&] { raiseFirst(MPI_COMM_WORLD, error(own), own); }), expected);
  // One rank alone, in turn.
  for (int failing = 0; failing <= last; ++failing)
    EXPECT_EQ(messageOf<NumericsError>([&] {
                raiseFirst(MPI_COMM_WORLD, worldRank() == failing ? error(5) : nullptr, worldRank() == failing ? 5 : 0);
              }),
              "number 5");
  EXPECT_NO_THROW(raiseFirst(MPI_COMM_WORLD, nullptr, 0));
}

TEST(FirstError, OfAllRanksIsKnownAsSuch) {
  try {
    raiseTogether(MPI_COMM_WORLD, InputError("everywhere"));
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "everywhere");
    EXPECT_TRUE(isCollective(error));
  }
}

TEST(StopRequest, BringsOtherWishesAlong) {
  std::array<int, 3> wishes{worldRank() == worldSize() - 1 ? 2 : 0, 0, 1 + worldRank()};
  EXPECT_EQ(agreedStopRequest(MPI_COMM_WORLD, wishes), 0);
  EXPECT_EQ(wishes, (std::array<int, 3>{2, 0, worldSize()}));
}

TEST(StopRequest, OfAnotherCauseEndsAsSigtermDoes) {
  try {
    raiseStopped(MPI_COMM_WORLD, "a limit", "at noon");
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Stopped& stopped) {
    EXPECT_STREQ(stopped.what(), "stopped by a limit at noon");
    EXPECT_EQ(stopped.signal(), SIGTERM);
  }
}

}  // namespace
}  // namespace lampblack::test
