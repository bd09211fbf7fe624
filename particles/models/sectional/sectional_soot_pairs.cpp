#include "particles/models/sectional/sectional_soot_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::particles {

SectionPairs::SectionPairs(std::span<const double> pivots, double factor, std::size_t melting)
    : sections_(pivots.size()), melting_(melting), events_(sections_), larger_(sections_), smaller_(sections_) {
  const std::size_t n = sections_;
  for (const double m : pivots) overLast_.push_back(m / pivots[n - 1]);
  for (std::size_t d = 0; d < n; ++d) {
    Diagonal line{};
    line.d = d;
    line.offset = root_.size();
    line.count = n - d;
    const double smaller = std::pow(factor, -static_cast<double>(d)), sum = 1 + smaller;  // over the larger pivot
    auto shift = static_cast<std::size_t>(std::log(sum) / std::log(factor));
    while (std::pow(factor, static_cast<double>(shift + 1)) <= sum) ++shift;
    line.shift = shift;
    const double lower = std::pow(factor, static_cast<double>(shift)), upper = lower * factor;
    line.number[1] = (smaller + (1 - lower)) / (upper - lower);  // Wang (2025), eq. 9-26
    line.number[0] = 1 - line.number[1];
    line.primaries[1] = line.number[1] * upper / sum;  // Wang (2025), eq. 9-27
    line.primaries[0] = 1 - line.primaries[1];
    line.beyond = sum;
    line.ratio = smaller;
    // Larger section t + d: interior where t + d + shift + 1 <= n - 1.
    line.interior = n - 1 > d + shift ? n - 1 - d - shift : 0;
    for (std::size_t t = 0; t < line.count; ++t) root_.push_back(std::sqrt(1 / pivots[t] + 1 / pivots[t + d]));
    diagonals_.push_back(line);
  }
  kernel_.assign(root_.size(), 0);
  slopeLarger_ = slopeSmaller_ = kernel_;
}

double SectionPairs::kernel(std::size_t i, std::size_t j) const {
  const std::size_t d = i > j ? i - j : j - i;
  return kernel_[diagonals_[d].offset + std::min(i, j)] * (d == 0 ? 2 : 1);
}

void SectionPairs::updateKernels(const SectionShapes& shapes, const Gas& gas) {
  const double* dc = shapes.collision.data();
  const double* g = shapes.slipOver.data();
  for (const Diagonal& line : diagonals_) {
    const double half = line.d == 0 ? 0.5 : 1;
    const double free = half * gas.freeMolecular, continuum = half * gas.continuum;
    const double* root = root_.data() + line.offset;
    double* kernel = kernel_.data() + line.offset;
    const std::size_t d = line.d;
    if (!gas.transition) {
      for (std::size_t t = 0; t < line.count; ++t) {
        const double sum = dc[t] + dc[t + d];
        kernel[t] = free * root[t] * sum * sum;
      }
      continue;
    }
    for (std::size_t t = 0; t < line.count; ++t) {
      const double sum = dc[t] + dc[t + d];
      kernel[t] = harmonicMean(free * root[t] * sum * sum, continuum * (g[t] + g[t + d]) * sum);
    }
  }
}

void SectionPairs::updateSlopes(const SectionShapes& shapes, const Gas& gas) {
  const double* dc = shapes.collision.data();
  const double* g = shapes.slipOver.data();
  const double* dcSlope = shapes.collisionSlope.data();
  const double* gSlope = shapes.slipOverSlope.data();
  for (const Diagonal& line : diagonals_) {
    const double half = line.d == 0 ? 0.5 : 1;
    const double free = half * gas.freeMolecular, continuum = half * gas.continuum;
    const std::size_t d = line.d, o = line.offset;
    for (std::size_t t = 0; t < line.count; ++t) {
      const std::size_t i = t + d, p = o + t;
      const double sum = dc[t] + dc[i];
      if (!gas.transition) {
        const double bySum = 2 * kernel_[p] / sum;
        slopeLarger_[p] = bySum * dcSlope[i];
        slopeSmaller_[p] = bySum * dcSlope[t];
        continue;
      }
      // 1/K = 1/F + 1/C: dK = (K/F)^2 dF + (K/C)^2 dC.
      const double overFree = kernel_[p] / (free * root_[p] * sum * sum), slips = g[t] + g[i];
      const double overContinuum = kernel_[p] / (continuum * slips * sum);
      const double bySum = kernel_[p] * (2 * overFree + overContinuum) / sum;
      const double bySlip = kernel_[p] * overContinuum / slips;
      slopeLarger_[p] = bySum * dcSlope[i] + bySlip * gSlope[i];
      slopeSmaller_[p] = bySum * dcSlope[t] + bySlip * gSlope[t];
    }
  }
}

