// Rates of a block of states and their derivatives, one state a lane (batch_jacobian.hpp); for temperatures at which
// BatchKernel forms rates from products. For the linkage see batch_kinetics_simd.hpp.
//
// With a reaction's rate q = E d, d = A S (Z_reactants - Z_products) as in BatchKernel,
//   dq/dc_j = E A S (prod of the other z)/s_j,   dq/d[M] = dE/d[M] d,
//   dq/dT = q d ln E/dT + q_reverse (sum nu h/RT - sum nu)/T   (van 't Hoff).
#pragma once

#include "chemistry/kinetics/batch_falloff_slopes.hpp"
#include "chemistry/kinetics/batch_jacobian_view.hpp"
#include "chemistry/kinetics/batch_kinetics_kernel.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {
namespace {

template <class V>
class BatchJacobianKernel {
  using D = typename V::D;
  static constexpr std::size_t lanes = V::lanes;
  using Constants = BatchConstants<V>;
  using Temperature = typename Constants::Temperature;
  struct Block {
    const BatchWork& rates;
    const BatchJacobianWork& work;
    const Temperature& t;
  };

 public:
  // From the concentrations and the rows h (thermo()) to all that BatchJacobianWork has.
  static void run(const BatchView& rates, const BatchJacobianView& view, const BatchWork& ratesWork,
                  const BatchJacobianWork& work, D T, D total) {
    const Temperature t = BatchKernel<V>::constants(rates, ratesWork, T, total);
    Constants::template all<true>(rates, ratesWork, t);
    constantSlopes(rates, ratesWork, work, t);
    clear(work.wdot, rates.numSpecies + 1);
    clear(work.byT, rates.numSpecies + 1);
    clear(work.common, rates.numSpecies);
    clear(work.columns, view.columns);
    for (std::size_t i = 0; i < view.valueList.size; ++i) V::store(work.values + view.valueList.data[i], D{});
    const Block block{ratesWork, work, t};
    for (std::size_t i = 0; i < view.groups.size; ++i) group(view.groups.data[i], block);
    for (std::size_t i = 0; i < view.general.size; ++i) general(view, view.general.data[i], block);
    for (std::size_t i = 0; i < view.sets.size; ++i) set(view, view.sets.data[i], work);
  }

  // h/R and cp/R of all species; WithSlope: d(cp/R)/dT as well. From log2(e) g/RT = c0 (1 - ln T) + c1 T + c2 T^2 +
  // ...: h/RT = -T d(g/RT)/dT.
  template <bool WithSlope>
  static void thermo(const BatchView& view, const BatchJacobianWork& work, D T) {
    for (std::size_t k = 0; k < view.nasa7.size; ++k) {
      const BatchNasa7& species = view.nasa7.data[k];
      const auto isLow = V::notAbove(T, V::all(species.mid));
      const bool allLow = V::every(isLow), noneLow = V::none(isLow);
      const auto c = [&](int i, double factor) {
        if (allLow) return V::all(factor * lnOf2 * species.low[i]);
        if (noneLow) return V::all(factor * lnOf2 * species.high[i]);
        return V::select(isLow, V::all(factor * lnOf2 * species.low[i]), V::all(factor * lnOf2 * species.high[i]));
      };
      const D c0 = c(0, 1.0), c1 = c(1, -1.0), c2 = c(2, -2.0), c3 = c(3, -3.0), c4 = c(4, -4.0);
      D h = V::multiplyAdd(c4, T, c3);
      h = V::multiplyAdd(h, T, c2);
      h = V::multiplyAdd(h, T, c1);
      h = V::multiplyAdd(h, T, c0);
      V::store(work.h + k * lanes, V::multiplyAdd(h, T, c(5, 1.0)));
      D cp = V::multiplyAdd(V::all(5.0) * c4, T, V::all(4.0) * c3);
      cp = V::multiplyAdd(cp, T, V::all(3.0) * c2);
      cp = V::multiplyAdd(cp, T, V::all(2.0) * c1);
      V::store(work.cp + k * lanes, V::multiplyAdd(cp, T, c0));
      if constexpr (WithSlope) {
        D slope = V::multiplyAdd(V::all(20.0) * c4, T, V::all(12.0) * c3);
        slope = V::multiplyAdd(slope, T, V::all(6.0) * c2);
        V::store(work.cpSlope + k * lanes, V::multiplyAdd(slope, T, V::all(2.0) * c1));
      }
    }
  }

