// The method of moments with interpolative closure (Frenklach and Harris 1987; Frenklach 2002).
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/errors.hpp"
#include "particles/population/moments/moment_interpolation.hpp"
#include "particles/population/moments/moment_system.hpp"
#include "particles/population/moments/momic_coagulation.hpp"

namespace lampblack::particles {
namespace {

class MomicSystem final : public MomentSystem {
 public:
  MomicSystem(const PopulationModel& model, const InitialPopulation& initial, const MomentOptions& options)
      : MomentSystem(model, initial, options.moments),
        broken_(size(), MomicCoagulation::lowestOrder, MomicCoagulation::highestOrder(size())) {
    if (model.coagulation) coagulation_.emplace(*model.coagulation, size(), unit(), model.density);
    if (model.breakage && model.breakage->rate > 0 && model.breakage->exponent != 0) {
      throw InputError("MOMIC: breakage at a rate that depends on the volume needs moments it does not have; use QMOM");
    }
    for (std::size_t k = 0; k < size(); ++k) {
      const double order = static_cast<double>(k);
      belowSurface_.push_back(lagrangeWeights(size(), order - 1 / 3.0));
      if (!model.deposition) continue;
      const double exponent = model.deposition->exponent;
      if (!(exponent >= -0.67 && exponent <= 0.34)) {
        throw InputError(fmt::format(
            "MOMIC: deposition.exponent needs to be in [-2/3, 1/3], not {}: moments of other orders are not known; use "
            "QMOM",
            exponent));
      }
      deposited_.push_back(lagrangeWeights(size(), order + exponent));
    }
  }

  bool hasVanishing(const double* y) const override { return y[0] > 0 && y[1] / y[0] <= vanishingVolume(0); }
  std::vector<double> withoutVanishing(double time, const double* y) const override {
    throw NumericsError(fmt::format(
        "MOMIC does not follow particles to their end, and the mean volume has fallen to the smallest one: {}",
        describe(time, y)));
  }
  bool limited(const double* /*y*/) const override { return false; }
  std::vector<double> simplified(const double* y) const override { return {y, y + size()}; }

  double geometricDeviation(const double* y) const override {
    if (!(y[0] > 0)) return 1;
    return std::exp(std::sqrt(std::max(0.0, std::log(y[0] / y[1] * (y[2] / y[1])))) / 3);
  }

 protected:
  bool addClosed(const double* y, double* f) const override {
    const bool growing = surfaceFactor() != 0;
    for (std::size_t k = 0; k < size(); ++k) {
      if (growing && k > 0) f[k] += static_cast<double>(k) * surfaceFactor() * interpolated(y, belowSurface_[k]);
      if (model().breakage) f[k] += model().breakage->rate * (share(k) - 1) * y[k];
      if (model().deposition) {
        f[k] -= lossRate(1) * (model().deposition->exponent != 0 ? interpolated(y, deposited_[k]) : y[k]);
      }
    }
    if (coagulation_) {
      BrokenMoments moments;
      broken_.interpolate({y, size()}, moments);
      coagulation_->addRates(moments, f);
    }
    return true;
  }

 private:
  double interpolated(const double* y, const std::vector<double>& weights) const {
    double sum = 0;
    for (std::size_t k = 0; k < size(); ++k) sum += weights[k] * std::log(y[k]);
    return std::exp(sum);
  }

  MomentInterpolation broken_;
  std::optional<MomicCoagulation> coagulation_;
  std::vector<std::vector<double>> belowSurface_, deposited_;
};

}  // namespace

std::unique_ptr<MomentSystem> makeMomicSystem(const PopulationModel& model, const InitialPopulation& initial,
                                              const MomentOptions& options) {
  return std::make_unique<MomicSystem>(model, initial, options);
}

}  // namespace lampblack::particles
