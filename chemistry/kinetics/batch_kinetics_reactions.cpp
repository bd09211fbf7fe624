// The reactions of BatchTables, and the temperatures at which their rates may be formed from products.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "chemistry/kinetics/batch_kinetics_tables.hpp"

namespace lampblack::chemistry {

namespace {

// Leaves concentrations 300 powers of two below one mol/m3, and as many above, to the limits of a double.
constexpr double kLargestExponent = 700;

}  // namespace

void BatchTables::setReactions(const KineticsTables& tables) {
  std::vector<bool> isGeneral(tables.numReactions, false);
  for (const auto& general : tables.general) isGeneral[general.reaction] = true;
  for (std::size_t r = 0; r < tables.numReactions; ++r)
    if (isGeneral[r] || !addToGroup(tables, r)) addGeneral(tables, r);
  groups_.reserve(records_.size());
  for (auto& [shape, records] : records_) orderRecords(shape, records);
}

// Reactions that change the same species follow one another as late as possible, so that a sum need not wait for the
// one before.
void BatchTables::orderRecords(const Shape& shape, std::vector<Record>& records) {
  const std::size_t targets = 1 + shape.reactants + shape.products;
  std::vector<std::ptrdiff_t> lastUse(numSpecies_ + 1, -static_cast<std::ptrdiff_t>(records.size()));
  auto& group = groups_.emplace_back();
  for (std::size_t n = 0; n < records.size(); ++n) {
    const auto latestUse = [&](const Record& record) {
      auto latest = lastUse.back();
      for (std::size_t i = targets; i < record.rows.size(); ++i)
        if (record.rows[i] != row(numSpecies_)) latest = std::max(latest, lastUse[record.rows[i] / batchLanes]);
      return latest;
    };
    const auto first = records.begin() + static_cast<std::ptrdiff_t>(n);
    const auto next = std::min_element(first, records.end(),
                                       [&](const Record& a, const Record& b) { return latestUse(a) < latestUse(b); });
    std::rotate(first, next, next + 1);
    for (std::size_t i = targets; i < first->rows.size(); ++i)
      if (first->rows[i] != row(numSpecies_)) lastUse[first->rows[i] / batchLanes] = static_cast<std::ptrdiff_t>(n);
    group.A.push_back(first->A);
    group.rows.insert(group.rows.end(), first->rows.begin(), first->rows.end());
  }
  groupViews_.push_back({static_cast<std::uint32_t>(shape.reactants), static_cast<std::uint32_t>(shape.products),
                         shape.reversible, static_cast<std::uint32_t>(records.size()), group.rows.data(),
                         group.A.data()});
}

// Where the net coefficients of a reaction are whole numbers: one target a molecule. False if there are more molecules
// than slots, or parts of molecules.
bool BatchTables::addToGroup(const KineticsTables& tables, std::size_t reaction) {
  const auto none = static_cast<std::int32_t>(numSpecies_);
  const auto sink = row(numSpecies_);
  std::vector<std::uint32_t> reactants, products, consumed, produced;
  auto net = tables.netTerms[reaction];
  const auto take = [&](std::int32_t species, double one) {
    for (auto& term : net)
      if (static_cast<std::int32_t>(term.species) == species && term.coefficient * one > 0) {
        term.coefficient -= one;
        return row(term.species);
      }
    return sink;
  };
  for (const auto& slot : tables.reactant)
    if (slot[reaction] != none) {
      reactants.push_back(row(static_cast<std::size_t>(slot[reaction])));
      consumed.push_back(take(slot[reaction], -1.0));
    }
  const bool reversible = reaction < tables.numReversible;
  for (const auto& slot : tables.product)
    if (slot[reaction] != none) {
      products.push_back(row(static_cast<std::size_t>(slot[reaction])));
      produced.push_back(take(slot[reaction], 1.0));
    }
  if (!reversible) {
    // The products count for the targets only.
    for (const auto& term : net)
      for (int left = static_cast<int>(term.coefficient); left > 0; --left)
        produced.push_back(take(static_cast<std::int32_t>(term.species), 1.0));
    if (produced.empty()) produced.push_back(sink);
    products.assign(produced.size(), sink);
  }
  const bool complete = std::all_of(net.begin(), net.end(), [](const auto& term) { return term.coefficient == 0; });
  if (!complete || reactants.empty() || products.empty() || products.size() > 3) return false;
  Record record{A_[reaction], {entry_[reaction]}};
  for (const auto* part : {&reactants, &products, &consumed, &produced})
    record.rows.insert(record.rows.end(), part->begin(), part->end());
  records_[{reactants.size(), products.size(), reversible}].push_back(std::move(record));
  return true;
}

void BatchTables::addGeneral(const KineticsTables& tables, std::size_t reaction) {
  const auto none = static_cast<std::int32_t>(numSpecies_);
  const auto slots = [&](const std::array<std::vector<std::int32_t>, 3>& side) {
    std::vector<StoichiometricTerm> terms;
    for (const auto& slot : side)
      if (slot[reaction] != none) terms.push_back({static_cast<std::size_t>(slot[reaction]), 1.0});
    return terms;
  };
  auto forward = slots(tables.reactant), reverse = slots(tables.product);
  for (const auto& general : tables.general)
    if (general.reaction == reaction) {
      forward = general.forwardOrders;
      reverse = general.reverseOrders;
    }
  const auto end = [&] { return static_cast<std::uint32_t>(terms_.size()); };
  BatchGeneral entry{};
  entry.entry = entry_[reaction];
  entry.A = A_[reaction];
  entry.reversible = reaction < tables.numReversible;
  entry.forwardBegin = addTerms(forward);
  entry.forwardEnd = end();
  entry.reverseBegin = addTerms(reverse);
  entry.reverseEnd = end();
  entry.netBegin = addTerms(tables.netTerms[reaction]);
  entry.netEnd = end();
  general_.push_back(entry);
}

// log2 (RT/p0 exp(g/RT)), as the kernel has it.
double BatchTables::gibbs(std::size_t species, double T) const {
  const double lnT = std::log(T);
  const auto& data = nasa7_[species];
  const double* c = T <= data.mid ? data.low : data.high;
  double extra = 0;
  for (const auto& range : nasa9_)
    if (range.species == row(species) && T >= range.lowerBound) {
      c = range.c;
      extra = c[7] / (T * T) + c[8] * (1.0 + lnT) / T;
    }
  return c[0] * (1.0 - lnT) + c[6] + T * (c[1] + T * (c[2] + T * (c[3] + T * c[4]))) + c[5] / T + extra + std::log2(T) -
         logStandard_;
}

// The range of temperatures around 1500 K where no product of the kernel comes near the limits of a double. Steps of a
// hundredth change the exponents by about as much.
void BatchTables::setProductRange(const KineticsTables& tables) {
  constexpr double middle = 1500, lowest = 50, highest = 10000, step = 1.01;
  minProductTemperature_ = maxProductTemperature_ = middle;
  if (!productsAreSafe(tables, middle)) {
    minProductTemperature_ = highest;  // an empty range
    return;
  }
  while (minProductTemperature_ > lowest && productsAreSafe(tables, minProductTemperature_ / step))
    minProductTemperature_ /= step;
  while (maxProductTemperature_ < highest && productsAreSafe(tables, maxProductTemperature_ * step))
    maxProductTemperature_ *= step;
}

bool BatchTables::productsAreSafe(const KineticsTables& tables, double T) const {
  const auto safe = [](double exponent) { return std::abs(exponent) <= kLargestExponent; };
  std::vector<double> g(numSpecies_ + 1, 0.0);
  for (std::size_t k = 0; k < numSpecies_; ++k) {
    g[k] = gibbs(k, T);
    if (!safe(g[k])) return false;
  }
  constexpr double log2e = 1.44269504088896340736;
  for (std::size_t r = 0; r < tables.numReactions; ++r) {
    const double x = log2e * (tables.lnA[r] + tables.b[r] * std::log(T) - tables.Ta[r] / T);
    const double logA = A_[r] == 0 ? 0 : std::log2(std::abs(A_[r]));
    double left = 0, right = 0;
    for (const auto& slot : tables.reactant) left += g[static_cast<std::size_t>(slot[r])];
    for (const auto& slot : tables.product) right += g[static_cast<std::size_t>(slot[r])];
    double net = 0;
    if (r < tables.numReversible)
      for (const auto& term : tables.netTerms[r]) net += term.coefficient * g[term.species];
    if (!safe(left) || !safe(right) || !safe(net)) return false;
    if (A_[r] != 0 && (!safe(x) || !safe(x - logA) || !safe(x - left) || !safe(x + net))) return false;
  }
  return true;
}

}  // namespace lampblack::chemistry
