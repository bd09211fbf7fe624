#include "particles/pah/site_counting.hpp"

#include <array>
#include <span>

namespace lampblack::particles {

bool SiteCounting::happen(PahProcess process, std::size_t sizeClass) {
  SiteCounts::Numbers left;
  if (!counts_.withoutOwn(process, left)) return false;
  std::array<SiteType, 2> neighbours{};
  const auto count = static_cast<std::size_t>(neighbourChange(process).count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!closure_.drawNeighbour(sizeClass, rowOf(process).site, left, random_, neighbours[i])) return false;
    --left[static_cast<std::size_t>(neighbours[i])];
  }
  return counts_.apply(process, std::span(neighbours).first(count));
}

double SiteCounting::advance(const PahRates& rates, double duration, std::uint64_t mostEvents) {
  if (hasLeft()) return 0;
  double left = duration;
  std::array<double, pahProcessCount> upTo{};  // sums of the rates of the processes so far
  for (std::uint64_t event = 0; event < mostEvents; ++event) {
    const std::size_t sizeClass = SiteClosure::classOf(counts_.carbon(), counts_.hydrogen());
    double total = 0;
    for (std::size_t p = 0; p < pahProcessCount; ++p) {
      if (rates[p] > 0) total += rates[p] * closure_.expected(sizeClass, pahProcesses[p].site, counts_);
      upTo[p] = total;
    }
    if (!(total > 0)) return 0;
    left -= random_.exponential(total);
    if (left <= 0) return 0;
    const double at = random_.uniform() * total;
    std::size_t p = 0;
    while (upTo[p] < at) ++p;
    const bool happened = happen(static_cast<PahProcess>(p), sizeClass);
    ++(happened ? events_.happened : events_.voids)[p];
    counts_.requireConsistent();
    if (hasLeft()) return 0;
  }
  return left;
}

}  // namespace lampblack::particles
