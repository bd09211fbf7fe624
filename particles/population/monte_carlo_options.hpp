// The choices of the Monte Carlo methods.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/modules.hpp"
#include "particles/population/population_solver.hpp"

namespace lampblack::particles {

enum class MonteCarloMethod {
  // Equal weights.
  dsmc,                    // doubling when half empty, contraction when full (Goodson and Kraft 2002)
  constantVolume,          // stepwise: doubled below N/2, halved above 2N (Maisels, Kruis, Fissan 2004)
  constantNumberByMass,    // one copied or removed after each event, weights keep M1 (Smith and Matsoukas 1998)
  constantNumberByNumber,  // or M0 (Lin, Lee, Matsoukas 2002)
  // Different weights.
  mmc,      // multi-Monte Carlo (Zhao, Zheng, Xu 2005)
  wfmc,     // weighted fraction (Jiang and Chan 2021)
  samwfmc,  // sorting, what is left over is merged into a neighbour (Wang 2025, chapter 4)
  sammc,    // sorting, the two nearest neighbours are merged (Wang 2025, chapter 5)
  swa,      // stochastic weighted algorithm (Patterson, Wagner, Kraft 2011)
  pairs,    // pairs drawn in time steps (pair_sampling.hpp)
  // Small particles as numbers, large ones as particles (Boje, Akroyd, Kraft 2019).
  hybrid
};

enum class FractionFunction { one, hyperbolic, exponential, stepwise, constant };
enum class FractionOf { volumes, weights };  // what the fraction functions compare (Wang 2025, chapters 4 and 5)
enum class MergingDifference { absolute, relative };  // of the volumes of neighbours (Wang 2025, eqs. 5-11, 5-12)
enum class WeightTransfer { harmonic, half, mass };   // w_i w_j/(w_i+w_j), w_i/2, w_i m_i/(m_i+m_j)
enum class EventRates { majorant, exact };  // fictitious jumps in O(log N), or the O(N) bookkeeping of Wang (2025)
// Nuclei at random times, or one in each interval of the integral of the nucleation rate that is as long as its weight:
// the same mean with hardly any noise.
enum class NucleationSampling { random, even };

// How the particles of a weighted method divide the initial population: each holds at most 4/N_s of any of M_0 to M_3,
// or each stands for as many real ones (initial_sample.hpp).
enum class InitialWeights { moments, equal };

struct MonteCarloOptions {
  MonteCarloMethod method = MonteCarloMethod::dsmc;
  std::size_t particles = 2000;  // numerical particles, N_s; at least 2
  std::uint64_t seed = 1;
  std::uint64_t repeat = 0;  // with the seed the key of the random numbers
  EventRates rates = EventRates::majorant;
  FractionFunction fraction = FractionFunction::one;
  FractionOf fractionOf = FractionOf::volumes;
  // sammc: the share of a particle's volume that it may take up of small ones at once, 0: one by one (TwoLevelStore).
  double bundledGrowth = 0;
  double fractionConstant = 1;  // C in (0, 1], of FractionFunction::constant
  MergingDifference merging = MergingDifference::relative;
  WeightTransfer transfer = WeightTransfer::mass;
  NucleationSampling nucleation = NucleationSampling::even;
  double nucleusWeight = 0;  // real particles (1/m3) a nucleus of a weighted method stands for; zero: N0 / particles
  InitialWeights initialWeights = InitialWeights::moments;  // of the weighted methods
  // Number density at which an ensemble that starts empty is full; needed there.
  double expectedNumber = 0;  // 1/m3
  // pairs: what a candidate pair is to happen with at most, and by which part other processes and coagulation may
  // change the population in a step.
  double pairProbability = 0.2, splitChange = 0.1;
  std::size_t threshold = 0;  // largest size, in nuclei, that the hybrid method keeps as a number
};

// For coalescing spheres; other types by shipped_types.hpp, one of your own by populationOf() in population_of.hpp.
// Throws InputError.
[[nodiscard]] std::unique_ptr<PopulationSolver> makeMonteCarlo(const PopulationModel& model,
                                                               const InitialPopulation& initial,
                                                               const MonteCarloOptions& options);

}  // namespace lampblack::particles
