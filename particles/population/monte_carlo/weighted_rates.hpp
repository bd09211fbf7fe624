// What a store needs to know of numerical particles with different weights. Weights are in 1/m3: numbers of real
// particles per m3 that a numerical one stands for; rates are in 1/s.
#pragma once

#include <optional>
#include <type_traits>

#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/monte_carlo/fraction_law.hpp"
#include "particles/population/monte_carlo/growth_jump.hpp"
#include "particles/population/monte_carlo/power_law.hpp"
#include "particles/population/monte_carlo/store.hpp"
#include "particles/population/monte_carlo/weighted_particle.hpp"

namespace lampblack::particles {

template <ParticleType Type>
class WeightedRates {
 public:
  using Particle = typename Type::Particle;
  using Entry = WeightedParticle<Particle>;
  static constexpr bool weighted = true;
  static constexpr bool bare = std::is_same_v<Type, Sphere>;

  WeightedRates(const Type& type, const PopulationModel& model, const MonteCarloOptions& options)
      : type_(type),
        jump_(type, model.growth),
        fraction_(options.fraction, options.fractionOf, options.fractionConstant),
        swa_(options.method == MonteCarloMethod::swa),
        relative_(options.merging == MergingDifference::relative) {
    if (model.coagulation) kernel_.emplace(*model.coagulation);
    if (model.breakage) breakage_.emplace(model.breakage->rate, model.breakage->exponent);
    if (model.deposition) deposition_.emplace(model.deposition->rate, model.deposition->exponent);
    merges_ = swa_ || options.method == MonteCarloMethod::sammc;
    // Numbers only fall by deposition and where particles shrink to nothing.
    keepsHeaviest_ = model.deposition || model.growth.condensation < 0 || model.growth.surface() < 0;
    // Powers of the volume, and sums of such that grow together; the transition kernels have terms that do not.
    monotone_ = bare && !(kernel_ && kernel_->tunable()) && !(model.growth.condensation * model.growth.surface() < 0);
  }

  [[nodiscard]] const Type& type() const { return type_; }
  [[nodiscard]] const GrowthJump<Type>& growthJump() const { return jump_; }
  [[nodiscard]] const FractionLaw& fraction() const { return fraction_; }
  [[nodiscard]] bool gels() const { return kernel_ && kernel_->gels(fractalDimension(type_)); }
  [[nodiscard]] bool tunable() const { return kernel_ && kernel_->tunable(); }
  // Of the same type; all bounds have to be made anew.
  void setKernel(const CollisionKernelOptions& options) { kernel_.emplace(options); }
  template <class ForEach>
  void tune(ForEach&& forEach) {
    kernel_->tune([&](const auto& f) { forEach([&](const Entry& entry) { f(properties(entry), entry.weight); }); });
  }

  [[nodiscard]] Entry entry(double volume, double weight) const { return {type_.make(volume), weight}; }
  [[nodiscard]] double volume(const Entry& entry) const { return orderVolume(type_, entry.particle); }
  [[nodiscard]] double weight(const Entry& entry) const { return entry.weight; }
  [[nodiscard]] std::size_t rank() const { return kernel_ ? kernel_->rank() : 0; }
  [[nodiscard]] CollisionKernel::Terms terms(const Entry& entry) const {
    return kernelTerms(*kernel_, type_, entry.particle);
  }
  [[nodiscard]] double weightFactor() const { return swa_ ? 1 : fraction_.bound(); }
  [[nodiscard]] double pair(const Entry& i, const Entry& j) const {
    return weightPart(i, j) * kernel_->value(properties(i), properties(j));
  }
  // Weights decide first: they are cheap and turn down about half of what is to be turned down.
  [[nodiscard]] bool accepts(const Entry& i, const Entry& j, double majorant, double u) const {
    const double part = weightPart(i, j), limit = u * weightFactor() * (i.weight + j.weight);
    if (!(limit < part)) return false;
    return part * kernel_->value(properties(i), properties(j)) > limit * majorant;
  }

  [[nodiscard]] double single(SingleProcess process, const Entry& entry) const {
    if (!exists(type_, entry.particle)) return 0;
    if (process == SingleProcess::condensation) return jump_.rate(entry.particle);
    return law(process)(type_.volume(entry.particle));
  }
  [[nodiscard]] double singleBound(SingleProcess process, const Entry& entry) const {
    if (process == SingleProcess::condensation) return jump_.rate(entry.particle);
    return largest(type_, entry.particle, law(process));
  }
  [[nodiscard]] bool active(SingleProcess process) const {
    if (process == SingleProcess::breakage) return breakage_.has_value();
    if (process == SingleProcess::deposition) return deposition_.has_value();
    return jump_.active();
  }

  [[nodiscard]] bool relativeDifference() const { return relative_; }
  [[nodiscard]] bool merges() const { return merges_; }
  [[nodiscard]] bool keepsHeaviest() const { return keepsHeaviest_; }
  [[nodiscard]] bool monotone() const { return monotone_; }

  // The kernel's factor: Wang (2025), eq. 5-5, or the two orders of the pair in SWA.
  [[nodiscard]] double weightPart(const Entry& i, const Entry& j) const {
    if (!exists(type_, i.particle) || !exists(type_, j.particle)) return 0;
    if (swa_) return i.weight + j.weight;
    return fraction_.rate(type_.volume(i.particle), type_.volume(j.particle), i.weight, j.weight);
  }

 private:
  [[nodiscard]] CollisionKernel::Properties properties(const Entry& entry) const {
    return kernelProperties(*kernel_, type_, entry.particle);
  }
  [[nodiscard]] const PowerLaw& law(SingleProcess process) const {
    return process == SingleProcess::breakage ? *breakage_ : *deposition_;
  }

  Type type_;
  std::optional<CollisionKernel> kernel_;
  std::optional<PowerLaw> breakage_, deposition_;
  GrowthJump<Type> jump_;
  FractionLaw fraction_;
  bool swa_, relative_, merges_ = false, keepsHeaviest_ = false, monotone_ = false;
};

}  // namespace lampblack::particles
