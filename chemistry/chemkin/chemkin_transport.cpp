#include "chemistry/chemkin/chemkin_transport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_set>

#include "core/constants.hpp"

namespace lampblack::chemistry {

namespace {

TransportData readLine(const ChemkinSource& source, const ChemkinLine& line) {
  const auto words = chemkinWords(line.text);
  const auto fail = [&](std::string_view message) {
    source.fail(line.number, fmt::format("transport data of '{}': {}", words[0], message));
  };
  constexpr std::array<std::string_view, 6> names{"the geometry",       "the well depth",
                                                  "the diameter",       "the dipole moment",
                                                  "the polarizability", "the rotational relaxation number"};
  if (words.size() < names.size() + 1)
    fail(
        fmt::format("expected six numbers (geometry, well depth, diameter, dipole moment, polarizability, rotational "
                    "relaxation), found {}",
                    words.size() - 1));
  // Text may follow, but one number more means that a value is torn in two, or too many.
  if (words.size() > names.size() + 1 && fortranNumber(words[names.size() + 1]))
    fail(fmt::format("expected six numbers, found a seventh, '{}', in column {}", words[names.size() + 1],
                     words[names.size() + 1].data() - line.text.data() + 1));
  std::array<double, names.size()> values{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto value = fortranNumber(words[i + 1]);
    if (!value) fail(fmt::format("expected a number for {}, found '{}'", names[i], words[i + 1]));
    values[i] = *value;
  }
  TransportData t;
  if (values[0] == 0)
    t.shape = MoleculeShape::Atom;
  else if (values[0] == 1)
    t.shape = MoleculeShape::Linear;
  else if (values[0] == 2)
    t.shape = MoleculeShape::Nonlinear;
  else
    fail(fmt::format("expected a geometry of 0 (atom), 1 (linear) or 2 (nonlinear), found '{}'", words[1]));
  for (std::size_t i = 1; i < names.size(); ++i) {
    const bool positive = i <= 2;
    if (positive ? !(values[i] > 0) : !(values[i] >= 0))
      fail(fmt::format("expected {} {}, found '{}'", names[i], positive ? "above zero" : "of zero or more",
                       words[i + 1]));
  }
  t.wellDepth = values[1];
  t.diameter = 1e-10 * values[2];
  t.dipole = constants::debye * values[3];
  t.polarizability = 1e-30 * values[4];
  t.rotationalRelaxation = values[5];
  return t;
}

}  // namespace

bool isChemkinTransport(const ChemkinSource& source) {
  if (source.lines().empty()) return false;
  const auto words = chemkinWords(source.lines()[0].text);
  const auto heading = upperCase(words[0]);
  if (heading == "TRANSPORT" || heading == "TRANS" || heading == "TRAN") return true;
  // A name and four numbers begin no thermodynamic data, whose first card has elements, and whose limits are three.
  if (words.size() < 5 || fortranNumber(words[0])) return false;
  return std::all_of(words.begin() + 1, words.begin() + 5, [](auto word) { return fortranNumber(word).has_value(); });
}

void readChemkinTransport(const ChemkinSource& source, std::span<const ChemkinLine> section,
                          const std::function<bool(std::string_view)>& wanted, ChemkinTransportTable& table,
                          std::vector<std::string>& warnings) {
  std::unordered_set<std::string> here;
  for (const auto& line : section) {
    const std::string name(chemkinWords(line.text)[0]);
    if (!wanted(name)) continue;
    const auto known = table.find(name);
    if (known == table.end())
      table.emplace(name, ChemkinTransport{readLine(source, line), source.place(line.number)});
    else if (here.contains(name))
      warnings.push_back(fmt::format("{}: species '{}' has transport data already at {}; the first holds",
                                     source.place(line.number), name, known->second.place));
    here.insert(name);
  }
}

}  // namespace lampblack::chemistry
