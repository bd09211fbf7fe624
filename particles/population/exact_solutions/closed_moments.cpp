// Models whose equations of the moments close. With losses l, condensation dv/dt = s v, nuclei of volume w at the rate
// J(t), breakage into b pieces at a constant rate c, and f_k the sum of the k-th powers of the pieces' shares, b^(1-k)
// of equal ones and 2/(k+1) of two uniform ones:
//
//   dM_k/dt = J w^k + (k s - l) M_k + c (f_k - 1) M_k + coagulation
//
// coagulation with the kernel A: -A M0^2/2, 0, A M1^2, 3 A M1 M2; with A (u+v): -A M0 M1, 0, 2 A M1 M2,
// 3 A (M1 M3 + M2^2). At a breakage rate c v the number alone closes: dM0/dt = c (b - 1) M1. Where growth is by jumps
// of volume m, a jump changes v^k by k m v^(k-1) + ..., at the rate s v / m.
#include <algorithm>
#include <cmath>

#include "particles/population/exact_solutions/extrapolation.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"
#include "particles/population/exact_solutions/solutions.hpp"
#include "particles/population/model/nucleation_schedule.hpp"

namespace lampblack::particles::exact {
namespace {

class ClosedMoments final : public ExactSolution {
 public:
  ClosedMoments(const PopulationModel& model, const InitialPopulation& initial, std::size_t known, bool exponential)
      : model_(model), initial_(initial), known_(known), exponential_(exponential) {
    // In units of the initial number and volume, or those of the nuclei.
    volume_ = initial.number > 0 ? initial.volume : model.nucleation ? model.nucleation->volume : 1.0;
    for (std::size_t k = 0; k < 4; ++k) {
      start_[k] = initialMoment(initial, static_cast<double>(k)) / std::pow(volume_, static_cast<double>(k));
    }
    if (model.nucleation) schedule_.emplace(*model.nucleation);
  }

  std::array<std::optional<double>, 4> moments(double time) const override {
    FourMoments y = start_;
    double begin = 0;
    for (const double end : stops(time)) {
      const double middle = 0.5 * (begin + end);
      y = extrapolated([&](double t, const FourMoments& m) { return rates(t, middle, m); }, begin, end, y);
      begin = end;
    }
    if (exponential_ && y[0] > 0) {
      y[2] = 2 * y[1] * (y[1] / y[0]);
      y[3] = 3 * y[2] * (y[1] / y[0]);
    }
    std::array<std::optional<double>, 4> result;
    for (std::size_t k = 0; k < (exponential_ ? 4 : known_); ++k) {
      result[k] = y[k] * std::pow(volume_, static_cast<double>(k));
    }
    return result;
  }

  std::vector<double> numberInBins(double time, std::span<const double> edges) const override {
    if (!exponential_ || edges.size() < 2) return {};
    const auto now = moments(time);
    InitialPopulation population = initial_;
    population.number = *now[0];
    if (population.number > 0) population.volume = *now[1] / *now[0];
    std::vector<double> numbers(edges.size() - 1);
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = initialNumber(population, edges[k], edges[k + 1]);
    return numbers;
  }

  std::string name() const override {
    std::string text = model_.coagulation ? "coagulation, " : "";
    if (model_.coagulation) {
      text += model_.coagulation->type == CollisionKernelType::constant ? "constant kernel, " : "additive kernel, ";
    }
    if (model_.nucleation) text += "nucleation, ";
    if (model_.breakage) {
      text += std::string(model_.breakage->daughters == BreakageOptions::Daughters::equal ? "equal" : "uniform") +
              (model_.breakage->exponent == 0 ? " breakage at a constant rate, " : " breakage at a linear rate, ");
    }
    if (model_.growth.active()) text += "condensation, ";
    if (loss() != 0) text += "losses, ";
    return text + (exponential_ ? "exponential for all times" : "closed equations of the moments");
  }

 private:
  double loss() const { return model_.dilution + (model_.deposition ? model_.deposition->rate : 0.0); }

