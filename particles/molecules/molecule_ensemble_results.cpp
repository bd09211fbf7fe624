// What results say of particles of molecules.
#include <cstdint>

#include "particles/collisions/sphere.hpp"
#include "particles/molecules/molecule_ensemble.hpp"
#include "particles/molecules/molecule_population.hpp"

namespace lampblack::particles {
namespace {

// What happens besides events of molecules. Those that come and go do so where the gas does not know of particles.
const std::vector<ProcessOf<MoleculeExchange>>& happenings() {
  using E = MoleculeExchange;
  static const SpeciesExchanged molecule{{MoleculeOptions::precursorAt}, {}};
  static const std::vector<ProcessOf<E>> all{
      {{{"inceptions", "1/m^3", "molecules, or pairs of them, that became a particle"}, molecule}, &E::inceptions},
      {{{"coagulations", "1/m^3", "collisions of particles that stuck"}}, &E::coagulations},
      {{{"condensations", "1/m^3", "molecules of the gas that condensed on a particle"}, molecule}, &E::condensations},
      {{{"came", "1/m^3", "single molecules that came as the gas had more of them"}}, &E::came},
      {{{"went", "1/m^3", "single molecules that went as the gas had fewer of them"}}, &E::went}};
  return all;
}

// Of one event of the edge, where both O2 and OH oxidise.
SpeciesExchanged exchangedBy(std::size_t process) {
  std::array<double, pahProcessCount> events{};
  events[process] = 1;
  std::array<double, SootSpecies::fixed + 1> gas{};
  addGasOfEvents(events, 0.5, gas);
  SpeciesExchanged exchanged;
  for (std::size_t k = 0; k < gas.size(); ++k)
    if (gas[k] != 0) (gas[k] < 0 ? exchanged.takes : exchanged.gives).push_back(k);
  return exchanged;
}

std::string nameOf(const PahProcessRow& process) {
  return std::string("events_") + process.name;
}

}  // namespace

std::vector<ParticleProcess> MoleculeEnsemble::processes() const {
  std::vector<ParticleProcess> all = namesOf(happenings());
  for (std::size_t p = 0; p < pahProcessCount; ++p)
    all.push_back({{nameOf(pahProcesses[p]), "1/m^3", pahProcesses[p].description}, exchangedBy(p)});
  return all;
}

std::vector<double> MoleculeEnsemble::amountsOfProcesses() const {
  std::vector<double> all = amountsOf(happenings(), taken_);
  all.insert(all.end(), taken_.events.begin(), taken_.events.end());
  return all;
}

std::vector<Quantity> MoleculeEnsemble::columns() const {
  std::vector<Quantity> all{
      {"soot_volume_fraction", "1", "particle volume per volume of gas"},
      {"soot_number_density", "1/m^3", "particles, the zeroth moment"},
      {"soot_mean_diameter", "m", "of the sphere of mean volume"},
      {"soot_collision_diameter", "m", "mean diameter of collision"},
      {"soot_surface_area", "m^2/m^3", "surface of all particles"},
      {"soot_mass", "kg/m^3", "mass of all particles"},
      {"soot_mass_squared", "kg^2/m^3", "sum of the squared masses of particles"},
      {"soot_single_molecules", "1/m^3", "particles of one molecule"},
      {"soot_molecules", "1", "molecules in a particle, mean"},
      {"soot_most_molecules", "1", "of the particle that has most of them"},
      {"soot_molecule_rings", "1", "rings of a molecule, mean over molecules"},
      {"soot_primaries", "1", "primary particles in a particle, mean"},
      {"soot_primary_diameter", "m", "mean over particles of the mean diameter of their primaries"},
      {"soot_sintering_level", "1", "mean over particles of their mean sintering level; of one primary 1"},
      {"soot_C", "1/m^3", "atoms of carbon in all particles"},
      {"soot_H", "1/m^3", "atoms of hydrogen in all particles"}};
  for (const ParticleProcess& one : happenings())
    all.push_back({"soot_" + one.name, one.unit, one.description + ", since the beginning"});
  for (const PahProcessRow& process : pahProcesses)
    all.push_back({"soot_" + nameOf(process), "1/m^3", std::string(process.description) + ", since the beginning"});
  all.push_back(
      {"soot_void_events", "1/m^3", "events at sites where another ring was in the way, since the beginning"});
  all.push_back({"soot_numerical_particles", "1", "numerical particles of the sample"});
  if (!options_.bandGaps.empty())
    all.push_back({"soot_band_gap", "eV", "optical band gap of a particle's largest molecule, mean over particles"});
  return all;
}

std::vector<double> MoleculeEnsemble::values(const ParticleGas&) const {
  const MoleculeTotals t = molecules_->totals();
  const auto perParticle = [&](double sum) { return t.number > 0 ? sum / t.number : 0.0; };
  std::vector<double> values{t.volume,
                             t.number,
                             t.number > 0 ? sphereDiameter(t.volume / t.number) : 0.0,
                             t.collisionDiameter,
                             t.surface,
                             t.mass,
                             t.massSquared,
                             t.single,
                             perParticle(t.molecules),
                             static_cast<double>(t.mostMolecules),
                             t.molecules > 0 ? t.rings / t.molecules : 0.0,
                             perParticle(t.primaries),
                             t.primaryDiameter,
                             t.sinteringLevel,
                             t.carbon,
                             t.hydrogen};
  for (const double amount : amountsOf(happenings(), total_)) values.push_back(amount);
  double voids = 0;
  for (std::size_t k = 0; k < pahProcessCount; ++k) {
    values.push_back(total_.events[k]);
    voids += total_.voids[k];
  }
  values.push_back(voids);
  values.push_back(static_cast<double>(molecules_->size()));
  if (!options_.bandGaps.empty()) {
    double sum = 0;
    molecules_->forEach(
        [&](const MoleculeParticle& p, double number) { sum += number * options_.bandGap(p.mostCarbon); });
    values.push_back(perParticle(sum));
  }
  return values;
}

std::vector<std::pair<std::string, double>> MoleculeEnsemble::counts() const {
  const PopulationCounters& c = molecules_->counters();
  const auto value = [](std::uint64_t count) { return static_cast<double>(count); };
  return {{"inceptions", value(c.nucleations)},
          {"coagulations", value(c.coagulations)},
          {"fictitious_collisions", value(c.fictitious)},
          {"collision_pairs", value(c.coagulations + c.fictitious)},
          {"collision_pairs_above_majorant", 0.0},  // the first ends the run (checkBound)
          {"fused_primaries", value(molecules_->fused())},
          {"doublings", value(c.doublings)},
          {"removals", value(c.removals)},
          {"samples_never_full", molecules_->size() > 0 && !molecules_->wasFull() ? 1.0 : 0.0},
          {"split_steps", value(c.splitSteps)}};
}

std::vector<StochasticPopulation::Table> MoleculeEnsemble::tables() const {
  using Real = std::vector<double>;
  using Whole = std::vector<std::int64_t>;
  Real number, volume, surface, collision;
  Whole primaries, molecules, particleOf, primaryOf, carbon, hydrogen, sixRings, fiveRings;
  std::int64_t particle = 0;
  molecules_->forEach([&](const MoleculeParticle& p, double weight) {
    number.push_back(weight);
    volume.push_back(p.tree.head().volume);
    surface.push_back(p.tree.head().surface);
    collision.push_back(p.collision);
    primaries.push_back(static_cast<std::int64_t>(p.tree.count()));
    molecules.push_back(p.molecules);
    for (std::size_t i = 0; i < p.inside->size(); ++i)
      for (const HeldMolecule& m : (*p.inside)[i]) {
        particleOf.push_back(particle);
        primaryOf.push_back(static_cast<std::int64_t>(i));
        carbon.push_back(static_cast<std::int64_t>(m->carbon()));
        hydrogen.push_back(static_cast<std::int64_t>(m->hydrogen()));
        sixRings.push_back(static_cast<std::int64_t>(m->sixRings()));
        fiveRings.push_back(static_cast<std::int64_t>(m->fiveRings()));
      }
    ++particle;
  });
  return {{"particles",
           {{{"number", "1/m^3", "particles that this one stands for"}, number},
            {{"volume", "m^3", "of the particle"}, volume},
            {{"surface", "m^2", "of the particle"}, surface},
            {{"collision_diameter", "m", "of the particle"}, collision},
            {{"primaries", "1", "in the particle"}, primaries},
            {{"molecules", "1", "in the particle"}, molecules}}},
          {"molecules",
           {{{"particle", "1", "that it is in, by its place in the table of particles"}, particleOf},
            {{"primary", "1", "of the particle that it is in, from 0"}, primaryOf},
            {{"C", "1", "carbon atoms"}, carbon},
            {{"H", "1", "hydrogen atoms"}, hydrogen},
            {{"six_rings", "1", "rings of six"}, sixRings},
            {{"five_rings", "1", "rings of five"}, fiveRings}}}};
}

}  // namespace lampblack::particles
