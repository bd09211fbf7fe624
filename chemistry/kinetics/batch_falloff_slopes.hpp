// Derivatives of fall-off constants in lanes, by [M] and by temperature: part of the kernel of
// batch_jacobian_kernel.hpp. The chain rule of FalloffFactors::evaluateSlopes, with logarithms to base 2.
#pragma once

#include "chemistry/kinetics/batch_jacobian_view.hpp"
#include "chemistry/kinetics/batch_kinetics_constants.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {
namespace {

template <class V>
class FalloffSlopes {
  using D = typename V::D;
  static constexpr std::size_t lanes = V::lanes;
  using Constants = BatchConstants<V>;
  using Temperature = typename Constants::Temperature;
  static constexpr double lnOf2 = 0.69314718055994530942;
  static constexpr double log10OfE = 0.43429448190325182765;
  static constexpr double log2OfE = 1.44269504088896340736;

 public:
  // d ln/dT of 2^(logA + b log2 T + Ta/T)
  template <class Exponential>
  static D ofExponential(const Exponential& e, D inverseT) {
    return (V::all(e.b) - V::all(lnOf2 * e.Ta) * inverseT) * inverseT;
  }

  // After the constants themselves: their rows of work.slope and work.byM.
  template <bool Broadened>
  static void all(const BatchView& view, const BatchArray<BatchFalloff>& reactions, const BatchWork& rates,
                  const BatchJacobianWork& work, const Temperature& t) {
    for (std::size_t i = 0; i < reactions.size; ++i) {
      const BatchFalloff& r = reactions.data[i];
      const D Pr = Constants::reducedPressure(r, rates);
      const D lnPrByT = ofExponential(r.ratio, t.inverse);
      const D one = V::all(1.0);
      D byLnPr = (r.activated ? D{} - Pr : one) / (one + Pr);  // d ln F/d ln Pr
      D byT = D{};
      if constexpr (Broadened) {
        const Broadening b = broadening(view, r, rates, t);
        byLnPr += b.byLnPr;
        byT = b.byT;
      }
      byT = V::multiplyAdd(byLnPr, lnPrByT, byT);
      V::store(work.slope + r.entry, V::load(work.slope + r.base) + byT);
      // Where Pr has vanished, fall-off is proportional to it and an activated reaction does not change.
      const D slope = V::select(V::notAbove(Pr, V::all(Constants::tiny)), r.activated ? D{} : one, byLnPr);
      V::store(work.byM + r.entry, V::load(rates.E + r.entry) / Pr * V::load(rates.factors + r.first) * slope);
    }
  }

 private:
  struct Broadening {
    D byLnPr, byT;  // of ln F; by T at constant Pr
  };

  static Broadening broadening(const BatchView& view, const BatchFalloff& r, const BatchWork& rates,
                               const Temperature& t) {
    const D T = t.T, inverseT = t.inverse;
    D centre = V::all(r.byT) * T, centreByT = V::all(r.byT);
    for (std::uint32_t n = 0; n < r.numTerms; ++n) {
      const std::uint32_t row = r.first + static_cast<std::uint32_t>((n + 1) * lanes);
      const BatchFactorExponential& e = view.factorExponentials.data[row / lanes];
      const D term = V::all(r.weight[n]) * V::load(rates.factors + row);
      const D byT = V::all(lnOf2) * (V::all(e.byT) - V::all(e.Ta) * inverseT * inverseT);
      centre += term;
      centreByT = V::multiplyAdd(term, byT, centreByT);
    }
    const D tiny = V::all(Constants::tiny);
    const D logCentre = log2<V>(V::larger(tiny, centre));
    const D lnCentreByT = V::select(V::notAbove(centre, tiny), D{}, centreByT / V::larger(tiny, centre));
    const D u = Constants::broadeningDistance(r, rates, logCentre, t);
    const D width = V::multiplyAdd(V::all(r.width1), logCentre, V::all(r.width0));
    const D v = width - V::all(r.slope) * u;
    const D inverseV = V::all(1.0) / v, h = u * inverseV, spread = V::all(1.0) / V::multiplyAdd(h, h, V::all(1.0));
    const D byH = V::all(-2.0 * lnOf2) * logCentre * h * spread * spread;
    const D byLnPr = byH * width * inverseV * inverseV * V::all(log10OfE);
    // d h/d log2 Fcent
    const D hByCentre = (V::all(r.shift1) * v - u * V::all(r.width1 - r.slope * r.shift1)) * inverseV * inverseV;
    const D byLnCentre = spread + byH * hByCentre * V::all(log2OfE);
    return {byLnPr, byLnCentre * lnCentreByT + V::all(r.scaleExponent) * inverseT};
  }
};

}  // namespace
}  // namespace lampblack::chemistry
