// Where a Monte Carlo method keeps its numerical particles ("entries") and draws the partners of an event from. Stores
// differ in how they find them - classes of like particles, a sorted structure, or the plain O(N) bookkeeping of
// Wang (2025) - and all give the same law. An event takes its entries out and the method inserts what becomes of them,
// so that no store has to hand out positions that could go stale.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/model/collision_kernel.hpp"

namespace lampblack::particles {

// Processes that concern one particle.
enum class SingleProcess : std::size_t { breakage, deposition, condensation };
inline constexpr std::size_t singleProcesses = 3;

// What a store needs to know of its entries, supplied by the method. volume() does not change while an entry is in the
// store; rates may (deferred growth), within bounds that do not. `pair` is the rate of the event of a pair now and
//   pair(i, j) <= (weighted ? factor * (w_i + w_j) : 1) * sum over r < rank of p_r(i) q_r(j) + p_r(j) q_r(i).
template <class R>
concept EntryRates = requires(const R rates, const typename R::Entry entry, CollisionKernel::Terms terms,
                              SingleProcess process) {
  { R::weighted } -> std::convertible_to<bool>;
  { rates.volume(entry) } -> std::convertible_to<double>;
  { rates.weight(entry) } -> std::convertible_to<double>;  // 1 where not weighted
  { rates.rank() } -> std::same_as<std::size_t>;
  { rates.terms(entry) } -> std::same_as<CollisionKernel::Terms>;
  { rates.weightFactor() } -> std::convertible_to<double>;  // the factor above
  { rates.pair(entry, entry) } -> std::convertible_to<double>;
  { rates.single(process, entry) } -> std::convertible_to<double>;  // 1/s; zero where the process is off
  { rates.active(process) } -> std::same_as<bool>;
};

// Bound of rates.single() for as long as the entry is in the store: what stores sum and draw by. Rates that change in
// between have a member singleBound(process, entry).
template <EntryRates R>
[[nodiscard]] double singleBound(const R& rates, SingleProcess process, const typename R::Entry& entry) {
  if constexpr (requires { rates.singleBound(process, entry); }) {
    return rates.singleBound(process, entry);
  } else {
    return rates.single(process, entry);
  }
}

template <class S>
concept EntryStore = requires(S store, const S fixed, typename S::Entry entry, RandomStream& random,
                              SingleProcess process) {
  { fixed.size() } -> std::same_as<std::size_t>;
  { fixed.bytes() } -> std::same_as<std::size_t>;
  store.clear();
  store.insert(entry);
  { fixed.pairRate() } -> std::convertible_to<double>;             // bound of the sum of `pair` over unordered pairs
  { store.drawPair(random, entry, entry) } -> std::same_as<bool>;  // one attempt; true: both are taken out
  { fixed.singleRate(process) } -> std::convertible_to<double>;    // bound of the sum of `single`
  { store.drawSingle(process, random, entry) } -> std::same_as<bool>;  // one attempt; true: it is taken out
  // Of weighted entries, also with a fourth argument left(first, second) -> {double, double}: the weights that stay in.
  { store.takeUniform(random) } -> std::same_as<typename S::Entry>;
  // Also: forEach(f) with f(const Entry&); transform(f) with f(Entry&) -> bool, false drops the entry.
};

// A store accepts a pair with the ratio of its rate to its bound, which gives the right law only while the bound holds.
[[noreturn]] void boundExceeded(double rate, double bound);  // throws NumericsError
inline void checkBound(double rate, double bound) {
  if (!(rate <= bound * (1 + 1e-9))) [[unlikely]]
    boundExceeded(rate, bound);  // 1e-9: rounding
}

}  // namespace lampblack::particles
