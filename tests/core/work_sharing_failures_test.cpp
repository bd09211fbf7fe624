// A failing item, wherever it runs and in whichever of its functions, ends the run on all ranks with one message and
// leaves the ranks in step. (A deadlock shows as ctest's timeout.)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "work_items.hpp"

namespace lampblack::test {
namespace {

// After a failure the same ranks must be able to share work again.
void expectInStep() {
  Bag bag(skewed());
  WorkSharing(MPI_COMM_WORLD).run(bag.items);
  EXPECT_EQ(sumOverRanks(bag.advanced), static_cast<double>(total(skewed())));
}

TEST(WorkSharingFailure, AnyItemThatFailsToAdvanceStopsAllRanksWithItsMessage) {
  const int count = total(skewed());
  for (const bool enabled : {true, false}) {
    for (int failing = 0; failing < count; failing += 7) {
      Bag bag(skewed(), 3);
      const auto advance = bag.items.advance;
      bag.items.advance = [&](std::span<const double> input, std::vector<double>& output) {
        if (input.front() == failing) throw NumericsError("item " + std::to_string(failing) + " failed");
        advance(input, output);
      };
      const auto message = messageOf<NumericsError>([&] { WorkSharing(MPI_COMM_WORLD, enabled).run(bag.items); });
      EXPECT_EQ(message, "item " + std::to_string(failing) + " failed");
    }
  }
  expectInStep();
}

TEST(WorkSharingFailure, FailuresOnAllRanksAtOnceGiveOneMessage) {
  Bag bag(skewed());
  bag.items.advance = [](std::span<const double> input, std::vector<double>&) {
    throw NumericsError("item " + std::to_string(static_cast<int>(input.front())) + " failed");
  };
  const auto message = messageOf<NumericsError>([&] { WorkSharing(MPI_COMM_WORLD).run(bag.items); });
  EXPECT_THAT(message, testing::MatchesRegex("item [0-9]+ failed"));
  EXPECT_TRUE(sameOnAllRanks(message));
  expectInStep();
}

TEST(WorkSharingFailure, ItemThatFailsToPackOrUnpackStopsAllRanksWhetherItTravelsOrNot) {
  for (int busy = 0; busy < worldSize(); ++busy) {
    for (std::size_t failing = 0; failing < 20; ++failing) {
      for (const bool packing : {true, false}) {
        Bag bag(allOn(busy, 20));
        const auto pack = bag.items.pack;
        const auto unpack = bag.items.unpack;
        bag.items.pack = [&](std::size_t item, std::vector<double>& input) {
          if (packing && item == failing) throw NumericsError("cannot pack");
          pack(item, input);
        };
        bag.items.unpack = [&](std::size_t item, std::span<const double> output) {
          if (!packing && item == failing) throw NumericsError("cannot unpack");
          unpack(item, output);
        };
        EXPECT_EQ(messageOf<NumericsError>([&] { WorkSharing(MPI_COMM_WORLD).run(bag.items); }),
                  packing ? "cannot pack" : "cannot unpack");
      }
    }
  }
  expectInStep();
}

TEST(WorkSharingFailure, ItemThatTravelledFailsAsItWouldAtHome) {
  // All items on one rank and all of them failing alike: whoever runs them, the message is the same.
  Bag bag(allOn(worldSize() - 1, 12));
  bag.items.advance = [](std::span<const double>, std::vector<double>&) { throw InputError("no such species"); };
  EXPECT_EQ(messageOf<InputError>([&] { WorkSharing(MPI_COMM_WORLD).run(bag.items); }), "no such species");
  expectInStep();
}

TEST(WorkSharingFailure, InvalidCostOnOneRankIsRefusedByAll) {
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Bag bag(skewed());
    if (worldRank() == worldSize() - 1) bag.items.cost.back() = bad;
    EXPECT_THROW(WorkSharing(MPI_COMM_WORLD).run(bag.items), std::invalid_argument);
  }
  expectInStep();
}

}  // namespace
}  // namespace lampblack::test
