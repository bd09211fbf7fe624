#include "particles/population/model/components.hpp"

#include <fmt/format.h>

#include <string_view>

#include "core/errors.hpp"

namespace lampblack::particles {

Components::Components(std::span<const double> densities, std::span<const double> nucleus,
                       std::span<const double> condensing)
    : count_(densities.size()) {
  if (count_ < 1 || count_ > most) {
    throw InputError(fmt::format("components: there need to be 1 to {}, not {}", most, count_));
  }
  for (std::size_t k = 0; k < count_; ++k) {
    if (!(densities[k] > 0)) {
      throw InputError(fmt::format("components: densities need to be above zero, not {}", densities[k]));
    }
    inverseDensity_[k] = 1 / densities[k];
  }
  const auto perVolume = [&](std::span<const double> fractions, std::string_view of) {
    if (fractions.size() != count_) {
      throw InputError(fmt::format("components: the {} needs {} mass fractions, not {}", of, count_, fractions.size()));
    }
    Masses masses{};
    double volume = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      if (!(fractions[k] >= 0)) {
        throw InputError(
            fmt::format("components: mass fractions of the {} need to be zero or above, not {}", of, fractions[k]));
      }
      masses[k] = fractions[k];
      volume += fractions[k] * inverseDensity_[k];
    }
    if (!(volume > 0)) throw InputError(fmt::format("components: the {} needs a mass fraction above zero", of));
    for (double& mass : masses) mass /= volume;
    return masses;
  };
  nucleus_ = perVolume(nucleus, "nucleus");
  condensing_ = perVolume(condensing, "condensing material");
}

}  // namespace lampblack::particles
