// What a block of states needs before its reactions: standard states, third bodies, rate constants. Part of the kernel
// of BatchKinetics; for the linkage see batch_kinetics_simd.hpp.
#pragma once

#include "chemistry/kinetics/batch_kinetics_view.hpp"
#include "core/modules.hpp"
#include "numerics/simd_vectors.hpp"

namespace lampblack::chemistry {
namespace {

template <class V>
class BatchConstants {
  using D = typename V::D;
  static constexpr std::size_t lanes = V::lanes;
  static_assert(lanes == batchLanes);
  static constexpr double log10Of2 = 0.30102999566398119521;
  static constexpr double lnOf2 = 0.69314718055994530942;
  static constexpr double huge = 0x1p+900;  // of Pr, so that its square by a broadening stays finite

 public:
  static constexpr double tiny = 0x1p-996;  // keeps logarithms of vanishing pressures and broadenings finite

  struct Temperature {
    D T, inverse, log, oneMinusLn;  // log to base 2
    D logPressure;                  // of Pa, if any reaction asks
  };

  static Temperature temperature(const BatchView& view, D T, D total) {
    Temperature t{};
    t.T = T;
    t.inverse = V::all(1.0) / T;
    t.log = log2<V>(T);
    t.oneMinusLn = V::all(1.0) - t.log * V::all(lnOf2);
    t.logPressure = D{};
    if (view.pressureLog.size + view.chebyshev.size > 0)
      t.logPressure = log2<V>(V::all(view.gasConstant) * T * V::larger(V::all(view.smallestConcentration), total));
    return t;
  }

  // g, s, 1/s and z of all species.
  static void standardStates(const BatchView& view, const BatchWork& work, const Temperature& t) {
    const D shift = t.log - V::all(view.logStandard);
    for (std::size_t k = 0; k < view.nasa7.size; ++k) {
      const BatchNasa7& species = view.nasa7.data[k];
      const auto low = V::notAbove(t.T, V::all(species.mid));
      D g;
      if (V::every(low))
        g = gibbs(species.low, t, shift);
      else if (V::none(low))
        g = gibbs(species.high, t, shift);
      else
        g = V::select(low, gibbs(species.low, t, shift), gibbs(species.high, t, shift));
      V::store(work.g + k * lanes, g);
    }
    for (std::size_t i = 0; i < view.nasa9.size; ++i) {
      const BatchNasa9Range& range = view.nasa9.data[i];
      const double* c = range.c;
      D g = gibbs(c, t, shift) + t.inverse * (V::all(c[7]) * t.inverse + V::all(c[8]) * (V::all(2.0) - t.oneMinusLn));
      double* row = work.g + range.species;
      V::store(row, V::select(V::notAbove(V::all(range.lowerBound), t.T), g, V::load(row)));
    }
    for (std::size_t row = 0; row < view.numSpecies * lanes; row += lanes) {
      D power, inverse;
      exp2Both<V>(V::load(work.g + row), power, inverse);
      V::store(work.s + row, inverse);
      V::store(work.inverseS + row, power);
      V::store(work.z + row, V::load(work.c + row) * power);
    }
  }

  static void thirdBodies(const BatchView& view, const BatchWork& work, D total) {
    for (std::size_t i = 0; i < view.thirdBodies.size; ++i) {
      const BatchThirdBody& body = view.thirdBodies.data[i];
      D M = V::all(body.base) * total;
      for (std::uint32_t e = body.begin; e < body.end; ++e)
        M = V::multiplyAdd(V::all(view.terms[e].coefficient), V::load(work.c + view.terms[e].row), M);
      V::store(work.M + i * lanes, M);
      if (body.logarithm) V::store(work.logM + i * lanes, log2<V>(V::larger(V::all(tiny), M)));
    }
  }

