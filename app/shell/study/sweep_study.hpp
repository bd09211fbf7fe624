// A study: many runs from a few decks. A file of its own (no `problem:`) names decks, what to vary in them and what to
// collect; every combination becomes a run. `lampblack sweep` carries them out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/shell/study/convergence_options.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

struct SweepRun {
  std::string name;  // also of its folder
  std::filesystem::path deck;
  std::vector<std::string> overrides;                       // "a.b=c", in the order they are applied
  std::vector<std::pair<std::string, std::string>> varied;  // key and value, of this run
};

struct SweepStudy {
  std::string name;
  std::vector<SweepRun> runs;
  std::optional<int> ranksPerRun;    // all, if not given
  std::size_t chain = 1;             // so many runs after each other, each from the one before
  std::vector<std::string> results;  // keys of a run's results to collect; "all"
  std::vector<std::string> tables;   // CSV files of the runs to put below each other
  std::vector<std::string> columns;  // of those tables to show on the console, without their units; "all"
  std::optional<ConvergenceOptions> convergence;
};

DeckSchema studySchema();

// The runs of a study, in order: decks first, then variants, then the product of all that varies, the last key fastest.
// `settings` are
// applied to every deck after what the study says. InputError where the study contradicts itself; the decks are not
// read.
SweepStudy readStudy(const Deck& study, const std::vector<std::string>& settings);

}  // namespace lampblack::app
