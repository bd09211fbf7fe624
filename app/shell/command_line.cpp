#include "app/shell/command_line.hpp"

#include <petscsys.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>

#include "app/run/build_info.hpp"
#include "app/run/warnings.hpp"
#include "app/shell/command.hpp"
#include "app/shell/command_mistakes.hpp"
#include "app/shell/problem.hpp"
#include "app/shell/rank_launcher.hpp"
#include "app/shell/study/analysis_command.hpp"
#include "app/shell/study/analysis_schema.hpp"
#include "app/shell/study/sweep_command.hpp"
#include "app/shell/study/sweep_study.hpp"
#include "app/shell/tools/cases_command.hpp"
#include "app/shell/tools/gas_command.hpp"
#include "app/shell/tools/mechanism_command.hpp"
#include "app/shell/tools/plot_command.hpp"
#include "app/shell/tools/replay_command.hpp"
#include "core/errors.hpp"
#include "core/long_lines.hpp"
#include "core/parallel_session.hpp"
#include "core/stop_request.hpp"
#include "core/system_error.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {
namespace {

constexpr int exitBug = 1;
constexpr int exitInput = 2;
constexpr int exitFailed = 3;
constexpr int exitSignal = 128;

struct Arguments {
  std::string deck;
  std::vector<std::string> overrides;
  std::string folder;
  bool force = false;
  std::string restart;    // a checkpoint; empty: the newest
  bool restarts = false;  // --restart was given
  bool json = false;
  int ranks = 0;  // 0: not given
};

void check(const Arguments& arguments) {
  const Deck deck = Deck::load(arguments.deck, arguments.overrides, deckKinds(), PETSC_COMM_WORLD);
  printWarnings(deck.notes());
  const auto prepared = problemOf(deck).prepare(PETSC_COMM_WORLD, deck);
  if (placeOfProcess().rank != 0) return;
  std::cout << arguments.deck << " is a valid deck: " << prepared->summary() << ".\n";
  for (const std::string& line : prepared->details()) std::cout << line << "\n";
}

void run(const Arguments& arguments) {
  const Deck deck = Deck::load(arguments.deck, arguments.overrides, deckKinds(), PETSC_COMM_WORLD);
  printWarnings(deck.notes());
  const Problem& problem = problemOf(deck);
  collectively(PETSC_COMM_WORLD, [&] {
    if (arguments.restarts && !problem.restarts)
      throw deck.error("problem", "runs of this problem write no checkpoints: there is nothing to restart from");
  });
  RunOptions options{arguments.folder, arguments.force, arguments.overrides, std::nullopt};
  if (arguments.restarts) options.restart = arguments.restart;
  problem.prepare(PETSC_COMM_WORLD, deck)->run(options);
}

void reference(const Arguments& arguments) {
  if (arguments.json) {
    std::cout << jsonSchema(deckKinds());
  } else {
    std::cout << markdownReference(deckKinds())
              << markdownPart(2, "Studies", "Files for `lampblack sweep`, without a `problem`.", studySchema())
              << markdownPart(
                     2, "Analyses",
                     "Files for `lampblack fit`, `sensitivity`, `propagate`, `design` and `trade_off`, without a "
                     "`problem`.",
                     analysisSchema());
  }
}

// Ends the run with the message of the failure. An error that all ranks raised together is told by rank 0; one that
// only this rank knows of ends the others at once.
int fail(const char* kind, const std::exception& error, int code) {
  const auto [rank, ranks] = placeOfProcess();
  const bool everywhere = ranks == 1 || isCollective(error);
  if (rank == 0 || !everywhere) {
    std::cout.flush();
    std::cerr << "lampblack: " << kind << withoutLongLines(error.what()) << std::endl;
  }
  if (!everywhere) MPI_Abort(PETSC_COMM_WORLD, code);
  return code;
}

// Of a damaged file HDF5 cannot close all, and says so when MPI ends, after the message that the file is damaged.
void sayNoMore() {
  if (std::freopen("/dev/null", "w", stderr) == nullptr) return;  // then it does
}

int execute(const std::function<void()>& work) {
  try {
    work();
    return 0;
  } catch (const InputError& error) {
    return fail("", error, exitInput);
  } catch (const NumericsError& error) {
    return fail("numerics: ", error, exitFailed);
  } catch (const SystemError& error) {
    return fail("", error, exitFailed);
  } catch (const std::bad_alloc&) {
    return fail("", outOfMemory(), exitFailed);
  } catch (const Stopped& error) {
    return fail("", error, exitSignal + error.signal());
  } catch (const std::exception& error) {
    return fail("internal error (a bug in Lampblack): ", error, exitBug);
  }
}

// Help and mistakes of the command line alike are told once.
int say(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  std::ostringstream out, message;
  const int status = app.exit(error, out, message) == 0 ? 0 : exitInput;
  if (const std::string meant = status == 0 ? "" : commandMistake(app, words); !meant.empty()) {
    message.str("");
    message << meant << "\nRun with --help for more information.\n";
  }
  if (placeOfProcess().rank != 0) return status;
  std::cout << out.str() << std::flush;
  if (!message.str().empty()) std::cerr << "lampblack: " << message.str() << std::flush;
  return status;
}

}  // namespace

