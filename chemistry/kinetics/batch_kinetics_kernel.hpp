// Production rates of a block of states, one state a lane: the kernel of BatchKinetics, written once for all vectors.
// For the linkage see batch_kinetics_simd.hpp.
//
// With s_k = p0/RT exp(-g_k/RT) the equilibrium constant of a reaction is the ratio of the products of s over its
// sides. So its rate of progress is k S (Z_reactants - Z_products), S the product of s over the reactants, Z that of z
// = c/s: no exponential for the reverse direction. Where these products might overflow (low temperatures), the block is
// evaluated by sums of logarithms instead; each state chooses by its own temperature.
#pragma once

#include "chemistry/kinetics/batch_kinetics_constants.hpp"
#include "chemistry/kinetics/batch_kinetics_view.hpp"
#include "core/modules.hpp"
#include "numerics/simd_vectors.hpp"

namespace lampblack::chemistry {
namespace {

template <class V>
class BatchKernel {
  using D = typename V::D;
  static constexpr std::size_t lanes = V::lanes;
  using Constants = BatchConstants<V>;
  using Temperature = typename Constants::Temperature;

 public:
  static void run(const BatchView& view, const BatchWork& work, const BatchStates& states) {
    std::size_t first = 0;
    for (; first + lanes <= states.n; first += lanes) {
      const double* c = states.c + first;
      D total = D{};
      for (std::size_t k = 0; k < view.numSpecies; ++k) {
        const D value = V::loadUnaligned(c + k * states.stride);
        V::store(work.c + k * lanes, value);
        total += value;
      }
      for (std::size_t i = 0; i < view.given.size; ++i)
        V::store(work.given + i * lanes, V::loadUnaligned(states.given + i * states.n + first));
      const double* rates = block(view, work, V::loadUnaligned(states.T + first), total);
      double* wdot = states.wdot + first;
      for (std::size_t k = 0; k < view.numSpecies; ++k)
        V::storeUnaligned(wdot + k * states.wdotStride, V::load(rates + k * lanes));
    }
    if (first < states.n) runRest(view, work, states, first);
  }

  // From the rows of concentrations to the rows that are returned.
  static const double* block(const BatchView& view, const BatchWork& work, D T, D total) {
    const Temperature t = constants(view, work, T, total);
    const auto byProducts =
        V::both(V::notAbove(V::all(view.minProductTemperature), T), V::notAbove(T, V::all(view.maxProductTemperature)));
    if (!V::every(byProducts)) {
      rates<false>(view, work, t, work.wdotByLogs);
      if (V::none(byProducts)) return work.wdotByLogs;
    }
    rates<true>(view, work, t, work.wdot);
    if (!V::every(byProducts))
      for (std::size_t k = 0; k < view.numSpecies; ++k) {
        const std::size_t row = k * lanes;
        V::store(work.wdot + row, V::select(byProducts, V::load(work.wdot + row), V::load(work.wdotByLogs + row)));
      }
    return work.wdot;
  }

  // The same, where the temperatures are known to allow products.
  static const double* byProducts(const BatchView& view, const BatchWork& work, D T, D total) {
    rates<true>(view, work, constants(view, work, T, total), work.wdot);
    return work.wdot;
  }

  // What rate constants and rates are made of.
  static Temperature constants(const BatchView& view, const BatchWork& work, D T, D total) {
    const Temperature t = Constants::temperature(view, T, total);
    Constants::standardStates(view, work, t);
    Constants::thirdBodies(view, work, total);
    Constants::falloff(view, work, t);
    return t;
  }

 private:
  template <bool ByProducts>
  static void rates(const BatchView& view, const BatchWork& work, const Temperature& t, double* wdot) {
    Constants::template all<ByProducts>(view, work, t);
    // Of a temperature that is no number there are no rates.
    const D start = ByProducts ? D{} : t.T - t.T;
    for (std::size_t k = 0; k <= view.numSpecies; ++k) V::store(wdot + k * lanes, start);
    for (std::size_t i = 0; i < view.groups.size; ++i) group<ByProducts>(view.groups.data[i], work, wdot);
    for (std::size_t i = 0; i < view.general.size; ++i) general<ByProducts>(view, view.general.data[i], work, wdot);
  }

  // Fewer states than lanes: the others are empty gas.
  static void runRest(const BatchView& view, const BatchWork& work, const BatchStates& states, std::size_t first) {
    const std::size_t count = states.n - first;
    alignas(64) double T[lanes];
    for (std::size_t i = 0; i < lanes; ++i) T[i] = i < count ? states.T[first + i] : 1000.0;
    D total = D{};
    for (std::size_t k = 0; k < view.numSpecies; ++k) {
      double* row = work.c + k * lanes;
      for (std::size_t i = 0; i < lanes; ++i) row[i] = i < count ? states.c[k * states.stride + first + i] : 0.0;
      total += V::load(row);
    }
    for (std::size_t g = 0; g < view.given.size; ++g)
      for (std::size_t i = 0; i < lanes; ++i)
        work.given[g * lanes + i] = i < count ? states.given[g * states.n + first + i] : 1.0;
    const double* rates = block(view, work, V::load(T), total);
    for (std::size_t k = 0; k < view.numSpecies; ++k)
      for (std::size_t i = 0; i < count; ++i) states.wdot[k * states.wdotStride + first + i] = rates[k * lanes + i];
  }

