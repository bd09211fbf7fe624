#include "coupling/gas_along.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/reactor/closed_reactor.hpp"
#include "core/constants.hpp"

namespace lampblack::coupling {
namespace {

// Of the larger end of an interval: below this part a concentration falls at a rate that stays finite at its zero.
constexpr double smallestShare = 1e-6;

}  // namespace

GasAlong::GasAlong(const Mechanism& mechanism, const GasHistory& history, const std::vector<std::size_t>& depleted,
                   CarriedPhase* carried)
    : mechanism_(mechanism),
      history_(history),
      held_(mechanism.numSpecies(), true),
      system_(mechanism, carried),
      y_(system_.size()),
      slope_(mechanism.numSpecies()),
      source_(mechanism.numSpecies()),
      loss_(mechanism.numSpecies()) {
  requireHistory(mechanism, history);
  for (const std::size_t k : depleted) held_[k] = false;
  const std::size_t n = mechanism.numSpecies();
  const auto W = mechanism.molecularWeights();
  for (std::size_t i = 0; i < history.time.size(); ++i) {
    const std::vector<double> c = concentrationsOf(history, i, n);
    for (std::size_t k = 0; k < n; ++k) partial_.push_back(c[k] * W[k]);
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += partial_[i * n + k];
    density_.push_back(sum);
  }
}

GasAlong::Place GasAlong::placeOf(double t) const {
  const std::vector<double>& time = history_.time;
  if (time.size() == 1 || t <= time.front()) return {};
  const auto next = std::upper_bound(time.begin(), time.end() - 1, t);
  const auto row = static_cast<std::size_t>(next - time.begin()) - 1;
  return {row, std::min((t - time[row]) / (time[row + 1] - time[row]), 1.0)};
}

double GasAlong::mixed(const std::vector<double>& values, const Place& place) const {
  if (place.share == 0) return values[place.row];
  return (1 - place.share) * values[place.row] + place.share * values[place.row + 1];
}

double GasAlong::fraction(const Place& place, std::size_t k) const {
  const std::size_t n = mechanism_.numSpecies(), at = place.row * n + k;
  const double own =
      place.share == 0 ? partial_[at] : (1 - place.share) * partial_[at] + place.share * partial_[at + n];
  return own / mixed(density_, place);
}

std::vector<double> GasAlong::initialState() const {
  std::vector<double> y(size(), 0.0);
  const Place first{};
  for (std::size_t k = 0; k < mechanism_.numSpecies(); ++k) y[k] = fraction(first, k);
  y[mechanism_.numSpecies()] = history_.temperature.front();
  return y;
}

double GasAlong::pressure(double t) const {
  return mixed(history_.pressure, placeOf(t));
}

double GasAlong::density(double t, const double* y) const {
  const std::size_t n = mechanism_.numSpecies();
  const auto W = mechanism_.molecularWeights();
  double moles = 0;
  for (std::size_t k = 0; k < n; ++k) moles += y[k] / W[k];
  return pressure(t) / (constants::gasConstant * y[n] * moles);
}

double GasAlong::nextRow(double t) const {
  const auto next = std::upper_bound(history_.time.begin(), history_.time.end(), t);
  return next == history_.time.end() ? INFINITY : *next;
}

void GasAlong::prescribe(double t, double* y) const {
  const Place place = placeOf(t);
  for (std::size_t k = 0; k < held_.size(); ++k)
    if (held_[k]) y[k] = fraction(place, k);
  y[held_.size()] = mixed(history_.temperature, place);
}

// The slopes of the line on which t is, and what they are of the species that are not held.
void GasAlong::setConditions(const Place& place, double t) {
  const std::size_t n = mechanism_.numSpecies(), row = place.row;
  ReactorSystem::Conditions conditions;
  conditions.value = pressure(t);
  conditions.energy = ReactorSystem::Energy::GivenTemperature;
  conditions.reacts = false;
  std::fill(slope_.begin(), slope_.end(), 0.0);
  std::fill(loss_.begin(), loss_.end(), 0.0);
  if (row + 1 < history_.time.size()) {
    const double length = history_.time[row + 1] - history_.time[row];
    const double density = mixed(density_, place), densitySlope = (density_[row + 1] - density_[row]) / length;
    conditions.temperatureRate = (history_.temperature[row + 1] - history_.temperature[row]) / length;
    if (!history_.numberLossRate.empty()) conditions.carriedRemoval = history_.numberLossRate[row];
    for (std::size_t k = 0; k < n; ++k) {
      const double first = partial_[row * n + k], last = partial_[(row + 1) * n + k];
      const double Y = fraction(place, k);
      slope_[k] = ((last - first) / length - Y * densitySlope) / density;
      if (!held_[k] && slope_[k] < 0)
        loss_[k] = -slope_[k] / std::max(Y, smallestShare * std::max(first / density_[row], last / density_[row + 1]));
    }
  }
  for (std::size_t k = 0; k < n; ++k) source_[k] = loss_[k] > 0 ? 0.0 : slope_[k];
  conditions.source = source_;
  conditions.loss = loss_;
  system_.setConditions(conditions);
}

const double* GasAlong::withGivenGas(double t, const double* y) {
  std::copy_n(y, y_.size(), y_.begin());
  prescribe(t, y_.data());
  setConditions(placeOf(t), t);
  return y_.data();
}

bool GasAlong::rates(double t, const double* y, double* f) {
  if (!system_.rates(withGivenGas(t, y), f)) return false;
  for (std::size_t k = 0; k < held_.size(); ++k)
    if (held_[k]) f[k] = slope_[k];
  return true;
}

bool GasAlong::jacobian(double t, const double* y, double* f, double* J, std::size_t ld) {
  if (!system_.jacobian(withGivenGas(t, y), f, J, ld)) return false;
  const std::size_t n = held_.size();
  const auto isGiven = [&](std::size_t i) { return i == n || (i < n && held_[i]); };
  for (std::size_t j = 0; j < size(); ++j)
    for (std::size_t i = 0; i < size(); ++i)
      if (isGiven(i) || isGiven(j)) J[i + ld * j] = 0;
  for (std::size_t k = 0; k < n; ++k)
    if (held_[k]) f[k] = slope_[k];
  return true;
}

double GasAlong::toleranceScale(std::size_t i) const {
  if (i < held_.size() && held_[i]) return carriedScale;
  return reactorToleranceScale(i, held_.size(), true);
}

std::string GasAlong::describe(double t, const double* y) const {
  return fmt::format("t = {:.6g} s, T = {:.6g} K, p = {:.6g} Pa, mass fractions {{{}}}", t, y[held_.size()],
                     pressure(t), compositionText(mechanism_, {y, held_.size()}));
}

}  // namespace lampblack::coupling
