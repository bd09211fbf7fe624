// Semi-empirical two-equation models: number and carbon mass of equal spheres that acetylene makes and feeds and that
// O2 and OH burn. One class for the family; the published members differ by their constants:
//   inception   C2H2 -> 2 C(s) + H2              A exp(-Ta/T) [C2H2], so many carbon atoms to a nucleus
//   growth      C2H2 -> 2 C(s) + H2 on soot      A exp(-Ta/T) [C2H2] S or sqrt(S), S the surface per volume
//   oxidation   C(s) + 1/2 O2 -> CO,  C(s) + OH -> CO + H
//   coagulation dN/dt = -2 C (6 k T / rho)^(1/2) d^(1/2) N^2
// The last is the free-molecular kernel of equal spheres, enhanced C times.
#pragma once

#include "core/modules.hpp"
#include "particles/models/equal_spheres.hpp"
#include "particles/models/soot_model.hpp"

namespace lampblack::particles {

struct SemiEmpiricalOptions {
  enum class Oxygen { none, leung, lee, nagle };

  double inceptionFactor = 0;       // 1/s
  double inceptionTemperature = 0;  // K
  double nucleusCarbon = 0;         // atoms
  double growthFactor = 0;          // m/s, or (m3/m2)^(1/2)/s with the root of the surface
  double growthTemperature = 0;     // K
  bool growthByRootOfSurface = false;
  double coagulation = 0;  // C above
  Oxygen oxygen = Oxygen::none;
  double ohEfficiency = 0;     // of collisions of OH
  double oxidationFactor = 1;  // on all oxidation
  double density = 0;          // kg/m3
  double carbonWeight = 12.011e-3;
  bool inception = true, growth = true, oxidation = true, coagulating = true;
};

// Leung, Lindstedt, Jones 1991: growth by the root of the surface, oxidation by O2 alone.
[[nodiscard]] SemiEmpiricalOptions leungSoot();
// Brookes and Moss 1999: growth by the surface, oxidation by OH (Fenimore and Jones 1967, efficiency 0.04).
[[nodiscard]] SemiEmpiricalOptions mossBrookesSoot();

class SemiEmpiricalSoot final : public SootModel {
 public:
  enum Scalar : std::size_t { number = 0, carbon = 1 };

  explicit SemiEmpiricalSoot(const SemiEmpiricalOptions& options);  // throws InputError

  [[nodiscard]] const std::vector<std::string>& gasSpecies() const override { return species_; }
  [[nodiscard]] std::vector<std::size_t> precursors() const override { return {C2H2}; }
  [[nodiscard]] const std::vector<ParticleScalar>& scalars() const override { return scalars_; }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) const override;
  void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const override;
  [[nodiscard]] ParticleProperties properties(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] ParticleProcesses processes(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] double volumeFraction(std::span<const double> densities) const override;
  void addSpheres(double count, double volume, std::span<double> densities) const override;

  [[nodiscard]] const SemiEmpiricalOptions& options() const { return options_; }

 private:
  enum Gas : std::size_t { C2H2, H2, O2, OH, H, CO };
  struct Rates {
    double inception = 0, growth = 0;                          // C2H2, mol/m3/s
    double O2 = 0, OH = 0;                                     // carbon, mol/m3/s
    double nucleated = 0, coagulated = 0, oxidisedNumber = 0;  // 1/m3/s, positive
  };
  [[nodiscard]] Rates evaluate(const ParticleGas& gas, std::span<const double> densities) const;

  SemiEmpiricalOptions options_;
  EqualSpheres spheres_;
  std::vector<std::string> species_;
  std::vector<ParticleScalar> scalars_;
};

}  // namespace lampblack::particles
