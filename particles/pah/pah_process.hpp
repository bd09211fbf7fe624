// What may happen at a site of a molecule: a row for each process. docs/theory/pah.md has what each does to the sites
// around, and the sources.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/modules.hpp"
#include "particles/pah/site.hpp"

namespace lampblack::particles {

// G grows, D desorbs, L closes, C converts, M moves, O oxidises; then the size of the ring and the site.
// clang-format off
enum class PahProcess : std::uint8_t {
  G6R_AC, G6R_FE, D6R_FE_AC, D6R_FE3, L6_BY6, G5R_ZZ, D5R_R5,
  C5R_RFE, C5R_RAC, M5R_RZZ, C6R_AC_FE3, O6R_FE3, O6R_FE_HACA
};
// clang-format on

struct PahProcessRow {
  const char* name;
  SiteGroup site;
  int carbon, hydrogen;  // what the molecule gains
  const char* description;
};

inline constexpr std::array<PahProcessRow, 13> pahProcesses{{
    {"G6R_AC", SiteGroup::AC, 2, 0, "a ring grows in an armchair"},
    {"G6R_FE", SiteGroup::FE, 4, 2, "a ring grows on a free edge"},
    {"D6R_FE_AC", SiteGroup::FE_HACA, -2, 0, "a ring leaves that has one free edge, and an armchair stays"},
    {"D6R_FE3", SiteGroup::FE3, -4, -2, "a ring with three free edges leaves"},
    {"L6_BY6", SiteGroup::BY6, 0, -2, "a bay closes"},
    {"G5R_ZZ", SiteGroup::ZZ, 2, 0, "a ring of five grows on a zigzag"},
    {"D5R_R5", SiteGroup::R5, -2, 0, "a ring of five leaves"},
    {"C5R_RFE", SiteGroup::RFE, 2, 2, "a ring of five becomes one of six on the free edge beside it"},
    {"C5R_RAC", SiteGroup::RAC, 0, 0, "a ring of five becomes one of six in the armchair beside it"},
    {"M5R_RZZ", SiteGroup::RZZ, 0, 0, "a ring of five moves to the zigzag beside it"},
    {"C6R_AC_FE3", SiteGroup::AC_FE3, -2, -2, "a ring with three free edges becomes one of five in the armchair"},
    {"O6R_FE3", SiteGroup::FE3, -4, -2, "a ring with three free edges is oxidised"},
    {"O6R_FE_HACA", SiteGroup::FE_HACA, -2, 0, "a ring with one free edge is oxidised"},
}};
inline constexpr std::size_t pahProcessCount = pahProcesses.size();

constexpr const PahProcessRow& rowOf(PahProcess process) {
  return pahProcesses[static_cast<std::size_t>(process)];
}

}  // namespace lampblack::particles
