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

// This process becomes another program, the first of the words. SystemError where it does not start.
[[noreturn]] void replaceBy(const std::vector<std::string>& words);

// Sets a variable of the environment unless the user has.
void setUnlessSet(const char* variable, const std::string& value);

}  // namespace lampblack::app
