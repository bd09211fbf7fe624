#include "io/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/errors.hpp"
#include "io/decimal_point.hpp"
#include "io/table_column.hpp"

namespace lampblack::io {
namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t';
}

}  // namespace

std::optional<char> separatorOf(std::string_view text) {
  bool quoted = false, comment = false, begins = true, hasSemicolon = false, hasTabulator = false;
  for (const char c : text) {
    if (c == '\n') {
      if (!quoted && !comment && !begins) break;
      comment = false;
    } else if (begins && !quoted && c == '#') {
      comment = true;
    } else if (!comment) {
      if (c == '"') quoted = !quoted;
      if (!quoted && c == ',') return ',';
      hasSemicolon = hasSemicolon || (!quoted && c == ';');
      hasTabulator = hasTabulator || (!quoted && c == '\t');
      begins = begins && (isBlank(c) || c == '\r');
    }
  }
  if (hasSemicolon) return ';';
  return hasTabulator ? std::optional('\t') : std::nullopt;
}

namespace {

// Of a line; nothing as separator: blanks, and units behind a blank are no fields of their own.
std::size_t numFields(std::string_view line, std::optional<char> separator) {
  bool quoted = false;
  std::size_t fields = separator ? 1 : 0;
  char before = ' ';
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (separator)
      fields += !quoted && c == *separator ? 1 : 0;
    else if (!quoted && isBlank(before) && !isBlank(c) && std::string_view("\r\n[(").find(c) == std::string_view::npos)
      ++fields;
    before = c;
  }
  return fields;
}

// No names: digits, and what else is in numbers and between them.
bool isNumbers(std::string_view line) {
  return line.find_first_of("0123456789") != std::string_view::npos &&
         line.find_first_not_of("0123456789+-.eEdD,; \t\r\"") == std::string_view::npos;
}

std::string quotedWhereNeeded(const std::string& field) {
  const bool hasBlanksAround = !field.empty() && (isBlank(field.front()) || isBlank(field.back()));
  if (!hasBlanksAround && field.find_first_of(",\"\n\r") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

// What a comment above numbers has in square brackets.
struct Bracketed {
  bool hasUnits = false, hasOthers = false;  // "[1]" may be a unit or a reference: it counts as neither
};

Bracketed bracketedIn(std::string_view comment) {
  Bracketed found;
  for (std::size_t open = comment.find('['); open != std::string_view::npos; open = comment.find('[', open + 1)) {
    const std::string_view text = comment.substr(open + 1, comment.find(']', open) - open - 1);
    if (text == "1") continue;
    (isUnit(text) ? found.hasUnits : found.hasOthers) = true;
  }
  return found;
}

// Whether a comment has the names of the columns of a row of numbers. With other brackets than units it is prose.
// InputError where it has units and as many fields as the row has not.
bool hasNamesOf(std::string_view comment, std::string_view row) {
  const Bracketed bracketed = bracketedIn(comment);
  if (bracketed.hasOthers && !bracketed.hasUnits) return false;
  // Semicolons or tabulators of the names part the row, too, where it has them: its commas are decimal.
  const auto ofNames = separatorOf(comment);
  const bool partsRow = ofNames && *ofNames != ',' && row.find(*ofNames) != std::string_view::npos;
  const std::size_t names = numFields(comment, ofNames),
                    numbers = numFields(row, partsRow ? ofNames : separatorOf(row));
  if (names != numbers && bracketed.hasUnits && !bracketed.hasOthers)
    throw InputError(fmt::format(
        "the comment above the first row, '#{}', names units, but has {} fields, the row {}; part the names "
        "as the numbers are and put those with blanks in quotes, or write the comment without brackets",
        comment.substr(0, comment.find_last_not_of(" \t\r\n") + 1), names, numbers));
  return names == numbers;
}

// The first row has the names. InputError where a row has another number of fields, or a comma that is not clear.
void addRow(TextTable& table, std::vector<std::string> row, std::size_t line, char separator) {
  if (table.columns.empty()) {
    table.columns = std::move(row);
    return;
  }
  if (row.size() != table.columns.size())
    throw InputError(
        fmt::format("line {} has {} fields, the line of the names {}", line, row.size(), table.columns.size()));
  if (separator == '\t') try {
      refuseThousands(row);
    } catch (const InputError& error) {
      throw InputError(fmt::format("line {}: {}", line, error.what()));
    }
  if (separator != ',')
    for (std::string& field : row) field = withDecimalPoint(std::move(field));
  table.rows.push_back(std::move(row));
  table.lines.push_back(line);
}

}  // namespace

std::string csvLine(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    line += quotedWhereNeeded(fields[i]);
  }
  return line + '\n';
}

