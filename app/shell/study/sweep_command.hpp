// `lampblack sweep`: many decks, or many variants of one, run one after another or side by side, and a table at the
// end.
#pragma once

#include "app/shell/command.hpp"
#include "core/modules.hpp"

namespace CLI {
class App;
}

namespace lampblack::app {

// Adds the subcommand to the command line; when it is chosen, parsing sets `command` to what has to run. The option
// --side-by-side sets `ranks`, as --ranks does, to all processors.
void addSweepCommand(CLI::App& app, Command& command, int& ranks);

}  // namespace lampblack::app
