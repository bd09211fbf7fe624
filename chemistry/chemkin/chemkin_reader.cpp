#include "chemistry/chemkin/chemkin_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "chemistry/chemkin/chemkin_equation.hpp"
#include "chemistry/chemkin/chemkin_keywords.hpp"
#include "chemistry/chemkin/chemkin_nasa9.hpp"
#include "chemistry/chemkin/chemkin_reaction.hpp"
#include "chemistry/chemkin/chemkin_reaction_lines.hpp"
#include "chemistry/chemkin/chemkin_sections.hpp"
#include "chemistry/chemkin/chemkin_thermo.hpp"
#include "chemistry/chemkin/chemkin_transport.hpp"
#include "chemistry/mechanism/elements.hpp"
#include "chemistry/mechanism/equation_text.hpp"
#include "chemistry/mechanism/mechanism_checks.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::chemistry {

namespace {

using Kind = ChemkinSection::Kind;

// "AR" as "Ar", the way the other format names elements.
std::string elementName(std::string_view symbol) {
  std::string name = upperCase(symbol);
  for (std::size_t i = 1; i < name.size(); ++i)
    name[i] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  return name;
}

// The first ten.
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(10, names.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", names[i]);
  return names.size() > 10 ? text + ", ..." : text;
}

class ChemkinReader {
 public:
  ChemkinReader(const ChemkinText& mechanism, bool permissive)
      : permissive_(permissive), source_(mechanism), sections_(splitChemkinSections(source_, nullptr, warnings_)) {}

  Mechanism read(const std::optional<ChemkinText>& thermo, const std::optional<ChemkinText>& transport) {
    for (const auto& section : sections_)
      if (section.kind == Kind::Elements) readElements(section);
    if (elements_.empty())
      throw InputError(fmt::format("{}: no elements; expected a section ELEMENTS", source_.file()));
    for (const auto& section : sections_)
      if (section.kind == Kind::Species) readSpecies(section);
    if (species_.empty()) throw InputError(fmt::format("{}: no species; expected a section SPECIES", source_.file()));
    readData(source_, sections_);
    // A mechanism with its own THERMO may come with transport data alone.
    const bool second = thermo && isChemkinTransport(ChemkinSource(*thermo));
    if (second && transport)
      throw InputError(
          fmt::format("{}: expected thermodynamic data, found transport data; expected the files in the "
                      "order mechanism, thermo, transport",
                      thermo->name));
    if (thermo) readFile(*thermo, second ? Kind::Transport : Kind::Thermo);
    if (transport) readFile(*transport, Kind::Transport);
    applyThermo();
    applyTransport(second || transport.has_value());
    readReactions();
    const MechanismRules rules{.permissive = permissive_, .duplicateMark = "DUPLICATE"};
    settleReactions(source_.file(), species_, reactions_, rules, warnings_);
    return Mechanism(source_.file(), source_.heading(), std::move(elements_), std::move(species_),
                     std::move(reactions_), std::move(warnings_), rules);
  }

 private:
  // "H O E/0.000549/ D /2.014/"
  void readElements(const ChemkinSection& section) {
    for (const auto& line : section.lines) {
      std::string_view rest = trimmed(line.text);
      while (!rest.empty()) {
        const auto end = std::min(rest.find_first_of(" \t/"), rest.size());
        const auto symbol = rest.substr(0, end);
        rest = trimmed(rest.substr(end));
        std::optional<double> weight;
        if (rest.starts_with('/')) {
          const auto close = rest.find('/', 1);
          weight = fortranNumber(rest.substr(1, close == std::string_view::npos ? close : close - 1));
          if (close == std::string_view::npos || !weight || !(*weight > 0))
            source_.fail(line.number, fmt::format("element '{}': expected an atomic weight above zero between slashes, "
                                                  "such as {}/2.014/",
                                                  symbol, symbol));
          rest = trimmed(rest.substr(close + 1));
        }
        addElement(symbol, weight, line.number);
      }
    }
  }

  void addElement(std::string_view symbol, std::optional<double> weight, int line) {
    const bool letters =
        std::ranges::all_of(symbol, [](char c) { return std::isalpha(static_cast<unsigned char>(c)); });
    if (symbol.empty() || symbol.size() > 2 || !letters)
      source_.fail(line, fmt::format("expected the symbol of an element, found '{}'", symbol));
    const auto name = elementName(symbol);
    for (const auto& element : elements_) {
      if (element.name != name) continue;
      warnings_.push_back(
          fmt::format("{}: element '{}' is declared twice; the first holds", source_.place(line), symbol));
      return;
    }
    if (weight) {
      elements_.push_back({name, *weight * 1e-3});
    } else if (const auto standard = standardAtomicWeight(name)) {
      elements_.push_back({name, *standard});
    } else {
      source_.fail(line, fmt::format("unknown element '{}'; one of your own needs its atomic weight in g/mol, such as "
                                     "{}/12.011/",
                                     symbol, symbol));
    }
  }

