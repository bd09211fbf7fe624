#include "app/tools/plot_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>
#include <vector>

#include "app/run/other_programs.hpp"
#include "app/run/shipped_files.hpp"
#include "core/parallel_session.hpp"
#include "core/system_error.hpp"

namespace lampblack::app {
namespace {

// A python3 that has what the pictures need: LAMPBLACK_PYTHON where that is set, else the one of PATH, else the
// system's.
std::string pythonForPictures() {
  const char* chosen = std::getenv("LAMPBLACK_PYTHON");
  const std::vector<std::string> names =
      chosen != nullptr ? std::vector<std::string>{chosen} : std::vector<std::string>{"python3", "/usr/bin/python3"};
  const std::string hasPackages =
      "from importlib.util import find_spec as find; raise SystemExit(not all(map(find, ('numpy', 'h5py', "
      "'matplotlib'))))";
  for (const std::string& name : names)
    if (const auto python = findProgram(name); python && runQuietly({*python, "-c", hasPackages}) == 0) return *python;
  throw SystemError(fmt::format(
      "pictures need python3 with numpy, h5py and matplotlib, and '{}' has not all of them. Install them (Debian: "
      "python3-h5py python3-matplotlib), or name another python3 in LAMPBLACK_PYTHON",
      names.front()));
}

void plot(const std::vector<std::string>& arguments) {
  if (placeOfProcess().rank != 0) return;
  const char* present = std::getenv("PYTHONPATH");
  const std::string package = shipped("python");
  setenv("PYTHONPATH", (present != nullptr ? package + ":" + present : package).c_str(), 1);
  setUnlessSet("PYTHONDONTWRITEBYTECODE", "1");  // nothing beside what is installed
  std::vector<std::string> words{pythonForPictures(), "-m", "lampblack.plots"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  replaceBy(words);
}

}  // namespace

void addPlotCommand(CLI::App& app, Command& command) {
  CLI::App* subcommand = app.add_subcommand("plot", "Make pictures of a run or study; --help for its options.");
  subcommand->prefix_command();
  subcommand->set_help_flag();  // the pictures' own
  subcommand->callback([subcommand, &command] { command = {[words = subcommand->remaining()] { plot(words); }}; });
}

}  // namespace lampblack::app
