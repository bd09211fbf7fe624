// Mistakes of the command line, told by what was meant.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::app {

// Of words that are no command of the program: a command that is not known, a deck without its command, an option that
// is not known, a setting whose value has blanks and no quotes. Empty where it is another mistake.
std::string commandMistake(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace lampblack::app