std::string csvRows(std::span<const double> rows, std::size_t width) {
  std::string lines;
  for (std::size_t i = 0; i < rows.size(); i += width)
    lines += fmt::format("{}\n", fmt::join(rows.subspan(i, width), ","));
  return lines;
}

std::string csvHeader(const std::vector<Quantity>& columns) {
  std::vector<std::string> names;
  for (const Quantity& column : columns) names.push_back(fmt::format("{} [{}]", column.name, column.unit));
  return csvLine(names);
}

std::string csvTable(const std::vector<Quantity>& columns, std::span<const double> rows) {
  return csvHeader(columns) + csvRows(rows, columns.size());
}

std::string csvText(const TextTable& table) {
  std::string text = csvLine(table.columns);
  for (const auto& row : table.rows) text += csvLine(row);
  return text;
}

std::string withNamesOutOfComment(std::string text) {
  std::size_t comment = std::string::npos;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first != std::string_view::npos && line[first] != '#') {
      if (comment != std::string::npos && isNumbers(line) &&
          hasNamesOf(std::string_view(text).substr(comment + 1, begin - comment - 1), line))
        text[comment] = ' ';
      break;
    }
    comment = first == std::string_view::npos ? std::string::npos : begin + first;
    begin = end + 1;
  }
  return text;
}

TextTable readCsv(const std::string& given) {
  const std::string text = withNamesOutOfComment(given);
  TextTable table;
  std::vector<std::string> row;
  std::string field;
  bool quoted = false, comment = false, hadQuotes = false, rowHadQuotes = false;
  std::size_t line = 1, begins = 1;
  const std::size_t start = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  const char separator = separatorOf(std::string_view(text).substr(start)).value_or(',');
  const auto endField = [&] {
    while (!hadQuotes && !field.empty() && isBlank(field.back())) field.pop_back();
    row.push_back(std::move(field));
    field.clear();
    rowHadQuotes = rowHadQuotes || hadQuotes;
    hadQuotes = false;
  };
  const auto endRow = [&] {
    if (row.empty() && field.empty()) return;
    endField();
    // Spreadsheets write separators behind the last column.
    while (row.size() > std::max<std::size_t>(table.columns.size(), 1) && row.back().empty()) row.pop_back();
    const bool isEmpty = !rowHadQuotes && std::ranges::all_of(row, &std::string::empty);  // separators alone
    if (!isEmpty) addRow(table, row, begins, separator);
    rowHadQuotes = false;
    row.clear();
  };
  for (std::size_t i = start; i < text.size(); ++i) {
    const char c = text[i];
    if (row.empty() && field.empty() && !quoted) begins = line;
    if (c == '\n') ++line;
    if (comment) {
      comment = c != '\n';
    } else if (quoted) {
      if (c != '"')
        field += c;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        field += text[++i];
      else
        quoted = false;
    } else if (c == '"') {
      quoted = hadQuotes = true;
    } else if (c == separator) {
      endField();
    } else if (isBlank(c) && (field.empty() || hadQuotes)) {
      continue;
    } else if (c == '\n') {
      endRow();
    } else if (c == '#' && row.empty() && field.empty()) {
      comment = true;
    } else if (c != '\r') {
      field += c;
    }
  }
  endRow();
  return table;
}

}  // namespace lampblack::io
