// The dimer two-equation model (Wang 2025, section 7.2.2) as a SootModel: number, carbon and hydrogen of a population
// of equal spheres, with the sources of TwoEquationSoot. What is added here makes them fit for Newton's method, whose
// iterates may be states that no soot is ever in: see the theory page "soot models".
#pragma once

#include "core/modules.hpp"
#include "particles/models/equal_spheres.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/models/two_equation/two_equation.hpp"

namespace lampblack::particles {

class DimerSoot final : public SootModel {
 public:
  enum Scalar : std::size_t { number = 0, carbon = 1, hydrogen = 2 };

  explicit DimerSoot(SootModelOptions options);  // throws InputError

  [[nodiscard]] const std::vector<std::string>& gasSpecies() const override { return species_; }
  [[nodiscard]] const std::vector<ParticleScalar>& scalars() const override { return scalars_; }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) const override;
  void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const override;
  [[nodiscard]] ParticleProperties properties(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] ParticleProcesses processes(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] double volumeFraction(std::span<const double> densities) const override;
  void addSpheres(double count, double volume, std::span<double> densities) const override;

  [[nodiscard]] const TwoEquationSoot& twoEquation() const { return model_; }

 private:
  [[nodiscard]] TwoEquationSoot::Population populationOf(std::span<const double> densities) const;
  [[nodiscard]] TwoEquationSoot::Sources evaluate(const ParticleGas& gas, std::span<const double> densities) const;

  TwoEquationSoot model_;
  EqualSpheres spheres_;  // a nucleus being known by its carbon
  std::vector<std::string> species_;
  std::vector<ParticleScalar> scalars_;
};

}  // namespace lampblack::particles
