// The gas that particles meet on their way, as samples in the order of time. Between two samples it is linear in time;
// particles see it as a row of constant states, each taken at the middle of its part.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"

namespace lampblack::particles {

struct GasSample {
  double time = 0;  // s
  CarrierGas gas;
  std::vector<double> concentrations;  // mol/m3, of the species that the particles see
};

// When particles are where, in what gas, and how fast their velocity diverges.
struct ParticlePath {
  std::vector<GasSample> points;  // in the order of time
  // Of the particles' velocity, 1/s, between a point and the next: at its two ends, linear in time.
  struct Divergence {
    double first = 0, last = 0;
    [[nodiscard]] double at(double w) const { return first + w * (last - first); }
  };
  std::vector<Divergence> divergence;
};

// Largest change of temperature (K) and of any concentration (relative to its larger end) over one constant state:
// intervals between samples are divided until they stay below.
struct GasDivision {
  double temperatureStep = 20;
  double relativeStep = 0.1;
  std::size_t most = 64;                  // parts of an interval
  std::vector<std::size_t> counted = {};  // concentrations that are looked at
};

// (1 - w) `from` + w `to`, at the time of `from`.
[[nodiscard]] GasSample mixed(const GasSample& from, const GasSample& to, double w);

// Throws InputError where time falls from one sample to the next, or where either has not this number of species.
void checkInterval(const GasSample& from, const GasSample& to, std::size_t species);

[[nodiscard]] std::size_t parts(const GasSample& from, const GasSample& to, const GasDivision& division);

// Calls advance(gas, w, dt) with the ParticleGas of each part of the way from one sample to the next; w in (0, 1) is
// where it was taken.
template <typename Advance>
void marchInterval(const GasSample& from, const GasSample& to, const GasDivision& division, Advance&& advance) {
  const auto count = static_cast<double>(parts(from, to, division));
  const double dt = (to.time - from.time) / count;
  if (!(dt > 0)) return;
  for (double part = 0; part < count; ++part) {
    const double w = (part + 0.5) / count;
    const GasSample middle = mixed(from, to, w);
    advance(ParticleGas{middle.gas, middle.concentrations}, w, dt);
  }
}

}  // namespace lampblack::particles