  template <bool ByProducts>
  static void group(const BatchGroup& g, const BatchWork& work, double* wdot) {
    switch (3 * (g.numReactants - 1) + g.numProducts - 1) {
      case 0:
        return progress<1, 1, ByProducts>(g, work, wdot);
      case 1:
        return progress<1, 2, ByProducts>(g, work, wdot);
      case 2:
        return progress<1, 3, ByProducts>(g, work, wdot);
      case 3:
        return progress<2, 1, ByProducts>(g, work, wdot);
      case 4:
        return progress<2, 2, ByProducts>(g, work, wdot);
      case 5:
        return progress<2, 3, ByProducts>(g, work, wdot);
      case 6:
        return progress<3, 1, ByProducts>(g, work, wdot);
      case 7:
        return progress<3, 2, ByProducts>(g, work, wdot);
      default:
        return progress<3, 3, ByProducts>(g, work, wdot);
    }
  }

  template <int R, int P, bool ByProducts>
  static void progress(const BatchGroup& g, const BatchWork& work, double* wdot) {
    if (g.reversible)
      progress<R, P, ByProducts, true>(g, work, wdot);
    else
      progress<R, P, ByProducts, false>(g, work, wdot);
  }

  template <int N>
  static D product(const double* rows, const std::uint32_t* at) {
    D value = V::load(rows + at[0]);
    for (int i = 1; i < N; ++i) value *= V::load(rows + at[i]);
    return value;
  }

  template <int N>
  static D sum(const double* rows, const std::uint32_t* at) {
    D value = V::load(rows + at[0]);
    for (int i = 1; i < N; ++i) value += V::load(rows + at[i]);
    return value;
  }

  template <int R, int P, bool ByProducts, bool Reversible>
  static void progress(const BatchGroup& g, const BatchWork& work, double* wdot) {
    const std::uint32_t* at = g.rows;
    for (std::uint32_t i = 0; i < g.count; ++i, at += 1 + 2 * (R + P)) {
      const std::uint32_t *reactants = at + 1, *products = at + 1 + R, *targets = at + 1 + R + P;
      D q;
      if constexpr (ByProducts) {
        q = V::all(g.A[i]) * V::load(work.E + at[0]);
        if constexpr (Reversible)
          q *= product<R>(work.s, reactants) * (product<R>(work.z, reactants) - product<P>(work.z, products));
        else
          q *= product<R>(work.c, reactants);
      } else {
        const D x = V::load(work.X + at[0]);
        q = exp2<V>(x) * product<R>(work.c, reactants);
        if constexpr (Reversible)
          q -= exp2<V>(x + sum<P>(work.g, products) - sum<R>(work.g, reactants)) * product<P>(work.c, products);
        q *= V::all(g.A[i]) * V::load(work.F + at[0]);
      }
      for (int r = 0; r < R; ++r) V::store(wdot + targets[r], V::load(wdot + targets[r]) - q);
      for (int p = R; p < R + P; ++p) V::store(wdot + targets[p], V::load(wdot + targets[p]) + q);
    }
  }

  // As concentrationPower of Kinetics.
  static D power(D c, double order, double smallestConcentration) {
    if (order == 1) return c;
    if (order == 2) return c * c;
    if (order == 3) return c * c * c;
    if (order == 4) return c * c * (c * c);
    if (order == 0) return V::all(1.0);
    const D least = V::all(order < 1 ? smallestConcentration : 0x1p-1020);
    const D value = exp2<V>(V::all(order) * log2<V>(V::larger(least, c)));
    return V::select(V::notAbove(least, c), value, order < 1 ? c * (value / least) : D{});
  }

  static D powers(const BatchView& view, std::uint32_t begin, std::uint32_t end, const BatchWork& work) {
    D value = V::all(1.0);
    for (std::uint32_t i = begin; i < end; ++i)
      value *= power(V::load(work.c + view.terms[i].row), view.terms[i].coefficient, view.smallestConcentration);
    return value;
  }

  template <bool ByProducts>
  static void general(const BatchView& view, const BatchGeneral& r, const BatchWork& work, double* wdot) {
    const BatchTerm* terms = view.terms;
    D gibbs = D{};
    for (std::uint32_t i = r.netBegin; i < r.netEnd; ++i)
      gibbs = V::multiplyAdd(V::all(terms[i].coefficient), V::load(work.g + terms[i].row), gibbs);
    const D forward = powers(view, r.forwardBegin, r.forwardEnd, work);
    const D reverse = r.reversible ? powers(view, r.reverseBegin, r.reverseEnd, work) : D{};
    D q = V::all(r.A);
    if constexpr (ByProducts) {
      q *= V::load(work.E + r.entry) * (forward - exp2<V>(gibbs) * reverse);
    } else {
      const D x = V::load(work.X + r.entry);
      q *= V::load(work.F + r.entry) * (exp2<V>(x) * forward - exp2<V>(x + gibbs) * reverse);
    }
    for (std::uint32_t i = r.netBegin; i < r.netEnd; ++i) {
      double* row = wdot + terms[i].row;
      V::store(row, V::multiplyAdd(V::all(terms[i].coefficient), q, V::load(row)));
    }
  }
};

}  // namespace
}  // namespace lampblack::chemistry
