#include "app/shell/study/sweep_command.hpp"

#include <fmt/format.h>
#include <petscsys.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <utility>

#include "app/shell/rank_launcher.hpp"
#include "app/shell/study/convergence_study.hpp"
#include "app/shell/study/sweep_jobs.hpp"
#include "app/shell/study/sweep_run.hpp"
#include "app/shell/study/sweep_study.hpp"
#include "app/shell/study/sweep_table.hpp"
#include "core/errors.hpp"
#include "core/parallel_session.hpp"
#include "core/stop_request.hpp"
#include "core/system_error.hpp"
#include "core/text_file.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {
namespace {

namespace fs = std::filesystem;

struct SweepArguments {
  std::string study;
  std::vector<std::string> overrides, settings;
  std::string folder, part;
  int jobs = 0, ranksOfJob = 0;  // of each job; zero: as many as a run has
  bool force = false, check = false, sideBySide = false, collect = false;
};

int rankOf(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

// Whether a study ended with all its runs begun. One that was stopped, or that met a full disk, goes on.
bool hasEnded(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return false;
  const std::string text = readTextFile(file, "the record of a study");
  for (const RunFailure unfinished : {RunFailure::stopped, RunFailure::system})
    if (text.find(fmt::format("\"status\": \"{}\"", wordFor(unfinished))) != std::string::npos) return false;
  return true;
}

// The folder of the study: nobody else's, and not that of a single run either.
RunFolder prepareFolder(MPI_Comm comm, const fs::path& folder, bool force, bool collect = false) {
  const fs::path last = folder / "study.json";
  collectively(comm, [&] {
    if (rankOf(comm) == 0 && !force && !collect && hasEnded(last))
      throw InputError(
          fmt::format("{}: this folder holds a study already. Choose another with --out DIR, or replace it "
                      "with --force",
                      folder.string()));
  });
  RunFolder prepared = RunFolder::prepare(folder, force, comm);
  std::error_code error;
  if (rankOf(comm) == 0) fs::remove(last, error);
  return prepared;
}

std::string withoutUnit(const std::string& column) {
  return column.substr(0, column.find(" ["));
}

// The columns that were asked for, in that order and without units; at most as many as a console holds.
TextTable shownColumns(const TextTable& table, const std::vector<std::string>& names) {
  constexpr std::size_t mostColumns = 16;
  std::vector<std::size_t> places;
  const bool all = std::find(names.begin(), names.end(), "all") != names.end();
  for (std::size_t i = 0; all && i < table.columns.size(); ++i) places.push_back(i);
  for (const std::string& name : names)
    for (std::size_t i = 0; !all && i < table.columns.size(); ++i)
      if (withoutUnit(table.columns[i]) == name) places.push_back(i);
  places.resize(std::min(places.size(), mostColumns));
  TextTable shown;
  for (const std::size_t i : places) shown.columns.push_back(withoutUnit(table.columns[i]));
  for (const auto& row : table.rows) {
    shown.rows.emplace_back();
    for (const std::size_t i : places) shown.rows.back().push_back(row[i]);
  }
  return shown;
}

// "table.csv" of the runs becomes "study_table.csv".
void writeTables(const SweepStudy& study, const std::vector<RunOutcome>& outcomes, const fs::path& folder) {
  const TextTable table = studyTable(study, outcomes, folder);
  writeFileAtomically(folder / "study.csv", csvText(table));
  fmt::print("\n{}\n\n", study.name);
  for (const std::string& name : study.tables) {
    const TextTable stacked = stackedTable(study, name, folder);
    if (stacked.rows.empty()) continue;
    writeFileAtomically(folder / ("study_" + name), csvText(stacked));
    std::vector<std::string> names = study.columns;
    names.insert(names.begin(), "run");
    fmt::print("{}\n", alignedText(shownColumns(stacked, names)));
  }
  // The messages go below the table, where there is room for them.
  std::vector<std::string> names = table.columns;
  std::erase(names, "message");
  for (std::string& name : names) name = withoutUnit(name);
  fmt::print("{}", alignedText(shownColumns(table, names)));
  fmt::print("{}", failureSummary(study, outcomes));
  writeFileAtomically(folder / "study.json", studyJson(study, outcomes, table));
  fmt::print("study in {}\n", folder.string());
}

// The worst failure decides how the command ends. Where the runs were cut short, its message is the first of that kind.
void raiseFailures(MPI_Comm comm, const std::vector<RunOutcome>& outcomes, const fs::path& folder,
                   bool collect = false) {
  RunFailure worst = RunFailure::none;
  std::size_t failed = 0;
  for (const RunOutcome& outcome : outcomes) {
    worst = std::max(worst, outcome.failure);
    failed += outcome.failure != RunFailure::none ? 1 : 0;
  }
  if (worst == RunFailure::stopped && collect)
    collectively(comm, [&] {
      throw SystemError(fmt::format(
          "{} of {} runs are not finished or failed; hand their jobs in again, or give this command without "
          "--collect",
          failed, outcomes.size()));
    });
  if (worst == RunFailure::stopped)
    raiseStopped(comm, agreedStopRequest(comm),
                 fmt::format("after {} of {} runs: they are in the tables in {}; the same command goes on",
                             outcomes.size() - failed, outcomes.size(), folder.string()));
  std::string message = fmt::format("{} of {} runs failed; the table says which and why", failed, outcomes.size());
  if (worst == RunFailure::system)
    message = std::find_if(outcomes.begin(), outcomes.end(), [](const RunOutcome& outcome) {
                return outcome.failure == RunFailure::system;
              })->message;
  collectively(comm, [&] {
    if (worst == RunFailure::input) throw InputError(message);
    if (worst == RunFailure::numerics) throw NumericsError(message);
    if (worst == RunFailure::system) throw SystemError(message);
    if (worst == RunFailure::bug) throw std::runtime_error(message);
  });
}

// The parts' own command lines, and who hands them in.
void writeJobs(MPI_Comm comm, const SweepStudy& study, const SweepArguments& arguments) {
  const int perRun = study.ranksPerRun.value_or(1), ranks = arguments.ranksOfJob > 0 ? arguments.ranksOfJob : perRun;
  if (study.runs.empty())
    throw InputError("--jobs: this study has no runs but its convergence study; give the command without --jobs");
  if (ranks % perRun != 0)
    throw InputError(
        fmt::format("--ranks: {} ranks of a job cannot be shared out to runs of {} (ranks_per_run)", ranks, perRun));
  const fs::path folder = arguments.folder;
  const RunFolder locked = prepareFolder(comm, folder, arguments.force);
  JobsOptions options{arguments.study, folder, {}, arguments.jobs, ranks};
  const auto add = [&](const char* flag, const std::vector<std::string>& values) {
    for (const std::string& value : values) options.words.insert(options.words.end(), {flag, value});
  };
  add("--set", arguments.settings);
  add("--study-set", arguments.overrides);
  const fs::path script = folder / "jobs.slurm";
  collectively(comm, [&] {
    if (rankOf(comm) != 0) return;
    writeFileAtomically(script, jobsScript(study, options));
    fmt::print(
        "{} runs to do; hand them to SLURM by\n  sbatch {}\nand give this command with --collect in place of --jobs "
        "for the table when they have ended{}\n",
        study.runs.size(), script.string(),
        study.convergence ? "; without either it makes the convergence study as well" : "");
  });
}

void runPart(MPI_Comm comm, const SweepStudy& part, const SweepArguments& arguments) {
  const std::vector<RunOutcome> outcomes = runStudy(comm, part, arguments.folder, {arguments.force, false});
  if (rankOf(comm) == 0) fmt::print("part {}: {} runs in {}\n", arguments.part, outcomes.size(), arguments.folder);
  raiseFailures(comm, outcomes, arguments.folder);
}

void refuseTogether(const SweepArguments& arguments) {
  const bool isPart = !arguments.part.empty();
  if ((arguments.jobs > 0) + isPart + arguments.collect + arguments.check > 1)
    throw InputError("--check, --jobs, --part, --collect: one of them at a time is expected");
  if (arguments.jobs > 0 && arguments.force)
    throw InputError(
        "--jobs with --force would take the finished runs as they are; remove the folder, or choose another with "
        "--out");
  if (arguments.collect && arguments.force)
    throw InputError("--collect runs nothing, and --force would replace the runs; leave one of them out");
}

void sweep(const SweepArguments& arguments) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const Deck deck = Deck::load(arguments.study, arguments.overrides, studySchema(), comm);
  SweepStudy study;
  collectively(comm, [&] {
    refuseTogether(arguments);
    study = readStudy(deck, arguments.settings);
    if (!arguments.part.empty()) study = partOf(std::move(study), readPart(arguments.part));
  });
  checkDecks(comm, study);
  if (!arguments.part.empty()) return runPart(comm, study, arguments);
  if (study.convergence) checkConvergence(comm, deck, *study.convergence);
  if (arguments.check) {
    if (rankOf(comm) != 0) return;
    for (const SweepRun& run : study.runs) fmt::print("{}\n", run.name);
    fmt::print("{} is a valid study: {} runs{}.\n", arguments.study, study.runs.size(),
               study.convergence ? " and a convergence study" : "");
    return;
  }
  if (arguments.jobs > 0) return writeJobs(comm, study, arguments);
  const fs::path folder = arguments.folder;
  const RunFolder locked = prepareFolder(comm, folder, arguments.force, arguments.collect);
  const std::vector<RunOutcome> outcomes = runStudy(comm, study, folder, {arguments.force, arguments.collect});
  collectively(comm, [&] {
    if (rankOf(comm) == 0) writeTables(study, outcomes, folder);
  });
  if (study.convergence && !arguments.collect && agreedStopRequest(comm) == 0)
    runConvergence(comm, *study.convergence, folder);
  raiseFailures(comm, outcomes, folder, arguments.collect);
}

}  // namespace

