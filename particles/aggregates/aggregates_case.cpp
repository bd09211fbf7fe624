#include "particles/aggregates/aggregates_case.hpp"

namespace lampblack::particles {

std::vector<std::size_t> AggregatesCase::sizes() const {
  std::vector<std::size_t> all{1};
  if (build == Build::collisions) return all;
  const std::size_t last = build == Build::equalPairs ? std::size_t{1} << doublings : spheres;
  while (2 * all.back() <= last) all.push_back(2 * all.back());
  if (all.back() != last) all.push_back(last);
  return all;
}

}  // namespace lampblack::particles
