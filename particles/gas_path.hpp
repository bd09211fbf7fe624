// The gas that particles meet on their way, as samples in the order of time. Between two samples it is linear in time;
// particles see it as a row of constant states, each taken at the middle of its part.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "particles/soot_gas.hpp"

namespace lampblack {

struct GasSample {
  double time = 0;          // s
  SootGasState gas;         // its span is not used: see pah
  std::vector<double> pah;  // mol/m3
};

// Largest change of temperature (K) and of any concentration (relative to its larger end) over one constant state:
// intervals between samples are divided until they stay below.
struct GasDivision {
  double temperatureStep = 20;
  double relativeStep = 0.1;
  std::size_t most = 64;  // parts of an interval
};

// (1 - w) `from` + w `to`; concentrations of PAH go to `pah`, which the result's span shows.
[[nodiscard]] SootGasState mixed(const GasSample& from, const GasSample& to, double w, std::span<double> pah);

// Throws InputError where time falls from one sample to the next, or where either has not `pah` PAH.
void checkInterval(const GasSample& from, const GasSample& to, std::size_t pah);

[[nodiscard]] std::size_t parts(const GasSample& from, const GasSample& to, const GasDivision& division);

// Calls advance(gas, w, dt) for each part of the way from one sample to the next; w in (0, 1) is where it was taken.
template <typename Advance>
void marchInterval(const GasSample& from, const GasSample& to, const GasDivision& division, Advance&& advance) {
  const auto count = static_cast<double>(parts(from, to, division));
  const double dt = (to.time - from.time) / count;
  if (!(dt > 0)) return;
  std::vector<double> pah(from.pah.size());
  for (double part = 0; part < count; ++part) {
    const double w = (part + 0.5) / count;
    advance(mixed(from, to, w, pah), w, dt);
  }
}

}  // namespace lampblack
