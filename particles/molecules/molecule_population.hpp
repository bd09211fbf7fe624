// A stochastic population of particles of molecules in a given gas: molecules become particles, particles collide,
// molecules condense, each molecule reacts at its edge (pah/), primaries sinter. Equal weights with doubling and
// contraction (EqualWeightMethod). The gas is not changed, but what is taken from it and given to it is reported: the
// same atoms that the particles gain, to round-off.
//
// Splitting (Strang 1968): collisions and inception by jumps for half a step, condensation, growth and sintering for
// all of it, jumps for half a step, of a length over which the population changes by `splitTolerance`.
// docs/theory/molecules_in_particles.md.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"
#include "particles/molecules/molecule_options.hpp"
#include "particles/molecules/molecule_particles.hpp"
#include "particles/pah/molecule_growth.hpp"
#include "particles/population/engine/even_births.hpp"
#include "particles/population/model/nucleation_schedule.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"
#include "particles/stochastic/particle_rows.hpp"
#include "particles/stochastic/size_bins.hpp"

namespace lampblack::particles {

inline constexpr std::uint32_t moleculeStream = 0x4d4f4c45;  // which random numbers of an owner are those of molecules

class MoleculePopulation {
 public:
  using Method = EqualWeightMethod<MoleculeParticles, ClassStore<EqualRates<MoleculeParticles>>>;

  // InputError.
  explicit MoleculePopulation(const MoleculeOptions& options);
  MoleculePopulation(const MoleculePopulation&) = delete;
  MoleculePopulation& operator=(const MoleculePopulation&) = delete;

  // Replaces the population by these particles, `number` (1/m3) in all.
  void fill(const std::vector<MoleculeParticle>& particles, double number);
  [[nodiscard]] const MoleculeParticles& type() const { return type_; }
  // A particle of so many molecules of the gas.
  [[nodiscard]] MoleculeParticle ofGas(std::size_t molecules) const {
    return type_.made(MoleculesOfPrimary(molecules, ofGas_));
  }

  // Over dt (s); the gas has the concentrations of species(), in their order. NumericsError.
  void advance(const ParticleGas& gas, double dt);
  void dilute(double factor) {  // all numbers per volume
    method_.dilute(factor);
    births_.dilute(factor);
  }
  [[nodiscard]] MoleculeExchange takeExchange() { return std::exchange(exchange_, {}); }

  [[nodiscard]] std::size_t size() const { return method_.size(); }
  [[nodiscard]] double weight() const { return method_.weight(); }  // 1/m3 for a numerical particle
  [[nodiscard]] bool wasFull() const { return method_.memory()[1] != 0; }
  [[nodiscard]] MoleculeTotals totals() const;
  // f(particle, number), 1/m3.
  template <class F>
  void forEach(F f) const {
    method_.forEachParticle(f);
  }
  [[nodiscard]] const PopulationCounters& counters() const { return const_cast<Method&>(method_).counters(); }
  [[nodiscard]] std::uint64_t fused() const { return fused_; }  // pairs of primaries that became one
  // Of the last advance(), as Ensemble::cost().
  [[nodiscard]] double cost() const { return cost_; }

  // The complete state, for restore() after a rejected step.
  struct State {
    std::vector<MoleculeParticle> particles;
    std::array<double, 2> memory{};
    std::uint64_t position = 0, fused = 0;
    EvenBirths::Memory births{};
    double clock = 0;
    MoleculeExchange exchange;
    PopulationCounters counters;
  };
  [[nodiscard]] State save() const;
  void restore(const State& state);
  // In rows of moleculeRows.
  [[nodiscard]] std::vector<double> pack() const;
  void unpack(std::span<const double> state);
  // As TreePopulation::join().
  void join(std::span<const double> rows, double share);

 private:
  // What the events of the loop do here.
  struct Events {
    MoleculePopulation& of;
    double weight = 0;  // before the event, 1/m3
    void look() {}
    void setTime(double time) {
      of.type_.trees().clock() = time;
      weight = of.method_.weight();
    }
    void giveBirth();
    template <class Process>
    void take(const Process&, bool happened) {
      if (happened)
        of.exchange_.coagulations += weight;
      else
        ++of.method_.counters().fictitious;
    }
  };
  void setGas(const ParticleGas& gas);
  [[nodiscard]] CollisionKernel::Properties properties(const MoleculeParticle& p) const {
    return {type_.volume(p), type_.mass(p), p.collision};
  }
  // 1/s, at which molecules of the gas condense on it.
  [[nodiscard]] double condensation(const MoleculeParticle& p) const;
  // 1/m3/s, of particles that are born, mean over dt from now.
  [[nodiscard]] double inception(double dt) const;
  [[nodiscard]] double stepLength(double remaining) const;
  void jump(double dt);
  void change(double dt);
  void condense(MoleculeParticle& p, double dt);
  void grow(MoleculeParticle& p, double dt);
  void sinter(MoleculeParticle& p, double dt);
  // Single molecules as the gas has them.
  void followGas();
  [[nodiscard]] bool isPairs() const { return options_.inception == MoleculeOptions::Inception::pairs; }
  [[nodiscard]] bool isOfGas(const MoleculeParticle& p) const {
    return p.molecules == 1 && p.carbon() == carbonOfGas_ && p.hydrogen() == hydrogenOfGas_;
  }
  void recordMolecules(double number, double sign);
  [[nodiscard]] const PahRates& ratesIn(const MoleculesOfPrimary& primary) const {
    return primary.size() >= options_.growthFactorFrom ? inside_ : outside_;
  }

  MoleculeOptions options_;
  MoleculeParticles type_;
  HeldMolecule ofGas_;
  double carbonOfGas_, hydrogenOfGas_;
  RandomStream random_;
  Method method_;
  EvenBirths births_;
  NucleationSchedule formation_;
  TreeSintering sintering_;
  std::vector<FusedPrimaries> fusions_;
  std::optional<CollisionKernel> kernel_;
  // Of the gas: 1/s; the part of oxidation by OH; molecules in a m3.
  PahRates outside_{}, inside_{};
  double byOH_ = 0, gasNumber_ = 0;
  CollisionKernel::Properties one_{};  // a molecule of the gas
  std::optional<MoleculeParticle> single_;
  // Of a step, in numerical particles.
  MoleculeEvents events_;
  double condensed_ = 0;
  MoleculeExchange exchange_;
  std::uint64_t fused_ = 0;
  double cost_ = 0;
};

// How particles of molecules stand in a packed population (packed_molecules.hpp).
inline constexpr ParticleRows moleculeRows{
    3 + 2 + 1 + 3 + 3 + sizeof(MoleculeExchange) / sizeof(double) + std::size(populationCounters) + 2, true, true};

}  // namespace lampblack::particles
