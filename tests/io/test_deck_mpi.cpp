#include <fstream>

#include "tests/io/sample_deck.hpp"

namespace lampblack {
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

TEST(DeckOnRanks, IsReadByTheFirstAndKnownToAll) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const auto path = std::filesystem::temp_directory_path() / ("lampblack_deck_" + std::to_string(ranks) + ".yaml");
  if (rank == 0) std::ofstream(path) << test::sampleText;
  const Deck deck = Deck::load(path, {"seed=3"}, test::sampleSchema(), MPI_COMM_WORLD);
  EXPECT_EQ(deck.integer("seed"), 3);
  EXPECT_TRUE(sameEverywhere(deck.resolved()));
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) std::filesystem::remove(path);
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
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  EXPECT_EQ(failureOf("/nowhere/deck.yaml"), "/nowhere/deck.yaml: there is no such file; expected a deck");
  const auto path = std::filesystem::temp_directory_path() / ("lampblack_bad_deck_" + std::to_string(ranks) + ".yaml");
  if (rank == 0) std::ofstream(path) << test::sampleText;
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THAT(failureOf(path), testing::HasSubstr("--set seed=many: seed: expected an integer, found 'many'"));
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) std::filesystem::remove(path);
}

}  // namespace
}  // namespace lampblack
