#include "app/shell/python_program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <filesystem>

#include "app/run/shipped_files.hpp"
#include "app/shell/other_programs.hpp"
#include "core/system_error.hpp"

namespace lampblack::app {
namespace {

std::string pythonWith(const PythonNeeds& needs) {
  const char* chosen = std::getenv("LAMPBLACK_PYTHON");
  const std::vector<std::string> names =
      chosen != nullptr ? std::vector<std::string>{chosen} : std::vector<std::string>{"python3", "/usr/bin/python3"};
  const std::string hasPackages =
      fmt::format("from importlib.util import find_spec as find; raise SystemExit(not all(map(find, ('{}', ))))",
                  fmt::join(needs.packages, "', '"));
  for (const std::string& name : names)
    if (const auto python = findProgram(name); python && runQuietly({*python, "-c", hasPackages}) == 0) return *python;
  const std::size_t last = needs.packages.size() - 1;
  throw SystemError(fmt::format(
      "{} python3 with {} and {}, and '{}' has not all of them. Install them (Debian: {}), or name another python3 in "
      "LAMPBLACK_PYTHON",
      needs.purpose,
      fmt::join(needs.packages.begin(), needs.packages.begin() + static_cast<std::ptrdiff_t>(last), ", "),
      needs.packages[last], names.front(), needs.debian));
}

}  // namespace

void replaceByPython(const PythonNeeds& needs, const std::string& module, const std::vector<std::string>& arguments) {
  const char* present = std::getenv("PYTHONPATH");
  const std::string package = shipped("python");
  setenv("PYTHONPATH", (present != nullptr ? package + ":" + present : package).c_str(), 1);
  setUnlessSet("PYTHONDONTWRITEBYTECODE", "1");  // nothing beside what is installed
  std::error_code error;
  if (const auto own = std::filesystem::read_symlink("/proc/self/exe", error); !error)
    setUnlessSet("LAMPBLACK_PROGRAM", own.string());
  std::vector<std::string> words{pythonWith(needs), "-m", module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  replaceBy(words);
}

}  // namespace lampblack::app
