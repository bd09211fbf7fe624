#include "app/shell/command_mistakes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "app/run/shipped_case.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::app {
namespace {

std::string unknownCommand(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  std::error_code error;
  if (std::filesystem::is_regular_file(word, error))
    return isStudy(word) ? fmt::format("'{0}' is a file, not a command; a study is run by: lampblack sweep {0}", word)
                         : fmt::format("'{0}' is a file, not a command; a deck is run by: lampblack run {0}", word);
  return fmt::format("there is no command '{}'{} Commands: {}", word,
                     didYouMean(word, names).empty() ? "." : didYouMean(word, names), fmt::join(names, ", "));
}

std::string unknownOption(const CLI::App& command, const std::string& word) {
  const std::string option = word.substr(0, word.find('='));
  std::vector<std::string> names;
  for (const CLI::Option* known : command.get_options())
    for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
  const bool isRanks = option == "-n" || option == "-np" || option == "--np" || option == "-j";
  const bool hasRanks = std::ranges::find(names, "--ranks") != names.end();
  const std::string name = command.get_parent() == nullptr ? "" : " " + command.get_name();
  return fmt::format("'lampblack{}' has no option '{}'{}", name, option,
                     isRanks && hasRanks ? "; did you mean '--ranks'?" : didYouMean(option, names));
}

}  // namespace

std::string commandMistake(const CLI::App& app, const std::vector<std::string>& words) {
  const auto parsed = app.get_subcommands();
  if (parsed.empty() && words.empty()) return {};
  if (parsed.empty()) return words[0].starts_with('-') ? unknownOption(app, words[0]) : unknownCommand(app, words[0]);
  const std::vector<std::string> extra = parsed[0]->remaining();
  if (extra.empty()) return {};
  const auto option = std::ranges::find_if(extra, [](const auto& word) { return word.starts_with('-'); });
  if (option != extra.end()) return unknownOption(*parsed[0], *option);
  for (std::size_t i = 2; i < words.size(); ++i) {
    if (std::ranges::find(extra, words[i]) == extra.end() || words[i - 2] != "--set") continue;
    if (words[i].find('=') != std::string::npos && words[i] != "=")
      return fmt::format("'{0}' is not expected; each setting has its own --set: --set {0}", words[i]);
    return fmt::format("'{0}' is not expected; a setting stands in quotes where it has blanks: --set \"{1} {0}\"",
                       words[i], words[i - 1]);
  }
  return {};
}

}  // namespace lampblack::app
