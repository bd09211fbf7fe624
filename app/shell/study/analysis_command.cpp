#include "app/shell/study/analysis_command.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/shell/python_program.hpp"
#include "app/shell/study/analysis_schema.hpp"
#include "core/errors.hpp"
#include "core/parallel_session.hpp"
#include "core/text_file.hpp"
#include "io/deck.hpp"

namespace lampblack::app {
namespace {

struct Task {
  std::string name, words;
  std::vector<std::string> uses;  // sections of methods
};

const std::vector<Task>& tasks() {
  static const std::vector<Task> every{
      {"fit", "Fit parameters of decks to measurements.", {"design", "surrogate", "optimise", "uncertainty"}},
      {"sensitivity", "Find which parameters of decks matter.", {"design", "surrogate", "sensitivity"}},
      {"propagate", "Find what is unknown of results as parameters are unknown.", {"design", "surrogate", "propagate"}},
      {"design", "Run a design of points, and choose the experiments that tell most.", {"design", "optimise"}},
      {"trade_off", "Find the best compromises between two results.", {"design", "surrogate", "trade_off"}},
  };
  return every;
}

bool asksSurrogates(const std::string& task, const Deck& deck) {
  if (task == "fit")
    return deck.choice("optimise.on") == "surrogate" || deck.choice("uncertainty.method") == "posterior";
  if (task == "sensitivity") return deck.choice("sensitivity.method") == "surrogate";
  if (task == "propagate") return deck.choice("propagate.through") == "surrogate";
  return true;
}

// A file serves several commands; what is said with --set is for this one. InputError for what it does not use.
void refuseUnused(const Task& task, const Deck& deck, const std::vector<std::string>& overrides) {
  const auto isUsed = [&](const std::string& section) {
    const bool isOfMethods = std::ranges::any_of(
        tasks(), [&](const Task& one) { return std::ranges::find(one.uses, section) != one.uses.end(); });
    if (!isOfMethods) return true;
    if (std::ranges::find(task.uses, section) == task.uses.end()) return false;
    return section != "surrogate" || asksSurrogates(task.name, deck);
  };
  for (const std::string& text : overrides) {
    const std::string section = text.substr(0, text.find_first_of(".="));
    if (!isUsed(section))
      throw InputError(fmt::format("--set {}: nothing of this `{}` uses the section {}; leave it out, or {}", text,
                                   task.name, section,
                                   section == "surrogate" && std::ranges::find(task.uses, section) != task.uses.end()
                                       ? "choose a method by surrogates"
                                       : "give it to the command that does"));
  }
}

struct AnalysisArguments {
  std::string file, folder;
  std::vector<std::string> overrides;
  int ranks = 0, jobs = 0;
  bool force = false;
};

// The package does `task` with the analysis as it was understood here.
void handOver(const std::string& task, const AnalysisArguments& arguments, const Deck& deck,
              const std::vector<std::string>& more) {
  std::vector<std::string> words{task, arguments.file, "--resolved", deck.resolvedJson()};
  words.insert(words.end(), more.begin(), more.end());
  replaceByPython({"an analysis needs", {"numpy", "h5py", "scipy"}, "python3-h5py python3-scipy"}, "lampblack.analysis",
                  words);
}

void refuseLauncher(const std::string& task) {
  if (startedByLauncher())
    throw InputError(
        fmt::format("{}: an analysis starts its runs itself, on all processors or on so many ranks as --ranks says; "
                    "leave out mpirun or srun. On a cluster --jobs N writes the runs for SLURM",
                    task));
}

void analyse(const Task& task, const AnalysisArguments& arguments) {
  refuseLauncher(task.name);
  const Deck deck = Deck::load(arguments.file, arguments.overrides, analysisSchema());
  refuseUnused(task, deck, arguments.overrides);
  std::vector<std::string> more{"--out", arguments.folder};
  if (arguments.ranks > 0) more.insert(more.end(), {"--ranks", std::to_string(arguments.ranks)});
  if (arguments.jobs > 0) more.insert(more.end(), {"--jobs", std::to_string(arguments.jobs)});
  if (arguments.force) more.emplace_back("--force");
  handOver(task.name, arguments, deck, more);
}

}  // namespace

void addAnalysisCommands(CLI::App& app, Command& command) {
  for (const Task& task : tasks()) {
    const auto arguments = std::make_shared<AnalysisArguments>();
    CLI::App* subcommand = app.add_subcommand(task.name, task.words);
    subcommand->add_option("analysis", arguments->file, "Analysis (YAML).")->required();
    subcommand->add_option("--set", arguments->overrides, "Override a key of the analysis: design.points=128.")
        ->allow_extra_args(false);
    subcommand->add_option("--out", arguments->folder, "Folder for the analysis; the same one goes on.")
        ->default_val("results/analysis");
    subcommand->add_flag("--force", arguments->force, "Replace the tables of an earlier analysis in that folder.");
    subcommand->add_option("--ranks", arguments->ranks, "MPI ranks of the runs; all processors otherwise.")
        ->check(CLI::Range(1, 1 << 24));
    subcommand
        ->add_option(
            "--jobs", arguments->jobs,
            "Run nothing: write the runs that are missing as an array of so many jobs for SLURM, each on the ranks "
            "of --ranks or of ranks_per_run.")
        ->check(CLI::Range(1, 1 << 24));
    subcommand->callback([arguments, &command, &task] {
      command = {.work = [arguments, &task] { analyse(task, *arguments); }, .on = Command::On::FirstRank};
    });
  }
}

bool isAnalysis(const std::string& file) {
  int is = 0;
  try {
    if (placeOfProcess().rank == 0) {
      const DeckNode root = parseDeck({file, readTextFile(file, "an analysis")});
      is = root.child("analysis") != nullptr && root.child("problem") == nullptr ? 1 : 0;
    }
  } catch (const InputError&) {
    is = 0;
  }
  // Ranks that took a deck for different things would wait for each other.
  if (ParallelSession::runs()) MPI_Bcast(&is, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return is != 0;
}

void checkAnalysis(const std::string& file, const std::vector<std::string>& overrides) {
  // The decks are checked by processes of this program, which would take themselves for ranks of the launcher's run.
  if (startedByLauncher())
    throw InputError("check: an analysis is checked by one process alone; leave out mpirun or srun");
  const AnalysisArguments arguments{file, {}, overrides};
  handOver("check", arguments, Deck::load(file, overrides, analysisSchema()), {});
}

}  // namespace lampblack::app
