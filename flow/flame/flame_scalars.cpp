#include "flow/flame/flame_scalars.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "flow/flame/flame_equations_data.hpp"

namespace lampblack::flow {

FlameScalars::FlameScalars(FlameEquations& equations, const FlameProfile& flame)
    : flame_(equations.data()),
      scalars_(flame.layout.scalars),
      matrix_(flame_.comm, flame.points(), scalars_, 0, 0),
      densities_(scalars_) {
  const std::size_t rows = scalars_ + flame_.carried->exchanged().size();
  jacobian_.resize(rows * (rows + 1));
  flame_.setUnknowns(flame.x);
  // Every rank evaluates all points: fast beside the gas.
  collectively(flame_.comm, [&] {
    flame_.chooseBlend();
    flame_.evaluate(0, flame_.points());
  });
  // The gas does not feel what the scalars take from it.
  std::fill(flame_.gas.nodes.exchanged.begin(), flame_.gas.nodes.exchanged.end(), 0.0);
}

std::size_t FlameScalars::size() const {
  return flame_.points() * scalars_;
}

std::vector<double> FlameScalars::start() const {
  std::vector<double> x;
  for (std::size_t i = 0; i < flame_.points(); ++i) {
    const auto scalars = flame_.profile.scalars(i);
    x.insert(x.end(), scalars.begin(), scalars.end());
  }
  return x;
}

void FlameScalars::put(std::span<const double> x, FlameProfile& flame) const {
  for (std::size_t i = 0; i < flame.points(); ++i)
    for (std::size_t s = 0; s < scalars_; ++s) flame.at(i, flame.layout.firstScalar() + s) = x[i * scalars_ + s];
}

void FlameScalars::evaluate(std::span<const double> x) {
  put(x, flame_.profile);
  if (!valuesAreChosen_) flame_.gas.chooseScalarValues(flame_.profile);
  valuesAreChosen_ = true;
  for (std::size_t f = 0; f + 1 < flame_.points(); ++f) flame_.gas.scalarFluxes(flame_.profile, f);
}

void FlameScalars::residual(std::span<const double> x, std::span<double> F) {
  flame_.endIfAsked();
  collectively(flame_.comm, [&] {
    evaluate(x);
    for (std::size_t i = 0; i < flame_.points(); ++i) {
      flame_.gas.scalarSources(flame_.profile, i);
      for (std::size_t s = 0; s < scalars_; ++s) F[i * scalars_ + s] = flame_.scalarResidual(i, s);
    }
  });
}

void FlameScalars::timeWeights(std::span<const double> /*x*/, std::span<double> M) {
  for (std::size_t i = 0; i < flame_.points(); ++i)
    for (std::size_t s = 0; s < scalars_; ++s) M[i * scalars_ + s] = flame_.gas.nodes.density[i] * flame_.volume[i];
}

void FlameScalars::fillRow(std::size_t i, double inverseTimeStep) {
  const std::size_t S = scalars_, last = flame_.points() - 1;
  const double dv = flame_.volume[i], rho = flame_.gas.nodes.density[i];
  const ParticleGas gas = flame_.gas.carriedGas(flame_.profile, i, concentrations_);
  flame_.gas.densities(flame_.profile, i, densities_);
  const std::size_t columns = S + flame_.carried->exchanged().size() + 1;
  flame_.carried->jacobian(gas, densities_, {jacobian_, columns});
  const auto& scale = flame_.gas.scalarScale;
  double* D = matrix_.diagonal(i);
  for (std::size_t c = 0; c < S; ++c)
    for (std::size_t r = 0; r < S; ++r) D[c * S + r] -= dv * jacobian_[r * columns + c] * scale[c] * rho / scale[r];
  const double net = flame_.profile.at(i, FlameLayout::massFlux) - flame_.leftFlux(i);
  for (std::size_t s = 0; s < S; ++s) {
    double& own = D[s * (S + 1)];
    own += dv * rho * inverseTimeStep - net;
    if (i > 0) {
      const auto [left, right] = flame_.scalarSlopes(i - 1, s);
      own -= right;
      matrix_.lower(i).diagonal()[s] -= left;
    } else {
      own -= flame_.endDrift(s, false);
    }
    if (i < last) {
      const auto [left, right] = flame_.scalarSlopes(i, s);
      own += left;
      matrix_.upper(i).diagonal()[s] += right;
    } else {
      own += flame_.endDrift(s, true);
    }
  }
}

bool FlameScalars::factorise(std::span<const double> x, double inverseTimeStep) {
  matrix_.clear();
  collectively(flame_.comm, [&] {
    evaluate(x);
    for (std::size_t i = matrix_.ownedBegin(); i < matrix_.ownedEnd(); ++i) fillRow(i, inverseTimeStep);
  });
  return matrix_.factorise();
}

void FlameScalars::bounds(std::span<double> lower, std::span<double> upper) const {
  std::fill(lower.begin(), lower.end(), -std::numeric_limits<double>::infinity());
  std::fill(upper.begin(), upper.end(), std::numeric_limits<double>::infinity());
}

void FlameScalars::correct(std::span<const double> x, std::span<double> trial) const {
  for (std::size_t u = 0; u < trial.size(); ++u) trial[u] = FlameEquations::positivePart(x[u], trial[u]);
}

void FlameScalars::scales(std::span<const double> x, std::span<double> scale) const {
  const auto n = static_cast<double>(flame_.points());
  for (std::size_t s = 0; s < scalars_; ++s) {
    double mean = 0;
    for (std::size_t u = s; u < x.size(); u += scalars_) mean += std::abs(x[u]) / n;
    for (std::size_t u = s; u < x.size(); u += scalars_)
      scale[u] = flame_.tolerances.relative * mean + flame_.tolerances.scalars;
  }
}

std::string FlameScalars::nameOf(std::size_t unknown) const {
  return flame_.nameOf(unknown / scalars_, flame_.layout.firstScalar() + unknown % scalars_);
}

}  // namespace lampblack::flow
