#include "app/shell/tools/cases_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/run/shipped_case.hpp"
#include "app/run/shipped_files.hpp"

namespace lampblack::app {
namespace {

namespace fs = std::filesystem;

void listCases() {
  const std::vector<ShippedCase> cases = shippedCases();
  std::size_t width = 0;
  for (const ShippedCase& one : cases) width = std::max(width, one.name.size());
  for (const ShippedCase& one : cases) std::cout << fmt::format("{:<{}}  {}\n", one.name, width, one.title);
}

void copy(const std::string& name, const std::string& target) {
  const ShippedCase chosen = shippedCase(name);
  const fs::path folder = target.empty() ? chosen.folder.filename() : fs::path(target);
  copyCase(chosen, folder);
  std::cout << fmt::format("{} is in {}. Its decks and studies:\n", chosen.name, folder.string());
  for (const fs::path& deck : decksIn(folder))
    std::cout << fmt::format("  lampblack {} {}\n", isStudy(deck) ? "sweep" : "run", shellWord(deck.string()));
}

}  // namespace

void addCasesCommand(CLI::App& app, Command& command) {
  CLI::App* cases = app.add_subcommand("cases", "List the cases that ship, and copy one.");
  cases->require_subcommand(0, 1);
  struct Words {
    std::string name, folder;
  };
  const auto words = std::make_shared<Words>();
  CLI::App* copied = cases->add_subcommand("copy", "Copy a case, with all that its decks name, to work on it.");
  copied->add_option("name", words->name, "A name of the list: flame1d/free_methane, or free_methane.")->required();
  copied->add_option("folder", words->folder, "Folder for the copy; without it, named as the case.");
  // The callbacks of the subcommand come first.
  copied->callback([words, &command] {
    command = {.work = [words] { copy(words->name, words->folder); }, .on = Command::On::FirstRank};
  });
  cases->callback([copied, &command] {
    if (!copied->parsed()) command = {.work = listCases, .on = Command::On::FirstRank};
  });
}

void addWhereCommand(CLI::App& app, Command& command) {
  const std::map<std::string, std::string> parts{
      {"cases", "cases"}, {"mechanisms", "cases/mechanisms"}, {"python", "python"}};
  const auto part = std::make_shared<std::string>();
  CLI::App* where =
      app.add_subcommand("where", "Print the folders of what ships: cases, mechanisms, the Python package.");
  where->add_option("part", *part, "One of them: cases, mechanisms or python; it is printed alone.")
      ->check(CLI::IsMember(std::vector<std::string>{"cases", "mechanisms", "python"}));
  where->callback([parts, part, &command] {
    const auto tell = [parts, part] {
      if (!part->empty()) {
        std::cout << shipped(parts.at(*part)).string() << '\n';
        return;
      }
      for (const auto& [name, folder] : parts) std::cout << fmt::format("{:<10}  {}\n", name, shipped(folder).string());
    };
    command = {.work = tell, .on = Command::On::FirstRank};
  });
}

}  // namespace lampblack::app
