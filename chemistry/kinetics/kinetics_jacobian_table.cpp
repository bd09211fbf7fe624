#include "chemistry/kinetics/kinetics_jacobian_table.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace lampblack::chemistry {

namespace {

// The species in the slots of one side of a reaction.
std::vector<std::size_t> slotSpecies(const KineticsTables& tables, bool left, std::size_t i) {
  std::vector<std::size_t> species;
  if (!left && i >= tables.numReversible) return species;
  for (const auto& slot : left ? tables.reactant : tables.product)
    if (static_cast<std::size_t>(slot[i]) != tables.numSpecies) species.push_back(static_cast<std::size_t>(slot[i]));
  return species;
}

std::vector<std::vector<std::size_t>> reactionsOfSets(const KineticsTables& tables) {
  std::vector<std::vector<std::size_t>> reactions(tables.sets.size());
  for (const auto& use : tables.threeBody) reactions[use.set].push_back(use.reaction);
  for (std::size_t i = 0; i < tables.falloff.reaction.size(); ++i)
    reactions[tables.falloff.set[i]].push_back(tables.falloff.reaction[i]);
  return reactions;
}

}  // namespace

JacobianTable::JacobianTable(const KineticsTables& tables) : numReactions_(tables.numReactions) {
  for (const auto& reactions : reactionsOfSets(tables)) {
    std::set<std::size_t> rows;
    for (const auto i : reactions)
      for (const auto& term : tables.netTerms[i]) rows.insert(term.species);
    sets_.push_back({{rows.begin(), rows.end()}, {}});
  }
  setPattern(tables);
  setGroups(tables);
  for (std::size_t s = 0; s < sets_.size(); ++s)
    for (const auto& collider : tables.sets[s].excess)
      for (const auto row : sets_[s].rows) sets_[s].position.push_back(position(row, collider.species));
  for (const auto& one : tables.linearBurke) {
    auto& positions = colliders_.emplace_back();
    for (const auto collider : one.colliders)
      for (const auto& term : tables.netTerms[one.reaction]) positions.push_back(position(term.species, collider));
  }
}

void JacobianTable::setPattern(const KineticsTables& tables) {
  std::vector<std::set<std::size_t>> columns(tables.numSpecies);
  for (std::size_t k = 0; k < tables.numSpecies; ++k) columns[k].insert(k);
  const auto add = [&](std::size_t i, std::size_t column) {
    for (const auto& term : tables.netTerms[i]) columns[column].insert(term.species);
  };
  for (std::size_t i = 0; i < tables.numReactions; ++i)
    for (const bool left : {true, false})
      for (const auto species : slotSpecies(tables, left, i)) add(i, species);
  for (const auto& general : tables.general)
    for (const auto* orders : {&general.forwardOrders, &general.reverseOrders})
      for (const auto& term : *orders) add(general.reaction, term.species);
  for (std::size_t s = 0; s < sets_.size(); ++s)
    for (const auto& collider : tables.sets[s].excess)
      columns[collider.species].insert(sets_[s].rows.begin(), sets_[s].rows.end());
  for (const auto& one : tables.linearBurke)
    for (const auto collider : one.colliders) add(one.reaction, collider);
  pattern_.size = tables.numSpecies;
  pattern_.columnStart.push_back(0);
  for (const auto& rows : columns) {
    for (const auto row : rows) pattern_.row.push_back(static_cast<std::int32_t>(row));
    pattern_.columnStart.push_back(static_cast<std::int32_t>(pattern_.row.size()));
  }
}

std::uint32_t JacobianTable::position(std::size_t row, std::size_t column) const {
  const auto first = pattern_.row.begin() + pattern_.columnStart[column];
  const auto last = pattern_.row.begin() + pattern_.columnStart[column + 1];
  return static_cast<std::uint32_t>(std::lower_bound(first, last, static_cast<std::int32_t>(row)) -
                                    pattern_.row.begin());
}

void JacobianTable::setGroups(const KineticsTables& tables) {
  std::map<std::array<std::size_t, 3>, Group> groups;
  for (std::size_t i = 0; i < tables.numReactions; ++i) {
    const auto left = slotSpecies(tables, true, i), right = slotSpecies(tables, false, i);
    const auto& net = tables.netTerms[i];
    if (left.empty() && right.empty()) continue;
    auto& group = groups[{net.size(), left.size(), right.size()}];
    group.numRows = net.size();
    group.numReactants = left.size();
    group.numProducts = right.size();
    group.reaction.push_back(static_cast<std::uint32_t>(i));
    for (const auto& term : net) group.nu.push_back(term.coefficient);
    for (const auto* side : {&left, &right})
      for (const auto column : *side)
        for (const auto& term : net) group.position.push_back(position(term.species, column));
  }
  for (auto& [shape, group] : groups) groups_.push_back(std::move(group));
  std::size_t source = 6 * numReactions_;
  for (const auto& general : tables.general)
    for (const auto* orders : {&general.forwardOrders, &general.reverseOrders})
      for (const auto& order : *orders) {
        for (const auto& term : tables.netTerms[general.reaction])
          general_.push_back(
              {position(term.species, order.species), static_cast<std::uint32_t>(source), term.coefficient});
        ++source;
      }
  numSources_ = source;
}

// Rows = 0: any number of them.
template <std::size_t Rows>
void JacobianTable::addGroup(const Group& group, const double* sources, double* __restrict values) const {
  const std::size_t rows = Rows == 0 ? group.numRows : Rows;
  const std::uint32_t* __restrict position = group.position.data();
  const double* __restrict nu = group.nu.data();
  const auto addSide = [&](const double* __restrict slot, std::size_t count) {
    for (std::size_t s = 0; s < count; ++s, slot += numReactions_, position += rows) {
      const double derivative = *slot;
      for (std::size_t k = 0; k < rows; ++k) values[position[k]] += nu[k] * derivative;
    }
  };
  for (const auto i : group.reaction) {
    addSide(sources + i, group.numReactants);
    addSide(sources + i + 3 * numReactions_, group.numProducts);
    nu += rows;
  }
}

void JacobianTable::addMassAction(const double* sources, double* values) const {
  for (const auto& group : groups_) {
    switch (group.numRows) {
      case 2:
        addGroup<2>(group, sources, values);
        break;
      case 3:
        addGroup<3>(group, sources, values);
        break;
      case 4:
        addGroup<4>(group, sources, values);
        break;
      default:
        addGroup<0>(group, sources, values);
    }
  }
  for (const auto& term : general_) values[term.position] += term.nu * sources[term.source];
}

void JacobianTable::addColliders(const KineticsTables& tables, std::size_t i, double scale,
                                 std::span<const double> excess, double* values) const {
  const std::uint32_t* position = colliders_[i].data();
  for (const double of : excess)
    for (const auto& term : tables.netTerms[tables.linearBurke[i].reaction])
      values[*position++] += scale * of * term.coefficient;
}

void JacobianTable::addExcess(const KineticsTables& tables, std::size_t set, const double* column,
                              double* values) const {
  const auto& table = sets_[set];
  const std::uint32_t* position = table.position.data();
  for (const auto& collider : tables.sets[set].excess) {
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      values[position[i]] += collider.coefficient * column[table.rows[i]];
    position += table.rows.size();
  }
}

}  // namespace lampblack::chemistry
