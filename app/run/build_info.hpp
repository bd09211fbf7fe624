// What this executable was made from.
#pragma once

#include <map>
#include <string>

#include "core/modules.hpp"

namespace lampblack::app {

std::string buildVersion();
std::string buildGitHash();                            // "unknown" outside a checkout
std::map<std::string, std::string> libraryVersions();  // "PETSc": "3.18.5"

}  // namespace lampblack::app
