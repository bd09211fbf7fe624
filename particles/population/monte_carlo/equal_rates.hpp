// What a store needs to know of numerical particles that all have the same weight. The rates of pairs are those of the
// kernel (m3/s): the method multiplies their sum by its one weight, so that the store's sums stay as they are when the
// weight changes.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/population/monte_carlo/growth_jump.hpp"
#include "particles/population/monte_carlo/power_law.hpp"
#include "particles/population/monte_carlo/store.hpp"

namespace lampblack::particles {

template <CoagulatingType Type>
class EqualRates {
 public:
  using Particle = typename Type::Particle;
  static constexpr bool weighted = false;

  // Whether particles change while they are in the store (deferred growth).
  static constexpr bool changing = requires(const Type type, const CollisionKernel kernel, const Particle p) {
    type.properties(kernel, p);
  };

  // The diameter is kept as it costs a root or a power, and is looked at in every attempt.
  struct Entry {
    Particle particle;
    double diameter;  // m, of collision; zero where no kernel asks for it or particles change
  };

  EqualRates(const Type& type, const PopulationModel& model) : type_(type), jump_(type, model.growth) {
    if (model.coagulation) kernel_.emplace(*model.coagulation);
    if (model.breakage) breakage_.emplace(model.breakage->rate, model.breakage->exponent);
    if (model.deposition) deposition_.emplace(model.deposition->rate, model.deposition->exponent);
  }

  [[nodiscard]] const Type& type() const { return type_; }
  [[nodiscard]] const GrowthJump<Type>& growthJump() const { return jump_; }
  [[nodiscard]] bool gels() const { return kernel_ && kernel_->gels(fractalDimension(type_)); }
  [[nodiscard]] bool tunable() const { return kernel_ && kernel_->tunable(); }
  // Of the same type; entries have to be put in anew.
  void setKernel(const CollisionKernelOptions& options) { kernel_.emplace(options); }
  // Makes the majorant the best one for these entries, forEach(f) calling f(entry) or f(entry, number); only where all
  // of them are put in anew after it. Any majorant holds: of so many entries some thousand are enough to look at.
  template <class ForEach>
  void tune(ForEach&& forEach, std::size_t entries = 0) {
    const std::size_t stride = 1 + entries / 1024;
    std::size_t wait = 1;
    kernel_->tune([&](const auto& f) {
      forEach([&](const Entry& entry, double number = 1) {
        if (--wait > 0) return;
        wait = stride;
        f(properties(entry), number);
      });
    });
  }

  [[nodiscard, gnu::always_inline]] Entry entry(const Particle& particle) const {
    return {particle, entryDiameter(particle)};
  }
  [[nodiscard, gnu::always_inline]] double entryDiameter(const Particle& particle) const {
    const bool needed = !changing && kernel_ && kernel_->needsDiameter();
    return needed ? type_.collisionDiameter(particle) : 0.0;
  }
  [[nodiscard]] double volume(const Entry& entry) const { return orderVolume(type_, entry.particle); }
  [[nodiscard]] double weight(const Entry&) const { return 1; }
  [[nodiscard]] double weightFactor() const { return 1; }
  [[nodiscard]] std::size_t rank() const { return kernel_ ? kernel_->rank() : 0; }
  [[nodiscard]] CollisionKernel::Terms terms(const Entry& entry) const {
    if constexpr (changing)
      return kernelTerms(*kernel_, type_, entry.particle);
    else
      return kernel_->terms(properties(entry));
  }
  // The largest of each over many.
  [[nodiscard]] CollisionKernel::Terms largestTerms(std::span<const Entry> entries) const requires(!changing) {
    constexpr std::size_t atATime = 128;
    std::array<CollisionKernel::Properties, atATime> some;
    CollisionKernel::Terms most;
    for (std::size_t first = 0; first < entries.size(); first += atATime) {
      const std::size_t n = std::min(atATime, entries.size() - first);
      for (std::size_t k = 0; k < n; ++k) some[k] = properties(entries[first + k]);
      const CollisionKernel::Terms these = kernel_->largestTerms({some.data(), n});
      for (std::size_t r = 0; r < rank(); ++r) {
        most.p[r] = std::max(most.p[r], these.p[r]);
        most.q[r] = std::max(most.q[r], these.q[r]);
      }
    }
    return most;
  }
  [[nodiscard]] double pair(const Entry& i, const Entry& j) const {
    if (changing && !(exists(type_, i.particle) && exists(type_, j.particle))) return 0;
    const double rate = kernel_->value(properties(i), properties(j));
    if constexpr (requires { type_.sticking(i.particle, j.particle); })
      return rate * type_.sticking(i.particle, j.particle);
    else
      return rate;
  }

  [[nodiscard, gnu::always_inline]] double single(SingleProcess process, const Entry& entry) const {
    if (changing && !exists(type_, entry.particle)) return 0;
    switch (process) {
      case SingleProcess::breakage:
        return (*breakage_)(type_.volume(entry.particle));
      case SingleProcess::deposition:
        return (*deposition_)(type_.volume(entry.particle));
      case SingleProcess::condensation:
        break;
    }
    return jump_.rate(entry.particle);
  }
  [[nodiscard]] double singleBound(SingleProcess process, const Entry& entry) const {
    if (!changing || process == SingleProcess::condensation) return single(process, entry);
    return largest(type_, entry.particle, process == SingleProcess::breakage ? *breakage_ : *deposition_);
  }
  [[nodiscard]] bool active(SingleProcess process) const {
    if (process == SingleProcess::breakage) return breakage_.has_value();
    if (process == SingleProcess::deposition) return deposition_.has_value();
    return jump_.active();
  }

 private:
  [[nodiscard]] CollisionKernel::Properties properties(const Entry& entry) const {
    if constexpr (changing) {
      return kernelProperties(*kernel_, type_, entry.particle);
    } else {
      return {type_.volume(entry.particle), type_.mass(entry.particle), entry.diameter};
    }
  }

  Type type_;
  std::optional<CollisionKernel> kernel_;
  std::optional<PowerLaw> breakage_, deposition_;
  GrowthJump<Type> jump_;
};

}  // namespace lampblack::particles
