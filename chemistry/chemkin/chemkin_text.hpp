// The text of CHEMKIN files: lines without their comments, words, and numbers as Fortran writes them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

// A file in memory. `name` is what messages call it.
struct ChemkinText {
  std::string name;
  std::string text;
};

// Reads a whole file; InputError if it cannot be opened or read, or is empty.
ChemkinText loadChemkinText(const std::string& path);

struct ChemkinLine {
  std::string text;  // up to the comment, no blanks at the end
  int number = 0;    // one-based, in the file
};

// The lines of one file that carry text besides comments ("! ..."). Line ends may be those of any system; a tabulator
// is kept in the text.
class ChemkinSource {
 public:
  explicit ChemkinSource(const ChemkinText& file);

  const std::string& file() const { return file_; }
  const std::vector<ChemkinLine>& lines() const { return lines_; }
  // The comment above everything else in the file, without its marks; empty if there is none.
  const std::string& heading() const { return heading_; }

  // Throws InputError "file:line: message".
  [[noreturn]] void fail(int line, std::string_view message) const;
  std::string place(int line) const;  // "file:line"

 private:
  std::string file_;
  std::vector<ChemkinLine> lines_;
  std::string heading_;
};

std::string upperCase(std::string_view text);
std::string_view trimmed(std::string_view text);
// Columns first..first+width-1, counted from one; what the line does not have is blank.
std::string_view chemkinColumns(std::string_view line, std::size_t first, std::size_t width);
// The parts between blanks (and between any of the other separators).
std::vector<std::string_view> chemkinWords(std::string_view text, std::string_view separators = " \t");

// A finite number in any form that Fortran reads: 1.5, 1, .5, 5., 1e3, 1.D+05, 1.0-300 (an exponent without its
// letter), 1.2E 05 (a blank for its sign). Empty if the text is something else, such as 1.2E+ 5, what is left of a
// number that slipped out of its columns.
std::optional<double> fortranNumber(std::string_view text);

}  // namespace lampblack::chemistry
