// A new problem is a file with its keys and its run, and one row of the table of problems: the deck's checks, the
// folder, the record, the results file and the messages come with it.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <vector>

#include "app/shell/problem.hpp"
#include "io/deck_keys.hpp"
#include "io/hdf5_reader.hpp"
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
  keys.quantity("rate", units::frequency, &DecayCase::rate, rules().required().above(0), "How fast it decays.");
  keys.quantity("end", units::time, &DecayCase::end, rules().above(0), "Simulated time.");
  keys.integer("rows", &DecayCase::rows, rules().atLeast(1).atMost(1000), "Rows of the table behind the first.");
  return keys;
}

class Decay : public PreparedRun {
 public:
  Decay(MPI_Comm comm, const Deck& deck) : comm_(comm), deck_(deck), case_(decayKeys().read(deck)) {}
  [[nodiscard]] std::string summary() const override { return fmt::format("decay at {:g} 1/s", case_.rate); }
  void run(const RunOptions& options) override {
    recordedRun(comm_, deck_, options, 0, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
      std::vector<double> rows;
      for (int i = 0; i <= case_.rows; ++i) {
        const double time = case_.end * i / case_.rows;
        rows.insert(rows.end(), {time, std::exp(-case_.rate * time)});
      }
      record.simulatedTime = case_.end;
      ResultsWriter results(comm_, folder.results(), info);
      results.table("/decay", {{"time", "s", "time"}, {"amount", "1", "what is left"}}, rows);
      results.close();
    });
  }

 private:
  MPI_Comm comm_;
  const Deck& deck_;
  DecayCase case_;
};

DeckSchema decaySchema() {
  return DeckSchema(decayKeys().schema()).add(choiceKey("problem", {"decay"}, "What is solved."));
}

std::vector<Problem> problemsAndDecay() {
  std::vector<Problem> table = problems();
  table.push_back({"decay", "Something vanishes.", decaySchema,
                   [](MPI_Comm comm, const Deck& deck) -> std::unique_ptr<PreparedRun> {
                     return std::make_unique<Decay>(comm, deck);
                   }});
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
