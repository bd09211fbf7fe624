// Processes of a population as results list them: what each is called, and what it exchanges with the gas.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "particles/gas/species_exchanged.hpp"

namespace lampblack::particles {

// Its amount is per m3 of the gas.
struct ParticleProcess : Quantity {
  SpeciesExchanged gas = {};
};

// With where `Exchange`, what a population did since it was asked last, has the amount.
template <class Exchange>
struct ProcessOf : ParticleProcess {
  double Exchange::*amount = nullptr;
};

template <class Process>
[[nodiscard]] std::vector<ParticleProcess> namesOf(const std::vector<Process>& processes) {
  return {processes.begin(), processes.end()};
}
template <class Process, class Exchange>
[[nodiscard]] std::vector<double> amountsOf(const std::vector<Process>& processes, const Exchange& exchange) {
  std::vector<double> all;
  for (const Process& process : processes) all.push_back(exchange.*process.amount);
  return all;
}

}  // namespace lampblack::particles
