// Programs beside this one that it hands over to: a launcher of ranks, Python.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::app {

// A program by its path, or by its name in the folders of PATH; empty where there is none that may be executed.
std::optional<std::filesystem::path> findProgram(const std::string& name);

// The exit code of a program that says nothing and is asked nothing; -1 where it did not start or did not end by
// itself.
int runQuietly(const std::vector<std::string>& words);

// Replaces this process by another program, the first of the words. SystemError where it does not start.
[[noreturn]] void replaceBy(const std::vector<std::string>& words);

// The exit code of a program that this process starts and waits for, 128 and the signal's number where one ended it.
// Signals that come in the meantime (SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2) are for the processes of this same
// executable among its descendants, as soon as there are some; a second one before that is for the program. The program
// is in a process group of its own, out of reach of a terminal's Ctrl-C. SystemError where it does not start.
int runForDescendants(const std::vector<std::string>& words);

// Sets a variable of the environment unless the user has.
void setUnlessSet(const char* variable, const std::string& value);

}  // namespace lampblack::app
