#include "chemistry/mechanism/known_species.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/errors.hpp"
#include "core/letter_case.hpp"

namespace lampblack::chemistry {

namespace {

// Atoms per element of the mechanism; empty if the name is no formula of C, H, O and N, or has an element that the
// mechanism lacks.
std::optional<std::vector<double>> atomsOfFormula(const Mechanism& mechanism, std::string_view name) {
  std::vector<double> atoms(mechanism.numElements(), 0.0);
  std::size_t at = 0;
  while (at < name.size()) {
    const auto symbol = name.substr(at++, 1);
    if (std::string_view("CHON").find(symbol) == std::string_view::npos) return std::nullopt;
    int count = 0;
    const std::size_t digits = at;
    for (; at < name.size() && std::isdigit(static_cast<unsigned char>(name[at])) != 0 && count < 1000; ++at)
      count = 10 * count + (name[at] - '0');
    if (digits != at && count == 0) return std::nullopt;
    const auto element = mechanism.findElement(symbol);
    if (!element) return std::nullopt;
    atoms[*element] += digits == at ? 1 : count;
  }
  return atoms;
}

bool hasAtoms(const Mechanism& mechanism, std::size_t k, const std::vector<double>& atoms) {
  for (std::size_t e = 0; e < atoms.size(); ++e)
    if (mechanism.atoms(k, e) != atoms[e]) return false;
  return true;
}

std::vector<std::size_t> ofComposition(const Mechanism& mechanism, const std::vector<double>& atoms) {
  std::vector<std::size_t> species;
  for (std::size_t k = 0; k < mechanism.numSpecies(); ++k)
    if (hasAtoms(mechanism, k, atoms)) species.push_back(k);
  return species;
}

}  // namespace

std::optional<std::size_t> findKnownSpecies(const Mechanism& mechanism, std::string_view name) {
  const auto found = mechanism.findSpecies(name);
  const auto atoms = atomsOfFormula(mechanism, name);
  if (!atoms || (found && mechanism.speciesName(*found) == name)) return found;
  auto like = ofComposition(mechanism, *atoms);
  if (like.size() == 1) return like[0];
  std::erase_if(like, [&](std::size_t k) { return !sameInAnyCase(mechanism.speciesName(k), name); });
  return like.size() == 1 ? std::optional(like[0]) : std::nullopt;
}

std::size_t knownSpecies(const Mechanism& mechanism, std::string_view name, std::string_view whoNeeds) {
  if (const auto k = findKnownSpecies(mechanism, name)) return *k;
  std::string candidates;
  if (const auto atoms = atomsOfFormula(mechanism, name))
    for (const auto k : ofComposition(mechanism, *atoms))
      candidates += fmt::format("{}'{}'", candidates.empty() ? "" : ", ", mechanism.speciesName(k));
  throw InputError(fmt::format(
      "{} the species '{}', but the mechanism has no species of this name{}; choose another mechanism", whoNeeds, name,
      candidates.empty() ? "" : fmt::format(", and several of its composition ({})", candidates)));
}

std::vector<std::size_t> knownSpecies(const Mechanism& mechanism, std::span<const std::string> names,
                                      std::string_view whoNeeds) {
  std::vector<std::size_t> species;
  for (const auto& name : names) species.push_back(knownSpecies(mechanism, name, whoNeeds));
  return species;
}

}  // namespace lampblack::chemistry
