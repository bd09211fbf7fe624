#include "particles/population/moments/moment_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"

namespace lampblack::particles {

double binomial(std::size_t n, std::size_t k) {
  double result = 1;
  for (std::size_t i = 0; i < k; ++i) result = result * static_cast<double>(n - i) / static_cast<double>(i + 1);
  return result;
}

MomentSystem::MomentSystem(const PopulationModel& model, const InitialPopulation& initial, std::size_t count)
    : model_(model), count_(count) {
  const bool any = initial.distribution != InitialPopulation::Distribution::none && initial.number > 0;
  unit_ = any ? initial.volume : model.nucleation ? model.nucleation->volume : 1.0;
  // The surface of a sphere is pi^(1/3) (6 v)^(2/3).
  surfaceFactor_ = model.growth.surface() * std::cbrt(36 * constants::pi / unit_);
  if (model.nucleation) schedule_.emplace(*model.nucleation);
}

std::vector<double> MomentSystem::start(const InitialPopulation& initial) const {
  std::vector<double> y(count_);
  for (std::size_t k = 0; k < count_; ++k) {
    y[k] = initialMoment(initial, static_cast<double>(k)) / std::pow(unit_, static_cast<double>(k));
  }
  return y;
}

void MomentSystem::setNucleation(bool on, double expected) {
  nucleating_ = on;
  expected_ = expected;
}

double MomentSystem::lossRate(double volume) const {
  if (!model_.deposition) return 0;
  const auto& d = *model_.deposition;
  return d.rate * (d.exponent != 0 ? std::pow(volume * unit_, d.exponent) : 1.0);
}

double MomentSystem::share(std::size_t k) const {
  if (k == 1) return 1;
  const double order = static_cast<double>(k);
  if (model_.breakage->daughters == BreakageOptions::Daughters::uniform) return 2 / (order + 1);
  return std::pow(static_cast<double>(model_.breakage->fragments), 1 - order);
}

double MomentSystem::vanishingVolume(double mean) const {
  const auto& growth = model_.growth;
  const bool shrinking = growth.condensation < 0 || growth.surface() < 0;
  if (!shrinking) return 0;
  // With a given speed of the surface every particle is gone after a finite time: below a millionth of the mean volume
  // it is as good as that.
  return std::max(growth.smallestVolume / unit_, growth.surface() < 0 ? 1e-6 * mean : 0.0);
}

bool MomentSystem::rates(double t, const double* y, double* f) {
  std::fill_n(f, count_, 0.0);
  for (std::size_t k = 0; k < count_; ++k) {
    if (!std::isfinite(y[k])) return false;
  }
  if (nucleating_) {
    const double rate = schedule_->rate(t), nucleus = model_.nucleation->volume / unit_;
    double power = rate;
    for (std::size_t k = 0; k < count_; ++k, power *= nucleus) f[k] += power;
  }
  if (!(y[0] > 0)) return true;  // nothing there yet
  for (std::size_t k = 0; k < count_; ++k) {
    if (!(y[k] > 0)) return false;
    f[k] += (static_cast<double>(k) * model_.growth.condensation - model_.dilution) * y[k];
  }
  return addClosed(y, f);
}

bool MomentSystem::jacobian(double t, const double* y, double* f, double* J, std::size_t ld) {
  if (!rates(t, y, f)) return false;
  std::array<double, most> moved{}, there{}, scale{};
  std::copy_n(y, count_, moved.begin());
  toleranceScales(y, scale.data());
  for (std::size_t k = 0; k < count_; ++k) {
    if (y[k] > 0) scale[k] = y[k];
  }
  for (std::size_t j = 0; j < count_; ++j) {
    const double h = std::sqrt(std::numeric_limits<double>::epsilon()) * scale[j];
    moved[j] = y[j] + h;
    const bool possible = rates(t, moved.data(), there.data());
    for (std::size_t i = 0; i < count_; ++i) J[i + ld * j] = possible ? (there[i] - f[i]) / (moved[j] - y[j]) : 0.0;
    moved[j] = y[j];
  }
  return true;
}

void MomentSystem::toleranceScales(const double* y, double* scales) const {
  const double nucleus = model_.nucleation ? model_.nucleation->volume / unit_ : 1.0;
  double nuclei = nucleating_ ? expected_ : 0.0;
  for (std::size_t k = 0; k < count_; ++k, nuclei *= nucleus) {
    scales[k] = std::max({std::abs(y[k]), nuclei, std::numeric_limits<double>::min()});
  }
}

std::string MomentSystem::describe(double t, const double* y) const {
  std::string text = fmt::format("t = {:.9g} s, moments (m^(3k-3))", t);
  for (std::size_t k = 0; k < count_; ++k) {
    text += fmt::format(" {:.9g}", y[k] * std::pow(unit_, static_cast<double>(k)));
  }
  return text;
}

}  // namespace lampblack::particles