int runCommandLine(int argc, char** argv) {
  CLI::App app{"Lampblack: soot in reacting flows."};
  app.set_version_flag("--version", buildVersion() + " (" + buildGitHash() + ")");
  app.require_subcommand(1);
  Arguments arguments;
  Command command;

  CLI::App* runCommand = app.add_subcommand("run", "Run a deck.");
  runCommand->add_option("deck", arguments.deck, "Input deck (YAML).")->required();
  runCommand->add_option("--set", arguments.overrides, "Override a key: a.b=c.")->allow_extra_args(false);
  runCommand->add_option("--out", arguments.folder, "Folder for the results.")->default_val("results/run");
  runCommand->add_flag("--force", arguments.force, "Replace an earlier run in that folder.");
  CLI::Option* restart =
      runCommand
          ->add_option(
              "--restart", arguments.restart,
              "Continue an interrupted run from the newest checkpoint in the folder of --out, or from this one.")
          ->expected(0, 1);
  runCommand->callback([&, restart] {
    arguments.restarts = restart->count() > 0;
    command = {[&] { run(arguments); }, true};
  });

  CLI::App* checkCommand = app.add_subcommand("check", "Read everything a deck or an analysis names and run nothing.");
  checkCommand->add_option("deck", arguments.deck, "Input deck or analysis (YAML).")->required();
  checkCommand->add_option("--set", arguments.overrides, "Override a key: a.b=c.")->allow_extra_args(false);
  checkCommand->callback([&] {
    if (isAnalysis(arguments.deck))
      command = {.work = [&] { checkAnalysis(arguments.deck, arguments.overrides); }, .on = Command::On::FirstRank};
    else
      command = {[&] { check(arguments); }, true};
  });

  CLI::App* referenceCommand = app.add_subcommand("deck-reference", "Print all keys of a deck.");
  referenceCommand->add_flag("--json-schema", arguments.json, "As a JSON schema for editors.");
  referenceCommand->callback([&] { command = {.work = [&] { reference(arguments); }, .on = Command::On::FirstRank}; });

  addGasCommand(app, command);
  addMechanismCommand(app, command);
  addReplayCommand(app, command);
  addSweepCommand(app, command, arguments.ranks);
  addAnalysisCommands(app, command);
  addPlotCommand(app, command);
  addCasesCommand(app, command);
  addWhereCommand(app, command);
  for (CLI::App* subcommand : {runCommand, app.get_subcommand("sweep")})
    subcommand->add_option("--ranks", arguments.ranks, "MPI ranks; they are started by mpirun.")
        ->check(CLI::Range(1, 1 << 24));

  // Where a launcher started several of this process, only the first rank speaks; alone, MPI starts when it is needed.
  std::optional<ParallelSession> session;
  const auto start = [&] {
    if (!ParallelSession::runs()) session.emplace();
  };
  if (const int code = startedByLauncher() ? execute(start) : 0; code != 0) return code;
  watchForSignals();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return say(app, error, {argv + 1, argv + argc});
  }
  std::optional<int> codeOfRanks;
  const int code = execute([&] {
    if (needsLauncher(arguments.ranks)) {
      codeOfRanks = runOnRanks(arguments.ranks, {argv, static_cast<std::size_t>(argc)});
      return;
    }
    if (command.needsMpi) start();
    if (ParallelSession::runs()) {
      checkRanks(PETSC_COMM_WORLD, arguments.ranks);
      countMachines(PETSC_COMM_WORLD);
    }
    if (command.on == Command::On::FirstRank) {
      const bool isFirst = placeOfProcess().rank == 0;
      session.reset();  // the others wait for nothing, and a failure is that of a process by itself
      if (!isFirst) return;
    }
    command.work();
  });
  if (codeOfRanks) return *codeOfRanks;
  if (code != 0) sayNoMore();
  return code;
}

}  // namespace lampblack::app
