// checkDuplicates and findColliderPairs of mechanism_checks.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "chemistry/mechanism/mechanism_checks.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

using Side = std::vector<std::pair<std::size_t, double>>;

// A reaction as it is compared with others: "H + O2 + AR" is H + O2 with the third body AR.
struct Compared {
  Reaction::Type type;
  Side left, right;  // sorted, the lesser first
  bool forward = true;
  std::optional<ThirdBody> body;
  std::optional<std::size_t> collider;  // the only one
};

Side sorted(const std::vector<StoichiometricTerm>& terms) {
  Side side;
  for (const auto& t : terms) side.emplace_back(t.species, t.coefficient);
  std::sort(side.begin(), side.end());
  return side;
}

// The molecules of a side; none if a coefficient is not a whole number.
std::optional<double> molecules(const std::vector<StoichiometricTerm>& terms) {
  double sum = 0;
  for (const auto& t : terms) {
    if (t.coefficient != std::floor(t.coefficient)) return std::nullopt;
    sum += t.coefficient;
  }
  return sum;
}

// The species that acts as a third body in an elementary reaction: the only one on both sides, where one side has three
// molecules.
std::optional<std::size_t> repeatedSpecies(const Reaction& reaction) {
  if (reaction.type != Reaction::Type::Elementary || !reaction.orders.empty()) return std::nullopt;
  const auto left = molecules(reaction.reactants), right = molecules(reaction.products);
  if (!left || !right || (*left != 3 && *right != 3)) return std::nullopt;
  std::optional<std::size_t> collider;
  for (const auto& a : reaction.reactants)
    for (const auto& b : reaction.products) {
      if (a.species != b.species) continue;
      if (collider || (a.coefficient > 1 && b.coefficient > 1)) return std::nullopt;
      collider = a.species;
    }
  return collider;
}

void removeOne(Side& side, std::size_t species) {
  for (auto& [k, coefficient] : side)
    if (k == species) coefficient -= 1;
  std::erase_if(side, [](const auto& term) { return term.second == 0; });
}

Compared compared(const Reaction& reaction) {
  Compared c{reaction.type, sorted(reaction.reactants), sorted(reaction.products), true, reaction.thirdBody, {}};
  if (const auto named = repeatedSpecies(reaction)) {
    c.type = Reaction::Type::ThreeBody;
    c.collider = named;
    c.body = ThirdBody{0, {{*named, 1.0}}};
    removeOne(c.left, *named);
    removeOne(c.right, *named);
  } else if (c.body && c.body->defaultEfficiency == 0 && c.body->efficiencies.size() == 1) {
    c.collider = c.body->efficiencies[0].species;
  }
  c.forward = c.left <= c.right;
  if (!c.forward) std::swap(c.left, c.right);
  return c;
}

double efficiency(const ThirdBody& body, std::size_t species) {
  for (const auto& e : body.efficiencies)
    if (e.species == species) return e.coefficient;
  return body.defaultEfficiency;
}

bool shareCollider(const Compared& a, const Compared& b, std::size_t numSpecies) {
  if (!a.body || !b.body) return true;
  for (const auto* one : {&a, &b})
    if (one->collider) return efficiency(*a.body, *one->collider) > 0 && efficiency(*b.body, *one->collider) > 0;
  for (std::size_t k = 0; k < numSpecies; ++k)
    if (efficiency(*a.body, k) > 0 && efficiency(*b.body, k) > 0) return true;
  return false;
}

