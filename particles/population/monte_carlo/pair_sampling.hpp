// Coagulation by candidate pairs in time (after Nanbu 1980, Babovsky 1986, Shima and others 2009; linear in the number
// of particles). Candidates are drawn uniformly one after the other, each from the population as it is then. In a time
// h, M candidates of n particles, a pair (i, j) with w_i >= w_j happens with the probability
//
//   p = K_ij w_i h n^2 / (2 M):   j takes up one of the real particles of i for each of its own, and w_i falls by w_j.
//
// Where p is above one, its whole part or one more real partners at once, as many as i has for each of j. Of two equal
// weights nothing of i is left: both become halves of what there is of i + j. Where i and j are one and the same
// particle (a part 1/n of the draws), its real particles join two by two, with the probability 2 p. The mean change of
// any sum over the particles is then that of Smoluchowski's equation with the population's own numbers, for any h and
// M. docs/theory/population_balance/pairs.md has the derivation and what remains of order 1/n.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "numerics/lanes.hpp"
#include "particles/population/monte_carlo/pair_population.hpp"
#include "particles/population/monte_carlo/pair_rates.hpp"
#include "particles/population/population_solver.hpp"

namespace lampblack::particles {

template <ParticleType Type>
class PairSampling {
 public:
  using Particle = typename Type::Particle;
  // `probability` is what no pair should be above: pairs of which one takes a small share of the other and grows by a
  // small share count by the larger of the two shares (shareOf). Pairs that are above it are counted as limited; above
  // one they would have happened more often.
  explicit PairSampling(double probability) : probability_(probability) {}

  // Coagulation over `time` (s).
  void advance(PairPopulation<Type>& population, double time, RandomStream& random, PopulationCounters& counters);
  // By how much coagulation lowers the number, and raises the second moment by half, in 1/s relative to them: over the
  // last events, or by a draw of pairs where there were none.
  [[nodiscard]] double pace(PairPopulation<Type>& population, RandomStream& random);
  // What advance() goes on with: the pace of the fastest pair (1/s) and the highest weight (1/m3) at the last
  // candidates; a pace of zero: not known.
  [[nodiscard]] std::array<double, 2> memory() const { return {highest_, heaviest_}; }
  void remember(const std::array<double, 2>& memory) {
    highest_ = memory[0];
    heaviest_ = highest_ > 0 ? memory[1] : std::numeric_limits<double>::max();
  }

 private:
  using Row = typename PairPopulation<Type>::Row;
  template <class Rate>
  void draw(const Rate& rate, PairPopulation<Type>& population, double time, RandomStream& random,
            PopulationCounters& counters);
  template <class Rate>
  void probe(const Rate& rate, const PairPopulation<Type>& population, RandomStream& random);
  template <class F>
  static void withRate(const PairPopulation<Type>& population, F&& f);
  // With all that it calls: an event waits for each result on its way, and for what goes through memory longest.
  [[gnu::flatten]] void happen(PairPopulation<Type>& population, std::size_t i, std::size_t j, double p, double u,
                               PopulationCounters& counters);
  // Of p: the larger of what the heavier one loses of its weight and the lighter one gains in volume.
  static double shareOf(const Row& i, const Row& j) {
    const bool heavier = i.weight >= j.weight;
    const auto &a = heavier ? i : j, &b = heavier ? j : i;
    return std::max(b.weight / a.weight, std::min(1.0, static_cast<double>(a.volume) / static_cast<double>(b.volume)));
  }
  static Particle times(const Type& type, Particle particle, std::uint64_t count);

