#include "chemistry/kinetics/batch_kinetics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "chemistry/kinetics/batch_kinetics_tables.hpp"
#include "chemistry/kinetics/batch_kinetics_targets.hpp"
#include "chemistry/kinetics/batch_workspace.hpp"
#include "chemistry/kinetics/kinetics_enthalpy.hpp"
#include "chemistry/kinetics/kinetics_linear_burke.hpp"
#include "chemistry/kinetics/kinetics_pressure.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

static_assert(BatchKinetics::blockSize == batchLanes);

struct BatchKinetics::State {
  explicit State(const Mechanism& mechanism)
      : tables(mechanism),
        batchTables(mechanism, tables),
        view(batchTables.view()),
        workspace(view, batchTables.numEntries()) {
    if (std::any_of(tables.pressureLog.sign.begin(), tables.pressureLog.sign.end(), [](double s) { return s < 0; }))
      sums.emplace(tables);
    if (view.given.size > 0) given.emplace(mechanism, tables);
  }

  // The factors that the kernel is given, one state after the other: those of the rarer kinds of rates.
  struct Given {
    Given(const Mechanism& mechanism, const KineticsTables& tables)
        : thermo(mechanism.allSpecies()),
          enthalpies(tables),
          linearBurke(mechanism, tables),
          enthalpy(mechanism.numSpecies()),
          c(mechanism.numSpecies()),
          lnBase(tables.numReactions) {}

    const double* evaluate(const KineticsTables& tables, std::span<const double> T, const double* concentrations,
                           std::size_t stride) {
      const std::size_t n = T.size(), first = tables.enthalpyDependent.size();
      factors.resize((first + tables.linearBurke.size()) * n);
      for (std::size_t i = 0; i < n; ++i) {
        const double lnT = std::log(T[i]);
        if (first > 0) {
          thermo.enthalpyOverRT(T[i], enthalpy.data());
          const auto logarithms = enthalpies.logarithms(tables, T[i], enthalpy.data());
          for (std::size_t e = 0; e < first; ++e) factors[e * n + i] = std::exp(logarithms[e]);
        }
        double total = 0;
        for (std::size_t k = 0; k < c.size(); ++k) total += c[k] = concentrations[k * stride + i];
        for (const auto& one : tables.linearBurke) {
          const auto r = one.reaction;
          lnBase[r] = tables.lnA[r] + tables.b[r] * lnT - tables.Ta[r] / T[i];
        }
        linearBurke.setTemperature(T[i], lnT, lnBase.data());
        const auto mixed = linearBurke.evaluate(c.data(), total);
        for (std::size_t e = 0; e < mixed.size(); ++e) factors[(first + e) * n + i] = mixed[e];
      }
      return factors.data();
    }

    SpeciesThermo thermo;
    EnthalpyFactors enthalpies;
    LinearBurkeFactors linearBurke;
    std::vector<double> enthalpy, c, lnBase, factors;
  };

  KineticsTables tables;
  BatchTables batchTables;
  BatchView view;
  BatchWorkspace workspace;
  std::optional<Given> given;
  std::optional<PressureRates> sums;  // refuses temperatures at which rate constants add up to nothing positive
};

bool BatchKinetics::available(Instructions instructions) {
  switch (instructions) {
#if defined(__x86_64__)
    case Instructions::Avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && available(Instructions::Avx2);
    case Instructions::Avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    case Instructions::Avx512:
    case Instructions::Avx2:
      return false;
#endif
    case Instructions::Generic:
      break;
  }
  return true;
}

BatchKinetics::Instructions BatchKinetics::best() {
  for (const auto instructions : {Instructions::Avx512, Instructions::Avx2})
    if (available(instructions)) return instructions;
  return Instructions::Generic;
}

const char* BatchKinetics::name(Instructions instructions) {
  switch (instructions) {
    case Instructions::Avx512:
      return "AVX-512";
    case Instructions::Avx2:
      return "AVX2";
    case Instructions::Generic:
      break;
  }
  return "generic";
}

void BatchKinetics::demand(Instructions instructions) {
  if (!available(instructions))
    throw InputError(
        fmt::format("this processor has no {} instructions; the best it has are {}", name(instructions), name(best())));
}

BatchKinetics::BatchKinetics(const Mechanism& mechanism, Instructions instructions) : instructions_(instructions) {
  demand(instructions);
  state_ = std::make_unique<State>(mechanism);
}

BatchKinetics::~BatchKinetics() = default;
BatchKinetics::BatchKinetics(BatchKinetics&&) noexcept = default;
BatchKinetics& BatchKinetics::operator=(BatchKinetics&&) noexcept = default;

std::size_t BatchKinetics::numSpecies() const {
  return state_->batchTables.numSpecies();
}

void BatchKinetics::netProductionRates(std::span<const double> T, std::span<const double> concentrations,
                                       std::span<double> wdot, std::size_t stride) {
  if (T.empty()) return;
  if (stride == 0) stride = T.size();
  const std::size_t needed = (numSpecies() - 1) * stride + T.size();
  if (stride < T.size() || concentrations.size() < needed || wdot.size() < needed)
    throw std::invalid_argument(fmt::format("{} states with stride {} need arrays of {} values, there are {} and {}",
                                            T.size(), stride, needed, concentrations.size(), wdot.size()));
  if (state_->sums)
    for (const double temperature : T) state_->sums->setTemperature(state_->tables, temperature, std::log(temperature));
  const double* given =
      state_->given ? state_->given->evaluate(state_->tables, T, concentrations.data(), stride) : nullptr;
  const BatchStates states{T.size(), T.data(), concentrations.data(), stride, wdot.data(), stride, given};
  switch (instructions_) {
#if defined(__x86_64__)
    case Instructions::Avx512:
      return batchRatesAvx512(state_->view, state_->workspace.work(), states);
    case Instructions::Avx2:
      return batchRatesAvx2(state_->view, state_->workspace.work(), states);
#else
    case Instructions::Avx512:
    case Instructions::Avx2:
#endif
    case Instructions::Generic:
      break;
  }
  batchRatesGeneric(state_->view, state_->workspace.work(), states);
}

}  // namespace lampblack::chemistry
