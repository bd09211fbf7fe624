// Growth and evaporation as jumps of the Markov process: one monomer at a time, at the rate |dv/dt| / monomer. The mean
// of v follows dv/dt; what is random about it vanishes as the monomer does.
#pragma once

#include <cmath>
#include <optional>

#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/population_model.hpp"

namespace lampblack::particles {

template <CoagulatingType Type>
class GrowthJump {
 public:
  using Particle = typename Type::Particle;
  GrowthJump(const Type& type, const GrowthOptions& growth) : type_(type), growth_(growth) {}

  [[nodiscard]] bool active() const {
    return growth_.active() && growth_.treatment == GrowthOptions::Treatment::jumps && growth_.monomer > 0;
  }
  [[nodiscard]] double speed(const Particle& p) const {  // dv/dt, m3/s
    const double condensation = growth_.condensation * type_.volume(p);
    return growth_.surface() == 0 ? condensation : condensation + growth_.surface() * type_.surface(p);
  }
  [[nodiscard]] double rate(const Particle& p) const { return std::abs(speed(p)) / growth_.monomer; }  // 1/s
  // Nothing where the particle falls below the smallest volume.
  [[nodiscard]] std::optional<Particle> jumped(const Particle& p) const {
    if (speed(p) > 0) return enlarged(type_, p, growth_.monomer);
    const double rest = type_.volume(p) - growth_.monomer;
    // A monomer counted down to nothing leaves rounding errors of its size.
    if (rest <= growth_.smallestVolume || rest <= 1e-9 * growth_.monomer) return std::nullopt;
    return enlarged(type_, p, -growth_.monomer);
  }

 private:
  Type type_;
  GrowthOptions growth_;
};

}  // namespace lampblack::particles
