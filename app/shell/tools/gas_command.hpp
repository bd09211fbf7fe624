// `lampblack gas`: thermodynamics, rates and transport properties of a gas at one state, or at the equilibrium of it.
#pragma once

#include "app/shell/command.hpp"
#include "core/modules.hpp"

namespace CLI {
class App;
}

namespace lampblack::app {

// Adds the subcommand to the command line; when it is chosen, parsing sets `command` to what has to run.
void addGasCommand(CLI::App& app, Command& command);

}  // namespace lampblack::app
