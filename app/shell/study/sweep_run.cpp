#include "app/shell/study/sweep_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <new>
#include <set>

#include "app/run/warnings.hpp"
#include "app/shell/problem.hpp"
#include "app/shell/study/study_progress.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "core/system_error.hpp"
#include "core/text_file.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/deck_node.hpp"
#include "io/json.hpp"
#include "io/units.hpp"

namespace lampblack::app {
namespace {

struct Group {
  MPI_Comm comm = MPI_COMM_NULL;
  int size = 1;   // ranks in a group
  int count = 1;  // groups
  int index = 0;  // this rank's group
  std::size_t chain = 1;

  Group(MPI_Comm all, const SweepStudy& study) : chain(study.chain) {
    int ranks = 1, rank = 0;
    MPI_Comm_size(all, &ranks);
    MPI_Comm_rank(all, &rank);
    size = study.ranksPerRun.value_or(ranks);
    collectively(all, [&] {
      if (size > ranks || ranks % size != 0)
        throw InputError(fmt::format("ranks_per_run: {} ranks cannot be shared out in groups of {}", ranks, size));
    });
    count = ranks / size;
    index = rank / size;
    MPI_Comm_split(all, index, rank, &comm);
  }
  ~Group() { MPI_Comm_free(&comm); }
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  // Chains stay on the same ranks.
  [[nodiscard]] int groupOf(std::size_t run) const { return static_cast<int>(run / chain) % count; }
  [[nodiscard]] int leaderOf(std::size_t run) const { return groupOf(run) * size; }
};

// An error that only some ranks of the group know of leaves the others waiting for them: nothing can go on.
void refuseLoneError(const Group& group, const std::exception& error) {
  if (group.size > 1 && !isCollective(error)) throw;
}

bool isSame(const DeckNode& a, const DeckNode& b) {
  return a.kind == b.kind && a.name == b.name && a.text == b.text && std::ranges::equal(a.children, b.children, isSame);
}

// What an earlier run of this deck has left in the folder of a run.
struct EarlierRun {
  enum class State : int { none, done, failed, unfinished, resumable };
  State state = State::none;
  double seconds = 0.0;  // wall time
  std::string message;   // why it failed; of rank 0
};

// Of one rank. None also where the folder has another deck's run, which is refused later on.
EarlierRun earlierRun(const Deck& deck, const std::filesystem::path& folder) {
  EarlierRun earlier;
  std::error_code error;
  if (!std::filesystem::exists(folder / "run.json", error)) return earlier;
  // JSON is read as the flow style of YAML.
  const auto parsed = [](const std::string& text) { return parseDeck({"run.json", text}); };
  try {
    const DeckNode record = parsed(readTextFile(folder / "run.json", "the record of a run"));
    const DeckNode *ran = record.child("deck"), *status = record.child("status"), *wall = record.child("wall_time_s");
    if (ran == nullptr || status == nullptr || wall == nullptr) return earlier;
    if (!std::ranges::equal(ran->children, parsed(deck.resolvedJson()).children, isSame)) return earlier;
    const bool hasCheckpoint = !CheckpointFolder(folder).checkpoints().empty();
    earlier.state = status->text == "done"     ? EarlierRun::State::done
                    : hasCheckpoint            ? EarlierRun::State::resumable
                    : status->text == "failed" ? EarlierRun::State::failed
                                               : EarlierRun::State::unfinished;
    earlier.seconds = units::parseNumber(wall->text);
    if (const DeckNode* message = record.child("message")) earlier.message = message->text;
  } catch (const InputError&) {
    return {};  // no record of a run
  }
  return earlier;
}

// Collective: what the first rank of the group finds.
EarlierRun agreedEarlierRun(MPI_Comm comm, const Deck& deck, const std::filesystem::path& folder) {
  EarlierRun earlier;
  collectively(comm, [&] {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0) earlier = earlierRun(deck, folder);
  });
  int state = static_cast<int>(earlier.state);
  MPI_Bcast(&state, 1, MPI_INT, 0, comm);
  MPI_Bcast(&earlier.seconds, 1, MPI_DOUBLE, 0, comm);
  earlier.state = static_cast<EarlierRun::State>(state);
  return earlier;
}

bool isFlow(const Deck& deck) {
  return deck.choice("problem") == "flow";
}

// InputError where the runs of a deck cannot start from each other.
void requireChain(const Deck& deck, const SweepStudy& study) {
  if (study.chain == 1) return;
  const std::string name = deck.choice("problem");
  if (isFlow(deck) && deck.strings("output.species") != std::vector<std::string>{"all"})
    throw deck.error("output.species", fmt::format("runs that start from each other (chain: {}) need all species in "
                                                   "their results; expected [all]",
                                                   study.chain));
  if (!isFlow(deck) && name != "flame1d")
    throw InputError(
        fmt::format("{}: only runs of problems flame1d and flow can start from each other (chain: {}); this one is of "
                    "problem {}",
                    deck.path().string(), study.chain, name));
}

// What is wrong with a run before its first step; empty where it can begin.
std::string whyItCannotBegin(const SweepRun& run) {
  try {
    const Deck deck = Deck::load(run.deck, run.overrides, deckKinds(), MPI_COMM_SELF);
    static_cast<void>(problemOf(deck).prepare(MPI_COMM_SELF, deck));
  } catch (const InputError& error) {
    return error.what();
  } catch (const NumericsError&) {
    return {};  // is told in its row of the table
  }
  return {};
}

// The outcome of a run that is not finished and that is not run now. The same on all ranks of a group but its message.
RunOutcome collected(const SweepRun& run, const EarlierRun& earlier) {
  RunOutcome outcome{RunFailure::stopped, "not finished", earlier.seconds};
  if (earlier.state == EarlierRun::State::failed) {
    outcome.failure = RunFailure::numerics;
    outcome.message = earlier.message;
  } else if (earlier.state == EarlierRun::State::none) {
    outcome.message = whyItCannotBegin(run);
    if (!outcome.message.empty()) outcome.failure = RunFailure::input;
    if (outcome.message.empty()) outcome.message = "not begun";
  }
  return outcome;
}

// `before`: the run in front of this one in its chain, if it ended well.
RunOutcome runOne(const Group& group, const SweepRun& run, const SweepRun* before, const std::filesystem::path& folder,
                  const SweepOptions& sweepOptions) {
  RunOutcome outcome;
  const double start = MPI_Wtime();
  try {
    std::vector<std::string> overrides = run.overrides;
    Deck deck = Deck::load(run.deck, overrides, deckKinds(), group.comm);
    if (before != nullptr && (isFlow(deck) || !deck.has("initial"))) {
      const std::string results = jsonString(std::filesystem::absolute(folder / before->name / "results.h5").string());
      overrides.push_back(isFlow(deck) ? fmt::format("initial={{layer: none, flow: {{results: {}}}}}", results)
                                       : "initial=" + results);
      deck = Deck::load(run.deck, overrides, deckKinds(), group.comm);
    }
    RunOptions options{folder / run.name, sweepOptions.force, overrides};
    const EarlierRun earlier = sweepOptions.force ? EarlierRun{} : agreedEarlierRun(group.comm, deck, options.folder);
    if (earlier.state == EarlierRun::State::done) {
      outcome.seconds = earlier.seconds;
      outcome.isTaken = true;
      return outcome;
    }
    if (sweepOptions.collect) return collected(run, earlier);
    if (earlier.state == EarlierRun::State::resumable) options.restart = "";
    if (earlier.state == EarlierRun::State::unfinished || earlier.state == EarlierRun::State::failed)
      options.force = true;
    problemOf(deck).prepare(group.comm, deck)->run(options);
  } catch (const InputError& error) {
    refuseLoneError(group, error);
    outcome.failure = RunFailure::input;
    outcome.message = error.what();
  } catch (const NumericsError& error) {
    refuseLoneError(group, error);
    outcome.failure = RunFailure::numerics;
    outcome.message = error.what();
  } catch (const SystemError& error) {
    refuseLoneError(group, error);
    outcome.failure = RunFailure::system;
    outcome.message = error.what();
  } catch (const std::bad_alloc& error) {
    refuseLoneError(group, error);
    outcome.failure = RunFailure::system;
    outcome.message = outOfMemory().what();
  } catch (const Stopped& error) {
    outcome.failure = RunFailure::stopped;
    outcome.message = error.what();
  } catch (const std::exception& error) {
    refuseLoneError(group, error);
    outcome.failure = RunFailure::bug;
    outcome.message = error.what();
  }
  outcome.seconds = MPI_Wtime() - start;
  return outcome;
}

void share(MPI_Comm comm, int from, RunOutcome& outcome) {
  int failure = static_cast<int>(outcome.failure);
  int length = static_cast<int>(outcome.message.size());
  MPI_Bcast(&failure, 1, MPI_INT, from, comm);
  MPI_Bcast(&length, 1, MPI_INT, from, comm);
  MPI_Bcast(&outcome.seconds, 1, MPI_DOUBLE, from, comm);
  outcome.failure = static_cast<RunFailure>(failure);
  outcome.message.resize(static_cast<std::size_t>(length));
  MPI_Bcast(outcome.message.data(), length, MPI_CHAR, from, comm);
}

// Rank 0. InputError where not one run can begin: what is wrong is in the deck then, not in a value of the study. Where
// none of the first twenty of many can, the runs themselves tell, so that a large study is not kept waiting.
void requireThatOneCanBegin(const SweepStudy& study) {
  constexpr std::size_t mostAsked = 20;
  std::string first;
  std::size_t asked = 0;
  for (const SweepRun& run : study.runs) {
    if (asked++ == mostAsked) return;
    const std::string why = whyItCannotBegin(run);
    if (why.empty()) return;
    if (first.empty()) first = why;
  }
  if (!study.runs.empty()) throw InputError(first);  // a convergence study may stand alone
}

}  // namespace

