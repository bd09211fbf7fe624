// A resolved soot population: equally weighted spheres in a sample volume, by direct simulation Monte Carlo with
// doubling and contraction (Bird 1994; Goodson and Kraft 2002; Shekar et al. 2011, section 2.3). Coagulation and
// inception are stochastic, with fictitious jumps under a bound of the kernel; condensation, surface growth and
// oxidation act on every particle, by Strang splitting. The gas is given and is not changed: the flow carries the
// two-equation model, and an ensemble resolves it along a trajectory (the decoupled solution).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "particles/dimer.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/soot_gas.hpp"
#include "particles/surface_chemistry.hpp"

namespace lampblack {

struct EnsembleOptions {
  std::size_t capacity = 4096;  // most particles at a time, at least 2
  std::uint64_t seed = 1;
  std::uint64_t owner = 0;  // global trajectory, cell or repeat: makes the random numbers independent of the rank
  SootModelOptions soot;
  CoagulationKernel kernel = CoagulationKernel::transition;
  double verificationScale = 1;  // of the constant (m3/s) and additive (m3/s/kg) kernels
  // Number density (1/m3) at which an ensemble that starts empty is full. Too small a guess costs some events, as
  // contraction adapts the sample volume; too large a guess costs resolution until doubling begins.
  double expectedNumberDensity = 1e12;
  double splitTolerance = 0.05;  // relative change of the population in one splitting step
};

class Ensemble {
 public:
  struct Counters {
    std::uint64_t coagulations = 0, fictitious = 0, inceptions = 0;
    std::uint64_t doublings = 0, contractions = 0;
    std::uint64_t oxidised = 0;  // particles removed because they shrank below the smallest nucleus
    std::uint64_t splitSteps = 0;
  };

  explicit Ensemble(EnsembleOptions options);  // throws InputError

  // Replaces the population: one particle for each mass (kg), all of one hydrogen mass fraction, together at
  // `numberDensity` (1/m3). Throws InputError for more particles than the capacity or masses that are not positive.
  void initialise(std::span<const double> masses, double hydrogenMassFraction, double numberDensity);

  // Advances over `dt` (s) in the given gas; `dilutionRate` (1/s) is d ln(sample volume)/dt, the divergence of the
  // particles' velocity. Throws NumericsError for a gas that is not physical.
  void advance(const SootGasState& gas, double dilutionRate, double dt);

  [[nodiscard]] std::size_t size() const { return masses_.size(); }
  [[nodiscard]] double sampleVolume() const { return sampleVolume_; }  // m3
  [[nodiscard]] double numberDensity() const { return static_cast<double>(size()) / sampleVolume_; }
  [[nodiscard]] double massDensity() const;      // kg/m3
  [[nodiscard]] double hydrogenDensity() const;  // kg/m3
  [[nodiscard]] double volumeFraction() const { return massDensity() / options_.soot.sootDensity; }
  // Sum over particles of volume^order per m3, m^(3 order - 3); `order` may be fractional.
  [[nodiscard]] double moment(double order) const;
  [[nodiscard]] double meanDiameter() const;                // m, by number; zero when empty
  [[nodiscard]] double geometricStandardDeviation() const;  // of diameter by number; one when empty
  // dN/dlog10(d) (1/m3) in `bins` equal bins of log10(d/m) from `logMin` to `logMax`; particles outside are left out.
  [[nodiscard]] std::vector<double> sizeDistribution(double logMin, double logMax, std::size_t bins) const;

  [[nodiscard]] std::span<const double> masses() const { return masses_; }            // kg
  [[nodiscard]] std::span<const double> hydrogenMasses() const { return hydrogen_; }  // kg
  [[nodiscard]] std::span<const double> diameters() const { return diameters_; }      // m
  [[nodiscard]] const Counters& counters() const { return counters_; }
  [[nodiscard]] const EnsembleOptions& options() const { return options_; }

  // The exact state, for restarts: an ensemble of the same options that restores it continues bit for bit.
  [[nodiscard]] std::vector<double> save() const;
  void restore(std::span<const double> state);  // throws InputError for what save() did not write

 private:
  struct Medium;  // the gas, digested once per advance
  [[nodiscard]] double dimerCollisionSum(const Medium& medium) const;
  [[nodiscard]] double dimerNumber(const Medium& medium, double collisionSum) const;
  [[nodiscard]] double splitStep(const Medium& medium, double dilutionRate, double remaining) const;
  [[nodiscard]] double newborn(const Medium& medium) const;  // the longest splitting step for particles born in it, s
  struct Fluxes {
    double condensation = 0;           // dimers times their mass times the collision prefactor
    double growth = 0, oxidation = 0;  // kg carbon/m2/s
  };
  // Of the population at the middle of a step of growth.
  [[nodiscard]] Fluxes fluxes(const Medium& medium, double dt) const;
  void grow(const Medium& medium, double dt);
  void jump(const Medium& medium, double dt);
  struct Jumps;  // the population while it jumps
  // Returns by how much the collision sum of the population with dimers changes.
  double incept(const Medium& medium, Jumps& jumps);
  [[nodiscard]] CollisionKernelOptions kernelOptions(const SootGasState& gas) const;
  [[nodiscard]] bool depleted(std::size_t particles) const;  // so that all are to be copied
  void removeParticle(std::size_t i);
  bool doubleIfDepleted();
  void restart();

  EnsembleOptions options_;
  DimerModel dimers_;
  RandomStream random_;
  std::vector<double> masses_, hydrogen_, diameters_;
  double initialVolume_, sampleVolume_;
  bool filled_ = false;  // doubling begins once the ensemble has been full
  Counters counters_;
};

}  // namespace lampblack
