// Soot by the method of moments with interpolative closure (Frenklach and Harris 1987; Frenklach 2002) as a SootModel:
// spheres, carried as the moments M_0 ... M_(n-1) of their mass. M_1 is the soot's mass, carried as carbon and hydrogen
// so that every atom is accounted for; the others are in units of a fixed mass. Broken and negative orders come from
// the Lagrange polynomial through ln M_k. Equations, and what happens in states no population has:
// docs/theory/soot_models.md.
#pragma once

#include <array>

#include "core/modules.hpp"
#include "particles/models/moments/moment_chemistry.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/population/moments/momic_coagulation.hpp"

namespace lampblack::particles {

struct MomicOptions {
  SootModelOptions soot;
  // 3 to 6. With 5 and 6 Newton's method fails in flames (docs/theory/soot_models.md); they are for reactors.
  std::size_t moments = 4;
};

class MomicSoot final : public SootModel {
 public:
  static constexpr std::size_t fewest = 3, most = 6;
  // Then the moments 2, 3, ...
  enum Scalar : std::size_t { number = 0, carbon = 1, hydrogen = 2, higher = 3 };

  explicit MomicSoot(MomicOptions options);  // throws InputError

  [[nodiscard]] const std::vector<std::string>& gasSpecies() const override { return chemistry_.species(); }
  [[nodiscard]] const std::vector<ParticleScalar>& scalars() const override { return scalars_; }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) const override;
  void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const override;
  [[nodiscard]] ParticleProperties properties(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] ParticleProcesses processes(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] double volumeFraction(std::span<const double> densities) const override;
  void addSpheres(double count, double volume, std::span<double> densities) const override;
  // Of the log-normal distribution with the same M_0, M_1 and M_2.
  [[nodiscard]] SizeDistribution sizeDistribution(std::span<const double> densities) const override;

  [[nodiscard]] const MomicOptions& options() const { return options_; }
  // Mass (kg) in which the moments above the first are counted: their scalar is the sum of (m/massUnit)^k, 1/m3.
  [[nodiscard]] double massUnit() const { return unit_; }

 private:
  using Moments = std::array<double, most>;
  struct State;  // what the closure makes of the densities
  struct Rates;  // of the moments and of the processes

  [[nodiscard]] State stateOf(std::span<const double> densities) const;
  [[nodiscard]] Rates evaluate(const MomentGas& gas, std::span<const double> densities) const;
  void addCoagulation(const MomentGas& gas, const State& state, Rates& rates) const;
  void addDimers(const MomentGas& gas, const State& state, Rates& rates) const;
  void addSurface(const MomentGas& gas, const State& state, Rates& rates) const;

  MomicOptions options_;
  MomentChemistry chemistry_;
  MomentInterpolation broken_;
  MomicCoagulation coagulation_;  // its gas is set call by call, in a copy
  double unit_ = 0;               // kg
  double unitDiameter_ = 0;       // m, of the sphere of that mass
  double nucleus_ = 0;            // the smallest particle, in units
  std::vector<ParticleScalar> scalars_;
};

}  // namespace lampblack::particles