void checkDecks(MPI_Comm comm, const SweepStudy& study) {
  std::set<std::string> told;
  for (const SweepRun& run : study.runs) {
    const Deck deck = Deck::load(run.deck, run.overrides, deckKinds(), comm);
    for (const std::string& note : deck.notes())
      if (told.insert(note).second) printWarnings({note});
    collectively(comm, [&] { requireChain(deck, study); });
  }
  collectively(comm, [&] {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0) requireThatOneCanBegin(study);
  });
}

std::vector<RunOutcome> runStudy(MPI_Comm comm, const SweepStudy& study, const std::filesystem::path& folder,
                                 const SweepOptions& options) {
  const Group group(comm, study);
  int groupRank = 0;
  MPI_Comm_rank(group.comm, &groupRank);
  std::vector<RunOutcome> outcomes(study.runs.size());
  std::size_t own = 0;
  for (std::size_t i = 0; i < study.runs.size(); ++i) own += group.groupOf(i) == 0 ? 1 : 0;
  StudyProgress progress(group.index == 0 && groupRank == 0, study.runs.size(), own);
  RunFailure ended = RunFailure::none;  // what keeps this group from going on
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    if (group.groupOf(i) != group.index) continue;
    const SweepRun& run = study.runs[i];
    if (ended == RunFailure::none && agreedStopRequest(group.comm) != 0) ended = RunFailure::stopped;
    if (ended != RunFailure::none) {
      outcomes[i].failure = ended;
      outcomes[i].message = "not begun";
      continue;
    }
    if (groupRank == 0) {
      fmt::print("\n--- run {} of {}: {}\n", i + 1, study.runs.size(), run.name);
      std::fflush(stdout);
    }
    const bool follows = i % study.chain > 0 && outcomes[i - 1].failure == RunFailure::none;
    outcomes[i] = runOne(group, run, follows ? &study.runs[i - 1] : nullptr, folder, options);
    const RunFailure failure = outcomes[i].failure;
    if (!options.collect && (failure == RunFailure::system || failure == RunFailure::stopped)) ended = failure;
    if (groupRank == 0 && outcomes[i].isTaken) {
      fmt::print("{} is there already\n", run.name);
      std::fflush(stdout);
    }
    if (groupRank == 0 && outcomes[i].failure != RunFailure::none) {
      fmt::print("{} failed: {}\n", run.name, outcomes[i].message);
      std::fflush(stdout);
    }
    progress.ended(outcomes[i].isTaken);
  }
  for (std::size_t i = 0; i < outcomes.size(); ++i) share(comm, group.leaderOf(i), outcomes[i]);
  return outcomes;
}

}  // namespace lampblack::app
