#include "app/study/analysis_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <utility>

#include "app/run/python_program.hpp"
#include "app/study/analysis_schema.hpp"
#include "core/errors.hpp"
#include "core/parallel_session.hpp"
#include "core/text_file.hpp"
#include "io/deck.hpp"

namespace lampblack::app {
namespace {

struct AnalysisArguments {
  std::string file, folder;
  std::vector<std::string> overrides;
  int ranks = 0, jobs = 0;
  bool force = false;
};

// The package does `task` with the analysis as it was understood here.
void handOver(const std::string& task, const AnalysisArguments& arguments, std::vector<std::string> more) {
  if (placeOfProcess().rank != 0) return;
  const Deck deck = Deck::load(arguments.file, arguments.overrides, analysisSchema());
  std::vector<std::string> words{task, arguments.file, "--resolved", deck.resolvedJson()};
  words.insert(words.end(), more.begin(), more.end());
  replaceByPython({"an analysis needs", {"numpy", "h5py", "scipy"}, "python3-h5py python3-scipy"}, "lampblack.analysis",
                  words);
}

void analyse(const std::string& task, const AnalysisArguments& arguments) {
  std::vector<std::string> more{"--out", arguments.folder};
  if (arguments.ranks > 0) more.insert(more.end(), {"--ranks", std::to_string(arguments.ranks)});
  if (arguments.jobs > 0) more.insert(more.end(), {"--jobs", std::to_string(arguments.jobs)});
  if (arguments.force) more.emplace_back("--force");
  handOver(task, arguments, more);
}

}  // namespace

void addAnalysisCommands(CLI::App& app, Command& command) {
  constexpr std::array<std::pair<const char*, const char*>, 5> tasks{{
      {"fit", "Fit parameters of decks to measurements."},
      {"sensitivity", "Find which parameters of decks matter."},
      {"propagate", "Find what is unknown of results as parameters are unknown."},
      {"design", "Run a design of points, and choose the experiments that tell most."},
      {"trade_off", "Find the best compromises between two results."},
  }};
  for (const auto& [task, words] : tasks) {
    const auto arguments = std::make_shared<AnalysisArguments>();
    CLI::App* subcommand = app.add_subcommand(task, words);
    subcommand->add_option("analysis", arguments->file, "Analysis (YAML).")->required();
    subcommand->add_option("--set", arguments->overrides, "Override a key of the analysis: design.points=128.")
        ->allow_extra_args(false);
    subcommand->add_option("--out", arguments->folder, "Folder for the analysis; the same one goes on.")
        ->default_val("results/analysis");
    subcommand->add_flag("--force", arguments->force, "Replace the tables of an earlier analysis in that folder.");
    subcommand->add_option("--ranks", arguments->ranks, "MPI ranks of the runs; all processors otherwise.")
        ->check(CLI::PositiveNumber);
    subcommand
        ->add_option("--jobs", arguments->jobs,
                     "Run nothing: write the runs that are missing as an array of so many jobs for SLURM.")
        ->check(CLI::PositiveNumber);
    subcommand->callback([arguments, &command, name = std::string(task)] {
      command = {[arguments, name] { analyse(name, *arguments); }};
    });
  }
}

bool isAnalysis(const std::string& file) {
  try {
    const DeckNode root = parseDeck(DeckSource{file, readTextFile(file, "an analysis"), {}});
    return root.child("analysis") != nullptr && root.child("problem") == nullptr;
  } catch (const InputError&) {
    return false;
  }
}

void checkAnalysis(const std::string& file, const std::vector<std::string>& overrides) {
  handOver("check", {file, {}, overrides}, {});
}

}  // namespace lampblack::app
