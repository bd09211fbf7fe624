// Sites of the edge of a molecule. A site is what lies between two neighbouring C-H of the edge: an empty cell with as
// many rings around it, one behind the other. docs/theory/pah.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/modules.hpp"

namespace lampblack::particles {

// By the number of rings around the empty cell: free edge, zigzag, armchair and two bays. R5: a zigzag that a ring of
// five carbon atoms bridges. R...: a site beside one of these, R...R: one between two.
// clang-format off
enum class SiteType : std::uint8_t {
  FE, ZZ, AC, BY5, BY6, R5,
  RFE, RZZ, RAC, RBY5, RBY6,
  RFER, RZZR, RACR, RBY5R, RBY6R
};
// clang-format on
inline constexpr std::size_t siteTypes = 16;
inline constexpr std::array<const char*, siteTypes> siteTypeNames{"FE",   "ZZ",   "AC",    "BY5",  "BY6",  "R5",
                                                                  "RFE",  "RZZ",  "RAC",   "RBY5", "RBY6", "RFER",
                                                                  "RZZR", "RACR", "RBY5R", "RBY6R"};

// The type of a site with so many rings around it that is no R5, and has so many R5 beside it.
constexpr SiteType siteType(unsigned rings, unsigned fiveRings) {
  constexpr unsigned first[] = {0, 6, 11};
  return static_cast<SiteType>(first[fiveRings] + rings - 1);
}

// Sites that a process may start from. The first are types; the others depend on what else is near: FE3 is a free edge
// between two, the middle of a ring with four H; FE_HACA has no free edge beside it, nor one beside an R5; AC_FE3 is an
// armchair with an FE3 two places away.
enum class SiteGroup : std::uint8_t { FE, ZZ, AC, BY6, R5, RFE, RZZ, RAC, FE3, FE_HACA, AC_FE3, none };
inline constexpr std::size_t siteGroups = static_cast<std::size_t>(SiteGroup::none);

// The group that all sites of a type are in.
constexpr SiteGroup groupOf(SiteType type) {
  switch (type) {
    case SiteType::FE:
      return SiteGroup::FE;
    case SiteType::ZZ:
      return SiteGroup::ZZ;
    case SiteType::AC:
      return SiteGroup::AC;
    case SiteType::BY6:
      return SiteGroup::BY6;
    case SiteType::R5:
      return SiteGroup::R5;
    case SiteType::RFE:
      return SiteGroup::RFE;
    case SiteType::RZZ:
      return SiteGroup::RZZ;
    case SiteType::RAC:
      return SiteGroup::RAC;
    default:
      return SiteGroup::none;
  }
}

}  // namespace lampblack::particles
