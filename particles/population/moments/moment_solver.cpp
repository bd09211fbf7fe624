#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/reactor/stiff_integrator.hpp"
#include "core/errors.hpp"
#include "particles/population/gelation_error.hpp"
#include "particles/population/moments/moment_options.hpp"
#include "particles/population/moments/moment_system.hpp"

namespace lampblack::particles {
namespace {

class MomentSolver final : public PopulationSolver {
 public:
  MomentSolver(std::unique_ptr<MomentSystem> system, const InitialPopulation& initial, double tolerance)
      : system_(std::move(system)),
        integrator_(*system_, {tolerance, 1e-6 * tolerance, 0, 1000000}),
        y_(system_->start(initial)) {
    const auto& kernel = system_->model().coagulation;
    gels_ = kernel && CollisionKernel(*kernel).gels();
    startWidth_ = width();
  }

  void advance(double end) override {
    while (time_ < end) {
      const double stop = segmentEnd(end);
      begin(stop);
      while (time_ < stop) {
        runCallback();
        step(stop);
      }
    }
  }
  double time() const override { return time_; }

  std::array<double, 4> moments() const override {
    std::array<double, 4> result{};
    for (std::size_t k = 0; k < 4; ++k) result[k] = y_[k] * std::pow(system_->unit(), static_cast<double>(k));
    return result;
  }
  std::vector<double> numberInBins(std::span<const double> /*edges*/) const override { return {}; }
  double geometricDeviation() const override { return system_->geometricDeviation(y_.data()); }
  std::size_t particles() const override { return y_.size(); }
  std::size_t bytes() const override { return sizeof(double) * y_.size() * (2 * y_.size() + 20); }
  const PopulationCounters& counters() const override { return counters_; }

 private:
  // M0 M2 / M1^2.
  double width() const { return y_[1] > 0 ? y_[0] / y_[1] * (y_[2] / y_[1]) : 1.0; }

  // Where the nucleation rate has a kink or a jump the integration stops.
  double segmentEnd(double end) const {
    const auto& nucleation = system_->model().nucleation;
    if (!nucleation || nucleation->source != NucleationOptions::Source::table) return end;
    const auto next = std::upper_bound(nucleation->times.begin(), nucleation->times.end(), time_);
    return next == nucleation->times.end() ? end : std::min(end, *next);
  }

  void begin(double stop) {
    double expected = 0;
    if (const auto* schedule = system_->schedule()) {
      const auto& nucleation = *system_->model().nucleation;
      const bool table = nucleation.source == NucleationOptions::Source::table;
      const bool on = !table || (time_ >= nucleation.times.front() && time_ < nucleation.times.back());
      expected = on ? schedule->cumulative(stop) - schedule->cumulative(time_) : 0.0;
      system_->setNucleation(expected > 0, expected);
      if (table) smooth_ = false;
    }
    if (!(y_[0] > 0) && !(expected > 0)) {
      time_ = stop;  // nothing is there and nothing comes
      smooth_ = false;
      return;
    }
    if (smooth_) {
      integrator_.extend(stop);
    } else {
      integrator_.start(time_, y_, stop);
    }
    smooth_ = true;
  }

  void step(double stop) {
    try {
      integrator_.step();
    } catch (const GelationError&) {
      throw;
    } catch (const NumericsError& error) {
      smooth_ = false;
      throw NumericsError(
          fmt::format("the moments are no longer those of any population of particles: {}", error.what()));
    }
    ++counters_.splitSteps;
    time_ = integrator_.time();
    std::copy(integrator_.state().begin(), integrator_.state().end(), y_.begin());
    // At gelation M2 goes to infinity.
    if (gels_ && width() > 1e7 * startWidth_) throw GelationError(time_);
    if (system_->hasVanishing(y_.data())) {
      remove(stop);
    } else if (system_->limited(y_.data())) {
      ++counters_.limited;
      simplify(stop);
    }
  }

  // Moments beyond those that the fewer nodes were made from obey no feedback: where all particles shrink, say, their
  // errors grow relative to them. They are put back when they are off by more than the root of the tolerance.
  void simplify(double stop) {
    const auto simple = system_->simplified(y_.data());
    double drift = 0;
    for (std::size_t k = 0; k < y_.size(); ++k) drift = std::max(drift, std::abs(simple[k] - y_[k]) / simple[k]);
    if (!(drift > std::sqrt(integrator_.options().relativeTolerance))) return;
    y_ = simple;
    smooth_ = false;
    if (time_ < stop) begin(stop);
  }

  // Takes out what has reached the smallest volume within the last step, at the time it did.
  void remove(double stop) {
    double low = integrator_.previousTime(), high = time_;
    std::vector<double> between(y_.size());
    integrator_.interpolate(low, between);
    if (system_->hasVanishing(between.data())) high = low;
    for (int halving = 0; halving < 50 && high - low > 1e-14 * high; ++halving) {
      const double middle = 0.5 * (low + high);
      integrator_.interpolate(middle, between);
      (system_->hasVanishing(between.data()) ? high : low) = middle;
    }
    integrator_.interpolate(high, between);
    time_ = high;
    y_ = system_->withoutVanishing(time_, between.data());
    ++counters_.vanished;
    smooth_ = false;
    if (time_ < stop) begin(stop);
  }

  std::unique_ptr<MomentSystem> system_;
  StiffIntegrator integrator_;
  std::vector<double> y_;
  PopulationCounters counters_;
  double time_ = 0, startWidth_ = 1;
  bool smooth_ = false, gels_ = false;
};

}  // namespace

std::unique_ptr<PopulationSolver> makeMoments(const PopulationModel& model, const InitialPopulation& initial,
                                              const MomentOptions& options) {
  check(model, initial);
  if (!(options.relativeTolerance > 0)) throw InputError("moments: the tolerance needs to be above zero");
  if (options.method == MomentMethod::qmom) {
    if (options.moments != 4 && options.moments != 6 && options.moments != 8) {
      throw InputError(fmt::format("moments: QMOM takes 4, 6 or 8 moments (2 to 4 nodes), not {}", options.moments));
    }
    return std::make_unique<MomentSolver>(makeQmomSystem(model, initial, options), initial, options.relativeTolerance);
  }
  if (options.moments < 4 || options.moments > MomentSystem::most) {
    throw InputError(fmt::format("moments: MOMIC takes 4 to 8 moments, not {}", options.moments));
  }
  return std::make_unique<MomentSolver>(makeMomicSystem(model, initial, options), initial, options.relativeTolerance);
}

}  // namespace lampblack::particles
