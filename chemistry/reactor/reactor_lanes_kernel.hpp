// Adiabatic reactors of constant pressure, one a lane: ReactorSystem's rates and Jacobian, NewtonMatrix's factors, a
// step of RosenbrockSolver. Their headers have the equations. For the linkage see batch_kinetics_simd.hpp.
//
// Every lane is computed by itself: neither what other lanes hold nor its place changes a bit of it.
#pragma once

#include "chemistry/kinetics/batch_jacobian_kernel.hpp"
#include "chemistry/kinetics/batch_kinetics_kernel.hpp"
#include "chemistry/reactor/reactor_lanes_view.hpp"
#include "core/modules.hpp"
#include "numerics/lane_lu_kernel.hpp"

namespace lampblack::chemistry {
namespace {

template <class V>
class ReactorLanesKernel {
  using D = typename V::D;
  static constexpr std::size_t lanes = V::lanes;
  using Rates = BatchKernel<V>;
  using Jacobian = BatchJacobianKernel<V>;
  using Lu = LaneLuKernel<V>;

 public:
  static void chemicalRates(const ReactorLanesView& view, const ReactorLanesWork& work) {
    const Gas gas = prepare(view, work, work.y, view.minTemperature, view.maxTemperature);
    const double* wdot = Rates::block(view.rates, work.rates, gas.T, gas.total);
    const D factor = V::load(work.rateFactor);
    for (std::size_t k = 0; k < view.numSpecies; ++k)
      V::store(work.f + k * lanes, factor * V::load(wdot + k * lanes) * (V::all(view.weights[k]) * gas.volume));
    V::store(work.isGood, gas.isGood);
  }

  static void step(const ReactorLanesView& view, const ReactorLanesWork& work, const LaneTolerance& tolerance) {
    const std::size_t n = view.numSpecies + 1;
    D isGood = linearise(view, work);
    const D scale = V::all(0.5) * V::load(work.stepSize);
    V::store(work.diagonal + n * lanes, scale);
    isGood *= factorise(view, work, scale);
    // Coefficients in the form without products by the Jacobian (Hairer and Wanner, IV.7), times gamma h.
    forEach(n, [&](std::size_t i) { V::store(work.k1 + i, scale * V::load(work.start + i)); });
    solve(view, work, work.k1);
    forEach(n, [&](std::size_t i) {
      const D twice = V::load(work.k1 + i) + V::load(work.k1 + i);
      V::store(work.k2 + i, V::multiplyAdd(scale, V::load(work.start + i), twice));
      V::store(work.end + i, V::load(work.y + i) + twice);
    });
    solve(view, work, work.k2);
    isGood *= rates(view, work, work.end, work.f);
    forEach(n, [&](std::size_t i) {
      const D difference = V::load(work.k1 + i) - V::load(work.k2 + i);
      V::store(work.k3 + i, V::multiplyAdd(scale, V::load(work.f + i), V::all(0.5) * difference));
    });
    solve(view, work, work.k3);
    forEach(n, [&](std::size_t i) { V::store(work.end + i, V::load(work.end + i) + V::load(work.k3 + i)); });
    isGood *= rates(view, work, work.end, work.f);
    forEach(n, [&](std::size_t i) {
      const D difference = V::load(work.k1 + i) - V::load(work.k2 + i) - V::all(8.0 / 3.0) * V::load(work.k3 + i);
      V::store(work.k4 + i, V::multiplyAdd(scale, V::load(work.f + i), V::all(0.5) * difference));
    });
    solve(view, work, work.k4);
    D sum = D{};
    forEach(n, [&](std::size_t i) {
      const D error = V::load(work.k4 + i), end = V::load(work.end + i) + error;
      V::store(work.end + i, end);
      const D smallest =
          V::all(i == view.numSpecies * lanes ? tolerance.smallestTemperature : tolerance.smallestMassFraction);
      const D size = V::larger(magnitude(V::load(work.y + i)), magnitude(end)) + smallest;
      const D scaled = error / (V::all(tolerance.relative) * size);
      sum = V::multiplyAdd(scaled, scaled, sum);
    });
    V::store(work.errorSum, sum);
    V::store(work.isGood, isGood);
  }

 private:
  struct Gas {
    D T, total, volume, meanWeight, isGood;  // total: mol/m3
  };

  template <class Work>
  static void forEach(std::size_t rows, Work&& work) {
    for (std::size_t i = 0; i < rows * lanes; i += lanes) work(i);
  }

  static D magnitude(D x) { return V::larger(x, D{} - x); }
  static D flag(typename V::Mask mask) { return V::select(mask, V::all(1.0), D{}); }

  static Gas prepare(const ReactorLanesView& view, const ReactorLanesWork& work, const double* y, double minT,
                     double maxT) {
    Gas gas{};
    gas.T = V::load(y + view.numSpecies * lanes);
    D moles = D{};
    for (std::size_t k = 0; k < view.numSpecies; ++k)
      moles = V::multiplyAdd(V::load(y + k * lanes), V::all(view.inverseWeights[k]), moles);
    gas.meanWeight = V::all(1.0) / moles;
    const D density = V::load(work.pressure) * gas.meanWeight / (V::all(view.gasConstant) * gas.T);
    gas.volume = V::all(1.0) / density;
    gas.total = D{};
    for (std::size_t k = 0; k < view.numSpecies; ++k) {
      const D c =
          V::larger(V::load(y + k * lanes), V::all(view.leastFraction)) * (density * V::all(view.inverseWeights[k]));
      V::store(work.rates.c + k * lanes, c);
      gas.total += c;
    }
    gas.isGood = flag(V::both(V::both(V::notAbove(V::all(minT), gas.T), V::notAbove(gas.T, V::all(maxT))),
                              V::notAbove(V::all(0x1p-1000), moles)));
    return gas;
  }

