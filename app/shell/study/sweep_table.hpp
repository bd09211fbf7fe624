// What a study leaves: study.csv with a row for each run, the tables of the runs below each other, and study.json. Made
// from the files that the runs wrote.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/shell/study/sweep_run.hpp"
#include "app/shell/study/sweep_study.hpp"
#include "core/modules.hpp"
#include "io/csv.hpp"

namespace lampblack::app {

// The numbers and words below "results" in the text of a run.json, in order, their parts joined by dots; lists are left
// out. InputError where the text is not JSON.
std::vector<std::pair<std::string, std::string>> resultsOf(const std::string& record);

// How a run ended, in a word of the tables: "done".
const char* wordFor(RunFailure failure);

// A table with columns of even width, for the console.
std::string alignedText(const TextTable& table);

// A row for each run: its name, what is varied, how it ended, its wall time, and the collected results; empty where a
// run does not have one.
TextTable studyTable(const SweepStudy& study, const std::vector<RunOutcome>& outcomes,
                     const std::filesystem::path& folder);

// The rows of the runs' tables called `name`, each with the name of its run in front. Columns are those of the first
// run that has the table, then what others have besides. No rows where no run has one.
TextTable stackedTable(const SweepStudy& study, const std::string& name, const std::filesystem::path& folder);

// The runs that failed, those with one message together, the most of them first: how they ended, how many, the first
// names, and the message. Empty where none failed.
std::string failureSummary(const SweepStudy& study, const std::vector<RunOutcome>& outcomes);

// study.json.
std::string studyJson(const SweepStudy& study, const std::vector<RunOutcome>& outcomes, const TextTable& table);

}  // namespace lampblack::app
