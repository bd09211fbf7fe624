#include "particles/pah/molecule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

constexpr std::int32_t leastSide = 16, mostSide = 2048;  // powers of two
constexpr unsigned around = 0x3f;                        // the bits of six directions

}  // namespace

Molecule::Molecule(std::span<const LatticeCell> rings, std::span<const LatticeCell> fiveRings) {
  if (rings.empty()) throw InputError("a molecule has one ring at least");
  LatticeCell low = rings[0], high = rings[0];
  for (const LatticeCell& cell : rings) {
    low = {std::min(low.q, cell.q), std::min(low.r, cell.r)};
    high = {std::max(high.q, cell.q), std::max(high.r, cell.r)};
  }
  // Two cells of margin: sites, and what toggles beside them.
  const std::int64_t extent = std::max(std::int64_t{high.q} - low.q, std::int64_t{high.r} - low.r) + 5;
  if (extent > mostSide) throw InputError(fmt::format("the molecule is more than {} cells wide", mostSide));
  const std::int32_t side =
      std::max(leastSide, static_cast<std::int32_t>(std::bit_ceil(static_cast<std::uint32_t>(extent))));
  setSide(side);
  const auto origin = [side](int least, int most) { return least - (side - (most - least + 1)) / 2; };
  originQ_ = origin(low.q, high.q);
  originR_ = origin(low.r, high.r);
  lattice_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
  for (const LatticeCell& ring : rings) {
    const std::int32_t cell = (ring.r - originR_) * side_ + ring.q - originQ_;
    if (lattice_[static_cast<std::size_t>(cell)] & ringBit)
      throw InputError(fmt::format("the ring at ({}, {}) is there twice", ring.q, ring.r));
    toggleRing(cell);
  }
  sixRings_ = rings.size();
  findEdge();
  findFiveRings(fiveRings);
  updateTypes(someSite_, siteCount_);
}

void Molecule::setSide(std::int32_t side) {
  side_ = side;
  for (std::size_t k = 0; k < 6; ++k) steps_[k] = latticeDirections[k].r * side + latticeDirections[k].q;
}

LatticeCell Molecule::coordinates(std::int32_t cell) const {
  return {cell % side_ + originQ_, cell / side_ + originR_};
}

void Molecule::toggle(std::int32_t cell, CellBits own, unsigned shift) {
  lattice_[static_cast<std::size_t>(cell)] ^= own;
  for (unsigned k = 0; k < 6; ++k)
    lattice_[static_cast<std::size_t>(cell + steps_[k])] ^= static_cast<CellBits>(1U << (shift + (k + 3) % 6));
}

void Molecule::toggleFiveRing(SiteNumber number) {
  Site& site = sites_[number];
  toggle(site.cell, fiveRingBit, 6);
  site.bridged = !site.bridged;
  fiveRings_ = site.bridged ? fiveRings_ + 1 : fiveRings_ - 1;
}

bool Molecule::isFree(const Site& site, unsigned fiveRingsThatMove) const {
  const unsigned bits = lattice_[static_cast<std::size_t>(site.cell)];
  return static_cast<unsigned>(std::popcount(bits & around)) == site.rings &&
         ((bits >> 6U) & around & ~fiveRingsThatMove) == 0;
}

void Molecule::makeRoom(SiteNumber site) {
  const std::int32_t cell = sites_[site].cell, q = cell % side_, r = cell / side_;
  if (q > 0 && q < side_ - 1 && r > 0 && r < side_ - 1) return;
  const std::int32_t old = side_, shift = side_ / 2;
  if (2 * old > mostSide) throw NumericsError(fmt::format("a molecule has grown {} rings wide", old));
  setSide(2 * old);
  originQ_ -= shift;
  originR_ -= shift;
  const auto moved = [&](std::int32_t at) { return (at / old + shift) * side_ + at % old + shift; };
  std::vector<CellBits> larger(4 * lattice_.size(), 0);
  for (std::size_t at = 0; at < lattice_.size(); ++at)
    larger[static_cast<std::size_t>(moved(static_cast<std::int32_t>(at)))] = lattice_[at];
  lattice_.swap(larger);
  for (Site& one : sites_) one.cell = moved(one.cell);
}

// Follows the boundary around the rings: behind the last ring of a run comes the cell in the next direction, whose run
// begins with that ring.
void Molecule::findEdge() {
  std::size_t sides = 0;  // of rings, with nothing behind
  std::int32_t start = -1;
  unsigned first = 0;
  for (std::size_t at = 0; at < lattice_.size(); ++at) {
    const unsigned bits = lattice_[at];
    if (bits & ringBit) continue;
    sides += static_cast<std::size_t>(std::popcount(bits & around));
    if (start >= 0 || (bits & around) == 0 || (bits & around) == around) continue;
    start = static_cast<std::int32_t>(at);
    while ((bits >> first & 1U) == 0 || (bits >> (first + 5) % 6 & 1U) != 0) ++first;
  }
  std::int32_t cell = start;
  const unsigned begin = first;
  std::size_t walked = 0;
  SiteNumber last = 0;
  do {
    const unsigned bits = lattice_[static_cast<std::size_t>(cell)];
    unsigned rings = 1;
    while (bits >> (first + rings) % 6 & 1U) ++rings;
    last = addSite(last, cell, first, rings);
    walked += rings;
    cell = neighbour(cell, first + rings);
    first = (first + rings + 4) % 6;
  } while (cell != start || first != begin);
  if (walked != sides) throw InputError("the rings are not one piece without a hole");
}

void Molecule::findFiveRings(std::span<const LatticeCell> fiveRings) {
  for (const LatticeCell& ring : fiveRings) {
    const auto refuse = [&](const char* why) {
      throw InputError(fmt::format("the ring of five at ({}, {}) {}", ring.q, ring.r, why));
    };
    SiteNumber site = someSite_;
    std::size_t seen = 0;
    while (seen < siteCount_ && !(coordinates(sites_[site].cell) == ring && sites_[site].rings == 2)) {
      site = sites_[site].next;
      ++seen;
    }
    if (seen == siteCount_) refuse("is not on a zigzag");
    if (sites_[site].bridged) refuse("is there twice");
    if (!isFree(sites_[site])) refuse("touches another ring");
    toggleFiveRing(site);
  }
}

std::vector<LatticeCell> Molecule::cells(bool ofFiveRings) const {
  std::vector<LatticeCell> found;
  for (std::size_t at = 0; at < lattice_.size(); ++at)
    if (lattice_[at] & (ofFiveRings ? fiveRingBit : ringBit)) found.push_back(coordinates(static_cast<int>(at)));
  return found;
}

std::size_t Molecule::bytes() const {
  return sizeof *this + lattice_.capacity() * sizeof lattice_[0] + sites_.capacity() * sizeof sites_[0] +
         members_.capacity() * sizeof members_[0];
}

}  // namespace lampblack::particles
