#include "app/run/shipped_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "app/run/shipped_files.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"
#include "core/system_error.hpp"

namespace lampblack::app {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

bool hasLine(const std::string& text, const std::string& beginning) {
  return text.starts_with(beginning) || text.find("\n" + beginning) != std::string::npos;
}

std::string titleOf(const fs::path& folder) {
  std::ifstream page(folder / "README.md");
  std::string line;
  std::getline(page, line);
  return line.starts_with("# ") ? line.substr(2) : line;
}

// Makes a deck name what lies outside the folder of its case by the file's own name, and puts that file beside it.
void bringAlong(const fs::path& deck, const fs::path& from) {
  static const std::regex outside(R"((\.\./)+[\w./-]*\w)");
  const std::string text = textOf(deck);
  std::string changed;
  auto end = text.cbegin();
  for (std::sregex_iterator match(text.begin(), text.end(), outside), none; match != none; ++match) {
    const fs::path named = from / match->str();
    const bool ships = fs::is_regular_file(named);
    changed.append(end, text.cbegin() + match->position());
    changed += ships ? named.filename().string() : match->str();
    end = text.cbegin() + match->position() + match->length();
    if (ships) fs::copy_file(named, deck.parent_path() / named.filename(), fs::copy_options::skip_existing);
  }
  changed.append(end, text.cend());
  if (changed != text && !(std::ofstream(deck) << changed).flush())
    throw SystemError(deck.string() + ": cannot be written");
}

// What an administrator installed may be for reading alone.
void allowWriting(const fs::path& folder) {
  fs::permissions(folder, fs::perms::owner_write, fs::perm_options::add);
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    fs::permissions(entry.path(), fs::perms::owner_write, fs::perm_options::add);
}

}  // namespace

std::vector<ShippedCase> shippedCases() {
  const fs::path root = shipped("cases");
  std::vector<ShippedCase> cases;
  for (const auto& entry : fs::recursive_directory_iterator(root, fs::directory_options::follow_directory_symlink)) {
    if (!entry.is_directory() || entry.path().filename() == "mechanisms" || decksIn(entry.path()).empty()) continue;
    cases.push_back({entry.path().lexically_relative(root).string(), titleOf(entry.path()), entry.path()});
  }
  std::ranges::sort(cases, {}, &ShippedCase::name);
  return cases;
}

ShippedCase shippedCase(const std::string& name) {
  std::vector<std::string> known;
  for (const ShippedCase& one : shippedCases()) {
    if (name == one.name || name == one.folder.filename()) return one;
    known.insert(known.end(), {one.name, one.folder.filename()});
  }
  throw InputError(fmt::format("there is no case '{}'{}; `lampblack cases` lists them", name, didYouMean(name, known)));
}

void copyCase(const ShippedCase& shipped, const fs::path& folder) {
  if (fs::exists(folder))
    throw InputError(fmt::format("{}: there is such a folder or file already; name another folder", folder.string()));
  try {
    if (folder.has_parent_path()) fs::create_directories(folder.parent_path());
    fs::copy(shipped.folder, folder, fs::copy_options::recursive);
    allowWriting(folder);
    for (const fs::path& deck : decksIn(folder)) bringAlong(deck, shipped.folder);
  } catch (const fs::filesystem_error& error) {
    throw SystemError(fmt::format("{}: the case cannot be copied ({})", folder.string(), error.code().message()));
  }
}

std::vector<fs::path> decksIn(const fs::path& folder) {
  std::vector<fs::path> decks;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string text = textOf(entry.path());
    if (hasLine(text, "problem:") || hasLine(text, "study:") || hasLine(text, "base:")) decks.push_back(entry.path());
  }
  std::ranges::sort(decks);
  return decks;
}

bool isStudy(const fs::path& deck) {
  return hasLine(textOf(deck), "study:");
}

std::string shellWord(const std::string& word) {
  static const std::regex plain(R"([\w./+-]+)");
  if (std::regex_match(word, plain)) return word;
  std::string quoted = "'";
  for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

}  // namespace lampblack::app
