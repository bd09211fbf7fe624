// `lampblack cases`: the cases that ship with the program, and copies of them to work on. `lampblack where`: the
// folders they lie in.
#pragma once

#include "app/shell/command.hpp"
#include "core/modules.hpp"

namespace CLI {
class App;
}

namespace lampblack::app {

// Adds the subcommands to the command line; when one is chosen, parsing sets `command` to what has to run.
void addCasesCommand(CLI::App& app, Command& command);
void addWhereCommand(CLI::App& app, Command& command);

}  // namespace lampblack::app
