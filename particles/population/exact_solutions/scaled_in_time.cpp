// Losses and linear condensation change only the clock of a coagulation or breakage: with the loss rate l, growth
// dv/dt = s v and a rate that goes with v^p, n(v, t) = exp(-(l + s) t) f(v exp(-s t), theta) where f solves the problem
// without them and d theta / dt = exp((p s - l) t) for pairs, exp(p s t) for single particles.
#include <cmath>
#include <utility>

#include "particles/population/exact_solutions/solutions.hpp"

namespace lampblack::particles::exact {
namespace {

class ScaledInTime final : public ExactSolution {
 public:
  ScaledInTime(std::unique_ptr<ExactSolution> alone, double clock, double loss, double condensation)
      : alone_(std::move(alone)), clock_(clock), loss_(loss), condensation_(condensation) {}

  std::array<std::optional<double>, 4> moments(double time) const override {
    auto result = alone_->moments(clockAt(time));
    for (std::size_t k = 0; k < result.size(); ++k) {
      if (result[k]) *result[k] *= std::exp((static_cast<double>(k) * condensation_ - loss_) * time);
    }
    return result;
  }

  std::vector<double> numberInBins(double time, std::span<const double> edges) const override {
    std::vector<double> before(edges.begin(), edges.end());
    for (double& edge : before) edge *= std::exp(-condensation_ * time);
    auto result = alone_->numberInBins(clockAt(time), before);
    for (double& number : result) number *= std::exp(-loss_ * time);
    return result;
  }

  std::optional<double> gelationTime() const override {
    const auto clock = alone_->gelationTime();
    if (!clock || clock_ == 0) return clock;
    if (!(1 + clock_ * *clock > 0)) return {};  // the clock stops before
    return std::log1p(clock_ * *clock) / clock_;
  }

  std::string name() const override {
    std::string text = alone_->name();
    if (loss_ != 0) text += ", with losses";
    if (condensation_ != 0) text += ", with linear condensation";
    return text;
  }

 private:
  double clockAt(double time) const { return clock_ != 0 ? std::expm1(clock_ * time) / clock_ : time; }

  std::unique_ptr<ExactSolution> alone_;
  double clock_, loss_, condensation_;
};

}  // namespace

std::unique_ptr<ExactSolution> scaledInTime(std::unique_ptr<ExactSolution> alone, double degree, bool pairs,
                                            double loss, double condensation) {
  if (!alone || (loss == 0 && condensation == 0)) return alone;
  const double clock = degree * condensation - (pairs ? loss : 0);
  return std::make_unique<ScaledInTime>(std::move(alone), clock, loss, condensation);
}

}  // namespace lampblack::particles::exact