 private:
  static constexpr double lnOf2 = 0.69314718055994530942;

  static void clear(double* rows, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) V::store(rows + i * lanes, D{});
  }

  static void add(double* row, D x) { V::store(row, V::load(row) + x); }
  static void subtract(double* row, D x) { V::store(row, V::load(row) - x); }

  // d ln E/dT of all entries, dE/d[M] of those with a set.
  static void constantSlopes(const BatchView& view, const BatchWork& rates, const BatchJacobianWork& work,
                             const Temperature& t) {
    for (std::size_t i = 0; i < view.exponentials.size; ++i)
      V::store(work.slope + i * lanes, FalloffSlopes<V>::ofExponential(view.exponentials.data[i], t.inverse));
    for (std::size_t i = 0; i < view.threeBody.size; ++i) {
      const BatchThreeBody& r = view.threeBody.data[i];
      V::store(work.slope + r.entry, V::load(work.slope + r.base));
      V::store(work.byM + r.entry, V::load(rates.E + r.base));
    }
    FalloffSlopes<V>::template all<false>(view, view.lindemann, rates, work, t);
    FalloffSlopes<V>::template all<true>(view, view.broadened, rates, work, t);
  }

  static void group(const BatchJacobianGroup& g, const Block& block) {
    switch (3 * (g.numReactants - 1) + g.numProducts - 1) {
      case 0:
        return reactions<1, 1>(g, block);
      case 1:
        return reactions<1, 2>(g, block);
      case 2:
        return reactions<1, 3>(g, block);
      case 3:
        return reactions<2, 1>(g, block);
      case 4:
        return reactions<2, 2>(g, block);
      case 5:
        return reactions<2, 3>(g, block);
      case 6:
        return reactions<3, 1>(g, block);
      case 7:
        return reactions<3, 2>(g, block);
      default:
        return reactions<3, 3>(g, block);
    }
  }

  template <int R, int P>
  static void reactions(const BatchJacobianGroup& g, const Block& block) {
    if (g.reversible)
      reactions<R, P, true>(g, block);
    else
      reactions<R, P, false>(g, block);
  }

  template <int N>
  static D product(const double* rows, const std::uint32_t* at) {
    D value = V::load(rows + at[0]);
    for (int i = 1; i < N; ++i) value *= V::load(rows + at[i]);
    return value;
  }

  // Of one side of a reaction, each without one of its factors, times x.
  template <int N>
  static void others(const double* rows, const std::uint32_t* at, D x, D* out) {
    if constexpr (N == 1) {
      out[0] = x;
    } else if constexpr (N == 2) {
      out[0] = x * V::load(rows + at[1]);
      out[1] = x * V::load(rows + at[0]);
    } else {
      const D a = V::load(rows + at[0]), b = V::load(rows + at[1]), c = V::load(rows + at[2]);
      out[0] = x * (b * c);
      out[1] = x * (a * c);
      out[2] = x * (a * b);
    }
  }

  template <int R, int P>
  static void toTargets(double* rows, const std::uint32_t* targets, D x) {
    for (int r = 0; r < R; ++r) subtract(rows + targets[r], x);
    for (int p = R; p < R + P; ++p) add(rows + targets[p], x);
  }

  template <int R, int P, bool Reversible>
  static void reactions(const BatchJacobianGroup& g, const Block& block) {
    constexpr int slots = Reversible ? R + P : R;
    const BatchWork& rates = block.rates;
    const BatchJacobianWork& work = block.work;
    const std::uint32_t* at = g.rows;
    for (std::uint32_t i = 0; i < g.count; ++i, at += 2 + slots + (R + P) * (1 + slots)) {
      const std::uint32_t entry = at[0], column = at[1], *reactants = at + 2, *products = at + 2 + R,
                          *targets = at + 2 + slots, *places = targets + R + P;
      const D E = V::load(rates.E + entry);
      D factor = V::all(g.A[i]), difference, q, byT;
      D derivatives[slots];
      if constexpr (Reversible) {
        factor *= product<R>(rates.s, reactants);
        const D back = product<P>(rates.z, products);
        difference = product<R>(rates.z, reactants) - back;
        const D constant = factor * E;
        q = constant * difference;
        byT = q * V::load(work.slope + entry) + constant * back * vantHoff<R, P>(block, reactants, products);
        others<R>(rates.z, reactants, constant, derivatives);
        others<P>(rates.z, products, D{} - constant, derivatives + R);
        for (int s = 0; s < slots; ++s) derivatives[s] *= V::load(rates.inverseS + reactants[s]);
      } else {
        difference = product<R>(rates.c, reactants);
        const D constant = factor * E;
        q = constant * difference;
        byT = q * V::load(work.slope + entry);
        others<R>(rates.c, reactants, constant, derivatives);
      }
      toTargets<R, P>(work.wdot, targets, q);
      toTargets<R, P>(work.byT, targets, byT);
      if (column != noColumn)
        toTargets<R, P>(work.columns + column, targets, V::load(work.byM + entry) * factor * difference);
      for (int s = 0; s < slots; ++s, places += R + P) toTargets<R, P>(work.values, places, derivatives[s]);
    }
  }