  void readSpecies(const ChemkinSection& section) {
    for (const auto& line : section.lines) {
      for (const auto word : chemkinWords(line.text)) {
        const bool printable = std::ranges::all_of(word, [](char c) { return c > 0x20 && c < 0x7f; });
        if (!printable || word.find('/') != std::string_view::npos || upperCase(word) == "M" || fortranNumber(word))
          source_.fail(line.number,
                       fmt::format("'{}' cannot be the name of a species; expected printable ASCII without "
                                   "'/', not a number and not M",
                                   word));
        const auto known = speciesLines_.find(std::string(word));
        if (known != speciesLines_.end()) {
          warnings_.push_back(fmt::format("{}: species '{}' is declared already in line {}", source_.place(line.number),
                                          word, known->second));
          continue;
        }
        speciesLines_.emplace(word, line.number);
        names_.emplace_back(word);
        Species species;
        species.name = word;
        species.line = line.number;
        species_.push_back(std::move(species));
      }
    }
  }

  void readData(const ChemkinSource& source, const std::vector<ChemkinSection>& sections) {
    const auto wanted = [this](std::string_view name) { return speciesLines_.contains(std::string(name)); };
    for (const auto& section : sections) {
      if (section.kind == Kind::Thermo) {
        bool nasa9 = false;
        for (const auto& option : section.options) {
          const auto word = upperCase(option);
          nasa9 = nasa9 || word == "NASA9";
          if (word != "ALL" && word != "NASA9" && word != "NASA7")
            source.fail(section.line, fmt::format("THERMO: expected ALL, NASA9 or nothing, found '{}'", option));
        }
        if (nasa9)
          readChemkinNasa9(source, section.lines, wanted, thermo_, warnings_);
        else
          readChemkinThermo(source, section.lines, wanted, thermo_, warnings_);
      } else if (section.kind == Kind::Transport) {
        readChemkinTransport(source, section.lines, wanted, transport_, warnings_);
        haveTransport_ = true;
      }
    }
  }

  void readFile(const ChemkinText& file, Kind kind) {
    const ChemkinSource source(file);
    const auto sections = splitChemkinSections(source, &kind, warnings_);
    for (const auto& section : sections)
      if (section.kind != kind)
        source.fail(section.line, fmt::format("expected {} data only",
                                              kind == Kind::Thermo ? "thermodynamic (THERMO)" : "transport"));
    readData(source, sections);
  }

  void applyThermo() {
    if (thermo_.empty())
      throw InputError(
          fmt::format("{}: no thermodynamic data of any species; expected them in a section THERMO or in a "
                      "second file (therm.dat)",
                      source_.file()));
    std::vector<std::string> missing;
    for (auto& species : species_) {
      const auto found = thermo_.find(species.name);
      if (found == thermo_.end()) {
        missing.push_back(fmt::format("'{}' (line {})", species.name, species.line));
        continue;
      }
      species.thermo = found->second.thermo;
      species.nasa9 = found->second.nasa9;
      species.atoms.assign(elements_.size(), 0.0);
      for (const auto& [symbol, atoms] : found->second.atoms) setAtoms(species, symbol, atoms, found->second.place);
    }
    if (!missing.empty())
      throw InputError(fmt::format("{}: no thermodynamic data for {} of {} species: {}", source_.file(), missing.size(),
                                   species_.size(), listed(missing)));
  }

  void setAtoms(Species& species, const std::string& symbol, double count, const std::string& place) const {
    const auto name = elementName(symbol);
    const auto element = std::ranges::find(elements_, name, &Element::name);
    if (element == elements_.end()) {
      std::string known;
      for (const auto& e : elements_) known += fmt::format("{}{}", known.empty() ? "" : ", ", e.name);
      throw InputError(fmt::format("{}: thermodynamic data of '{}': element '{}' is not declared; declared are {}",
                                   place, species.name, symbol, known));
    }
    if (count < 0 && name != "E")
      throw InputError(fmt::format("{}: thermodynamic data of '{}': expected zero or more atoms of {}, found {}", place,
                                   species.name, symbol, count));
    species.atoms[static_cast<std::size_t>(element - elements_.begin())] = count;
  }

