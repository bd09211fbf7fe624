#include "particles/pah/molecule_growth.hpp"

namespace lampblack::particles {

double MoleculeGrowth::advance(const PahRates& rates, double duration, std::uint64_t mostEvents) {
  if (hasLeft()) return 0;
  double left = duration;
  std::array<double, pahProcessCount> upTo{};  // sums of the rates of the processes so far
  for (std::uint64_t event = 0; event < mostEvents; ++event) {
    double total = 0;
    for (std::size_t p = 0; p < pahProcessCount; ++p)
      upTo[p] = total += rates[p] * static_cast<double>(molecule_.count(pahProcesses[p].site));
    if (!(total > 0)) return 0;
    left -= random_.exponential(total);
    if (left <= 0) return 0;
    const double at = random_.uniform() * total;
    std::size_t p = 0;
    while (upTo[p] < at) ++p;
    const SiteGroup group = pahProcesses[p].site;
    const auto site = molecule_.member(group, random_.below(molecule_.count(group)));
    const bool happened = molecule_.apply(static_cast<PahProcess>(p), site, random_);
    ++(happened ? events_ : voids_)[p];
#ifndef NDEBUG
    molecule_.requireConsistent();
#endif
    if (hasLeft()) return 0;
  }
  return left;
}

}  // namespace lampblack::particles