// Calls `visit` for every ordered pair of different reactions that do the same.
template <class Visit>
void forEqualPairs(std::span<const Species> species, std::span<const Reaction> reactions, const Visit& visit) {
  std::vector<Compared> all;
  std::map<std::pair<Side, Side>, std::vector<std::size_t>> groups;
  for (std::size_t r = 0; r < reactions.size(); ++r) {
    all.push_back(compared(reactions[r]));
    groups[{all[r].left, all[r].right}].push_back(r);
  }
  for (const auto& [sides, members] : groups)
    for (const auto r : members)
      for (const auto other : members) {
        const auto &a = reactions[r], &b = reactions[other];
        if (r == other || (all[r].forward != all[other].forward && !a.reversible && !b.reversible)) continue;
        // Marks may say so across types, as in a sum of a tabulated and an Arrhenius rate.
        const bool marked = a.duplicate && b.duplicate;
        if (!marked && all[r].type != all[other].type) continue;
        if (marked || shareCollider(all[r], all[other], species.size())) visit(r, other, all[r], all[other]);
      }
}

std::string place(const std::string& file, const Reaction& reaction) {
  return fmt::format("{}:{}", reaction.file.empty() ? file : reaction.file, reaction.line);
}

}  // namespace

std::vector<ColliderPair> findColliderPairs(std::span<const Species> species, std::span<const Reaction> reactions) {
  std::vector<ColliderPair> pairs;
  forEqualPairs(species, reactions, [&](std::size_t r, std::size_t other, const Compared& a, const Compared& b) {
    if (reactions[r].duplicate && reactions[other].duplicate) return;
    if (!a.collider && b.collider && a.body) pairs.push_back({r, other, *b.collider});
  });
  return pairs;
}

void markDuplicates(const std::string& file, std::span<const Species> species, std::span<Reaction> reactions,
                    std::vector<std::string>& warnings) {
  std::vector<std::size_t> like(reactions.size(), reactions.size());
  forEqualPairs(species, reactions,
                [&](std::size_t r, std::size_t other, const Compared& first, const Compared& second) {
                  if (!reactions[r].duplicate && first.collider.has_value() == second.collider.has_value())
                    like[r] = std::min(like[r], other);
                });
  for (std::size_t r = 0; r < reactions.size(); ++r) {
    if (like[r] == reactions.size()) continue;
    reactions[r].duplicate = true;
    // One warning for two.
    if (const auto& other = reactions[like[r]]; like[r] < r)
      warnings.push_back(
          fmt::format("{}: reaction '{}' is marked as a duplicate: it is the same as '{}' at line {}, and both count",
                      place(file, reactions[r]), reactions[r].equation, other.equation, other.line));
  }
}

void checkDuplicates(const std::string& file, std::span<const Species> species, std::span<Reaction> reactions,
                     std::string_view mark, std::vector<std::string>& warnings) {
  std::vector<bool> partner(reactions.size(), false);
  forEqualPairs(species, reactions,
                [&](std::size_t r, std::size_t other, const Compared& first, const Compared& second) {
                  partner[r] = true;
                  if (reactions[r].duplicate || first.collider.has_value() != second.collider.has_value()) return;
                  const auto &earlier = reactions[std::min(r, other)], &later = reactions[std::max(r, other)];
                  throw InputError(
                      fmt::format("{}: reaction '{}' is the same as '{}' at line {}; expected both to be marked {} if "
                                  "both count, which `lampblack mechanism --permissive -o FILE` does in a new file",
                                  place(file, later), later.equation, earlier.equation, earlier.line, mark));
                });
  for (std::size_t r = 0; r < reactions.size(); ++r) {
    if (partner[r] || !reactions[r].duplicate) continue;
    reactions[r].duplicate = false;
    warnings.push_back(
        fmt::format("{}: reaction '{}' is marked as a duplicate, but there is no other one like it; the mark "
                    "is passed over",
                    place(file, reactions[r]), reactions[r].equation));
  }
  for (const auto& pair : findColliderPairs(species, reactions)) {
    const auto &named = reactions[pair.named], &mixture = reactions[pair.mixture];
    warnings.push_back(fmt::format(
        "{}: reaction '{}' has the collider {} of '{}' at line {} a second time; expected "
        "its efficiency there to be zero, or both to be marked {}",
        place(file, named), named.equation, species[pair.collider].name, mixture.equation, mixture.line, mark));
  }
}

}  // namespace lampblack::chemistry
