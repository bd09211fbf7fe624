// How species diffuse in a flame of one dimension or a flow, as a deck says it.
#pragma once

#include <optional>
#include <vector>

#include "chemistry/transport/transport.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

struct TransportModel {
  enum class Diffusion { MixtureAveraged, Multicomponent, UnityLewis, ConstantLewis };

  Diffusion diffusion = Diffusion::MixtureAveraged;
  bool soret = false;                // thermal diffusion; not with Lewis numbers
  std::vector<double> lewisNumbers;  // ConstantLewis: of every species
  CollisionIntegrals integrals = CollisionIntegrals::MonchickMason;
  std::optional<SutherlandLaw> sutherland{};  // with Lewis numbers only

  [[nodiscard]] bool isMulticomponent() const { return diffusion == Diffusion::Multicomponent; }
  // Fluxes go along gradients of mass fractions instead of mole fractions.
  [[nodiscard]] bool hasLewisNumbers() const {
    return diffusion == Diffusion::UnityLewis || diffusion == Diffusion::ConstantLewis;
  }
  // Of the mixture-averaged properties, which the multicomponent model needs as well.
  [[nodiscard]] TransportOptions averaged() const {
    TransportOptions options;
    options.integrals = integrals;
    options.sutherland = sutherland;
    if (diffusion == Diffusion::UnityLewis) options.diffusion = DiffusionModel::UnityLewis;
    if (diffusion == Diffusion::ConstantLewis) {
      options.diffusion = DiffusionModel::ConstantLewis;
      options.lewisNumbers = lewisNumbers;
    }
    return options;
  }
};

}  // namespace lampblack::flow