  void applyTransport(bool given) {
    std::vector<std::string> missing;
    for (auto& species : species_) {
      const auto found = transport_.find(species.name);
      if (found == transport_.end())
        missing.push_back(species.name);
      else
        species.transport = found->second.data;
    }
    if ((given || haveTransport_) && !missing.empty())
      warnings_.push_back(fmt::format("{}: no transport data for {} of {} species: {}", source_.file(), missing.size(),
                                      species_.size(), listed(missing)));
  }

  void readReactions() {
    const ChemkinEquationParser parser(names_);
    for (const auto& section : sections_) {
      if (section.kind != Kind::Reactions) continue;
      ChemkinUnits units;
      for (const auto& option : section.options)
        if (!units.set(option))
          source_.fail(section.line,
                       fmt::format("REACTIONS: unknown unit '{}'; expected {}", option, ChemkinUnits::expected()));
      for (const auto& entry : splitChemkinReactions(source_, section.lines, parser, warnings_)) {
        auto made = readChemkinReaction(source_, entry, units, parser, permissive_, warnings_);
        const bool ownReverse = made.size() == 2 || std::ranges::any_of(entry.auxiliaries, [](const auto& item) {
                                  return upperCase(item.key) == "REV";
                                });
        for (auto& reaction : made) {
          reaction.equation = equationText(reaction, [this](std::size_t k) { return std::string_view(names_[k]); });
          reactions_.push_back(std::move(reaction));
          fromReverse_.push_back(ownReverse);
        }
      }
    }
    unmarkSplitDuplicates();
  }

  // DUP of a reaction with REV may hold for one of its two directions only.
  void unmarkSplitDuplicates() {
    const auto sorted = [](std::vector<StoichiometricTerm> terms) {
      std::ranges::sort(terms, {}, &StoichiometricTerm::species);
      return terms;
    };
    const auto same = [&](const auto& a, const auto& b) {
      return std::ranges::equal(sorted(a), sorted(b), [](const auto& x, const auto& y) {
        return x.species == y.species && x.coefficient == y.coefficient;
      });
    };
    for (std::size_t r = 0; r < reactions_.size(); ++r) {
      auto& reaction = reactions_[r];
      if (!fromReverse_[r] || !reaction.duplicate) continue;
      reaction.duplicate = false;
      for (std::size_t other = 0; other < reactions_.size() && !reaction.duplicate; ++other) {
        const auto& b = reactions_[other];
        if (other == r || b.type != reaction.type) continue;
        reaction.duplicate =
            (same(reaction.reactants, b.reactants) && same(reaction.products, b.products)) ||
            (b.reversible && same(reaction.reactants, b.products) && same(reaction.products, b.reactants));
      }
    }
  }

  bool permissive_;
  ChemkinSource source_;
  std::vector<std::string> warnings_;
  std::vector<ChemkinSection> sections_;
  std::vector<Element> elements_;
  std::vector<Species> species_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, int> speciesLines_;
  ChemkinThermoTable thermo_;
  ChemkinTransportTable transport_;
  bool haveTransport_ = false;
  std::vector<Reaction> reactions_;
  std::vector<bool> fromReverse_;
};

}  // namespace

Mechanism readChemkin(const ChemkinFiles& files) {
  const auto load = [](const std::optional<std::string>& path) -> std::optional<ChemkinText> {
    if (!path) return std::nullopt;
    return loadChemkinText(*path);
  };
  return parseChemkin(loadChemkinText(files.mechanism), load(files.thermo), load(files.transport), files.permissive);
}

namespace {

// Other programs' formats, known by how they begin.
void refuseForeignFormat(const ChemkinText& file) {
  const ChemkinSource source(file);
  if (source.lines().empty()) return;
  const auto& first = source.lines().front();
  const auto begins = [&](std::string_view word) { return trimmed(first.text).starts_with(word); };
  constexpr std::string_view made = "; a mechanism is read as YAML or CHEMKIN: Cantera's";
  if (begins("<?xml") || begins("<ctml"))
    source.fail(first.number, fmt::format("this is XML{} ctml2yaml converts", made));
  for (const auto& line : source.lines())
    for (const std::string_view call : {"units(", "ideal_gas(", "species(", "reaction("})
      if (trimmed(line.text).starts_with(call))
        source.fail(line.number, fmt::format("this is CTI, a former format of Cantera{} cti2yaml converts", made));
  if (begins("FoamFile") || begins("/*---"))
    source.fail(first.number, "this is a dictionary of OpenFOAM; a mechanism is read as YAML or CHEMKIN");
}

}  // namespace

Mechanism parseChemkin(const ChemkinText& mechanism, const std::optional<ChemkinText>& thermo,
                       const std::optional<ChemkinText>& transport, bool permissive) {
  refuseForeignFormat(mechanism);
  return ChemkinReader(mechanism, permissive).read(thermo, transport);
}

}  // namespace lampblack::chemistry
