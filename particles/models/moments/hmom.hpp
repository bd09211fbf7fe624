// The hybrid method of moments (Mueller, Blanquart and Pitsch 2009) as a SootModel: aggregates of volume V and surface
// S as two delta functions, one of nuclei (spheres) and one of everything else. In the paper's terms the moments M_00,
// M_10, M_01 and the number N_0 of nuclei, with linear interpolation. Carried are the parts themselves, so that no
// difference of almost equal numbers has to be taken, and each with its carbon and hydrogen:
//   N_0;  the mass of nuclei, whose mean size follows the dimers where several PAH make them;
//   N_L = M_00 - N_0,  the mass of large particles,  S_L = M_01 - N_0 S_0.
// Equations: docs/theory/soot_models.md.
#pragma once

#include "core/modules.hpp"
#include "particles/models/moments/moment_chemistry.hpp"
#include "particles/models/soot_model.hpp"

namespace lampblack::particles {

struct HmomOptions {
  SootModelOptions soot;
  double fractalDimension = 1.8;    // of collision diameters, in (1, 3]
  double surfaceExponent = 0.2043;  // growth of an aggregate's surface falls with n_p^-exponent (Mueller et al. 2009)
};

class HmomSoot final : public SootModel {
 public:
  enum Scalar : std::size_t {
    nuclei = 0,
    nucleiCarbon = 1,
    nucleiHydrogen = 2,
    number = 3,  // of large particles, like the rest
    carbon = 4,
    hydrogen = 5,
    surface = 6,
    scalarCount = 7
  };

  explicit HmomSoot(HmomOptions options);  // throws InputError

  [[nodiscard]] const std::vector<std::string>& gasSpecies() const override { return chemistry_.species(); }
  [[nodiscard]] const std::vector<ParticleScalar>& scalars() const override { return scalars_; }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) const override;
  void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const override;
  [[nodiscard]] ParticleProperties properties(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] ParticleProcesses processes(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] double volumeFraction(std::span<const double> densities) const override;
  void addSpheres(double count, double volume, std::span<double> densities) const override;

  [[nodiscard]] const HmomOptions& options() const { return options_; }

 private:
  struct Mode;   // one delta function
  struct State;  // both
  struct Rates;

  [[nodiscard]] State stateOf(std::span<const double> densities) const;
  // `largest`: bound of the mean particle, in nuclei.
  [[nodiscard]] Mode modeOf(double particles, double carbonMass, double hydrogenMass, double largest) const;
  [[nodiscard]] double surfacePerVolume(const Mode& mode) const;
  [[nodiscard]] static double mobilityDiameter(const Mode& mode);
  [[nodiscard]] Rates evaluate(const MomentGas& gas, std::span<const double> densities) const;
  void addCoagulation(const MomentGas& gas, const State& state, Rates& rates) const;
  void addDimers(const MomentGas& gas, const State& state, Rates& rates) const;
  void addSurface(const MomentGas& gas, const State& state, Rates& rates) const;

  HmomOptions options_;
  MomentChemistry chemistry_;
  double nucleusMass_ = 0;  // kg of carbon in the smallest nucleus
  std::vector<ParticleScalar> scalars_;
};

}  // namespace lampblack::particles