void addSweepCommand(CLI::App& app, Command& command, int& ranks) {
  const auto arguments = std::make_shared<SweepArguments>();
  CLI::App* subcommand = app.add_subcommand("sweep", "Run a study: many decks, or many variants of one, and a table.");
  subcommand->add_option("study", arguments->study, "Study (YAML).")->required();
  subcommand->add_option("--set", arguments->settings, "Override a key of every deck: a.b=c.")->allow_extra_args(false);
  subcommand->add_option("--study-set", arguments->overrides, "Override a key of the study: ranks_per_run=1.")
      ->allow_extra_args(false);
  subcommand->add_option("--out", arguments->folder, "Folder for the study; each run gets a folder in it.")
      ->default_val("results/study");
  subcommand->add_flag("--force", arguments->force, "Replace an earlier study in that folder.");
  subcommand->add_flag("--check", arguments->check, "Read the study and its decks, name the runs, and run nothing.");
  subcommand->add_flag(
      "--side-by-side", arguments->sideBySide,
      "Runs side by side, each on one rank (ranks_per_run=1), on all processors, or on those of --ranks.");
  subcommand
      ->add_option("--jobs", arguments->jobs,
                   "Run nothing: write the runs as an array of so many jobs for SLURM, each on the ranks of --ranks.")
      ->check(CLI::Range(1, 1 << 24));
  subcommand->add_option("--part", arguments->part,
                         "Run one part of the study and make no table: 3/10, as the jobs of --jobs do.");
  subcommand->add_flag("--collect", arguments->collect, "Run nothing: the table of what the jobs have left.");
  subcommand->callback([arguments, &command, &ranks] {
    if (arguments->sideBySide) arguments->overrides.emplace_back("ranks_per_run=1");
    if (arguments->jobs > 0) arguments->ranksOfJob = std::exchange(ranks, 0);
    if (arguments->sideBySide && arguments->jobs == 0 && ranks == 0 && !startedByLauncher()) ranks = processors();
    command = {[arguments] { sweep(*arguments); }, true};
  });
}

}  // namespace lampblack::app
