// A new problem is a file with its keys and its run, and one row of the table of problems: the deck's checks, the
// folder, the record, the results file and the messages come with it.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <vector>

#include "app/shell/problem.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/messages.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using testing::HasSubstr;

DeckSchema decaySchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"decay"}, "What is solved."))
      .add(quantityKey("rate", units::frequency, "How fast it decays.").above(0))
      .add(quantityKey("end", units::time, "Simulated time.").byDefault("1 s").above(0));
  return schema;
}

class Decay : public PreparedRun {
 public:
  Decay(MPI_Comm comm, const Deck& deck)
      : comm_(comm), deck_(deck), rate_(deck.quantity("rate")), end_(deck.quantity("end")) {}
  [[nodiscard]] std::string summary() const override { return fmt::format("decay at {:g} 1/s", rate_); }
  void run(const RunOptions& options) override {
    recordedRun(comm_, deck_, options, 0, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
      std::vector<double> rows;
      for (int i = 0; i <= 10; ++i)
        for (const double value : {0.1 * i * end_, std::exp(-rate_ * 0.1 * i * end_)}) rows.push_back(value);
      record.simulatedTime = end_;
      ResultsWriter results(comm_, folder.results(), info);
      results.table("/decay", {{"time", "s", "time"}, {"amount", "1", "what is left"}}, rows);
      results.close();
    });
  }

 private:
  MPI_Comm comm_;
  const Deck& deck_;
  double rate_, end_;
};

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
  const Deck deck = decayDeck("{problem: decay, rate: 2 1/s}");
  const auto prepared = problemOf(deck, problemsAndDecay()).prepare(MPI_COMM_WORLD, deck);
  EXPECT_EQ(prepared->summary(), "decay at 2 1/s");
  RunOptions options;
  options.folder = scratch.path() / "run";
  prepared->run(options);
  const Hdf5Reader results(options.folder / "results.h5");
  EXPECT_DOUBLE_EQ(results.numbers("/decay/amount").back(), std::exp(-2.0));
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
