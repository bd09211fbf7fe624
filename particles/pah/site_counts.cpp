#include "particles/pah/site_counts.hpp"

#include <numeric>
#include <stdexcept>

namespace lampblack::particles {
namespace {

using Numbers = SiteCounts::Numbers;

// Sites that a process takes and those it leaves in their place; its rings.
struct OwnChange {
  Numbers taken{}, left{};  // FE, ZZ, AC, BY5, BY6, R5
  int rings = 0;
};
constexpr OwnChange ownChange(PahProcess process) {
  switch (process) {
    case PahProcess::G6R_AC:
      return {{0, 0, 1}, {1}, 1};
    case PahProcess::G6R_FE:
      return {{1}, {3}, 1};
    case PahProcess::D6R_FE_AC:
    case PahProcess::O6R_FE_HACA:
      return {{1}, {0, 0, 1}, -1};
    case PahProcess::D6R_FE3:
    case PahProcess::O6R_FE3:
      return {{3}, {1}, -1};
    case PahProcess::L6_BY6:
      return {{0, 0, 0, 0, 1}, {}, 1};
    case PahProcess::G5R_ZZ:
      return {{0, 1}, {0, 0, 0, 0, 0, 1}, 1};
    case PahProcess::D5R_R5:
      return {{0, 0, 0, 0, 0, 1}, {0, 1}, -1};
    case PahProcess::C5R_RFE:
      return {{1, 0, 0, 0, 0, 1}, {3, 0, 1}, 0};
    case PahProcess::C5R_RAC:
      return {{0, 0, 1, 0, 0, 1}, {1, 0, 1}, 0};
    case PahProcess::M5R_RZZ:
      return {{0, 1, 0, 0, 0, 1}, {0, 1, 0, 0, 0, 1}, 0};
    case PahProcess::C6R_AC_FE3:
      return {{3, 0, 1}, {1, 0, 0, 0, 0, 1}, 0};
  }
  return {};
}

constexpr int bay = static_cast<int>(SiteType::BY6);

}  // namespace

SiteCounts::SiteCounts(const Numbers& sites, int rings)
    : sites_(sites), rings_(rings), hydrogen_(std::accumulate(sites.begin(), sites.end(), 0)) {
  requireConsistent();
}

SiteCounts::SiteCounts(const Molecule& molecule)
    : rings_(static_cast<int>(molecule.rings())), hydrogen_(static_cast<int>(molecule.hydrogen())) {
  for (std::size_t t = 0; t < siteTypes; ++t) {
    const auto type = static_cast<SiteType>(t);
    sites_[static_cast<std::size_t>(countedType(type))] += static_cast<int>(molecule.count(type));
  }
  requireConsistent();
}

bool SiteCounts::withoutOwn(PahProcess process, Numbers& left) const {
  const OwnChange own = ownChange(process);
  left = sites_;
  bool isThere = true;
  for (std::size_t t = 0; t < countedSites; ++t) isThere = (left[t] -= own.taken[t]) >= 0 && isThere;
  return isThere;
}

bool SiteCounts::apply(PahProcess process, std::span<const SiteType> neighbours) {
  Numbers now;
  if (!withoutOwn(process, now)) return false;
  int together = 1;  // rings around what two neighbours of a bay become
  const NeighbourChange change = neighbourChange(process);
  for (const SiteType neighbour : neighbours) {
    const int from = static_cast<int>(neighbour), to = from + change.rings;
    if (neighbour == SiteType::R5 || to < 0 || to > bay || --now[static_cast<std::size_t>(from)] < 0) return false;
    together += from + 1;
    if (process != PahProcess::L6_BY6) ++now[static_cast<std::size_t>(to)];
  }
  if (process == PahProcess::L6_BY6) {
    if (together - 1 > bay) return false;
    ++now[static_cast<std::size_t>(together - 1)];
  }
  const OwnChange own = ownChange(process);
  for (std::size_t t = 0; t < countedSites; ++t) now[t] += own.left[t];
  sites_ = now;
  rings_ += own.rings;
  hydrogen_ = std::accumulate(sites_.begin(), sites_.end(), 0);
  return true;
}

// FE has no edge carbon without H, ZZ one, AC two, ...; R5 two.
void SiteCounts::requireConsistent() const {
  int without = 2 * count(SiteType::R5);
  for (int t = 0; t <= bay; ++t) without += t * sites_[static_cast<std::size_t>(t)];
  bool isRight = hydrogen_ - without == 6 - count(SiteType::R5) && rings_ >= 1;
  for (const int n : sites_) isRight = isRight && n >= 0;
  if (!isRight) throw std::logic_error("SiteCounts: numbers of sites that no molecule has");
}

}  // namespace lampblack::particles
