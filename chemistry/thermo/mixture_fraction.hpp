// The mixture fraction of Bilger, Starner and Kee (1990): of the elements' mass fractions Z_C, Z_H, Z_O
// beta = 2 Z_C/W_C + Z_H/(2 W_H) - Z_O/W_O, from zero in the oxidiser to one in the fuel.
#pragma once

#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class MixtureFraction {
 public:
  // Mass fractions of both streams. InputError where beta does not tell them apart.
  MixtureFraction(const Mechanism& mechanism, std::span<const double> fuel, std::span<const double> oxidizer);

  [[nodiscard]] double of(std::span<const double> Y) const;

 private:
  std::vector<double> share_;  // of the species' mass fractions
  double ofOxidizer_ = 0.0;
};

}  // namespace lampblack::chemistry
