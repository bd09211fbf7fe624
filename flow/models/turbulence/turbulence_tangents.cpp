// Turbulence and the derivatives of its rates, which implicit steps need: by the variables, and by their gradients.
#include <algorithm>
#include <cmath>

#include "flow/models/turbulence/turbulence_operator.hpp"

namespace lampblack::flow {

// Sinks become what a rate falls by as its own variable rises, where that is more; the rates stay what they are. The
// wall function of SA goes with the sixth power of the variable: with a sink of that of the square alone long steps
// swing. Slopes are the derivatives: of two variables that make and destroy each other's all four as they are, of one
// by itself the sink, without what it makes of itself.
void TurbulenceOperator::linearise() {
  constexpr double small = 1e-6;
  std::ranges::copy(cells_, beside_.begin());
  std::ranges::fill(slopes_, Slope{});
  const auto net = [](const TurbulentRates& of, const TurbulentCell& cell, std::size_t v) {
    return of.source[v] - of.sink[v] * cell.values[v];
  };
  for (std::size_t v = 0; v < count_; ++v) {
    for (std::size_t c = 0; c < cells_.size(); ++c) slopes_[c][v][v] = -rates_[c].sink[v];
    for (std::size_t c = 0; c < cells_.size(); ++c) beside_[c].values[v] += small * std::abs(cells_[c].values[v]);
    model_->evaluate(beside_, ratesBeside_);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const double rise = beside_[c].values[v] - cells_[c].values[v];
      beside_[c].values[v] = cells_[c].values[v];
      if (!(cells_[c].values[v] > 0.0)) continue;
      TurbulentCell moved = cells_[c];
      moved.values[v] += rise;
      for (std::size_t w = 0; w < count_; ++w)
        slopes_[c][w][v] = (net(ratesBeside_[c], moved, w) - net(rates_[c], cells_[c], w)) / rise;
      const double more = -slopes_[c][v][v] - rates_[c].sink[v];
      if (more > 0.0) {
        rates_[c].sink[v] += more;
        rates_[c].source[v] += more * cells_[c].values[v];
      }
      if (count_ == 1) slopes_[c][v][v] = -rates_[c].sink[v];
    }
  }
}

void TurbulenceOperator::addSlopes(const State& state, const Slopes& slopes) {
  if (slopes.carried.empty()) return;
  const std::size_t n = state.scalars.size();
  for (std::size_t c = 0; c < rates_.size(); ++c)
    for (std::size_t v = first_; v < first_ + count_; ++v)
      for (std::size_t w = first_; w < first_ + count_; ++w)
        slopes.carried[(c * n + v) * n + w] += slopes_[c][w - first_][v - first_];
}

// Of the state that was evaluated last. A rate that changes with the gradient of its variable moves the variable with
// the velocity -d rate/d gradient: -3 D |grad g|^2/g of omega's equation and the cross diffusion do so faster than the
// gas flows, and faster than they spread. Explicit in a long step that would swing.
void TurbulenceOperator::addCarriedFlow(std::span<double> flow) {
  constexpr double small = 1e-4;
  const Mesh& m = context_.mesh;
  const auto d = static_cast<std::size_t>(m.dimension);
  const std::size_t width = count_ * d, n = flow.size() / static_cast<std::size_t>(m.faces);
  drift_.assign(static_cast<std::size_t>(m.cells) * width, 0.0);
  std::ranges::copy(cells_, beside_.begin());
  for (std::size_t v = 0; v < count_; ++v)
    for (std::size_t i = 0; i < d; ++i) {
      const auto riseOf = [&](std::size_t c) { return small * length(cells_[c].gradients[v]); };
      for (std::size_t c = 0; c < cells_.size(); ++c) beside_[c].gradients[v][i] += riseOf(c);
      model_->evaluate(beside_, ratesBeside_);
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        beside_[c].gradients[v][i] = cells_[c].gradients[v][i];
        const bool isOfWallLaw = !layerArea_.empty() && layerArea_[c] > 0.0;
        if (!(riseOf(c) > 0.0) || isOfWallLaw) continue;
        const auto net = [&](const TurbulentRates& of) { return of.source[v] - of.sink[v] * cells_[c].values[v]; };
        drift_[c * width + v * d + i] = -density_[c] * (net(ratesBeside_[c]) - net(rates_[c])) / riseOf(c);
      }
    }
  context_.halo.update(drift_, static_cast<int>(width));
  for (int face = 0; face < m.faces; ++face) {
    const bool isInside = m.high[face] >= 0;
    if (!isInside && known_[static_cast<std::size_t>(face - m.interiorFaces)] != BoundaryData::Value) continue;
    const auto low = static_cast<std::size_t>(m.low[face]);
    const std::size_t high = isInside ? static_cast<std::size_t>(m.high[face]) : low;
    const double w = isInside ? m.lowWeight[face] : 1.0;
    for (std::size_t v = 0; v < count_; ++v) {
      double across = 0.0;
      for (std::size_t i = 0; i < d; ++i)
        across +=
            m.normal[face][i] * (w * drift_[low * width + v * d + i] + (1.0 - w) * drift_[high * width + v * d + i]);
      flow[static_cast<std::size_t>(face) * n + first_ + v] += across * m.area[face];
    }
  }
}

}  // namespace lampblack::flow
