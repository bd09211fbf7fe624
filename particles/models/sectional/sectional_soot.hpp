// The sectional soot model (Wang 2025, section 9.2.2): soot in sections of fixed carbon mass on a geometric grid (fixed
// pivots, Kumar and Ramkrishna 1996), each with a number of aggregates and a number of primary particles, so that size
// and shape evolve together. A section's aggregates are equal: n_p = primaries / aggregates spheres in point contact.
//
// The pivots are masses of carbon. Without carbonisation soot has no hydrogen: that of PAH returns to the gas as H2 as
// the PAH is taken up. With carbonisation it stays in the soot, one more scalar, and leaves it at a first-order rate.
// All events move whole atoms: C, H and O of soot and gas close to round-off. docs/theory/soot_models.md has it all.
#pragma once

#include <memory>

#include "core/modules.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/soot/soot_fragmentation.hpp"

namespace lampblack::particles {

struct SectionalSootOptions {
  enum class Nucleation {
    pah,   // two equal PAH make a nucleus, PAH condense (Wang 2025, eqs. 9-23, 9-31), for every listed PAH
    dimer  // two dimers make a nucleus, dimers condense (Wang 2025, section 7.2.2), as in the dimer two-equation model
  };
  enum class Aggregation {
    aggregates,  // point contact: coagulation keeps the number of primaries (Wang 2025, eq. 9-27)
    spheres      // coalescence on contact: no primaries are carried, n_p = 1
  };
  enum class ActiveSites {  // whose carbon atoms are mu_1 in alpha(T, mu_1), a mean over the population
    aggregate,              // all carbon over the number of aggregates: M_1/M_0 of Appel, Bockhorn and Frenklach (2000)
    primary                 // over the number of primaries (Wang 2025, eq. 9-37)
  };
  enum class GrowthScheme {  // of what growth and oxidation move from section to section, carbon exact in both
    upwind,                  // Wang (2025), eqs. 9-41 to 9-44: first order, spreads the sizes
    limited                  // second order where the distribution is smooth, upwind where it is steep
  };

  // PAH list, densities, HACA, OH efficiency, van der Waals enhancement and switches, as in all soot models.
  // soot.sootDensity is the mass of carbon per volume of soot, 1800 kg/m3 in Wang (2025, chapter 9).
  SootModelOptions soot{.sootDensity = 1800};
  std::size_t sections = 35;  // 2 to 400
  double factor = 2;          // mass ratio of neighbouring sections, above 1
  double nucleusCarbon = 0;   // carbon atoms of the first pivot; zero: of the smallest nucleus the PAH list can make
  Nucleation nucleation = Nucleation::pah;
  double nucleationFactor = 0.002;      // gamma of eq. 9-23; of Nucleation::pah
  double condensationEfficiency = 0.5;  // of a PAH's collision with an aggregate; of Nucleation::pah
  Aggregation aggregation = Aggregation::aggregates;
  double coalescenceDiameter = 0;  // m; who is smaller (as a sphere) melts into its partner; zero: nobody does
  ActiveSites activeSites = ActiveSites::aggregate;
  GrowthScheme growthScheme = GrowthScheme::upwind;
  CollisionKernelType kernel = CollisionKernelType::transition;  // or freeMolecular

  // Break-up of aggregates by oxidation, into halves. Off by default, as in Wang (2025).
  SootFragmentation fragmentation;

  // Loss of the hydrogen that PAH brought, A exp(-E/RT) (Dobbins 2002). Off by default, as in Wang (2025).
  bool carbonisation = false;
  double carbonisationRate = 1.78e6;    // A, 1/s
  double carbonisationEnergy = 1.13e5;  // E, J/mol
};

// Gas species: H, H2, OH, H2O, O2, C2H2, CO, then the PAH of the list. Scalars: aggregates of all sections, then their
// primaries (not of spheres), then hydrogen (with carbonisation). What grows out of the last section stays in it: no
// growth or condensation there, and a coagulated mass above its pivot counts as more than one aggregate of it.
// Not for several threads at once: an object keeps its work space.
class SectionalSoot final : public SootModel {
 public:
  explicit SectionalSoot(const SectionalSootOptions& options);  // throws InputError
  ~SectionalSoot() override;

  [[nodiscard]] const std::vector<std::string>& gasSpecies() const override;
  [[nodiscard]] const std::vector<ParticleScalar>& scalars() const override;
  // Aggregates, primaries, surface of the equivalent spheres, carbon and its second moment; hydrogen.
  [[nodiscard]] std::vector<std::vector<double>> gridSums() const override;
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) const override;
  void jacobian(const ParticleGas& gas, std::span<const double> densities, std::span<double> values) const override;
  void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const override;
  [[nodiscard]] ParticleProperties properties(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] ParticleProcesses processes(const ParticleGas& gas, std::span<const double> densities) const override;
  [[nodiscard]] double volumeFraction(std::span<const double> densities) const override;
  void addSpheres(double count, double volume, std::span<double> densities) const override;
  [[nodiscard]] double volumeFractionAtLimit(std::span<const double> densities) const override;
  [[nodiscard]] SizeDistribution sizeDistribution(std::span<const double> densities) const override;

  [[nodiscard]] std::size_t sections() const;
  [[nodiscard]] std::span<const double> pivots() const;  // kg of carbon
  [[nodiscard]] const SectionalSootOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lampblack::particles
