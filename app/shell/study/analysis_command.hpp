// `lampblack fit`, `sensitivity`, `propagate`, `design`, `trade_off`: what runs tell about the parameters of decks. The
// analysis is read here, by its schema; the Python that ships does the rest and starts the runs by `lampblack sweep`.
#pragma once

#include <string>
#include <vector>

#include "app/shell/command.hpp"
#include "core/modules.hpp"

namespace CLI {
class App;
}

namespace lampblack::app {

// Adds the subcommands to the command line; when one is chosen, parsing sets `command` to what has to run.
void addAnalysisCommands(CLI::App& app, Command& command);

// Whether a file is an analysis rather than a deck: it has `analysis` and no `problem`. False where it cannot be read,
// which is told by who reads it next. Collective where MPI has started: the first rank reads.
bool isAnalysis(const std::string& file);

// Reads an analysis and all that it names, and runs nothing. InputError.
void checkAnalysis(const std::string& file, const std::vector<std::string>& overrides);

}  // namespace lampblack::app