  // Ends of the intervals on which the rates are smooth.
  std::vector<double> stops(double time) const {
    std::vector<double> result;
    if (model_.nucleation && model_.nucleation->source == NucleationOptions::Source::table) {
      for (const double t : model_.nucleation->times) {
        if (t > 0 && t < time) result.push_back(t);
      }
    }
    if (time > 0) result.push_back(time);
    return result;
  }

  double nucleation(double time, double middle) const {
    if (!schedule_) return 0;
    const auto& options = *model_.nucleation;
    if (options.source != NucleationOptions::Source::table) return schedule_->rate(time);
    if (middle < options.times.front() || middle > options.times.back()) return 0;
    return schedule_->rate(std::clamp(time, options.times.front(), options.times.back()));
  }

  FourMoments rates(double time, double middle, const FourMoments& m) const {
    FourMoments f{};
    const double source = nucleation(time, middle);
    const double s = model_.growth.condensation;
    for (std::size_t k = 0; k < 4; ++k) {
      const double order = static_cast<double>(k);
      f[k] = (order * s - loss()) * m[k];
      if (model_.nucleation) f[k] += source * std::pow(model_.nucleation->volume / volume_, order);
    }
    if (model_.growth.active() && model_.growth.treatment == GrowthOptions::Treatment::jumps) {
      const double jump = model_.growth.monomer / volume_;
      f[2] += s * jump * m[1];
      f[3] += s * jump * (3 * m[2] + jump * m[1]);
    }
    if (model_.breakage) addBreakage(m, f);
    if (model_.coagulation) {
      const double a = model_.coagulation->rate * model_.coagulation->efficiency;
      if (model_.coagulation->type == CollisionKernelType::constant) {
        f[0] -= 0.5 * a * m[0] * m[0];
        f[2] += a * m[1] * m[1];
        f[3] += 3 * a * m[1] * m[2];
      } else {
        const double b = a * volume_;
        f[0] -= b * m[0] * m[1];
        f[2] += 2 * b * m[1] * m[2];
        f[3] += 3 * b * (m[1] * m[3] + m[2] * m[2]);
      }
    }
    for (std::size_t k = known_; k < 4; ++k) f[k] = 0;
    return f;
  }

  void addBreakage(const FourMoments& m, FourMoments& f) const {
    const double pieces = model_.breakage->fragments;
    const double rate = model_.breakage->rate * std::pow(volume_, model_.breakage->exponent);
    if (model_.breakage->exponent != 0) {
      f[0] += rate * (pieces - 1) * m[1];
      return;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const double order = static_cast<double>(k);
      const double share = model_.breakage->daughters == BreakageOptions::Daughters::equal ? std::pow(pieces, 1 - order)
                                                                                           : 2 / (order + 1);
      f[k] += rate * (share - 1) * m[k];
    }
  }

  PopulationModel model_;
  InitialPopulation initial_;
  std::size_t known_;
  bool exponential_;
  double volume_ = 1;
  FourMoments start_{};
  std::optional<NucleationSchedule> schedule_;
};

}  // namespace

std::unique_ptr<ExactSolution> exponentialForever(const PopulationModel& model, const InitialPopulation& initial) {
  if (initial.distribution != InitialPopulation::Distribution::exponential || model.nucleation) return nullptr;
  if (model.growth.active() && model.growth.treatment == GrowthOptions::Treatment::jumps) return nullptr;
  if (model.coagulation && model.coagulation->type != CollisionKernelType::constant) return nullptr;
  if (model.breakage &&
      (model.breakage->exponent != 1 || model.breakage->daughters != BreakageOptions::Daughters::uniform)) {
    return nullptr;
  }
  return std::make_unique<ClosedMoments>(model, initial, 2, true);
}

std::unique_ptr<ExactSolution> closedMoments(const PopulationModel& model, const InitialPopulation& initial) {
  // Numbers that do not decide by themselves when they meet the multiplicative kernel's gelation are left out.
  if (model.coagulation && model.coagulation->type == CollisionKernelType::multiplicative) return nullptr;
  std::size_t known = 4;
  if (model.breakage && model.breakage->exponent != 0) {
    if (model.breakage->exponent != 1) return nullptr;
    known = 2;
  }
  return std::make_unique<ClosedMoments>(model, initial, known, false);
}

}  // namespace lampblack::particles::exact
