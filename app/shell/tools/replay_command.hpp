// `lampblack replay`: advances a cell that failed in a run once more, step by step before the user's eyes.
#pragma once

#include "app/shell/command.hpp"
#include "core/modules.hpp"

namespace CLI {
class App;
}

namespace lampblack::app {

// Adds the subcommand to the command line; when it is chosen, parsing sets `command` to what has to run.
void addReplayCommand(CLI::App& app, Command& command);

}  // namespace lampblack::app
