#include "chemistry/reactor/engine/engine_cylinder.hpp"

namespace lampblack::chemistry {

void EngineCylinder::saveOrLoad(StateArchive& archive) {
  archive.shared("species", gas_.species);
  archive.shared("scalars", gas_.scalars);
  archive.shared("attempts", attempts_);
  archive.shared("steps", ledger_.steps);
  archive.shared("rejected_steps", ledger_.rejected);
  archive.shared("steps_too_large", ledger_.tooLarge);
  const std::pair<const char*, double*> numbers[] = {{"pressure", &gas_.pressure},
                                                     {"time", &time_},
                                                     {"growth_rate", &growthRate_},
                                                     {"step_size", &size_},
                                                     {"work", &ledger_.work},
                                                     {"wall_heat", &ledger_.heat},
                                                     {"chemical_heat", &ledger_.chemical},
                                                     {"injected_mass", &ledger_.injectedMass},
                                                     {"injected_enthalpy", &ledger_.injectedEnthalpy},
                                                     {"carried_enthalpy", &ledger_.carriedEnthalpy},
                                                     {"chemistry_steps", &ledger_.chemistrySteps},
                                                     {"step_error", &ledger_.largestDefect},
                                                     {"start_pressure", &startPressure_},
                                                     {"start_temperature", &startTemperature_},
                                                     {"start_volume", &startVolume_},
                                                     {"start_energy", &startEnergy_}};
  for (const auto& [name, value] : numbers) archive.shared(name, *value);
  const std::pair<const char*, std::vector<double>*> lists[] = {{"masses", &gas_.mass},
                                                                {"temperatures", &gas_.temperature},
                                                                {"mass_fractions", &gas_.massFractions},
                                                                {"carried", &gas_.carried},
                                                                {"first_steps", &gas_.firstStep},
                                                                {"costs", &gas_.cost},
                                                                {"start_elements", &startElements_}};
  for (const auto& [name, values] : lists) archive.shared(name, *values);
  std::vector<double> peaks = peaks_.packed();
  archive.shared("peaks", peaks);
  peaks_.unpack(peaks);
}

}  // namespace lampblack::chemistry