  static constexpr std::size_t together = pairsTogether;
  // Makes the rates `p` of pairs (m3/s) their probabilities, and has what counts of these (shareOf); returns which of
  // them happen, a bit each. In vector lanes, to the bits of one alone.
  static std::uint32_t judge(const Row* rows, const PlacesOfPairs& i, const PlacesOfPairs& j,
                             const std::array<double, together>& u, double scale, std::array<double, together>& p,
                             std::array<double, together>& share);
  static constexpr double aim = 0.8;           // of the probability: what is still higher comes between two blocks
  static constexpr double largestShare = 0.7;  // what the highest rate falls to at most from one block to the next
  static constexpr std::size_t leastBlock = 32;
  static constexpr double roundOff = 1e-9;  // of a weight, below which what is left of it is a matter of rounding

  double probability_;
  double highest_ = 0;                                    // K w of the pair with the highest, 1/s; zero: not known
  double heaviest_ = std::numeric_limits<double>::max();  // 1/m3, weight at the last candidates
  // Sums over the last events.
  double lost_ = 0, gained_ = 0, over_ = 0;  // 1/m3, m3, s
  std::uint64_t events_ = 0;
};

template <ParticleType Type>
template <class F>
void PairSampling<Type>::withRate(const PairPopulation<Type>& population, F&& f) {
  if (population.kernel().hasForm()) {
    population.kernel().visit([&](const auto& form) { f(PairRates{population.rows(), form}); });
  } else {
    f(PairRatesAsked<Type>{population});
  }
}

template <ParticleType Type>
void PairSampling<Type>::advance(PairPopulation<Type>& population, double time, RandomStream& random,
                                 PopulationCounters& counters) {
  if (population.size() == 0 || !(time > 0)) return;
  population.findTerms();
  const double heaviest = population.heaviest();
  // Weights that others have raised since the last candidates.
  if (heaviest > heaviest_) highest_ *= heaviest / heaviest_;
  heaviest_ = heaviest;
  withRate(population, [&](const auto& rate) {
    if (!(highest_ > 0)) probe(rate, population, random);
    if (highest_ > 0) draw(rate, population, time, random, counters);
  });
}

template <ParticleType Type>
std::uint32_t PairSampling<Type>::judge(const Row* rows, const PlacesOfPairs& i, const PlacesOfPairs& j,
                                        const std::array<double, together>& u, double scale,
                                        std::array<double, together>& p, std::array<double, together>& share) {
  using numerics::Lanes, numerics::loadLanes, numerics::storeLanes;
  static_assert(numerics::laneCount == together);
  const auto weights = [rows](const PlacesOfPairs& at) {
    return Lanes{rows[at[0]].weight, rows[at[1]].weight, rows[at[2]].weight, rows[at[3]].weight,
                 rows[at[4]].weight, rows[at[5]].weight, rows[at[6]].weight, rows[at[7]].weight};
  };
  const auto volumes = [rows](const PlacesOfPairs& at) {
    return Lanes{rows[at[0]].volume, rows[at[1]].volume, rows[at[2]].volume, rows[at[3]].volume,
                 rows[at[4]].volume, rows[at[5]].volume, rows[at[6]].volume, rows[at[7]].volume};
  };
  const Lanes wi = weights(i), wj = weights(j), vi = volumes(i), vj = volumes(j), one = Lanes{} + 1.0;
  const auto isHeavier = wi >= wj;
  const Lanes heavy = isHeavier ? wi : wj, light = isHeavier ? wj : wi;
  const Lanes grown = isHeavier ? vi / vj : vj / vi, lost = light / heavy, most = grown < one ? grown : one;
  storeLanes(share.data(), lost > most ? lost : most);
  const Lanes chance = loadLanes(p.data()) * heavy * scale;
  storeLanes(p.data(), chance);
  for (std::size_t c = 0; c < together; ++c) p[c] *= i[c] == j[c] ? 2.0 : 1.0;
  const Lanes bits{1, 2, 4, 8, 16, 32, 64, 128};
  return static_cast<std::uint32_t>(numerics::sumOfLanes(loadLanes(p.data()) > loadLanes(u.data()) ? bits : Lanes{}));
}

template <ParticleType Type>
template <class Rate>
void PairSampling<Type>::draw(const Rate& rate, PairPopulation<Type>& population, double time, RandomStream& random,
                              PopulationCounters& counters) {
  const auto n = static_cast<std::uint32_t>(population.size());
  const double pairs = 0.5 * static_cast<double>(n) * static_cast<double>(n);
  const auto* rows = population.rows();
  const auto block = static_cast<double>(std::max<std::size_t>(leastBlock, n / 2));
  while (time > 0) {
    // As many candidates as keep the highest probability, at most a block of them.
    const double needed = std::max(1.0, std::ceil(time * highest_ * pairs / (aim * probability_)));
    const auto candidates = static_cast<std::uint64_t>(std::min(needed, block));
    const double part = needed > block ? block * aim * probability_ / (highest_ * pairs) : time;
    const double scale = part * pairs / static_cast<double>(candidates);
    double highest = 0;
    std::uint64_t happened = 0;
    std::array<std::uint64_t, 2 * together> words{};
    PlacesOfPairs i, j;
    std::array<double, together> u, p, share;
    for (std::uint64_t k = 0; k < candidates; k += together) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(together, candidates - k));
      for (std::size_t w = 0; w < 2 * count; ++w) words[w] = random.bits();
      for (std::size_t c = 0; c < together; ++c) {
        // i and j by half a word each, of which n is too small a part for its bias (n / 2^32) to be seen.
        const std::uint64_t word = words[2 * c];
        i[c] = static_cast<std::uint32_t>(((word >> 32U) * n) >> 32U);
        j[c] = static_cast<std::uint32_t>(((word & 0xffffffffU) * n) >> 32U);
        u[c] = openUnitInterval(words[2 * c + 1]);
      }
      rate(i, j, p);
      std::uint32_t happening = judge(rows, i, j, u, scale, p, share) & ((1U << count) - 1U);
      for (std::size_t c = count; c < together; ++c) p[c] = 0;
      while (happening != 0) {
        const auto c = static_cast<std::size_t>(std::countr_zero(happening));
        happening &= happening - 1U;
        ++happened;
        happen(population, i[c], j[c], p[c], u[c], counters);
        // Those behind it are of the population as it is now.
        const std::uint32_t a = i[c], b = j[c];
        std::uint32_t same = 0;  // that have one of the two, a bit each, without a branch
        for (std::size_t l = 0; l < together; ++l)
          same |= static_cast<std::uint32_t>((i[l] == a) | (i[l] == b) | (j[l] == a) | (j[l] == b)) << l;
        for (same &= (1U << count) - (2U << c); same != 0; same &= same - 1U) {
          const auto l = static_cast<std::size_t>(std::countr_zero(same));
          const auto &first = rows[i[l]], &second = rows[j[l]];
          p[l] = rate(i[l], j[l]) * std::max(first.weight, second.weight) * (i[l] == j[l] ? 2 * scale : scale);
          share[l] = shareOf(first, second);
          happening = (happening & ~(1U << l)) | static_cast<std::uint32_t>(p[l] > u[l]) << l;
        }
      }
      for (std::size_t c = 0; c < together; ++c) {
        const double counted = p[c] * share[c];
        highest = std::max(highest, counted);
        counters.limited += counted > probability_ * (1 + roundOff) ? 1 : 0;
      }
    }
    counters.fictitious += candidates - happened;
    events_ += happened;
    over_ += part;
    time = needed > block ? time - part : 0;
    // A block of few candidates says little about the highest.
    const double trust = static_cast<double>(candidates) / block;
    highest_ = std::max(highest / scale, highest_ * (1 - (1 - largestShare) * trust));
  }
}

