#include "particles/population/sectional/section_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

// Part of the number density; the integrator divides by the square of the scales.
constexpr double leastScale = 1e-100;

}  // namespace

SectionSystem::SectionSystem(const SectionGrid& grid, const PopulationModel& model, const SectionalOptions& options)
    : grid_(grid), layout_(grid.layout()), linear_(grid, model), growth_(grid, model.growth, options.growth) {
  if (model.coagulation) coagulation_.emplace(grid, CollisionKernel(*model.coagulation), model.density);
  if (model.nucleation) {
    schedule_.emplace(*model.nucleation);
    nucleusVolume_ = model.nucleation->volume;
    // A nucleus on the first pivot may miss it by rounding.
    const double first = grid.volume(1);
    if (nucleusVolume_ < first * (1 - 1e-12) || nucleusVolume_ > grid.volume(grid.last())) {
      throw InputError(
          fmt::format("the volume of a nucleus, {:.4g} m3, is outside the sectional grid, {:.4g} to {:.4g} m3",
                      nucleusVolume_, first, grid.volume(grid.last())));
    }
    nuclei_ = grid.pivotsAround(nucleusVolume_);
  }
}

void SectionSystem::setNucleation(bool on, double expected) {
  nucleating_ = on;
  expected_ = expected;
}

bool SectionSystem::rates(double t, const double* y, double* f) {
  std::fill_n(f, size(), 0.0);
  linear_.addRates(y, f);
  growth_.addRates(y, f);
  if (coagulation_) coagulation_->addRates(y, f);
  if (nucleating_) {
    const double rate = schedule_->rate(t);
    f[nuclei_.lower] += (1 - nuclei_.upper) * rate;
    f[nuclei_.lower + 1] += nuclei_.upper * rate;
  }
  double sum = 0;
  for (std::size_t k = 0; k < size(); ++k) sum += f[k];
  return std::isfinite(sum);
}

bool SectionSystem::jacobian(double t, const double* y, double* f, double* J, std::size_t ld) {
  std::fill_n(J, ld * size(), 0.0);
  linear_.addJacobian(J, ld);
  growth_.addJacobian(y, J, ld);
  if (coagulation_) coagulation_->addJacobian(y, J, ld);
  return rates(t, y, f);
}

double SectionSystem::moment(const double* y, int k) const {
  double sum = k == 0 ? y[0] : 0;
  for (std::size_t i = 1; i < layout_.sections; ++i) {
    double term = y[i];
    for (int power = 0; power < k; ++power) term *= grid_.volume(i);
    sum += term;
  }
  return sum;
}

void SectionSystem::toleranceScales(const double* y, double* scales) const {
  // Of M_0 to M_3, with the nuclei that come.
  std::array<double, 4> moments{};
  double nuclei = expected_;
  for (std::size_t j = 0; j < moments.size(); ++j, nuclei *= nucleusVolume_)
    moments[j] = std::abs(moment(y, static_cast<int>(j))) + nuclei;
  if (!(moments[0] > 0)) moments[0] = 1;
  for (std::size_t j = 1; j < moments.size(); ++j)
    if (!(moments[j] > 0)) moments[j] = moments[j - 1] * grid_.volume(1);
  const double number = moments[0], least = number * leastScale;
  scales[0] = number;
  for (std::size_t k = 1; k < layout_.sections; ++k) {
    double scale = number, power = 1;
    for (std::size_t j = 1; j < moments.size(); ++j) {
      power *= grid_.volume(k);
      scale = std::min(scale, moments[j] / power);
    }
    scales[k] = std::max(scale, least);
  }
  scales[layout_.overNumber()] = scales[layout_.overVolume()] = scales[grid_.last()];
  scales[layout_.vanished()] = number + std::abs(y[layout_.vanished()]);
}

std::string SectionSystem::describe(double t, const double* y) const {
  return fmt::format("t = {:.6g} s, {:.4g} particles/m3 of {:.4g} m3/m3 in {} sections", t, moment(y, 0), moment(y, 1),
                     grid_.last());
}

std::size_t SectionSystem::bytes() const {
  return linear_.bytes() + (coagulation_ ? coagulation_->bytes() : 0);
}

}  // namespace lampblack::particles
