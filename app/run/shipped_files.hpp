// What ships with the program: cases, mechanisms, and the Python that reads and draws results. The folder lies beside
// the program, in the folder of a build as where it is installed, so that both may be moved as a whole.
#pragma once

#include <filesystem>
#include <string>

#include "core/modules.hpp"

namespace lampblack::app {

// .../share/lampblack/<part>, or below what LAMPBLACK_SHARE names; `part` is "cases", "cases/mechanisms" or "python".
// Empty where the program lies alone.
std::filesystem::path shippedIfThere(const std::string& part);
// The same, which has to be there. SystemError.
std::filesystem::path shipped(const std::string& part);

// The file of a mechanism that the user names, seen from `folder` (empty: the current one). Where it is not there, and
// the name has no folder, the mechanism of that name which ships. InputError where there is none either.
std::filesystem::path findMechanism(const std::filesystem::path& folder, const std::string& name);

}  // namespace lampblack::app
