#include "chemistry/mechanism_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "chemistry/mechanism.hpp"
#include "core/errors.hpp"

namespace lampblack {

namespace {

using Side = std::vector<std::pair<std::size_t, double>>;

Side sorted(const std::vector<StoichiometricTerm>& terms) {
  Side side;
  for (const auto& t : terms) side.emplace_back(t.species, t.coefficient);
  std::sort(side.begin(), side.end());
  return side;
}

double efficiency(const ThirdBody& body, std::size_t species) {
  for (const auto& e : body.efficiencies)
    if (e.species == species) return e.coefficient;
  return body.defaultEfficiency;
}

bool shareCollider(const Reaction& a, const Reaction& b, std::size_t numSpecies) {
  if (!a.thirdBody || !b.thirdBody) return true;
  for (std::size_t k = 0; k < numSpecies; ++k)
    if (efficiency(*a.thirdBody, k) > 0 && efficiency(*b.thirdBody, k) > 0) return true;
  return false;
}

void checkBalance(const std::string& file, std::span<const Element> elements, std::span<const Species> species,
                  const Reaction& reaction) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    double left = 0, right = 0;
    for (const auto& t : reaction.reactants) left += t.coefficient * species[t.species].atoms[i];
    for (const auto& t : reaction.products) right += t.coefficient * species[t.species].atoms[i];
    // Lumped reactions carry decimal coefficients with a few digits.
    if (std::abs(left - right) > 1e-4 * std::max({1.0, left, right}))
      throw InputError(fmt::format("{}:{}: reaction '{}' does not balance: {} atoms of {} on the left, {} on the right",
                                   file, reaction.line, reaction.equation, left, elements[i].name, right));
  }
}

}  // namespace

void checkReactions(const std::string& file, std::span<const Element> elements, std::span<const Species> species,
                    std::span<const Reaction> reactions) {
  // Reactions of the same kind between the same two sets of species, in either direction.
  struct Key {
    Reaction::Type type;
    Side first, second;
    auto operator<=>(const Key&) const = default;
  };
  std::map<Key, std::vector<std::size_t>> groups;
  std::vector<bool> forward(reactions.size());
  for (std::size_t r = 0; r < reactions.size(); ++r) {
    checkBalance(file, elements, species, reactions[r]);
    auto left = sorted(reactions[r].reactants), right = sorted(reactions[r].products);
    forward[r] = left <= right;
    if (!forward[r]) std::swap(left, right);
    groups[Key{reactions[r].type, left, right}].push_back(r);
  }
  for (const auto& [key, members] : groups) {
    for (const auto r : members) {
      bool partner = false;
      for (const auto other : members) {
        if (r == other) continue;
        const auto &a = reactions[r], &b = reactions[other];
        if (forward[r] != forward[other] && !a.reversible && !b.reversible) continue;
        if (!shareCollider(a, b, species.size())) continue;
        partner = true;
        if (!a.duplicate)
          throw InputError(
              fmt::format("{}:{}: reaction '{}' is the same as '{}' at line {}; expected both to be marked "
                          "'duplicate: true'",
                          file, std::max(a.line, b.line), a.equation, b.equation, std::min(a.line, b.line)));
      }
      if (!partner && reactions[r].duplicate)
        throw InputError(fmt::format("{}:{}: reaction '{}' is marked as a duplicate, but there is no other one like it",
                                     file, reactions[r].line, reactions[r].equation));
    }
  }
}

}  // namespace lampblack