// n pairs that are only looked at.
template <ParticleType Type>
template <class Rate>
void PairSampling<Type>::probe(const Rate& rate, const PairPopulation<Type>& population, RandomStream& random) {
  const auto n = static_cast<std::uint32_t>(population.size());
  const auto* rows = population.rows();
  double number = 0, square = 0;
  const std::uint32_t count = std::max<std::uint32_t>(leastBlock, n);
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto i = static_cast<std::uint32_t>(random.below(n)), j = static_cast<std::uint32_t>(random.below(n));
    const double kernel = rate(i, j);
    highest_ = std::max(highest_, kernel * std::max(rows[i].weight, rows[j].weight) * shareOf(rows[i], rows[j]));
    const double collisions = 0.5 * kernel * rows[i].weight * rows[j].weight;
    number += collisions;
    square += 2 * collisions * static_cast<double>(rows[i].volume) * static_cast<double>(rows[j].volume);
  }
  const double pairs = static_cast<double>(n) * static_cast<double>(n) / count;
  // As if it were what an eighth of the number had shown.
  over_ = number > 0 ? 0.125 * population.number() / (number * pairs) : 0;
  lost_ = number * pairs * over_;
  gained_ = square * pairs * over_;
  events_ = 0;
}

template <ParticleType Type>
double PairSampling<Type>::pace(PairPopulation<Type>& population, RandomStream& random) {
  if (population.size() == 0) return 0;
  if (!(over_ > 0)) {
    population.findTerms();
    withRate(population, [&](const auto& rate) { probe(rate, population, random); });
    if (!(over_ > 0)) return 0;
  }
  if (events_ > population.size() / 4) {  // what was long ago counts less
    lost_ *= 0.5;
    gained_ *= 0.5;
    over_ *= 0.5;
    events_ /= 2;
  }
  double number = 0, square = 0;
  for (std::size_t k = 0; k < population.size(); ++k) {
    const auto& row = population.row(k);
    number += row.weight;
    square += row.weight * static_cast<double>(row.volume) * static_cast<double>(row.volume);
  }
  return std::max(lost_ / number, 0.5 * gained_ / square) / over_;
}

