// Particles that do not meet: growth moves each along dv/dt = s v + g S, deposition and dilution thin them out, nuclei
// join. A sphere's diameter obeys the linear dd/dt = s d/3 + 2 g, so that sizes now and at the start are explicit
// functions of each other: d(t) = d(0) e + G. Deposition that depends on the volume only without growth.
#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"
#include "particles/population/exact_solutions/quadrature.hpp"
#include "particles/population/exact_solutions/solutions.hpp"
#include "particles/population/model/nucleation_schedule.hpp"

namespace lampblack::particles::exact {
namespace {

double diameterOf(double volume) {
  return std::cbrt(6 / constants::pi * volume);
}
double volumeOf(double diameter) {
  return diameter > 0 ? constants::pi / 6 * diameter * diameter * diameter : 0.0;
}

class Transported final : public ExactSolution {
 public:
  Transported(const PopulationModel& model, const InitialPopulation& initial) : model_(model), initial_(initial) {
    if (model.nucleation) schedule_.emplace(*model.nucleation);
  }

  std::array<std::optional<double>, 4> moments(double time) const override {
    std::array<std::optional<double>, 4> result;
    for (std::size_t k = 0; k < 4; ++k) {
      const double order = static_cast<double>(k);
      double sum = 0;
      if (growth() == 0 && lossExponent() == 0) {
        sum = initialMoment(initial_, order) * std::exp((order * model_.growth.condensation - loss(1)) * time);
      }
      const bool closed = sum > 0 && vanishedBelow(time) == 0;
      if (!closed) {
        sum = initialIntegral(initial_, vanishedBelow(time), HUGE_VAL,
                              [&](double v) { return std::exp(-loss(v) * time) * std::pow(grown(v, time), order); });
      }
      result[k] = sum + nuclei(time, 0, HUGE_VAL, order);
    }
    return result;
  }

  std::vector<double> numberInBins(double time, std::span<const double> edges) const override {
    std::vector<double> numbers(edges.empty() ? 0 : edges.size() - 1);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const double lower = std::max({shrunk(edges[k], time), vanishedBelow(time), 0.0});
      const double upper = shrunk(edges[k + 1], time);
      if (lossExponent() == 0) {
        numbers[k] = initialNumber(initial_, lower, upper) * std::exp(-loss(1) * time);
      } else {
        numbers[k] = initialIntegral(initial_, lower, upper, [&](double v) { return std::exp(-loss(v) * time); });
      }
      numbers[k] += nuclei(time, edges[k], edges[k + 1], 0);
    }
    return numbers;
  }

  std::string name() const override {
    std::string text;
    const auto add = [&](bool present, const char* what) {
      if (present) text += (text.empty() ? "" : ", ") + std::string(what);
    };
    add(model_.nucleation.has_value(), "nucleation");
    add(model_.growth.active(), "growth");
    add(model_.deposition.has_value(), "deposition");
    add(model_.dilution != 0, "dilution");
    return text.empty() ? "nothing happens" : text;
  }

 private:
  double growth() const { return model_.growth.surface(); }
  double lossExponent() const { return model_.deposition ? model_.deposition->exponent : 0.0; }
  double loss(double volume) const {
    if (!model_.deposition) return model_.dilution;
    return model_.dilution + model_.deposition->rate * (lossExponent() != 0 ? std::pow(volume, lossExponent()) : 1.0);
  }

  double stretch(double time) const { return std::exp(model_.growth.condensation * time / 3); }
  double shift(double time) const {
    const double s = model_.growth.condensation;
    return 2 * growth() * (s != 0 ? 3 / s * std::expm1(s * time / 3) : time);
  }
  double grown(double volume, double time) const {
    if (growth() == 0) return volume * std::exp(model_.growth.condensation * time);
    return volumeOf(diameterOf(volume) * stretch(time) + shift(time));
  }
  // The volume at the start of what is now `volume`; zero or less becomes zero.
  double shrunk(double volume, double time) const {
    if (!std::isfinite(volume)) return volume;
    if (growth() == 0) return std::max(volume, 0.0) * std::exp(-model_.growth.condensation * time);
    return volumeOf((diameterOf(std::max(volume, 0.0)) - shift(time)) / stretch(time));
  }
  // Particles smaller than this at the start have fallen below the smallest volume.
  double vanishedBelow(double time) const {
    if (model_.growth.condensation >= 0 && growth() >= 0) return 0;
    return shrunk(model_.growth.smallestVolume, time);
  }

  // The age, between zero and `oldest`, at which a nucleus passes a volume.
  double ageAt(double volume, double oldest) const {
    const double start = diameterOf(model_.nucleation->volume), s = model_.growth.condensation;
    const double end = start * stretch(oldest) + shift(oldest), target = diameterOf(volume);
    if (end > start ? target <= start : target >= start) return 0;
    if (end > start ? target >= end : target <= end) return oldest;
    if (s == 0) return (target - start) / (2 * growth());
    return 3 / s * std::log((target + 6 * growth() / s) / (start + 6 * growth() / s));
  }

  // Sum of v^order of the nuclei that are now in [lower, upper).
  double nuclei(double time, double lower, double upper, double order) const {
    if (!schedule_ || !(time > 0)) return 0;
    const double volume = model_.nucleation->volume;
    const double speed = model_.growth.condensation * diameterOf(volume) / 3 + 2 * growth();
    double youngest = 0, oldest = time;
    if (speed == 0) {
      if (!(volume >= lower && volume < upper)) return 0;
    } else if (speed > 0) {
      youngest = ageAt(lower, time);
      oldest = ageAt(upper, time);
    } else {
      youngest = ageAt(upper, time);
      oldest = ageAt(std::max(lower, model_.growth.smallestVolume), time);
    }
    if (!(oldest > youngest)) return 0;
    const auto rate = [&](double age) {
      return schedule_->rate(time - age) * std::exp(-loss(volume) * age) * std::pow(grown(volume, age), order);
    };
    return integral(rate, youngest, oldest, kinks(time, youngest, oldest));
  }

  // Where the rates are not smooth, and panels that get finer to both ends.
  std::vector<double> kinks(double time, double youngest, double oldest) const {
    std::vector<double> result;
    for (double length = 0.5 * (oldest - youngest); length > 1e-6 * (oldest - youngest); length *= 0.5) {
      result.push_back(youngest + length);
      result.push_back(oldest - length);
    }
    for (const double t : model_.nucleation->times) result.push_back(time - t);
    return result;
  }

  PopulationModel model_;
  InitialPopulation initial_;
  std::optional<NucleationSchedule> schedule_;
};

}  // namespace

std::unique_ptr<ExactSolution> transported(const PopulationModel& model, const InitialPopulation& initial) {
  const auto& growth = model.growth;
  if (growth.active() && growth.treatment == GrowthOptions::Treatment::jumps) return nullptr;
  if (model.deposition && model.deposition->exponent != 0 && growth.active()) return nullptr;
  // Growth at one end of the sizes and shrinking at the other: which of them are below the smallest volume is not
  // followed.
  if (growth.condensation * growth.surface() < 0 && growth.smallestVolume > 0) return nullptr;
  return std::make_unique<Transported>(model, initial);
}

}  // namespace lampblack::particles::exact
