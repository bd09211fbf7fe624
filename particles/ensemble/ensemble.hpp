// A stochastic soot population with all processes of soot, by any of four methods: equal weights with doubling and
// contraction (dsmc), weighted particles whose neighbours are merged (sammc), the stochastic weighted algorithm with
// the transfer of weights that conserves mass (swa), or weighted particles of which pairs are drawn in time steps
// (pairs). Nuclei from dimers, coagulation in all regimes, condensation, growth and oxidation; dilution by the
// divergence of the particles' velocity. The gas is given and is not changed, but what is taken from it and given to it
// is reported: the same atoms that the soot gains, to round-off.
//
// The gas's dimers play the part of the transfer species of a decoupled solution (Kraft 2022): their number is
// made to follow the gas's PAH at all times, and particles begin and grow by them.
//
// Splitting: jumps for half a step, growth for a whole one, jumps for half a step; steps over which the population
// changes by `splitTolerance`. docs/theory/stochastic_soot.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/population/population_solver.hpp"
#include "particles/soot/soot_aggregate.hpp"
#include "particles/stochastic/particle_rows.hpp"

namespace lampblack::particles {

enum class EnsembleMethod { dsmc, sammc, swa, pairs };

struct EnsembleOptions {
  EnsembleMethod method = EnsembleMethod::dsmc;
  std::size_t particles = 2000;  // most numerical ones, at least 8
  std::uint64_t seed = 1;
  std::uint64_t owner = 0;  // global trajectory and repeat: makes the random numbers independent of the rank
  SootModelOptions soot;
  // Of coagulation; the gas gives its gas, and soot its enhancement and slip. The kernels with exact solutions are
  // there for verification.
  CollisionKernelOptions kernel{.type = CollisionKernelType::transition};
  SootShape shape = SootShape::spheres;
  double fractalDimension = 0;    // SootAggregate: of particles by volume and surface
  bool alphaOfPrimaries = false;  // mu_1 in alpha(T, mu_1) is of the mean primary (Wang 2025, eq. 9-37), not particle
  bool keepsHydrogen = true;      // false: that of PAH returns to the gas as H2 when they are taken up
  // Growth, condensation and oxidation in whole events, as often as chance has it, not as their mean: where particles
  // are of few atoms, they then differ by how many events they had.
  bool growthByEvents = false;
  double splitTolerance = 0.01;  // relative change of the population in a splitting step
  // sammc: the share of its volume that a particle may take up of small ones at once; 0: one by one. Saves most of the
  // events where new particles are many; the growth of the second moment by them is too large by at most half of it.
  double bundledGrowth = 0;
  // 1/m3, that fewer particles are not resolved: with different weights, those born where there are as many or fewer
  // stand for this over the capacity. Zero: the first trace of soot is.
  double leastNumberDensity = 0;
  // 1/m3: dsmc, at which a sample that is or becomes empty is full at least; more where more are born at once.
  double startNumberDensity = 1e6;
};

[[nodiscard]] inline SootAggregate sootAggregate(const EnsembleOptions& options) {
  return {options.soot.sootDensity, options.shape, options.fractalDimension};
}

// What a population took from (negative) and gave to the gas and what happened to its own mass, summed over the steps
// since the last look, per m3 of the gas of each moment.
struct EnsembleExchange {
  SootSpeciesArray gas{};                          // mol/m3
  double nucleatedNumber = 0, oxidisedNumber = 0;  // 1/m3
  // Soot mass, kg/m3; oxidation positive.
  double nucleated = 0, condensed = 0, grown = 0, oxidisedO2 = 0, oxidisedOH = 0;
  double carbon = 0, hydrogen = 0;  // of the soot, by all of these: kg/m3
  // By dilution; and by numerical particles that come and go, which is zero in the mean. sammc: always; swa: carbon and
  // hydrogen together always. kg/m3.
  double dilutedCarbon = 0, dilutedHydrogen = 0, resampledCarbon = 0, resampledHydrogen = 0;
  double joinedCarbon = 0, joinedHydrogen = 0;  // by join(), in the mean: kg/m3
};

class Ensemble {
 public:
  virtual ~Ensemble() = default;

  // Replaces the population. dsmc: all numbers have to be equal. Throws InputError for more particles than there is
  // room, and for what is not positive.
  virtual void initialise(std::span<const GivenParticle> population) = 0;

  // Most numerical particles from now on: eight at least, `particles` at most. Method pairs only, others keep these.
  virtual void setRoom(std::size_t particles) = 0;
  // Over dt (s) in the given gas; `dilution` (1/s) is the divergence of the particles' velocity. Throws NumericsError
  // for a gas that is not physical.
  virtual void advance(const ParticleGas& gas, double dilution, double dt) = 0;
  // Multiplies all numbers per volume: the gas grew by 1/factor.
  virtual void dilute(double factor) = 0;
  // All particles, by size.
  [[nodiscard]] virtual std::vector<GivenParticle> particles() const = 0;
  // Particles of another population come in: of each `share` times its number per m3 in the mean. Equal weights: as
  // many copies of the sample's own weight; otherwise `share` of the numerical particles with the numbers they have, so
  // that one leaves and joins for what flows. Who joins is drawn by this population's random numbers; numbers of more
  // than there is room for are contracted or merged as the method does.
  virtual void join(std::span<const GivenParticle> particles, double share) = 0;
  // Since it was asked for last.
  [[nodiscard]] virtual EnsembleExchange takeExchange() = 0;
  // Of the last advance(): particles looked at in its splitting steps, and events. What the next one of that length
  // will cost is likely about the same; the same on every machine.
  [[nodiscard]] virtual double cost() const = 0;

  // The complete state (packed_ensemble.hpp), with whose random numbers it draws: a population of the same options that
  // unpacks it goes on to the same bits, whether it was saved, went to another rank or stayed. Throws InputError for
  // what pack() did not write.
  [[nodiscard]] virtual std::vector<double> pack() const = 0;
  virtual void unpack(std::span<const double> state) = 0;

  [[nodiscard]] virtual std::size_t size() const = 0;
  // Carbon, hydrogen in kg/m3; number of particles and of primaries in 1/m3; surface in m2/m3.
  struct Totals {
    double number = 0, carbon = 0, hydrogen = 0, primaries = 0, surface = 0;
    double diameters = 0;  // of mobility, m/m3
    [[nodiscard]] double mass() const { return carbon + hydrogen; }
    [[nodiscard]] double meanDiameter() const { return number > 0 ? diameters / number : 0; }  // m, by number
  };
  [[nodiscard]] virtual Totals totals() const = 0;
  // Sum over particles of volume^order per m3.
  [[nodiscard]] virtual double moment(double order) const = 0;
  [[nodiscard]] virtual double geometricDeviation() const = 0;  // of the mobility diameter by number; 1 when empty
  [[nodiscard]] virtual const PopulationCounters& counters() const = 0;
  [[nodiscard]] virtual const EnsembleOptions& options() const = 0;

  [[nodiscard]] double volumeFraction() const { return totals().mass() / options().soot.sootDensity; }
};

// Throws InputError.
[[nodiscard]] std::unique_ptr<Ensemble> makeEnsemble(EnsembleOptions options);

}  // namespace lampblack::particles
