// What happens to a population of particles in a well-stirred volume of gas: the processes of the population balance
// equation (Wang 2025, eq. 5-1) as plain data, independent of the method that solves it. Everything in SI: volumes in
// m3, number densities in 1/m3. Benchmarks without dimensions are run with a unit volume of 1 m3.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/model/collision_kernel.hpp"

namespace lampblack::particles {

// New particles of one volume. The rate J(t), in particles per m3 and s, is constant, follows a precursor that decays
// by a first-order reaction (Wang 2025, eq. 5-22: J = K C0 exp(-K t)), or is linear between the points of a table.
struct NucleationOptions {
  enum class Source { constant, precursor, table };
  Source source = Source::constant;
  double rate = 0;            // 1/m3/s, of Source::constant
  double rateConstant = 0;    // 1/s, of Source::precursor
  double precursor = 0;       // 1/m3, number density of precursors at time zero
  std::vector<double> times;  // s, increasing; J is zero outside
  std::vector<double> rates;  // 1/m3/s
  double volume = 1;          // m3, of a nucleus
};

// Fragmentation at the rate `rate * v^exponent` (1/s) into `fragments` pieces. Equal: each has v/fragments. Uniform
// (two fragments only): one has a volume uniform in (0, v), the other the rest.
struct BreakageOptions {
  enum class Daughters { equal, uniform };
  double rate = 0;
  double exponent = 0;
  int fragments = 2;
  Daughters daughters = Daughters::equal;
};

// Continuous change of volume, dv/dt = condensation * v + surface * S, S being the particle's surface. Evaporation and
// oxidation are negative. Particles that fall below `smallestVolume` are removed and counted.
struct GrowthOptions {
  enum class Treatment {
    split,     // all particles at once, by Strang splitting with the jumps
    deferred,  // each when it is looked at, at the latest at the end of a step (LPDA; Patterson et al. 2006)
    jumps      // one monomer of volume `monomer` at a time, as a jump of the Markov process
  };
  double condensation = 0;   // 1/s
  double surfaceGrowth = 0;  // m/s, at least zero
  double oxidation = 0;      // m/s, at least zero; takes off what surfaceGrowth puts on
  double smallestVolume = 0;
  Treatment treatment = Treatment::split;
  double step = 0;     // s, of splitting or deferment; zero: chosen by the solver
  double monomer = 0;  // m3, of Treatment::jumps
  // Also where nothing grows, in steps of `step`: for particles that change by themselves, by sintering.
  bool always = false;

  [[nodiscard]] double surface() const { return surfaceGrowth - oxidation; }
  [[nodiscard]] bool active() const { return always || condensation != 0 || surfaceGrowth != 0 || oxidation != 0; }
};

// Loss of particles at the rate `rate * v^exponent` (1/s).
struct DepositionOptions {
  double rate = 0;
  double exponent = 0;
};

struct PopulationModel {
  std::optional<CollisionKernelOptions> coagulation;
  std::optional<NucleationOptions> nucleation;
  std::optional<BreakageOptions> breakage;
  std::optional<DepositionOptions> deposition;
  GrowthOptions growth;
  double dilution = 0;    // 1/s: all number densities fall by exp(-dilution t); negative for compression
  double density = 1800;  // kg/m3, of particles whose type has no density of its own
};

// A row of a table of sizes: its number lies evenly over the logarithm of the volume (and of the diameter).
struct SizeInterval {
  double from = 0, to = 0;  // m3
  double number = 0;        // 1/m3
};

// The population at time zero.
struct InitialPopulation {
  enum class Distribution { none, monodisperse, exponential, lognormal, table, modes };
  Distribution distribution = Distribution::none;
  double number = 0;                          // 1/m3, of all modes or rows
  double volume = 1;                          // m3: of all, mean, or median by number; of tables and modes the mean
  double geometricDeviation = 1;              // of diameter, of the log-normal distribution
  std::vector<SizeInterval> intervals = {};   // of a table, rising, apart or adjoining
  std::vector<InitialPopulation> modes = {};  // whose sum the population is, none of them of modes itself
};

// The population of a table, which needs at least one number above zero, and the sum of several. InputError where
// intervals do not rise, overlap, or hold numbers below zero.
[[nodiscard]] InitialPopulation tabulated(std::vector<SizeInterval> intervals);
[[nodiscard]] InitialPopulation sumOf(const std::vector<InitialPopulation>& modes);

// The populations that this one is the sum of: its modes, or itself.
[[nodiscard]] std::span<const InitialPopulation> modesOf(const InitialPopulation& initial);

// Throws InputError for what has no meaning: rates below zero, fewer than two fragments, uniform daughters of more than
// two, tables that do not increase, a kernel that lacks its gas, growth by jumps without a monomer.
void check(const PopulationModel& model, const InitialPopulation& initial);

}  // namespace lampblack::particles
