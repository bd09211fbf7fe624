// Physical checks on a mechanism as a whole, whatever format it came from.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/mechanism/reaction.hpp"
#include "chemistry/mechanism/species.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct Element;
struct MechanismRules;

// Throws InputError with file and line for a reaction that does not conserve an element (1e-4 of its atoms).
void checkBalances(const std::string& file, std::span<const Element> elements, std::span<const Species> species,
                   std::span<const Reaction> reactions);

// Throws InputError with file and line for two reactions of one type between the same species that are not both marked
// as duplicates; `mark` says how the file marks one. A mark without a partner is taken away, with a warning. Opposite
// directions count as the same unless both are irreversible; reactions with third bodies count as different if no
// species is a collider in both. A collider named in the equation beside the same reaction with M is a warning, as in
// Cantera.
void checkDuplicates(const std::string& file, std::span<const Species> species, std::span<Reaction> reactions,
                     std::string_view mark, std::vector<std::string>& warnings);

// Marks the reactions that checkDuplicates would refuse, with a warning each.
void markDuplicates(const std::string& file, std::span<const Species> species, std::span<Reaction> reactions,
                    std::vector<std::string>& warnings);

// What a reader does with its reactions before they become a mechanism's: marks duplicates if the rules are permissive,
// and joins those that have a rate only together (pressure_rate_sums.hpp).
void settleReactions(const std::string& file, std::span<const Species> species, std::vector<Reaction>& reactions,
                     const MechanismRules& rules, std::vector<std::string>& warnings);

// Pairs of a reaction with M and the same reaction with a named collider that M has, too, not both marked as
// duplicates: first the one with M. The collider acts twice.
struct ColliderPair {
  std::size_t mixture = 0, named = 0;  // reactions
  std::size_t collider = 0;            // species
};
std::vector<ColliderPair> findColliderPairs(std::span<const Species> species, std::span<const Reaction> reactions);

// A warning with file and line for each species whose ranges of thermodynamic data do not meet: cp/R jumps by more than
// 1 %, h/RT by more than 0.001 cp/R or s/R by more than 0.001 (s + cp)/R (the limits of Cantera).
void checkThermo(const std::string& file, std::span<const Species> species, std::vector<std::string>& warnings);

// A warning with file and line for each species whose transport data no molecule of its atoms has: a geometry of fewer
// or more atoms, a diameter of less than an Angstrom.
void checkTransport(const std::string& file, std::span<const Element> elements, std::span<const Species> species,
                    std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
