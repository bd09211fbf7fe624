// `lampblack mechanism`: checks and summarises a mechanism file, and converts CHEMKIN files to YAML.
#pragma once

#include "app/shell/command.hpp"
#include "core/modules.hpp"

namespace CLI {
class App;
}

namespace lampblack::app {

// Adds the subcommand to the command line; when it is chosen, parsing sets `command` to what has to run.
void addMechanismCommand(CLI::App& app, Command& command);

}  // namespace lampblack::app
