#include "app/shell/study/sweep_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>

#include "app/run/build_info.hpp"
#include "io/deck_node.hpp"
#include "io/json.hpp"
#include "io/run_record.hpp"

namespace lampblack::app {
namespace {

using Leaves = std::vector<std::pair<std::string, std::string>>;

std::optional<std::string> readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void addLeaves(const DeckNode& node, const std::string& path, Leaves& leaves) {
  if (node.kind == DeckNode::Kind::scalar) leaves.emplace_back(path, node.text);
  if (node.kind != DeckNode::Kind::map) return;
  for (const DeckNode& child : node.children)
    addLeaves(child, path.empty() ? child.name : path + "." + child.name, leaves);
}

// Index of a column, which is made where it is new.
std::size_t columnOf(TextTable& table, const std::string& name) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found != table.columns.end()) return static_cast<std::size_t>(found - table.columns.begin());
  table.columns.push_back(name);
  return table.columns.size() - 1;
}

void put(TextTable& table, std::vector<std::string>& row, const std::string& column, const std::string& text) {
  const std::size_t place = columnOf(table, column);
  if (row.size() <= place) row.resize(place + 1);
  row[place] = text;
}

void makeEven(TextTable& table) {
  for (auto& row : table.rows) row.resize(table.columns.size());
}

bool isNumber(const std::string& text) {
  if (text.empty()) return false;
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size();
}

// Of such a text; one too small for the normal numbers, which std::stod refuses, is read as near as can be.
double numberOf(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

// Length on the console: the bytes inside a UTF-8 character take no room.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

const char* wordFor(RunFailure failure) {
  switch (failure) {
    case RunFailure::none:
      return "done";
    case RunFailure::input:
      return "wrong input";
    case RunFailure::numerics:
      return "numerics failed";
    case RunFailure::system:
      return "machine failed";
    case RunFailure::bug:
      return "internal error";
    case RunFailure::stopped:
      return "stopped";
  }
  return "";
}

Leaves resultsOf(const std::string& record) {
  // JSON is read as the flow style of YAML.
  const DeckNode root = parseDeck({"run.json", record});
  Leaves leaves;
  if (const DeckNode* results = root.child("results")) addLeaves(*results, "", leaves);
  return leaves;
}

std::string alignedText(const TextTable& table) {
  const std::size_t count = table.columns.size();
  std::vector<std::size_t> widths(count);
  // Numbers are long where they are exact; five digits are enough to look at.
  const auto shown = [](const std::string& text) {
    return isNumber(text) && text.find_first_of(".eE") != std::string::npos ? fmt::format("{:.5g}", numberOf(text))
                                                                            : text.substr(0, text.find('\n'));
  };
  const auto measure = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < count; ++i) widths[i] = std::max(widths[i], width(shown(row[i])));
  };
  measure(table.columns);
  for (const auto& row : table.rows) measure(row);
  std::string text;
  const auto write = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string field = shown(row[i]);
      const std::string blanks(widths[i] - width(field), ' ');
      if (i > 0) line += "  ";
      line += isNumber(field) ? blanks + field : field + blanks;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  write(table.columns);
  for (const auto& row : table.rows) write(row);
  return text;
}

TextTable studyTable(const SweepStudy& study, const std::vector<RunOutcome>& outcomes,
                     const std::filesystem::path& folder) {
  TextTable table;
  const bool all = std::find(study.results.begin(), study.results.end(), "all") != study.results.end();
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const SweepRun& run = study.runs[i];
    std::vector<std::string> row;
    put(table, row, "run", run.name);
    for (const auto& [key, value] : run.varied) put(table, row, key, value);
    put(table, row, "status", wordFor(outcomes[i].failure));
    put(table, row, "message", outcomes[i].message);
    put(table, row, "wall_time_s", fmt::format("{:.3f}", outcomes[i].seconds));
    Leaves leaves;
    if (const auto record = readFile(folder / run.name / "run.json"); record && outcomes[i].failure == RunFailure::none)
      leaves = resultsOf(*record);
    for (const auto& [name, value] : leaves) {
      // Whether a flame burns is worth a column, asked for or not.
      if (all || name == "flame_state" ||
          std::find(study.results.begin(), study.results.end(), name) != study.results.end())
        put(table, row, name, value);
    }
    table.rows.push_back(std::move(row));
  }
  // A column for what was asked for even where no run has it: that it is empty says something.
  for (const std::string& name : study.results)
    if (name != "all") columnOf(table, name);
  makeEven(table);
  return table;
}

TextTable stackedTable(const SweepStudy& study, const std::string& name, const std::filesystem::path& folder) {
  TextTable stacked{{"run"}, {}};
  for (const SweepRun& run : study.runs) {
    const auto text = readFile(folder / run.name / name);
    if (!text) continue;
    const TextTable table = readCsv(*text);
    for (const auto& values : table.rows) {
      std::vector<std::string> row;
      put(stacked, row, "run", run.name);
      for (std::size_t i = 0; i < values.size(); ++i) put(stacked, row, table.columns[i], values[i]);
      stacked.rows.push_back(std::move(row));
    }
  }
  makeEven(stacked);
  return stacked;
}

std::string failureSummary(const SweepStudy& study, const std::vector<RunOutcome>& outcomes) {
  struct Group {
    const RunOutcome* outcome;
    std::vector<std::string> names;
  };
  std::vector<Group> groups;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const RunOutcome& outcome = outcomes[i];
    if (outcome.failure == RunFailure::none) continue;
    auto group = std::ranges::find_if(groups, [&](const Group& other) {
      return other.outcome->failure == outcome.failure && other.outcome->message == outcome.message;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), Group{&outcome, {}});
    group->names.push_back(study.runs[i].name);
  }
  std::ranges::stable_sort(groups, std::ranges::greater{}, [](const Group& group) { return group.names.size(); });
  constexpr std::size_t mostNames = 3;
  std::string text;
  for (const auto& [outcome, names] : groups) {
    const std::vector<std::string> first(
        names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(mostNames, names.size())));
    text += fmt::format("{} ({}", fmt::join(first, ", "), wordFor(outcome->failure));
    if (names.size() > mostNames) text += fmt::format(", and {} more", names.size() - mostNames);
    text += fmt::format("): {}\n", outcome->message);
  }
  return text;
}

std::string studyJson(const SweepStudy& study, const std::vector<RunOutcome>& outcomes, const TextTable& table) {
  JsonWriter json;
  json.beginObject();
  json.field("study", study.name);
  json.field("version", buildVersion());
  json.field("git_hash", buildGitHash());
  json.field("finished", utcNow());
  json.field("failed_runs",
             static_cast<std::int64_t>(std::count_if(outcomes.begin(), outcomes.end(), [](const RunOutcome& outcome) {
               return outcome.failure != RunFailure::none;
             })));
  json.key("runs").beginArray();
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const SweepRun& run = study.runs[i];
    json.beginObject();
    json.field("deck", std::filesystem::absolute(run.deck).lexically_normal().string());
    json.key("set").beginArray();
    for (const std::string& setting : run.overrides) json.value(setting);
    json.endArray();
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      json.key(table.columns[c]);
      const std::string& text = table.rows[i][c];
      if (text.empty())
        json.null();
      else if (isNumber(text))
        json.value(numberOf(text));
      else
        json.value(text);
    }
    json.endObject();
  }
  json.endArray().endObject();
  return json.text() + "\n";
}

}  // namespace lampblack::app