void SectionPairs::addRates(std::span<const double> aggregates, std::span<const double> primaries,
                            std::span<double> aggregateRates, std::span<double> primaryRates) {
  const std::size_t last = sections_ - 1;
  const double* N = aggregates.data();
  const double* P = primaries.data();
  double* fN = aggregateRates.data();
  double* fP = primaryRates.data();
  for (const Diagonal& line : diagonals_) {
    const std::size_t d = line.d;
    const double* K = kernel_.data() + line.offset;
    for (std::size_t t = 0; t < line.count; ++t) events_[t] = K[t] * N[t] * N[t + d];
    for (std::size_t t = 0; t < line.count; ++t) fN[t] -= events_[t];
    const bool stays = line.shift == 0;  // below, with what stays where it is taken off first: no carbon is lost by it
    if (stays) {
      for (std::size_t t = 0; t < line.interior; ++t) fN[t + d] -= line.number[1] * events_[t];
    } else {
      for (std::size_t t = 0; t < line.count; ++t) fN[t + d] -= events_[t];
      for (std::size_t t = 0; t < line.interior; ++t) fN[t + d + line.shift] += line.number[0] * events_[t];
    }
    const std::size_t up = d + line.shift + 1;
    for (std::size_t t = 0; t < line.interior; ++t) fN[t + up] += line.number[1] * events_[t];
    for (std::size_t t = line.interior; t < line.count; ++t)
      fN[last] += (stays ? line.ratio : line.beyond * overLast_[t + d]) * events_[t];
    if (primaries.empty()) continue;

    for (std::size_t t = 0; t < line.count; ++t) {
      larger_[t] = K[t] * P[t + d] * N[t];
      smaller_[t] = K[t] * P[t] * N[t + d];
    }
    for (std::size_t t = 0; t < line.count; ++t) fP[t] -= smaller_[t];
    const std::size_t melting = std::min(melting_, line.count), melted = std::min(melting, line.interior);
    for (std::size_t t = 0; t < melting; ++t) smaller_[t] = 0;
    const double *numbers = line.number, *parts = line.primaries;
    if (stays) {
      for (std::size_t t = 0; t < melted; ++t) fP[t + d] -= numbers[1] * larger_[t];
      for (std::size_t t = melted; t < line.interior; ++t) fP[t + d] += parts[0] * smaller_[t] - parts[1] * larger_[t];
    } else {
      for (std::size_t t = 0; t < line.count; ++t) fP[t + d] -= larger_[t];
      for (std::size_t t = 0; t < line.interior; ++t)
        fP[t + up - 1] += (t < melted ? numbers[0] : parts[0]) * (larger_[t] + smaller_[t]);
    }
    for (std::size_t t = 0; t < melted; ++t) fP[t + up] += numbers[1] * larger_[t];
    for (std::size_t t = melted; t < line.interior; ++t) fP[t + up] += parts[1] * (larger_[t] + smaller_[t]);
    for (std::size_t t = line.interior; t < line.count; ++t) {
      const double beyond = stays ? line.ratio : line.beyond * overLast_[t + d];
      fP[last] += t < melting ? beyond * larger_[t] : stays ? smaller_[t] : larger_[t] + smaller_[t];
    }
  }
}

void SectionPairs::addJacobian(const SectionShapes& shapes, std::span<const double> aggregates,
                               std::span<const double> primaries, double* J, std::size_t ld) const {
  const std::size_t n = sections_, last = n - 1;
  const bool withPrimaries = !primaries.empty();
  for (const Diagonal& line : diagonals_) {
    for (std::size_t t = 0; t < line.count; ++t) {
      const std::size_t i = t + line.d, p = line.offset + t;
      const bool inside = t < line.interior;
      const std::size_t lower = inside ? i + line.shift : last, upper = inside ? lower + 1 : last;
      const double numberLower = inside ? line.number[0] : line.beyond * overLast_[i];
      const double numberUpper = inside ? line.number[1] : 0;
      const double K = kernel_[p], Ni = aggregates[i], Nt = aggregates[t];
      const auto column = [&](std::size_t c, double events, double larger, double smaller) {
        double* at = J + c;
        at[i * ld] -= events;
        at[t * ld] -= events;
        at[lower * ld] += numberLower * events;
        at[upper * ld] += numberUpper * events;
        if (!withPrimaries) return;
        double* below = at + n * ld;
        below[i * ld] -= larger;
        below[t * ld] -= smaller;
        if (t < melting_) {
          below[lower * ld] += numberLower * larger;
          below[upper * ld] += numberUpper * larger;
        } else {
          below[lower * ld] += (inside ? line.primaries[0] : 1) * (larger + smaller);
          below[upper * ld] += (inside ? line.primaries[1] : 0) * (larger + smaller);
        }
      };
      if (!withPrimaries) {
        column(i, K * Nt, 0, 0);
        column(t, K * Ni, 0, 0);
        continue;
      }
      const double Pi = primaries[i], Pt = primaries[t];
      const double byNi = slopeLarger_[p] * shapes.byAggregates[i], byPi = slopeLarger_[p] * shapes.byPrimaries[i];
      const double byNt = slopeSmaller_[p] * shapes.byAggregates[t], byPt = slopeSmaller_[p] * shapes.byPrimaries[t];
      const double pairs = Ni * Nt, larger = Pi * Nt, smaller = Pt * Ni;
      column(i, K * Nt + byNi * pairs, byNi * larger, K * Pt + byNi * smaller);
      column(t, K * Ni + byNt * pairs, K * Pi + byNt * larger, byNt * smaller);
      column(n + i, byPi * pairs, K * Nt + byPi * larger, byPi * smaller);
      column(n + t, byPt * pairs, byPt * larger, K * Ni + byPt * smaller);
    }
  }
}

}  // namespace lampblack::particles
