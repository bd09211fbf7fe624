// `lampblack plot`: pictures of results, by the Python that ships.
#pragma once

#include "app/shell/command.hpp"
#include "core/modules.hpp"

namespace CLI {
class App;
}

namespace lampblack::app {

// Adds the subcommand to the command line; when it is chosen, parsing sets `command` to what has to run.
void addPlotCommand(CLI::App& app, Command& command);

}  // namespace lampblack::app