// `count` of them as one, by doubling: what a particle adds to another does not depend on the order.
template <ParticleType Type>
auto PairSampling<Type>::times(const Type& type, Particle particle, std::uint64_t count) -> Particle {
  Particle sum = particle;
  for (--count; count > 0; count /= 2) {
    if (count % 2 == 1) sum = type.coagulated(sum, particle);
    if (count > 1) particle = type.coagulated(particle, particle);
  }
  return sum;
}

template <ParticleType Type>
void PairSampling<Type>::happen(PairPopulation<Type>& population, std::size_t i, std::size_t j, double p, double u,
                                PopulationCounters& counters) {
  const Type& type = population.type();
  ++counters.coagulations;
  if (i == j) {  // two by two
    const double half = 0.5 * population.weight(i), v = population.volume(i);
    lost_ += half;
    gained_ += 2 * half * v * v;
    population.set(i, type.coagulated(population.particle(i), population.particle(i)), half);
    return;
  }
  if (population.weight(i) < population.weight(j)) std::swap(i, j);
  const double heavy = population.weight(i), light = population.weight(j);
  const double whole = std::floor(p), wanted = u < p - whole ? whole + 1 : whole;
  const double most = std::floor(heavy / light), partners = std::min(wanted, most);
  const Particle &a = population.particle(i), &b = population.particle(j);
  const double va = type.volume(a), vb = type.volume(b);
  const Particle joined =
      partners == 1 ? type.coagulated(b, a) : type.coagulated(b, times(type, a, static_cast<std::uint64_t>(partners)));
  const double vj = type.volume(joined), left = heavy - partners * light;
  lost_ += partners * light;
  gained_ += light * (vj * vj - vb * vb - partners * va * va);
  if (left > roundOff * heavy) {
    population.setWeight(i, left);
    population.set(j, joined, light);
  } else {
    population.set(j, joined, 0.5 * (light + left * va / vj));
    population.copy(j, i);
  }
}

}  // namespace lampblack::particles
