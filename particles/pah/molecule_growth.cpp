#include "particles/pah/molecule_growth.hpp"

namespace lampblack::particles {
namespace {

// Sums of the rates of the processes so far.
using RateSums = std::array<double, pahProcessCount>;

RateSums sumsOf(const Molecule& molecule, const PahRates& rates) {
  RateSums upTo;
  double total = 0;
  for (std::size_t p = 0; p < pahProcessCount; ++p)
    upTo[p] = total += rates[p] * static_cast<double>(molecule.count(pahProcesses[p].site));
  return upTo;
}

void jumpBy(Molecule& molecule, const RateSums& upTo, RandomStream& random, MoleculeEvents& events) {
  const double at = random.uniform() * upTo.back();
  std::size_t p = 0;
  while (upTo[p] < at) ++p;
  const SiteGroup group = pahProcesses[p].site;
  const auto site = molecule.member(group, random.below(molecule.count(group)));
  const bool happened = molecule.apply(static_cast<PahProcess>(p), site, random);
  ++(happened ? events.happened : events.voids)[p];
#ifndef NDEBUG
  molecule.requireConsistent();
#endif
}

}  // namespace

double totalRate(const Molecule& molecule, const PahRates& rates) {
  return sumsOf(molecule, rates).back();
}

void jump(Molecule& molecule, const PahRates& rates, RandomStream& random, MoleculeEvents& events) {
  jumpBy(molecule, sumsOf(molecule, rates), random, events);
}

double MoleculeGrowth::advance(const PahRates& rates, double duration, std::uint64_t mostEvents) {
  if (hasLeft()) return 0;
  double left = duration;
  for (std::uint64_t event = 0; event < mostEvents; ++event) {
    const RateSums upTo = sumsOf(molecule_, rates);
    if (!(upTo.back() > 0)) return 0;
    left -= random_.exponential(upTo.back());
    if (left <= 0) return 0;
    jumpBy(molecule_, upTo, random_, events_);
    if (hasLeft()) return 0;
  }
  return left;
}

}  // namespace lampblack::particles
