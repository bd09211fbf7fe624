// A gas mechanism: elements, species with thermodynamic and transport data, reactions. Read once from a file, checked,
// and immutable afterwards; every model of the gas (thermo, kinetics, transport) makes its own flat copies from it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "chemistry/mechanism/reaction.hpp"
#include "chemistry/mechanism/species.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct Element {
  std::string name;
  double atomicWeight = 0;  // kg/mol
};

// How files are taken that are not quite as their format has them.
struct MechanismRules {
  // In place of an InputError, with a warning: two reactions that are the same and not marked as duplicates are marked;
  // efficiencies of species that a CHEMKIN file does not declare are left out.
  bool permissive = false;
  std::string_view duplicateMark = "'duplicate: true'";  // how the file's format marks one, for messages
};

class Mechanism {
 public:
  // Reads Cantera's YAML format: the ideal-gas phase of this name (the first one if empty), species with the
  // thermodynamic data of species.hpp and gas transport data, reactions of the types of reaction.hpp. Throws InputError
  // with file, line and what was expected; what the format knows but Lampblack does not (other phases, rate types,
  // polynomials) is such an error too. Keys of a phase that the format does not know are a warning. `permissive`: as in
  // MechanismRules.
  static Mechanism fromFile(const std::string& path, const std::string& phase = "", bool permissive = false);

  // Takes finished data, e.g. from a reader of another format; the same physical checks apply (mechanism_checks.hpp).
  // `warnings` are those of the reader, which has done what mechanism_checks.hpp asks before. Of `rules` the words for
  // messages count here. What can be used though it is not quite right is told in a warning, such as a mark of a
  // duplicate too many, which is dropped.
  Mechanism(std::string file, std::string description, std::vector<Element> elements, std::vector<Species> species,
            std::vector<Reaction> reactions, std::vector<std::string> warnings = {}, const MechanismRules& rules = {});

  std::size_t numSpecies() const { return species_.size(); }
  std::size_t numElements() const { return elements_.size(); }
  std::size_t numReactions() const { return reactions_.size(); }

  const std::string& fileName() const { return file_; }
  // "file:line" where an entry of this mechanism stands, for messages; the file may be another one it was taken from.
  std::string placeOf(const Species& species) const;
  std::string placeOf(const Reaction& reaction) const;
  const std::string& description() const { return description_; }
  // What may be wrong but can be computed with, each with file and line.
  const std::vector<std::string>& warnings() const { return warnings_; }

  const std::string& speciesName(std::size_t k) const { return species_[k].name; }
  // By its name, or by the only name that differs from it in the case of letters alone. speciesIndex throws InputError
  // naming the nearest known species, or those that differ in case.
  std::size_t speciesIndex(std::string_view name) const;
  std::optional<std::size_t> findSpecies(std::string_view name) const;
  std::span<const double> molecularWeights() const { return molecularWeights_; }  // kg/mol

  const std::string& elementName(std::size_t i) const { return elements_[i].name; }
  std::size_t elementIndex(std::string_view name) const;  // InputError if unknown
  std::optional<std::size_t> findElement(std::string_view name) const;
  double atomicWeight(std::size_t i) const { return elements_[i].atomicWeight; }  // kg/mol
  double atoms(std::size_t k, std::size_t element) const { return species_[k].atoms[element]; }

  const Species& species(std::size_t k) const { return species_[k]; }
  const Reaction& reaction(std::size_t r) const { return reactions_[r]; }
  std::span<const Species> allSpecies() const { return species_; }
  std::span<const Reaction> reactions() const { return reactions_; }

 private:
  std::string file_;
  std::string description_;
  std::vector<Element> elements_;
  std::vector<Species> species_;
  std::vector<Reaction> reactions_;
  std::vector<std::string> warnings_;
  std::vector<double> molecularWeights_;
  std::unordered_map<std::string, std::size_t> speciesByName_;
  std::unordered_map<std::string, std::vector<std::size_t>> speciesByLowerName_;
};

// "C2H4: 1, N2: 3" (commas or blanks between the pairs) as mole fractions that sum to one; names as findSpecies takes
// them; a name alone is that species alone. InputError for unknown names (with the nearest known one), negative or
// unreadable amounts, a name given twice, and all amounts zero.
std::vector<double> parseComposition(const Mechanism& mechanism, std::string_view text);

// The same pairs as they stand, with `absent` for species that are not named; messages call the text `what`.
std::vector<double> parseAmounts(const Mechanism& mechanism, std::string_view text, std::string_view what,
                                 double absent);

}  // namespace lampblack::chemistry
