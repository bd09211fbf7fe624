// Inside of SectionalSoot: how PAH become soot, as nuclei and by condensation on the sections. Not for other models.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/models/sectional/sectional_soot.hpp"
#include "particles/models/sectional/sectional_soot_shapes.hpp"
#include "particles/soot/dimer.hpp"

namespace lampblack::particles {

class SectionPah {
 public:
  struct Nuclei {
    double rate = 0;        // 1/m3/s
    std::size_t lower = 0;  // pivots lower and lower + 1
    double share = 1;       // of the number that goes to `lower`
    double carbon = 0;      // kg/m3/s
  };
  struct Uptake {
    std::array<Nuclei, maximumPahSpecies> nuclei{};
    std::size_t kinds = 0;                    // of nuclei
    PahArray consumption{};                   // mol/m3/s of each PAH
    std::vector<double> condensation, slope;  // kg of carbon/s on an aggregate of each section; its derivative by n_p
    // With dimers: their number (1/m3) and production (1/m3/s); collisions with an aggregate (m3/s) and by n_p; and
    // d ln(number) / d (sum of collisions of aggregates, 1/s).
    double dimers = 0, production = 0, bySum = 0;
    std::vector<double> collision, collisionSlope;
  };

  SectionPah(const SectionalSootOptions& options, std::span<const double> pivots);  // throws InputError
  // Carbon atoms of the smallest nucleus; throws InputError without a PAH.
  [[nodiscard]] static double smallestNucleus(const SectionalSootOptions& options);

  [[nodiscard]] Uptake makeUptake() const;
  // `concentrations`: of the PAH, mol/m3, not negative. Nothing condenses on the last section.
  void evaluate(double temperature, std::span<const double> concentrations, const SectionShapes& shapes,
                std::span<const double> aggregates, Uptake& uptake) const;
  // Changes of the consumption of each PAH (mol/m3/s) with the aggregates: with one more, and with n_p of one section.
  [[nodiscard]] bool consumptionByAggregates() const { return !dimers_; }
  // Of PAH k by an aggregate of section i, mol/s, and by n_p; without dimers.
  void addConsumption(double temperature, double concentration, const SectionShapes& shapes, std::size_t k,
                      std::span<double> perAggregate, std::span<double> slope) const;

 private:
  struct Molecule {
    double carbon, mass, diameter;  // atoms, kg, m
    std::vector<double> root;       // sqrt(1/mass + 1/pivot)
  };
  [[nodiscard]] Nuclei divideBetweenPivots(double rate, double carbonMass) const;

  SectionalSootOptions options_;
  DimerModel dimerModel_;
  std::vector<double> pivots_;
  std::vector<Molecule> molecules_;
  double carbonMass_;  // kg of an atom
  bool dimers_;
};

}  // namespace lampblack::particles
