#include "particles/molecules/molecule_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/errors.hpp"
#include "particles/pah/molecule.hpp"

namespace lampblack::particles {

TreeMaterial MoleculeOptions::material() const {
  SootReactions reactions;
  reactions.soot.sootDensity = density;
  reactions.soot.carbonWeight = carbonWeight;
  reactions.soot.hydrogenWeight = hydrogenWeight;
  TreeMaterial m = sootMaterial(reactions);
  m.fractalDimension = fractalDimension;
  m.sintering = sintering;
  return m;
}

double MoleculeOptions::bandGap(double carbon) const {
  const MoleculeSticking::Place at = MoleculeSticking::placeOf(bandGapCarbons, carbon);
  return (1 - at.share) * bandGaps[at.first] + at.share * bandGaps[at.second];
}

std::vector<std::string> MoleculeOptions::species() const {
  std::vector<std::string> names = sootSpecies(SootModelOptions{});
  names.push_back(precursor);
  return names;
}

void requireMolecules(const MoleculeOptions& o) {
  const auto require = [](bool holds, const std::string& message) {
    if (!holds) throw InputError("particles: " + message);
  };
  requireMaterial(o.material());
  const auto isPart = [](double x) { return x >= 0 && x <= 1; };
  require(isPart(o.growthFactor) && isPart(o.inceptionEfficiency) && isPart(o.condensationEfficiency),
          "the growth factor and the efficiencies of collisions of molecules need to be in [0, 1]");
  require(o.sticking.rings >= 0 && (o.sticking.rule != MoleculeSticking::Rule::bySize || o.sticking.B > 0),
          "the constants of sticking may not be below zero, and B has to be above it");
  if (o.sticking.rule == MoleculeSticking::Rule::byTable) {
    const MoleculeSticking& s = o.sticking;
    require(!s.temperatures.empty() && !s.carbons.empty() &&
                s.probabilities.size() == s.temperatures.size() * s.carbons.size() &&
                std::ranges::all_of(s.probabilities, isPart),
            "a table of sticking needs a probability in [0, 1] for each temperature and number of carbon atoms");
    for (const auto* points : {&s.temperatures, &s.carbons})
      require(std::ranges::is_sorted(*points, std::less_equal{}), "the points of a table of sticking have to rise");
  }
  require(o.bandGaps.size() == o.bandGapCarbons.size() && std::ranges::is_sorted(o.bandGapCarbons, std::less_equal{}),
          "band gaps need as many numbers of carbon atoms, which have to rise");
  require(
      o.inception != MoleculeOptions::Inception::byFormation || o.formation.source == NucleationOptions::Source::table,
      "molecules by formation need a table of the rate at which they are formed");
  require(o.particles >= 8, "at least 8 numerical particles are needed");
  require(o.splitTolerance > 0 && o.splitTolerance <= 1 && o.fullAt > 0,
          "the split tolerance needs to be in (0, 1], the number density of a full sample positive");
  require(o.atStart >= 0 && std::isfinite(o.atStart), "the number of molecules at the start may not be below zero");
  (void)Molecule(o.rings);
}

void addGasOfEvents(const std::array<double, pahProcessCount>& events, double byOH,
                    std::array<double, SootSpecies::fixed + 1>& gas) {
  for (std::size_t p = 0; p < pahProcessCount; ++p) {
    const double carbon = events[p] * pahProcesses[p].carbon, hydrogen = events[p] * pahProcesses[p].hydrogen;
    const auto process = static_cast<PahProcess>(p);
    if (process == PahProcess::O6R_FE3 || process == PahProcess::O6R_FE_HACA) {
      // - carbon atoms leave, each with an O of OH or half an O2.
      gas[SootSpecies::CO] -= carbon;
      gas[SootSpecies::OH] += carbon * byOH;
      gas[SootSpecies::O2] += 0.5 * carbon * (1 - byOH);
      gas[SootSpecies::H2] -= 0.5 * (hydrogen + carbon * byOH);
    } else {
      gas[SootSpecies::C2H2] -= 0.5 * carbon;
      gas[SootSpecies::H2] += 0.5 * (carbon - hydrogen);
    }
  }
}

}  // namespace lampblack::particles
