#include "chemistry/mechanism/mechanism.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "chemistry/mechanism/mechanism_checks.hpp"
#include "core/errors.hpp"
#include "core/letter_case.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::chemistry {

Mechanism::Mechanism(std::string file, std::string description, std::vector<Element> elements,
                     std::vector<Species> species, std::vector<Reaction> reactions, std::vector<std::string> warnings,
                     const MechanismRules& rules)
    : file_(std::move(file)),
      description_(std::move(description)),
      elements_(std::move(elements)),
      species_(std::move(species)),
      reactions_(std::move(reactions)),
      warnings_(std::move(warnings)) {
  for (std::size_t k = 0; k < species_.size(); ++k) {
    auto& s = species_[k];
    s.molecularWeight = 0;
    for (std::size_t i = 0; i < elements_.size(); ++i) s.molecularWeight += s.atoms[i] * elements_[i].atomicWeight;
    if (!speciesByName_.emplace(s.name, k).second)
      throw InputError(fmt::format("{}: species '{}' is declared twice", placeOf(s), s.name));
    if (!(s.molecularWeight > 0))
      throw InputError(fmt::format("{}: species '{}' has no atoms; expected a composition with a positive mass",
                                   placeOf(s), s.name));
    molecularWeights_.push_back(s.molecularWeight);
    speciesByLowerName_[lowerCase(s.name)].push_back(k);
  }
  checkBalances(file_, elements_, species_, reactions_);
  checkDuplicates(file_, species_, reactions_, rules.duplicateMark, warnings_);
  checkThermo(file_, species_, warnings_);
  checkTransport(file_, elements_, species_, warnings_);
}

std::string Mechanism::placeOf(const Species& species) const {
  return fmt::format("{}:{}", species.file.empty() ? file_ : species.file, species.line);
}

std::string Mechanism::placeOf(const Reaction& reaction) const {
  return fmt::format("{}:{}", reaction.file.empty() ? file_ : reaction.file, reaction.line);
}

std::optional<std::size_t> Mechanism::findSpecies(std::string_view name) const {
  if (const auto found = speciesByName_.find(std::string(name)); found != speciesByName_.end()) return found->second;
  const auto like = speciesByLowerName_.find(lowerCase(name));
  if (like == speciesByLowerName_.end() || like->second.size() != 1) return std::nullopt;
  return like->second.front();
}

std::size_t Mechanism::speciesIndex(std::string_view name) const {
  if (const auto k = findSpecies(name)) return *k;
  if (const auto like = speciesByLowerName_.find(lowerCase(name)); like != speciesByLowerName_.end()) {
    std::string names;
    for (const auto k : like->second) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", species_[k].name);
    throw InputError(
        fmt::format("species '{}' in mechanism {} may be any of {}; expected one of these names", name, file_, names));
  }
  std::vector<std::string> names;
  for (const auto& s : species_) names.push_back(s.name);
  if (const std::string near = nearestName(name, names); !near.empty())
    throw InputError(
        fmt::format("unknown species '{}' in mechanism {}; the nearest known name is '{}'", name, file_, near));
  constexpr std::size_t most = 12;  // of a message
  const std::size_t left = names.size() > most ? names.size() - most : 0;
  names.resize(names.size() - left);
  throw InputError(fmt::format("unknown species '{}' in mechanism {}, which has {}{}", name, file_,
                               fmt::join(names, ", "), left > 0 ? fmt::format(" and {} more", left) : ""));
}

std::optional<std::size_t> Mechanism::findElement(std::string_view name) const {
  for (std::size_t i = 0; i < elements_.size(); ++i)
    if (elements_[i].name == name) return i;
  return std::nullopt;
}

std::size_t Mechanism::elementIndex(std::string_view name) const {
  if (const auto i = findElement(name)) return *i;
  std::vector<std::string_view> names;
  for (const auto& e : elements_) names.push_back(e.name);
  throw InputError(fmt::format("unknown element '{}' in mechanism {}; the nearest known name is '{}'", name, file_,
                               closestName(name, names)));
}

}  // namespace lampblack::chemistry