  // The factors F of fall-off reactions. Short loops over all of them, as one after the other they would wait for their
  // own results most of the time.
  static void falloff(const BatchView& view, const BatchWork& work, const Temperature& t) {
    for (std::size_t i = 0; i < view.factorExponentials.size; ++i) {
      const BatchFactorExponential& e = view.factorExponentials.data[i];
      V::store(work.factors + i * lanes, exp2<V>(V::multiplyAdd(V::all(e.byT), t.T, exponent(e, t))));
    }
    for (std::size_t i = 0; i < view.lindemann.size; ++i) {
      const BatchFalloff& r = view.lindemann.data[i];
      const D Pr = reducedPressure(r, work);
      V::store(work.F + r.entry, (r.activated ? V::all(1.0) : Pr) / (V::all(1.0) + Pr));
    }
    for (std::size_t i = 0; i < view.broadened.size; ++i) {
      const BatchFalloff& r = view.broadened.data[i];
      D centre = V::all(r.byT) * t.T;
      for (std::uint32_t n = 0; n < r.numTerms; ++n)
        centre = V::multiplyAdd(V::all(r.weight[n]), V::load(work.factors + r.first + (n + 1) * lanes), centre);
      V::store(work.centre + i * lanes, log2<V>(V::larger(V::all(tiny), centre)));
    }
    for (std::size_t i = 0; i < view.broadened.size; ++i) broadening(view.broadened.data[i], work, t, i * lanes);
    for (std::size_t i = 0; i < view.broadened.size; ++i) {
      double* factor = work.F + view.broadened.data[i].entry;
      V::store(factor, V::load(factor) * exp2<V>(V::load(work.centre + i * lanes)));
    }
  }

  // ByProducts: the rows E. Otherwise the rows X, and the factors that are not there yet.
  template <bool ByProducts>
  static void all(const BatchView& view, const BatchWork& work, const Temperature& t) {
    for (std::size_t i = 0; i < view.exponentials.size; ++i) {
      const D x = exponent(view.exponentials.data[i], t);
      if constexpr (ByProducts)
        V::store(work.E + i * lanes, exp2Inside<V>(x));
      else
        V::store(work.X + i * lanes, x);
    }
    for (std::size_t i = 0; i < view.given.size; ++i) {
      const BatchGiven& r = view.given.data[i];
      multiply<ByProducts>(work, r.entry, r.base, V::load(work.given + i * lanes));
    }
    for (std::size_t i = 0; i < view.threeBody.size; ++i) {
      const BatchThreeBody& r = view.threeBody.data[i];
      multiply<ByProducts>(work, r.entry, r.base, V::load(work.M + r.set));
    }
    multiplyByFactors<ByProducts>(view.lindemann, work);
    multiplyByFactors<ByProducts>(view.broadened, work);
    for (std::size_t i = 0; i < view.pressureLog.size; ++i) {
      const BatchPressureLog& r = view.pressureLog.data[i];
      set<ByProducts>(work, r.entry, pressureLog(view, r, t));
    }
    for (std::size_t i = 0; i < view.chebyshev.size; ++i) {
      const BatchChebyshev& r = view.chebyshev.data[i];
      set<ByProducts>(work, r.entry, chebyshev(view, r, t));
    }
  }

  static D reducedPressure(const BatchFalloff& r, const BatchWork& work) {
    const D Pr = V::load(work.factors + r.first) * V::load(work.M + r.set);
    return V::smaller(V::all(huge), V::larger(V::all(tiny), Pr));
  }

  // u of BatchFalloff
  static D broadeningDistance(const BatchFalloff& r, const BatchWork& work, D logCentre, const Temperature& t) {
    const D logPr = V::all(log10Of2) * (exponent(r.ratio, t) + V::load(work.logM + r.set));
    return V::multiplyAdd(V::all(r.shift1), logCentre, V::all(r.shift0) + logPr);
  }

 private:
  static D gibbs(const double* c, const Temperature& t, D shift) {
    D g = V::multiplyAdd(V::all(c[4]), t.T, V::all(c[3]));
    g = V::multiplyAdd(g, t.T, V::all(c[2]));
    g = V::multiplyAdd(g, t.T, V::all(c[1]));
    g = V::multiplyAdd(g, t.T, V::all(c[6]));
    const D rest = V::multiplyAdd(V::all(c[5]), t.inverse, shift);
    return g + V::multiplyAdd(V::all(c[0]), t.oneMinusLn, rest);
  }

  template <bool ByProducts>
  static void multiply(const BatchWork& work, std::uint32_t entry, std::uint32_t base, D factor) {
    if constexpr (ByProducts) {
      V::store(work.E + entry, V::load(work.E + base) * factor);
    } else {
      V::store(work.X + entry, V::load(work.X + base));
      V::store(work.F + entry, V::load(work.F + base) * factor);
    }
  }

  template <bool ByProducts>
  static void multiplyByFactors(const BatchArray<BatchFalloff>& reactions, const BatchWork& work) {
    for (std::size_t i = 0; i < reactions.size; ++i) {
      const BatchFalloff& r = reactions.data[i];
      multiply<ByProducts>(work, r.entry, r.base, V::load(work.F + r.entry));
    }
  }

