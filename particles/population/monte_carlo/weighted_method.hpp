// The jumps of the methods whose numerical particles have different weights, for any type of particles. There is room
// for options.particles numerical particles in 1 m3; no sample grows, shrinks or is doubled.
//
// Two numerical particles coagulate at max(w_i, w_j) / alpha K (Wang 2025, eqs. 4-5, 5-5): then alpha min(w_i, w_j)
// real ones of each do, and the rest of each is left over. What the methods do with one particle too many:
// - mmc (alpha = 1; Zhao, Zheng, Xu 2005): there is none in coagulation. A nucleus or fragment adds its weight to the
//   particle of the most similar volume, which conserves number, not mass: biased wherever volumes differ. Events that
//   did so with different volumes are counted as `limited`.
// - sammc (Wang 2025, chapter 5): the two nearest neighbours are merged into their mean before. Number and mass
// conserved;
//   moments above the first lose w_k w_l / (w_k + w_l) (v_k - v_l)^2 and more.
// - samwfmc (Wang 2025, chapter 4): what is left of the one with the smaller weight goes into the particle nearest in
// volume,
//   the weight of which changes so that mass is conserved; number is not, by the relative difference of the volumes.
//   Coagulation, deposition and growth only.
// - wfmc (Jiang and Chan 2021): one of the two left-overs is removed at random and the other takes its mass. Mass is
//   conserved; all other moments are in the mean, see coagulateLeftOvers(). Processes as samwfmc.
// - swa (Patterson, Wagner, Kraft 2011): i becomes i + j with the weight gamma(i, j), j stays, at the rate K w_j. With
//   gamma(i, j) w_j + gamma(j, i) w_i = w_i w_j, which holds for all three transfer functions, every moment has the
//   right mean. Mass is conserved exactly by WeightTransfer::mass, in the mean by the others; number in the mean.
//   Where other processes add particles, neighbours are merged as in sammc.
//
// In all: a deposited or vanished particle is replaced by halving the one with the highest weight (Wang 2025, section
// 5.2.8), once the population has been full. Nuclei stand for nucleusWeight() real ones each, fragments for as many as
// their parent.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "particles/population/monte_carlo/deferred_growth.hpp"
#include "particles/population/monte_carlo/growth_step.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/population/monte_carlo/jump_process.hpp"
#include "particles/population/monte_carlo/systematic_sample.hpp"
#include "particles/population/monte_carlo/weighted_rates.hpp"
#include "particles/population/monte_carlo/weighted_statistics.hpp"

namespace lampblack::particles {

template <ParticleType Type, class Store>
class WeightedMethod {
 public:
  using Entry = typename Store::Entry;
  using Particle = typename Type::Particle;

  WeightedMethod(const Type& type, const PopulationModel& model, const InitialPopulation& initial,
                 const MonteCarloOptions& options, RandomStream& random)
      : type_(type),
        method_(options.method),
        transfer_(options.transfer),
        breakage_(model.breakage),
        growth_(model.growth),
        alone_(!model.coagulation && !model.breakage && !model.deposition && !model.nucleation),
        capacity_(options.particles),
        nucleusWeight_(options.nucleusWeight > 0 ? options.nucleusWeight : initialWeight(initial, options)),
        store_(WeightedRates<Type>(type, model, options)),
        first_{type.make(1), 0},
        second_{type.make(1), 0} {
    if (model.nucleation) {
      nucleusVolume_ = model.nucleation->volume;
      nucleus_ = type.make(nucleusVolume_);
    }
    std::vector<Entry> entries;
    if constexpr (bundles) {
      if (method_ == MonteCarloMethod::sammc && options.fraction == FractionFunction::one)
        store_.setBundledGrowth(options.bundledGrowth);
    }
    for (const auto& [volume, weight] : initialParticles(initial, capacity_, options.initialWeights, random))
      entries.push_back({type.make(volume), weight});
    for (const Entry& entry : entries) track(entry, 1);
    putIn_ = held_;
    assign(std::move(entries));
    filled_ = store_.size() >= capacity_;
    retune();
    measureGrowth();
  }

  [[nodiscard]] double coagulationRate() const { return store_.pairRate(); }
  bool coagulate(RandomStream& random);
  [[nodiscard]] double breakageRate() const { return store_.singleRate(SingleProcess::breakage); }
  bool breakUp(RandomStream& random);
  [[nodiscard]] double depositionRate() const { return store_.singleRate(SingleProcess::deposition); }
  bool deposit(RandomStream& random);
  [[nodiscard]] double condensationRate() const { return store_.singleRate(SingleProcess::condensation); }
  bool condense(RandomStream& random);
  void nucleate(RandomStream& random);
  [[nodiscard]] double nucleusWeight() const { return nucleusWeight_; }

