// Inside of SectionalSoot: its data, and its rates at one state, digested. Not for other models.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "particles/models/sectional/sectional_soot.hpp"
#include "particles/models/sectional/sectional_soot_flux.hpp"
#include "particles/models/sectional/sectional_soot_pah.hpp"
#include "particles/models/sectional/sectional_soot_pairs.hpp"
#include "particles/models/sectional/sectional_soot_shapes.hpp"
#include "particles/soot/surface_chemistry.hpp"

namespace lampblack::particles {

struct SectionalSoot::Impl : SootSpecies {
  // Events of surface chemistry per area, mol/m2/s, and by ln(alpha).
  struct Surface {
    double growth = 0, oxidationO2 = 0, oxidationOH = 0;
  };

  // A state, digested by prepare().
  struct State {
    double temperature = 0;
    std::vector<double> aggregates, primaries;  // 1/m3, not negative; primaries of spheres stay empty
    double hydrogen = 0;                        // kg/m3, not negative
    double number = 0, carbon = 0;              // sums over the sections: 1/m3, kg/m3
    SootSpeciesArray gas{};                     // mol/m3, not negative
    double size = 0;                            // mu_1, carbon atoms
    double alpha = 0;
    Surface surface;
    SectionFlux up, down;          // by growth and condensation, by oxidation
    std::vector<double> breaking;  // of an aggregate of each section, 1/s
    // Sums over the sections: events of growth and oxidation, mol/m3/s; carbon condensed, kg/m3/s.
    double growth = 0, byO2 = 0, byOH = 0, condensed = 0;
    double dehydrogenation = 0;  // 1/s
    SectionPah::Uptake uptake;
  };

  explicit Impl(const SectionalSootOptions& wanted);

  [[nodiscard]] std::size_t numberScalars() const { return scalars.size(); }
  [[nodiscard]] std::size_t hydrogenScalar() const { return scalars.size() - 1; }  // with carbonisation
  [[nodiscard]] static Surface surface(const SurfaceChemistry& chemistry, const SootSpeciesArray& gas, double alpha);
  [[nodiscard]] double meanSize(double carbon, double number) const;
  // Primaries of an aggregate as they are moved with it; not bounded as in its shape.
  [[nodiscard]] double primaryRatio(std::size_t i) const {
    if (spheres || !(state.aggregates[i] > 1e-6 * numberScale[i])) return 0;
    return state.primaries[i] / state.aggregates[i];
  }
  // Number whose mean size is mu_1, 1/m3.
  [[nodiscard]] double sizeNumber() const;
  [[nodiscard]] SectionPairs::Gas collisionGas(const ParticleGas& gas) const;
  void prepareSections(std::span<const double> densities);                  // what does not depend on the gas
  void prepare(const ParticleGas& gas, std::span<const double> densities);  // throws NumericsError
  void sources(std::span<double> rates, std::span<double> exchange);
  void jacobian(const ParticleGas& gas, std::span<const double> densities, std::span<double> values);
  // Parts of the Jacobian; `spare`: a column that is zero, and will be again.
  struct Assembly;
  void addSections(Assembly& a);
  void addSurface(Assembly& a, std::size_t column, const Surface& by);
  void addProduct(Assembly& a, std::size_t column, std::span<const double> row);
  void addActiveSites(Assembly& a, const SurfaceChemistry& chemistry, std::size_t spare);
  void addDimers(Assembly& a, std::size_t spare);
  void addGas(Assembly& a, const SurfaceChemistry& chemistry);
  void addExchange(Assembly& a);

  SectionalSootOptions options;
  std::vector<double> pivots;   // kg
  std::vector<double> toUpper;  // kg, to the next pivot
  std::vector<double> toLower;  // kg, to the pivot below, of the first to nothing
  double carbonMass;            // kg of an atom
  bool spheres, withHydrogen;
  std::size_t sections, pahs;
  // Where half an aggregate goes: sections below, numbers in halves and shares of primaries at the lower pivot.
  struct Halves {
    std::size_t below = 1;
    double number[2] = {1, 0}, primaries[2] = {1, 0};
  } halves;
  std::vector<std::string> species;
  std::vector<ParticleScalar> scalars;
  std::vector<double> numberScale;  // 1/m3, below which a section counts as empty for its n_p
  SectionShapes shapes;
  SectionPairs pairs;
  SectionPah pah;
  State state;
  // Of the Jacobian.
  std::vector<double> work, fullRow;
  std::array<std::vector<double>, 2> perSection;
  SectionPah::Uptake spareUptake;
};

}  // namespace lampblack::particles
