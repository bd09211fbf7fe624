// The cases that ship, and copies of them that run anywhere.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::app {

struct ShippedCase {
  std::string name;   // "flame1d/free_methane"
  std::string title;  // the first line of its page
  std::filesystem::path folder;
};

// In order of their names. SystemError where nothing ships.
std::vector<ShippedCase> shippedCases();

// By its name, or by the last part of it. InputError with names that may be meant.
ShippedCase shippedCase(const std::string& name);

// Copies the folder of a case, and files outside it that its decks name (a mechanism, a mesh): they come to lie beside
// the decks, which name them there. InputError where there is such a folder already; SystemError where it cannot be
// written.
void copyCase(const ShippedCase& shipped, const std::filesystem::path& folder);

// The decks and studies of a folder, by name.
std::vector<std::filesystem::path> decksIn(const std::filesystem::path& folder);
bool isStudy(const std::filesystem::path& deck);

// A word as a shell reads it: in quotes where it has to be.
std::string shellWord(const std::string& word);

}  // namespace lampblack::app
