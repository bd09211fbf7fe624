// Modules of the Python that ships, as programs that this process becomes.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::app {

// What a module of Python needs, and the words for it where it is missing.
struct PythonNeeds {
  std::string purpose;                // "pictures need"
  std::vector<std::string> packages;  // as they are imported
  std::string debian;                 // "python3-h5py python3-matplotlib"
};

// Replaces this process by `python3 -m module arguments...`, which finds the package lampblack, and this very program
// by LAMPBLACK_PROGRAM. python3 is the first that has all packages: LAMPBLACK_PYTHON where that is set, else the one of
// PATH, else the system's. SystemError where none has them.
[[noreturn]] void replaceByPython(const PythonNeeds& needs, const std::string& module,
                                  const std::vector<std::string>& arguments);

}  // namespace lampblack::app
