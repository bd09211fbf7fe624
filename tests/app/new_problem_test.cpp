// A new problem is a file with its keys and its run, and one row of the table of problems: the deck's checks, the
// folder, the record, the results file and the messages come with it.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <ranges>
#include <vector>

#include "app/shell/problem.hpp"
#include "io/deck_keys.hpp"
#include "io/hdf5_reader.hpp"
#include "io/table.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/messages.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using testing::HasSubstr;

struct DecayCase {
  double rate = 0.0, end = 1.0;  // 1/s, s
  int rows = 10;
};

DeckKeys<DecayCase> decayKeys() {
  DeckKeys<DecayCase> keys("");
  keys.choice("problem", {"decay"}, rules(), "What is solved.");
  keys.quantity("rate", units::frequency, &DecayCase::rate, rules().required().above(0), "How fast it decays.");
  keys.quantity("end", units::time, &DecayCase::end, rules().above(0), "Simulated time.");
  keys.integer("rows", &DecayCase::rows, rules().atLeast(1).atMost(1000), "Rows of the table behind the first.");
  return keys;
}

class Decay : public PreparedRunOf<DecayCase> {
 public:
  Decay(MPI_Comm comm, const Deck& deck)
      : PreparedRunOf(comm, deck, [](const Deck& keys) { return decayKeys().read(keys); }) {}
  [[nodiscard]] std::string summary() const override { return fmt::format("decay at {:g} 1/s", case_.rate); }
  void run(const RunOptions& options) override {
    recordedRun(comm_, deck_, options, 0, [&](const RunFolder& folder, const RunInfo& info, RunRecord&) {
      const TableOf<int> decay{
          {{"time", "s", "time"}, [this](int row) { return timeOf(row); }},
          {{"amount", "1", "what is left"}, [this](int row) { return std::exp(-case_.rate * timeOf(row)); }}};
      ResultsWriter results(comm_, folder.results(), info);
      decay.of(std::views::iota(0, case_.rows + 1)).write(results, "/decay");
      results.close();
    });
  }

 private:
  [[nodiscard]] double timeOf(int row) const { return case_.end * row / case_.rows; }
};

std::vector<Problem> problemsAndDecay() {
  std::vector<Problem> table = problems();
  table.push_back({"decay", "Something vanishes.", [] { return decayKeys().schema(); }, preparedAs<Decay>});
  return table;
}

Deck decayDeck(const std::string& text) {
  return Deck::parse(text, "deck.yaml", {}, deckKinds(problemsAndDecay()));
}

TEST(NewProblem, RunsFromItsRowOfTheTable) {
  const test::SharedScratchFolder scratch;
  const Deck deck = decayDeck("{problem: decay, rate: 2 1/s, rows: 4}");
  const auto prepared = problemOf(deck, problemsAndDecay()).prepare(MPI_COMM_WORLD, deck);
  EXPECT_EQ(prepared->summary(), "decay at 2 1/s");
  RunOptions options;
  options.folder = scratch.path() / "run";
  prepared->run(options);
  const Hdf5Reader results(options.folder / "results.h5");
  EXPECT_DOUBLE_EQ(results.numbers("/decay/amount").back(), std::exp(-2.0));
  EXPECT_EQ(results.numbers("/decay/time").size(), 5u);
  EXPECT_TRUE(std::filesystem::exists(options.folder / "run.json"));
}

TEST(NewProblem, ItsDeckIsCheckedAsAllDecksAre) {
  EXPECT_THAT(test::messageOf<InputError>([] { (void)decayDeck("{problem: decay, rat: 2 1/s}"); }),
              HasSubstr("did you mean 'rate'"));
  EXPECT_THAT(test::messageOf<InputError>([] { (void)decayDeck("{problem: decays, rate: 2 1/s}"); }),
              HasSubstr("'decay'"));
}

}  // namespace
}  // namespace lampblack::app