  template <int R, int P>
  static D vantHoff(const Block& block, const std::uint32_t* reactants, const std::uint32_t* products) {
    D h = D{};
    for (int p = 0; p < P; ++p) h += V::load(block.work.h + products[p]);
    for (int r = 0; r < R; ++r) h -= V::load(block.work.h + reactants[r]);
    return V::multiplyAdd(h, block.t.inverse, V::all(static_cast<double>(R - P))) * block.t.inverse;
  }

  // Of molecules [begin, end), one of them left out.
  static D molecules(const BatchJacobianView& view, const double* c, std::uint32_t begin, std::uint32_t end,
                     std::uint32_t without = UINT32_MAX) {
    D value = V::all(1.0);
    for (std::uint32_t i = begin; i < end; ++i)
      if (i != without) value *= V::load(c + view.rowList[i]);
    return value;
  }

  static void general(const BatchJacobianView& view, const BatchJacobianGeneral& r, const Block& block) {
    const BatchWork& rates = block.rates;
    const BatchJacobianWork& work = block.work;
    const BatchTerm *net = view.terms + r.net, *netEnd = view.terms + r.netEnd;
    const auto toTerms = [&](double* rows, D x) {
      for (const BatchTerm* term = net; term != netEnd; ++term) add(rows + term->row, V::all(term->coefficient) * x);
    };
    D gibbs = D{}, h = D{};
    double moles = 0;
    for (const BatchTerm* term = net; term != netEnd; ++term) {
      gibbs = V::multiplyAdd(V::all(term->coefficient), V::load(rates.g + term->row), gibbs);
      h = V::multiplyAdd(V::all(term->coefficient), V::load(work.h + term->row), h);
      moles += term->coefficient;
    }
    const D back = r.reversible ? exp2<V>(gibbs) : D{};  // the reverse constant over the forward one
    const D backward = back * molecules(view, rates.c, r.products, r.productsEnd);
    const D E = V::load(rates.E + r.entry), A = V::all(r.A), constant = A * E;
    const D difference = molecules(view, rates.c, r.reactants, r.reactantsEnd) - backward;
    const D vantHoff = V::multiplyAdd(h, block.t.inverse, V::all(-moles)) * block.t.inverse;
    const D q = constant * difference;
    toTerms(work.wdot, q);
    toTerms(work.byT, q * V::load(work.slope + r.entry) + constant * backward * vantHoff);
    if (r.column != noColumn) toTerms(work.columns + r.column, V::load(work.byM + r.entry) * A * difference);
    const std::uint32_t* place = view.placeList + r.places;
    for (std::uint32_t slot = r.reactants; slot < r.productsEnd; ++slot) {
      const D derivative = slot < r.reactantsEnd
                               ? constant * molecules(view, rates.c, r.reactants, r.reactantsEnd, slot)
                               : D{} - constant * back * molecules(view, rates.c, r.products, r.productsEnd, slot);
      for (const BatchTerm* term = net; term != netEnd; ++term)
        add(work.values + *place++, V::all(term->coefficient) * derivative);
    }
  }

  static void set(const BatchJacobianView& view, const BatchJacobianSet& s, const BatchJacobianWork& work) {
    const double* column = work.columns + s.column;
    const std::uint32_t* place = view.placeList + s.places;
    for (std::uint32_t j = s.colliders; j < s.collidersEnd; ++j)
      for (std::uint32_t i = s.rows; i < s.rowsEnd; ++i)
        add(work.values + *place++, V::all(view.excess[j]) * V::load(column + view.rowList[i]));
    for (std::uint32_t i = s.rows; i < s.rowsEnd; ++i)
      add(work.common + view.rowList[i], V::all(s.base) * V::load(column + view.rowList[i]));
  }
};

}  // namespace
}  // namespace lampblack::chemistry