  // dy/dt from the production rates and the rows of thermo(); one over the heat capacity.
  static D finishRates(const ReactorLanesView& view, const ReactorLanesWork& work, const Gas& gas, const double* y,
                       const double* wdot, double* f) {
    const D factor = V::load(work.rateFactor);
    D heat = D{}, capacity = D{};
    for (std::size_t k = 0; k < view.numSpecies; ++k) {
      const std::size_t row = k * lanes;
      const D rate = V::multiplyAdd(factor * V::load(wdot + row), V::all(view.weights[k]) * gas.volume,
                                    V::load(work.source + row));
      const D R = V::all(view.gasConstants[k]);
      heat = V::multiplyAdd(R * V::load(work.jacobian.h + row), rate, heat);
      capacity = V::multiplyAdd(R * V::load(work.jacobian.cp + row), V::load(y + row), capacity);
      V::store(f + row, rate);
    }
    const D inverse = V::all(1.0) / capacity;
    V::store(f + view.numSpecies * lanes, (V::load(work.heating) - heat) * inverse);
    return inverse;
  }

  static D rates(const ReactorLanesView& view, const ReactorLanesWork& work, const double* y, double* f) {
    const Gas gas = prepare(view, work, y, view.minStepTemperature, view.maxStepTemperature);
    const double* wdot = Rates::byProducts(view.rates, work.rates, gas.T, gas.total);
    Jacobian::template thermo<false>(view.rates, work.jacobian, gas.T);
    finishRates(view, work, gas, y, wdot, f);
    return gas.isGood;
  }

  // dy/dt at y to `start`, and the matrix.
  static D linearise(const ReactorLanesView& view, const ReactorLanesWork& work) {
    const std::size_t n = view.numSpecies;
    const BatchJacobianWork& jacobian = work.jacobian;
    double* values = work.lu.matrix;
    const Gas gas = prepare(view, work, work.y, view.minStepTemperature, view.maxStepTemperature);
    Jacobian::template thermo<true>(view.rates, jacobian, gas.T);
    Jacobian::run(view.rates, view.jacobian, work.rates, jacobian, gas.T, gas.total);
    const D inverse = finishRates(view, work, gas, work.y, jacobian.wdot, work.start);
    const D factor = V::load(work.rateFactor), slopeT = V::load(work.start + n * lanes), inverseT = V::all(1.0) / gas.T;
    for (std::size_t j = 0; j < n; ++j) V::store(values + view.temperatureRow[j], D{});
    D byT = D{}, byProduct = D{};
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t row = k * lanes;
      const D R = V::all(view.gasConstants[k]), W = V::all(view.weights[k]);
      const D energy = R * V::load(jacobian.h + row), common = factor * V::load(jacobian.common + row);
      D response = common * gas.total;  // sum over j of d wdot_k/d c_j c_j
      for (std::uint32_t e = view.entriesBegin[k]; e < view.entriesBegin[k + 1]; ++e) {
        const LaneEntry& entry = view.entries[e];
        const D derivative = factor * V::load(values + entry.place);
        response = V::multiplyAdd(derivative, V::load(work.rates.c + entry.column), response);
        const D value = derivative * V::all(entry.weightRatio);
        V::store(values + entry.place, value);
        double* heat = values + view.temperatureRow[entry.column / lanes];
        V::store(heat, V::multiplyAdd(energy, value, V::load(heat)));
      }
      const D difference = factor * V::load(jacobian.wdot + row) - response;
      const D column = W * gas.volume * V::multiplyAdd(difference, inverseT, factor * V::load(jacobian.byT + row));
      const D product = W * V::multiplyAdd(difference, gas.meanWeight * gas.volume, common);
      V::store(values + view.temperatureColumn[k], column);
      V::store(values + view.product[k], product);
      byProduct = V::multiplyAdd(energy, product, byProduct);
      byT = V::multiplyAdd(energy, column, byT);
      byT = V::multiplyAdd(R * V::load(jacobian.cp + row), V::load(work.start + row), byT);
      byT = V::multiplyAdd(R * V::load(jacobian.cpSlope + row) * V::load(work.y + row), slopeT, byT);
    }
    const D minus = D{} - inverse;
    for (std::size_t j = 0; j < n; ++j) {
      double* heat = values + view.temperatureRow[j];
      const D capacity = V::all(view.gasConstants[j]) * V::load(jacobian.cp + j * lanes);
      V::store(heat, minus * V::multiplyAdd(capacity, slopeT, V::load(heat)));
    }
    V::store(values + view.temperatureColumn[n], minus * byT);
    V::store(values + view.product[n], minus * byProduct);
    return gas.isGood;
  }

  static D factorise(const ReactorLanesView& view, const ReactorLanesWork& work, D scale) {
    const auto quality = Lu::factorise(view.lu, work.lu, scale, work.diagonal);
    return flag(V::both(V::notAbove(quality.largestMultiplier, V::all(view.largestMultiplier)),
                        V::both(V::notAbove(quality.finite, D{}), V::notAbove(D{}, quality.finite))));
  }

  static void solve(const ReactorLanesView& view, const ReactorLanesWork& work, double* b) {
    V::store(b + (view.numSpecies + 1) * lanes, D{});
    Lu::solve(view.lu, work.lu, b);
  }
};

}  // namespace
}  // namespace lampblack::chemistry
