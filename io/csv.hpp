// Comma-separated values by RFC 4180 (Shafranovich 2005): a field with a comma, a quote or a line break stands in
// quotes. Every table that Lampblack writes or reads goes through here; names of species have commas.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"
#include "io/results_writer.hpp"

namespace lampblack::io {

// Rows of texts under a line of names.
struct TextTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> lines = {};  // of a file that was read: where each row begins, from 1
};

// One line with its end.
std::string csvLine(const std::vector<std::string>& fields);
// "time [s],X_C5H5O(1,3) [1]", the second in quotes.
std::string csvHeader(const std::vector<Quantity>& columns);
std::string csvText(const TextTable& table);
// Numbers, row-major: a row a line, in the shortest digits that give the number back; under their quantities.
std::string csvRows(std::span<const double> rows, std::size_t width);
std::string csvTable(const std::vector<Quantity>& columns, std::span<const double> rows);

// What parts the fields, by the first line that is neither empty nor a comment: a comma outside of quotes, where there
// is none a semicolon, else a tabulator; nothing where there is none of them.
[[nodiscard]] std::optional<char> separatorOf(std::string_view text);

// The text of a table, in which the names may stand in a comment right above the first row, as numpy's savetxt and
// plotting programs write them ("# time [ms],T [K]"): without its '#'. The row has numbers alone then, as many as the
// comment has fields, parted by the comment's semicolons or tabulators where it has them; a comment whose square
// brackets are no units is prose. InputError where they are units and the numbers of fields differ.
[[nodiscard]] std::string withNamesOutOfComment(std::string text);

// Lines that begin with # and a byte-order mark are skipped, as are blanks around a field outside of quotes and empty
// fields behind the last column and rows of separators alone. separatorOf parts the fields; where it is no comma,
// decimal commas become points (withDecimalPoint), in quotes, too. The names may stand in a comment, as
// withNamesOutOfComment says. InputError where a row has another number of fields than the first line, or tabulators
// part the fields and a comma may be that of thousands (refuseThousands).
TextTable readCsv(const std::string& text);

}  // namespace lampblack::io