  void grow(double dt);
  [[nodiscard]] double growthStep() const { return growthStep_; }
  // For populations in a gas that changes and that grow by laws of their own. f(Particle&, weight) -> bool changes a
  // particle, false drops it.
  template <class F>
  void changeParticles(F f);
  // f(const Particle&, weight).
  template <class F>
  void forEachParticle(F f) const {
    store_.forEach([&](const Entry& entry) { f(entry.particle, entry.weight); });
  }
  // Of the type there was; rebuilds.
  void setKernel(const CollisionKernelOptions& kernel);
  // The store as made of its particles alone, without a trace of the events there were.
  void rebuild();
  // A store may hold an eighth more than there is room for, until this is asked for.
  void mergeExcess();
  // What nucleate() puts in, and for how many real ones (1/m3) that stands.
  void setNucleus(const Particle& nucleus, double weight) {
    nucleus_ = nucleus;
    nucleusWeight_ = weight;
  }
  // Replaces all particles.
  void replace(std::vector<Entry> entries);
  // Takes in the part `chance` of these, with weights that make up for the others.
  void join(const std::vector<Entry>& coming, double chance, RandomStream& random);
  // What a population in a gas keeps besides its particles and counters so that it goes on as it would have: for how
  // many real ones (1/m3) a nucleus stands, and whether the store was full. More particles than there is room for are
  // merged.
  [[nodiscard]] std::array<double, 2> memory() const { return {nucleusWeight_, filled_ ? 1.0 : 0.0}; }
  void restore(const std::array<double, 2>& memory, std::vector<Entry> entries);
  void dilute(double factor);
  void beginStep(double, double) {}
  void atTime(double) {}
  void endStep() {}

  // The volume in which the mean unit of mass resides, M_2/M_1, diverges at the gel point; held against what was put
  // in. In a sample of N equal particles it is then of the order of N^(1/3) times that (clusters of N^(2/3) at the gel
  // point, Aldous 1997), and the factor 4 corresponds to the criterion of the methods with equal weights.
  [[nodiscard]] bool gelled() const {
    if (!store_.rates().gels()) return false;
    return held_[1] / held_[0] > 4 * std::cbrt(static_cast<double>(capacity_)) * putIn_[1] / putIn_[0];
  }
  [[nodiscard]] std::array<double, 4> moments() const { return weightedMoments(type_, store_); }
  [[nodiscard]] std::vector<double> numberInBins(std::span<const double> edges) const {
    return weightedInBins(type_, store_, edges);
  }
  [[nodiscard]] double geometricDeviation() const { return weightedGeometricDeviation(type_, store_); }
  [[nodiscard]] std::size_t size() const { return store_.size(); }
  [[nodiscard]] std::size_t bytes() const { return store_.bytes(); }
  PopulationCounters& counters() { return counters_; }
  [[nodiscard]] const Store& store() const { return store_; }
  [[nodiscard]] const Type& type() const { return type_; }

 private:
  static constexpr bool mergesMany = requires(Store store) {
    store.mergeDownTo(1, [](const Entry& e, const Entry&) { return e; });
  };
  static constexpr bool bundles = requires(Store store) { store.collected(); };
  // By which volumes change in a step. Splitting has an error of second order in it, deferment none.
  static constexpr double growthPart = isDeferred<Type> ? 0.3 : 0.05;

  void put(const Particle& particle, double weight) {
    const Entry entry{particle, weight};
    track(entry, 1);
    store_.insert(entry);
  }
  // The particle will be put in soon.
  void expect(const Particle& particle, double weight) {
    if constexpr (requires { store_.expect(Entry{particle, weight}); }) store_.expect({particle, weight});
  }
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q, double times) const {
    if constexpr (requires { type_.coagulated(p, q, times); }) {
      if (times > 1) return type_.coagulated(p, q, times);
    }
    return type_.coagulated(p, q);
  }
  void taken(const Entry& entry) { track(entry, -1); }
  void track(const Entry& entry, double sign) {
    if (!store_.rates().gels()) return;
    const double v = type_.volume(entry.particle), mass = sign * entry.weight * v;
    held_[0] += mass;
    held_[1] += mass * v;
  }
  void assign(std::vector<Entry> entries);
  [[nodiscard]] std::vector<Entry> takeAll();  // in the order of the store
  void retune();
  void measureGrowth();

  [[nodiscard]] Entry meanOf(const Entry& a, const Entry& b) const {
    const double weight = a.weight + b.weight;
    if constexpr (WeightedRates<Type>::bare) {  // to the last bit where both are the same
      if (a.particle.volume == b.particle.volume) return {a.particle, weight};
    }
    return {type_.mean(a.particle, a.weight, b.particle, b.weight), weight};
  }
  void makeRoom(std::size_t count);
  bool mergeDownTo(std::size_t count);
  void refill();
  void add(const Particle& particle, double weight, std::size_t copies = 1);
  void coagulateLeftOvers(const Entry& i, double leftI, const Entry& j, double leftJ, RandomStream& random);
  bool coagulateFractions(RandomStream& random);
  bool transferWeight(RandomStream& random);

  Type type_;
  MonteCarloMethod method_;
  WeightTransfer transfer_;
  std::optional<BreakageOptions> breakage_;
  GrowthOptions growth_;
  bool alone_, filled_ = false;
  std::size_t capacity_, sinceTuned_ = 0;
  double nucleusWeight_;  // 1/m3
  double growthStep_ = 0;
  double nucleusVolume_ = 0;  // m3
  std::optional<Particle> nucleus_;
  Store store_;
  Entry first_, second_;
  std::array<double, 2> held_{}, putIn_{};  // sums of w v and w v^2, of kernels that may gel
  PopulationCounters counters_;
};

}  // namespace lampblack::particles

#include "core/modules.hpp"
#include "particles/population/monte_carlo/weighted_events.hpp"
