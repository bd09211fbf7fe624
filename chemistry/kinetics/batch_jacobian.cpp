#include "chemistry/kinetics/batch_jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace lampblack::chemistry {

namespace {

std::uint32_t endOf(const auto& list) {
  return static_cast<std::uint32_t>(list.size());
}

bool isWhole(double order) {
  return order >= 1 && order == std::floor(order);
}

}  // namespace

bool BatchJacobianTables::covers(const KineticsTables& tables, const BatchView& rates) {
  if (rates.given.size + rates.pressureLog.size + rates.chebyshev.size + rates.nasa9.size > 0) return false;
  return std::ranges::all_of(tables.general, [](const auto& reaction) {
    const auto whole = [](const StoichiometricTerm& term) { return isWhole(term.coefficient); };
    return std::ranges::all_of(reaction.forwardOrders, whole) && std::ranges::all_of(reaction.reverseOrders, whole);
  });
}

BatchJacobianTables::BatchJacobianTables(const KineticsTables& tables, const BatchView& rates, std::size_t entries,
                                         const JacobianTable& table, const Place& place, std::uint32_t nowhere)
    : species_(tables.numSpecies), entries_(entries) {
  if (!covers(tables, rates)) throw std::logic_error("BatchJacobianTables: a mechanism that is not covered");
  setColumns(rates);
  for (const auto& group : std::span(rates.groups.data, rates.groups.size)) addGroup(group, place, nowhere);
  for (const auto& reaction : std::span(rates.general.data, rates.general.size)) addGeneral(reaction, rates, place);
  addSets(tables, table, place);
  const auto& pattern = table.pattern();
  for (std::size_t j = 0; j < pattern.size; ++j)
    for (auto e = pattern.columnStart[j]; e < pattern.columnStart[j + 1]; ++e)
      valueList_.push_back(place(static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(e)]), j));
  std::ranges::sort(valueList_);
  for (auto& group : groups_) {
    group.view.rows = group.rows.data();
    group.view.A = group.A.data();
    groupViews_.push_back(group.view);
  }
}

BatchJacobianView BatchJacobianTables::view() const {
  BatchJacobianView view{};
  view.numEntries = entries_;
  view.groups = {groupViews_.data(), groupViews_.size()};
  view.general = {general_.data(), general_.size()};
  view.sets = {sets_.data(), sets_.size()};
  view.valueList = {valueList_.data(), valueList_.size()};
  view.columns = sets_.size() * (species_ + 1);
  view.rowList = rowList_.data();
  view.placeList = placeList_.data();
  view.terms = terms_.data();
  view.excess = excess_.data();
  return view;
}

// Sets are named by their rows of [M].
void BatchJacobianTables::setColumns(const BatchView& rates) {
  const auto column = [this](std::uint32_t set) { return static_cast<std::uint32_t>(set * (species_ + 1)); };
  for (std::size_t i = 0; i < rates.threeBody.size; ++i)
    columns_[rates.threeBody.data[i].entry] = column(rates.threeBody.data[i].set);
  for (const auto* falloff : {&rates.lindemann, &rates.broadened})
    for (std::size_t i = 0; i < falloff->size; ++i) columns_[falloff->data[i].entry] = column(falloff->data[i].set);
}

std::uint32_t BatchJacobianTables::columnOf(std::uint32_t entry) const {
  const auto at = columns_.find(entry);
  return at == columns_.end() ? noColumn : at->second;
}

void BatchJacobianTables::addGroup(const BatchGroup& group, const Place& place, std::uint32_t nowhere) {
  auto& added = groups_.emplace_back();
  added.view = {group.numReactants, group.numProducts, group.reversible, group.count, nullptr, nullptr};
  const std::size_t numReactants = group.numReactants, molecules = numReactants + group.numProducts,
                    slots = group.reversible ? molecules : numReactants;
  const std::uint32_t* rows = group.rows;
  for (std::uint32_t i = 0; i < group.count; ++i, rows += 1 + 2 * molecules) {
    const std::span species(rows + 1, slots), targets(rows + 1 + molecules, molecules);
    added.A.push_back(group.A[i]);
    added.rows.push_back(rows[0]);
    added.rows.push_back(columnOf(rows[0]));
    added.rows.insert(added.rows.end(), species.begin(), species.end());
    added.rows.insert(added.rows.end(), targets.begin(), targets.end());
    for (const auto column : species)
      for (const auto target : targets) {
        const std::size_t row = target / batchLanes;
        added.rows.push_back(row == species_ ? nowhere : place(row, column / batchLanes));
      }
  }
}

void BatchJacobianTables::addGeneral(const BatchGeneral& reaction, const BatchView& rates, const Place& place) {
  const auto molecules = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i)
      for (double left = rates.terms[i].coefficient; left > 0; --left) rowList_.push_back(rates.terms[i].row);
  };
  BatchJacobianGeneral added{};
  added.entry = reaction.entry;
  added.column = columnOf(reaction.entry);
  added.A = reaction.A;
  added.reversible = reaction.reversible;
  added.reactants = endOf(rowList_);
  molecules(reaction.forwardBegin, reaction.forwardEnd);
  added.reactantsEnd = added.products = endOf(rowList_);
  if (reaction.reversible) molecules(reaction.reverseBegin, reaction.reverseEnd);
  added.productsEnd = endOf(rowList_);
  added.net = endOf(terms_);
  terms_.insert(terms_.end(), rates.terms + reaction.netBegin, rates.terms + reaction.netEnd);
  added.netEnd = endOf(terms_);
  added.places = endOf(placeList_);
  for (std::uint32_t slot = added.reactants; slot < added.productsEnd; ++slot)
    for (std::uint32_t term = added.net; term < added.netEnd; ++term)
      placeList_.push_back(place(terms_[term].row / batchLanes, rowList_[slot] / batchLanes));
  general_.push_back(added);
}

void BatchJacobianTables::addSets(const KineticsTables& tables, const JacobianTable& table, const Place& place) {
  for (std::size_t s = 0; s < tables.sets.size(); ++s) {
    BatchJacobianSet set{};
    set.base = tables.sets[s].base;
    set.column = static_cast<std::uint32_t>(s * (species_ + 1) * batchLanes);
    set.rows = endOf(rowList_);
    for (const auto row : table.setRows(s)) rowList_.push_back(static_cast<std::uint32_t>(row * batchLanes));
    set.rowsEnd = endOf(rowList_);
    set.colliders = endOf(excess_);
    set.places = endOf(placeList_);
    for (const auto& collider : tables.sets[s].excess) {
      excess_.push_back(collider.coefficient);
      for (const auto row : table.setRows(s)) placeList_.push_back(place(row, collider.species));
    }
    set.collidersEnd = endOf(excess_);
    sets_.push_back(set);
  }
}

}  // namespace lampblack::chemistry
