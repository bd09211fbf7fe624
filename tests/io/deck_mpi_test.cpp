#include <fstream>

#include "core/modules.hpp"
#include "tests/io/sample_deck.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::io {
namespace {

// Whether all ranks hold the same text.
bool sameEverywhere(const std::string& text) {
  const auto hash = static_cast<unsigned long>(std::hash<std::string>{}(text));
  unsigned long low = hash;
  unsigned long high = hash;
  MPI_Allreduce(MPI_IN_PLACE, &low, 1, MPI_UNSIGNED_LONG, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &high, 1, MPI_UNSIGNED_LONG, MPI_MAX, MPI_COMM_WORLD);
  return low == high;
}

// The sample deck as a file of the first rank.
struct SampleFile {
  SampleFile() {
    if (test::worldRank() == 0) std::ofstream(path) << test::sampleText;
  }
  test::SharedScratchFolder folder;
  std::filesystem::path path = folder.path() / "deck.yaml";
};

TEST(DeckOnRanks, IsReadByTheFirstAndKnownToAll) {
  const SampleFile file;
  const Deck deck = Deck::load(file.path, {"seed=3"}, test::sampleSchema(), MPI_COMM_WORLD);
  EXPECT_EQ(deck.integer("seed"), 3);
  EXPECT_TRUE(sameEverywhere(deck.resolved()));
}

// The message of the error that loading raises, which all ranks have to raise together.
std::string failureOf(const std::filesystem::path& path) {
  try {
    (void)Deck::load(path, {"seed=many"}, test::sampleSchema(), MPI_COMM_WORLD);
  } catch (const InputError& error) {
    EXPECT_TRUE(isCollective(error));
    EXPECT_TRUE(sameEverywhere(error.what()));
    return error.what();
  }
  return "accepted";
}

TEST(DeckOnRanks, FailsAlikeOnAll) {
  EXPECT_EQ(failureOf("/nowhere/deck.yaml"), "/nowhere/deck.yaml: there is no such file; expected a deck");
  const SampleFile file;
  EXPECT_THAT(failureOf(file.path), testing::HasSubstr("--set seed=many: seed: expected an integer, found 'many'"));
}

}  // namespace
}  // namespace lampblack::io
