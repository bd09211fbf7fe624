// Warnings about the input, for the user to see once.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::app {

// Prints "lampblack: warning: ..." lines to the standard error of rank 0; the other ranks print nothing.
void printWarnings(const std::vector<std::string>& warnings);

}  // namespace lampblack::app
