#include "app/shell/tools/plot_command.hpp"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/shell/python_program.hpp"

namespace lampblack::app {
namespace {

void plot(const std::vector<std::string>& arguments) {
  replaceByPython({"pictures need", {"numpy", "h5py", "matplotlib"}, "python3-h5py python3-matplotlib"},
                  "lampblack.plots", arguments);
}

}  // namespace

void addPlotCommand(CLI::App& app, Command& command) {
  CLI::App* subcommand = app.add_subcommand("plot", "Make pictures of a run or study; --help for its options.");
  subcommand->prefix_command();
  subcommand->set_help_flag();  // the pictures' own
  subcommand->callback([subcommand, &command] {
    command = {.work = [words = subcommand->remaining()] { plot(words); }, .on = Command::On::FirstRank};
  });
}

}  // namespace lampblack::app
