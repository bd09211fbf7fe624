#include "particles/population/sectional/sectional_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "chemistry/reactor/stiff_integrator.hpp"
#include "core/errors.hpp"
#include "particles/population/gelation_error.hpp"
#include "particles/population/sectional/initial_sections.hpp"
#include "particles/population/sectional/section_system.hpp"

namespace lampblack::particles {

struct SectionalSolver::Impl {
  Impl(const PopulationModel& modelIn, const InitialPopulation& initial, const SectionalOptions& optionsIn)
      : model(modelIn),
        options(optionsIn),
        grid(options),
        system(grid, model, options),
        integrator(system, {options.relativeTolerance, options.absoluteTolerance, 0, 1000000}),
        y(initialSections(grid, initial, options.overflow)) {}

  [[nodiscard]] double segmentEnd(double end) const;
  void begin(double end);
  void step();
  [[nodiscard]] double overflowOf(const double* state) const;
  [[noreturn]] void overflown();

  PopulationModel model;
  SectionalOptions options;
  SectionGrid grid;
  SectionSystem system;
  StiffIntegrator integrator;
  std::vector<double> y;
  PopulationCounters counters;
  double time = 0;
  bool smooth = false;  // the integrator may go on from here with its history
};

// Where the nucleation rate has a kink or a jump the integration stops.
double SectionalSolver::Impl::segmentEnd(double end) const {
  if (!model.nucleation || model.nucleation->source != NucleationOptions::Source::table) return end;
  const auto& times = model.nucleation->times;
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  return next == times.end() ? end : std::min(end, *next);
}

void SectionalSolver::Impl::begin(double end) {
  if (const auto* schedule = system.schedule()) {
    const bool table = model.nucleation->source == NucleationOptions::Source::table;
    const bool on = !table || (time >= model.nucleation->times.front() && time < model.nucleation->times.back());
    const bool jump = table && (time == model.nucleation->times.front() || time == model.nucleation->times.back());
    system.setNucleation(on, schedule->cumulative(end) - schedule->cumulative(time));
    if (jump) smooth = false;
  }
  if (smooth)
    integrator.extend(end);
  else
    integrator.start(time, y, end);
  smooth = true;
}

double SectionalSolver::Impl::overflowOf(const double* state) const {
  const double over = state[grid.layout().overVolume()] * grid.volume(grid.last());
  return over > 0 ? over / (over + system.moment(state, 1)) : 0;
}

// Where within the last step the limit was passed.
void SectionalSolver::Impl::overflown() {
  double low = integrator.previousTime(), high = integrator.time();
  std::vector<double> between(y.size());
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (low + high);
    integrator.interpolate(middle, between);
    (overflowOf(between.data()) > options.overflow ? high : low) = middle;
  }
  smooth = false;
  if (model.coagulation && CollisionKernel(*model.coagulation).gels()) throw GelationError(high);
  throw NumericsError(
      fmt::format("the sectional grid ends too early: at t = {:.6g} s a part {:.2g} of the volume has grown beyond its "
                  "last pivot of {:.4g} m3; set a larger volume of the last pivot, a larger spacing or more sections",
                  high, options.overflow, grid.volume(grid.last())));
}

void SectionalSolver::Impl::step() {
  integrator.step();
  ++counters.splitSteps;
  time = integrator.time();
  std::copy(integrator.state().begin(), integrator.state().end(), y.begin());
  if (overflowOf(y.data()) > options.overflow) overflown();
}

SectionalSolver::SectionalSolver(const PopulationModel& model, const InitialPopulation& initial,
                                 const SectionalOptions& options) {
  if (!(options.relativeTolerance > 0) || !(options.absoluteTolerance > 0)) {
    throw InputError("sections: the tolerances need to be above zero");
  }
  if (!(options.overflow > 0)) throw InputError("sections: the limit of what passes the last pivot is above zero");
  check(model, initial);
  impl_ = std::make_unique<Impl>(model, initial, options);
}
SectionalSolver::~SectionalSolver() = default;

