// One rank's failure becomes that of all: the lowest failing rank's, with its type and message.
#include "core/errors.hpp"

#include <gtest/gtest.h>

#include <new>

#include "core/system_error.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

TEST(Collectively, DoesNothingWhenNoRankFails) {
  int calls = 0;
  EXPECT_NO_THROW(collectively(MPI_COMM_WORLD, [&] { ++calls; }));
  EXPECT_EQ(calls, 1);
  EXPECT_NO_THROW(raiseCollectively(MPI_COMM_WORLD, nullptr));
}

TEST(Collectively, FailureOfAnyOneRankIsThrownByAllWithTypeAndMessage) {
  for (int failing = 0; failing < worldSize(); ++failing) {
    const std::string expected = "failed on rank " + std::to_string(failing);
    const auto fail = [&](auto&& raise) {
      collectively(MPI_COMM_WORLD, [&] {
        if (worldRank() == failing) raise();
      });
    };
    EXPECT_EQ(messageOf<InputError>([&] { fail([&] { throw InputError(expected); }); }), expected);
    EXPECT_EQ(messageOf<NumericsError>([&] { fail([&] { throw NumericsError(expected); }); }), expected);
    EXPECT_EQ(messageOf<SystemError>([&] { fail([&] { throw SystemError(expected); }); }), expected);
    EXPECT_EQ(messageOf<SystemError>([&] { fail([&] { throw std::bad_alloc(); }); }), outOfMemory().what());
    EXPECT_EQ(messageOf<std::runtime_error>([&] { fail([&] { throw std::out_of_range(expected); }); }), expected);
  }
}

TEST(Collectively, LowestFailingRankDecidesTypeAndMessage) {
  // All but rank 0 fail (rank 0 too when alone), each in its own way.
  const int lowest = worldSize() > 1 ? 1 : 0;
  const auto work = [&] {
    if (worldRank() < lowest) return;
    if (worldRank() == lowest) throw NumericsError("the lowest");
    throw InputError("a longer message of a higher rank, which must not be heard");
  };
  EXPECT_EQ(messageOf<NumericsError>([&] { collectively(MPI_COMM_WORLD, work); }), "the lowest");
}

TEST(Collectively, BugIsNeitherInputNorNumericsError) {
  const auto bug = [] { throw std::logic_error("a bug"); };
  EXPECT_EQ(messageOf<InputError>([&] { collectively(MPI_COMM_WORLD, bug); }), "other: a bug");
  EXPECT_EQ(messageOf<NumericsError>([&] { collectively(MPI_COMM_WORLD, bug); }), "other: a bug");
}

TEST(Collectively, WhatIsNoStandardExceptionIsStillReportedByAll) {
  const auto odd = [] {
    if (worldRank() == worldSize() - 1) throw 42;
  };
  EXPECT_NE(messageOf<std::runtime_error>([&] { collectively(MPI_COMM_WORLD, odd); }), "");
}

TEST(Collectively, ErrorRaisedOnAllRanksIsKnownAsSuch) {
  try {
    collectively(MPI_COMM_WORLD, [] { throw NumericsError("on all ranks"); });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const NumericsError& e) {
    EXPECT_TRUE(isCollective(e));
  }
  EXPECT_FALSE(isCollective(NumericsError("on one rank")));
}

TEST(Collectively, MessagesOfAnyLengthArriveWhole) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{100000}}) {
    const std::string expected(length, 'x');
    bool thrown = false;
    try {
      collectively(MPI_COMM_WORLD, [&] {
        if (worldRank() == worldSize() - 1) throw InputError(expected);
      });
    } catch (const InputError& e) {
      thrown = true;
      EXPECT_EQ(e.what(), expected);
    }
    EXPECT_TRUE(thrown);
  }
}

TEST(Collectively, RanksAreInStepAfterAFailure) {
  for (int round = 0; round < 20; ++round) {
    const int failing = round % worldSize();
    EXPECT_THROW(collectively(MPI_COMM_WORLD,
                              [&] {
                                if (worldRank() == failing) throw InputError("again");
                              }),
                 InputError);
    EXPECT_EQ(sumOverRanks(round), static_cast<double>(round * worldSize()));
  }
}

}  // namespace
}  // namespace lampblack::test