  template <bool ByProducts>
  static void set(const BatchWork& work, std::uint32_t entry, D x) {
    if constexpr (ByProducts)
      V::store(work.E + entry, exp2<V>(x));
    else
      V::store(work.X + entry, x);
  }

  template <class Exponential>
  static D exponent(const Exponential& e, const Temperature& t) {
    return V::multiplyAdd(V::all(e.b), t.log, V::multiplyAdd(V::all(e.Ta), t.inverse, V::all(e.logA)));
  }

  // Leaves log2 F in its row of work.centre, and F's companion in work.F.
  static void broadening(const BatchFalloff& r, const BatchWork& work, const Temperature& t, std::size_t row) {
    const D logCentre = V::load(work.centre + row);
    const D Pr = reducedPressure(r, work);
    const D u = broadeningDistance(r, work, logCentre, t);
    const D v = V::multiplyAdd(V::all(r.width1), logCentre, V::all(r.width0)) - V::all(r.slope) * u;
    // 1/(1 + (u/v)^2) and Pr/(1 + Pr) by one division.
    const D v2 = v * v, both = V::multiplyAdd(u, u, v2), one = V::all(1.0) + Pr;
    const D inverse = V::all(1.0) / (both * one);
    const D scale = V::multiplyAdd(V::all(r.scaleExponent), t.log, V::all(r.logScale));
    V::store(work.centre + row, V::multiplyAdd(logCentre, v2 * (one * inverse), scale));
    V::store(work.F + r.entry, (r.activated ? V::all(1.0) : Pr) * (both * inverse));
  }

  static D pressureLog(const BatchView& view, const BatchPressureLog& r, const Temperature& t) {
    D below = logOfLevel(view, view.levels[r.begin], t), x = below;
    for (std::uint32_t i = r.begin + 1; i < r.end; ++i) {
      const BatchPressureLevel& level = view.levels[i];
      const D above = logOfLevel(view, level, t);
      const D over = V::all(level.logP) - t.logPressure;
      const D inside = V::multiplyAdd(below - above, V::all(level.inverseWidth) * over, above);
      // Above the level before, this interval decides; above this level, its rate, until the next interval.
      x = V::select(V::notAbove(t.logPressure, V::all(view.levels[i - 1].logP)), x,
                    V::select(V::notAbove(t.logPressure, V::all(level.logP)), inside, above));
      below = above;
    }
    return x;
  }

  static D logOfLevel(const BatchView& view, const BatchPressureLevel& level, const Temperature& t) {
    const auto x = [&](const BatchPressureRate& rate) { return exponent(rate, t); };
    const BatchPressureRate* rates = view.pressureRates;
    if (level.end - level.begin == 1) return x(rates[level.begin]);
    D largest = x(rates[level.begin]), sum = D{};
    for (std::uint32_t i = level.begin + 1; i < level.end; ++i) largest = V::larger(x(rates[i]), largest);
    for (std::uint32_t i = level.begin; i < level.end; ++i)
      sum = V::multiplyAdd(V::all(rates[i].sign), exp2<V>(x(rates[i]) - largest), sum);
    // The logarithm of a sum that is not positive is none.
    const D value = largest + log2<V>(V::larger(V::all(tiny), sum));
    return V::select(V::notAbove(sum, D{}), V::all(__builtin_nan("")), value);
  }

  // Clenshaw's recurrence in both directions.
  static D chebyshev(const BatchView& view, const BatchChebyshev& r, const Temperature& t) {
    const D x = V::multiplyAdd(V::all(r.scaleT), t.inverse, V::all(r.shiftT));
    const D y = V::multiplyAdd(V::all(r.scaleP), t.logPressure, V::all(r.shiftP));
    const double* a = view.chebyshevCoefficients + r.begin;
    D b1 = D{}, b2 = D{};
    for (std::uint32_t i = r.numT; i-- > 1;) {
      const D b = V::multiplyAdd(x + x, b1, clenshaw(a + std::size_t{i} * r.numP, r.numP, y) - b2);
      b2 = b1;
      b1 = b;
    }
    return V::multiplyAdd(x, b1, clenshaw(a, r.numP, y) - b2);
  }

  static D clenshaw(const double* a, std::uint32_t n, D x) {
    D b1 = D{}, b2 = D{};
    for (std::uint32_t i = n; i-- > 1;) {
      const D b = V::multiplyAdd(x + x, b1, V::all(a[i]) - b2);
      b2 = b1;
      b1 = b;
    }
    return V::multiplyAdd(x, b1, V::all(a[0]) - b2);
  }
};

}  // namespace
}  // namespace lampblack::chemistry