void SectionalSolver::advance(double end) {
  auto& self = *impl_;
  while (self.time < end) {
    const double stop = self.segmentEnd(end);
    self.begin(stop);
    while (self.time < stop) {
      runCallback();
      self.step();
    }
  }
}

double SectionalSolver::time() const {
  return impl_->time;
}

std::array<double, 4> SectionalSolver::moments() const {
  std::array<double, 4> result{};
  for (int k = 0; k < 4; ++k) result[static_cast<std::size_t>(k)] = impl_->system.moment(impl_->y.data(), k);
  return result;
}

std::vector<double> SectionalSolver::numberInBins(std::span<const double> edges) const {
  const SectionGrid& grid = impl_->grid;
  const auto& y = impl_->y;
  // Number below a volume, at the boundaries of the sections.
  std::vector<double> below(grid.last() + 1, y[0]);
  for (std::size_t k = 1; k <= grid.last(); ++k) below[k] = below[k - 1] + y[k];
  const auto cumulative = [&](double volume) {
    if (volume <= 0) return 0.0;
    if (volume < grid.lowerBoundary(1)) return below[0];
    if (volume >= grid.lowerBoundary(grid.last() + 1)) return below.back();
    // The section is that of the pivot below or above.
    std::size_t k = std::clamp<std::size_t>(grid.pivotsAround(volume).lower, 1, grid.last());
    if (k < grid.last() && volume >= grid.lowerBoundary(k + 1)) ++k;
    const double from = grid.lowerBoundary(k), to = grid.lowerBoundary(k + 1);
    return below[k - 1] + (volume - from) / (to - from) * y[k];
  };
  std::vector<double> bins(edges.empty() ? 0 : edges.size() - 1);
  for (std::size_t b = 0; b < bins.size(); ++b) bins[b] = cumulative(edges[b + 1]) - cumulative(edges[b]);
  return bins;
}

double SectionalSolver::geometricDeviation() const {
  const auto& y = impl_->y;
  const SectionGrid& grid = impl_->grid;
  double number = 0, mean = 0, square = 0;
  for (std::size_t k = 1; k <= grid.last(); ++k) {
    number += y[k];
    mean += y[k] * static_cast<double>(k);
  }
  if (!(number > 0)) return 1;
  mean /= number;
  for (std::size_t k = 1; k <= grid.last(); ++k) square += y[k] * std::pow(static_cast<double>(k) - mean, 2);
  // Pivots are ln(spacing) apart in ln v, a third of that in ln d.
  return std::exp(std::log(grid.spacing()) / 3 * std::sqrt(std::max(square / number, 0.0)));
}

std::size_t SectionalSolver::particles() const {
  return impl_->grid.last();
}
std::size_t SectionalSolver::bytes() const {
  const std::size_t n = impl_->grid.layout().size();
  // Jacobian and its factors, vectors of the integrator.
  return impl_->system.bytes() + sizeof(double) * n * (2 * n + 20);
}
const PopulationCounters& SectionalSolver::counters() const {
  return impl_->counters;
}
std::span<const double> SectionalSolver::volumes() const {
  return impl_->grid.volumes();
}
std::span<const double> SectionalSolver::numbers() const {
  return std::span(impl_->y).first(impl_->grid.layout().sections);
}

SectionalSolver::Left SectionalSolver::left() const {
  const auto& y = impl_->y;
  const SectionLayout layout = impl_->grid.layout();
  return {y[layout.overNumber()], y[layout.overVolume()] * impl_->grid.volume(impl_->grid.last()), y[layout.vanished()],
          y[layout.vanished()] * impl_->system.vanishingVolume()};
}

std::unique_ptr<PopulationSolver> makeSectional(const PopulationModel& model, const InitialPopulation& initial,
                                                const SectionalOptions& options) {
  return std::make_unique<SectionalSolver>(model, initial, options);
}

}  // namespace lampblack::particles
