// A molecule by the numbers of its sites alone, without the places of its rings: what site counting (ARS-SC; Celnik et
// al. 2008) knows of it. Sites beside a ring of five are counted with those that are not: what the neighbours of a site
// are is for a closure to say. docs/theory/site_counting.md.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/modules.hpp"
#include "particles/pah/molecule.hpp"
#include "particles/pah/pah_process.hpp"

namespace lampblack::particles {

// FE, ZZ, AC, BY5, BY6 and R5, the first of SiteType.
inline constexpr std::size_t countedSites = 6;
// The counted one of a site of any type.
constexpr SiteType countedType(SiteType type) {
  const auto t = static_cast<unsigned>(type);
  return t < countedSites ? type : static_cast<SiteType>((t - countedSites) % (countedSites - 1));
}

// How many neighbours a process changes that are not sites of its own, and by how many rings around them.
struct NeighbourChange {
  int count = 0, rings = 0;
};
constexpr NeighbourChange neighbourChange(PahProcess process) {
  switch (process) {
    case PahProcess::G6R_AC:
    case PahProcess::G6R_FE:
    case PahProcess::L6_BY6:  // both become one
      return {2, 1};
    case PahProcess::D6R_FE_AC:
    case PahProcess::D6R_FE3:
    case PahProcess::O6R_FE3:
    case PahProcess::O6R_FE_HACA:
      return {2, -1};
    case PahProcess::C5R_RFE:
    case PahProcess::C5R_RAC:
      return {1, 1};
    case PahProcess::C6R_AC_FE3:
      return {1, -1};
    default:
      return {};
  }
}

class SiteCounts {
 public:
  using Numbers = std::array<int, countedSites>;

  // Numbers of sites of a molecule of so many rings, those of five included. std::logic_error for what is none.
  SiteCounts(const Numbers& sites, int rings);
  explicit SiteCounts(const Molecule& molecule);

  [[nodiscard]] int count(SiteType type) const { return sites_[static_cast<std::size_t>(type)]; }
  [[nodiscard]] const Numbers& sites() const { return sites_; }
  [[nodiscard]] int rings() const { return rings_; }
  [[nodiscard]] int hydrogen() const { return hydrogen_; }
  [[nodiscard]] int carbon() const { return hydrogen_ + 2 * (rings_ - 1); }

  // What is left of the sites when those that a process takes are away: of these its neighbours are. False where it
  // lacks one of its own.
  [[nodiscard]] bool withoutOwn(PahProcess process, Numbers& left) const;
  // Carries a process out with these neighbours, as many as it changes. False, and nothing is changed, where one is
  // missing or cannot change so.
  bool apply(PahProcess process, std::span<const SiteType> neighbours);

  // std::logic_error where H - B = 6 - R5 does not hold, B being the edge carbon atoms without H.
  void requireConsistent() const;

 private:
  Numbers sites_{};
  int rings_ = 0, hydrogen_ = 0;
};

}  // namespace lampblack::particles
