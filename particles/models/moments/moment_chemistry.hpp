// What the moment models share: the gas as the soot sees it, dimers shared out between new particles and those there
// are, and the exchange of atoms with the gas.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/soot/dimer.hpp"
#include "particles/soot/surface_chemistry.hpp"

namespace lampblack::particles {

// The gas at one point, digested; negative concentrations are zero.
struct MomentGas {
  CarrierGas gas;
  SootSpeciesArray concentrations{};
  PahArray consumption{};
  SurfaceChemistry surface;
  DimerProduction dimer;
  double freeMolecular = 0;  // prefactor of collisions with enhancement
};

// Atoms that come to the soot, mol/m3/s.
struct SootAtoms {
  double carbon = 0, hydrogen = 0;
};

// Dimers in steady state.
struct DimerBalance {
  double number = 0;           // 1/m3
  double nucleation = 0;       // nuclei, 1/m3/s, of two dimers each
  double condensingShare = 0;  // of the dimers made
  SootAtoms atoms;             // of all dimers made
};

// Events of the surface chemistry, mol/m3/s.
struct SurfaceEvents {
  double growth = 0, oxidationO2 = 0, oxidationOH = 0;
};

class MomentChemistry {
 public:
  explicit MomentChemistry(const SootModelOptions& options);  // throws InputError

  [[nodiscard]] const std::vector<std::string>& species() const { return species_; }
  [[nodiscard]] const DimerModel& dimers() const { return dimers_; }

  [[nodiscard]] MomentGas read(const ParticleGas& gas) const;  // throws NumericsError for a gas that is not physical
  // `withParticles`: sum over particles of their collision rate with a dimer, 1/s.
  [[nodiscard]] DimerBalance dimerBalance(const MomentGas& gas, double withParticles) const;
  [[nodiscard]] SurfaceEvents events(const MomentGas& gas, double area, double meanCarbonAtoms) const;

  // Atoms that oxidation takes from soot of this ratio of hydrogen to carbon atoms, mol/m3/s.
  [[nodiscard]] static SootAtoms lost(const SurfaceEvents& events, double hydrogenToCarbon) {
    const double carbon = 2 * events.oxidationO2 + events.oxidationOH;
    return {carbon, hydrogenToCarbon * carbon};
  }

  // Gas production, mol/m3/s, by dimers and surface events; `hydrogenLost`: as above, it becomes H2.
  void exchange(const MomentGas& gas, const DimerBalance& dimers, const SurfaceEvents& events, double hydrogenLost,
                std::span<double> production) const;

  // All but the numbers lost.
  [[nodiscard]] static ParticleProcesses processes(const SootModelOptions& options, const MomentGas& gas,
                                                   const DimerBalance& dimers, const SurfaceEvents& events,
                                                   double hydrogenToCarbon);

 private:
  SootModelOptions options_;
  DimerModel dimers_;
  std::vector<std::string> species_;
};

}  // namespace lampblack::particles
