#include <bit>

#include "particles/pah/molecule.hpp"

namespace lampblack::particles {

bool Molecule::apply(PahProcess process, SiteNumber site, RandomStream& random) {
  switch (process) {
    case PahProcess::G6R_AC:
    case PahProcess::G6R_FE:
    case PahProcess::L6_BY6:
      return addRing(site);
    case PahProcess::D6R_FE3:
    case PahProcess::O6R_FE3: {
      const SiteNumber from = previous(previous(site));
      removeOuterRing(site);
      updateTypes(from, 3);
      return true;
    }
    case PahProcess::D6R_FE_AC:
    case PahProcess::O6R_FE_HACA:
      return removeInnerRing(site);
    case PahProcess::G5R_ZZ:
      return placeFiveRing(site);
    case PahProcess::D5R_R5:
      toggleFiveRing(site);
      updateTypes(site, 1);
      return true;
    case PahProcess::C5R_RFE:
    case PahProcess::C5R_RAC:
      return moveFiveRing(site, true);
    case PahProcess::M5R_RZZ:
      return moveFiveRing(site, false);
    case PahProcess::C6R_AC_FE3:
      return shrinkToFiveRing(site, random);
  }
  return false;
}

bool Molecule::hasRoom(SiteGroup group, SiteNumber number) const {
  const Site& site = sites_[number];
  switch (group) {
    case SiteGroup::FE:
    case SiteGroup::ZZ:
    case SiteGroup::AC:
    case SiteGroup::BY6:
    case SiteGroup::AC_FE3:
      return isFree(site);
    case SiteGroup::RFE:
    case SiteGroup::RZZ:
    case SiteGroup::RAC:
      return isFreeBesideFive(site);
    case SiteGroup::FE_HACA:
      return isInner(neighbour(site.cell, site.first));
    default:
      return true;
  }
}

bool Molecule::isInner(std::int32_t ring) const {
  return std::popcount(lattice_[static_cast<std::size_t>(ring)] & 0x3fU) == 3;
}

bool Molecule::isFreeBesideFive(const Site& site) const {
  const bool isBehind = sites_[site.next].bridged;
  const unsigned direction = isBehind ? static_cast<unsigned>(site.first) + site.rings : site.first + 5U;
  return isFree(site, 1U << direction % 6);
}

bool Molecule::addRing(SiteNumber site) {
  if (!isFree(sites_[site])) return false;
  makeRoom(site);
  if (sites_[site].rings == 5)
    close(site);
  else
    grow(site);
  return true;
}

// The run of rings of the site before gains the new ring as its last, that of the site behind as its first; the other
// sides of the new ring are free edges.
void Molecule::grow(SiteNumber number) {
  const Site site = sites_[number];
  toggleRing(site.cell);
  ++sixRings_;
  removeSite(number);
  ++sites_[site.previous].rings;
  Site& behind = sites_[site.next];
  behind.first = static_cast<std::uint8_t>((behind.first + 5U) % 6U);
  ++behind.rings;
  SiteNumber last = site.previous;
  for (unsigned k = site.first + 4U; k > static_cast<unsigned>(site.first) + site.rings; --k)
    last = addSite(last, neighbour(site.cell, k), k + 3, 1);
  updateTypes(site.previous, 6U - site.rings);
}

// The sites to both sides have the same empty cell, and become one.
void Molecule::close(SiteNumber number) {
  const Site site = sites_[number];
  toggleRing(site.cell);
  ++sixRings_;
  Site& before = sites_[site.previous];
  before.rings = static_cast<std::uint8_t>(before.rings + 1U + sites_[site.next].rings);
  removeSite(site.next);
  removeSite(number);
  updateTypes(site.previous, 1);
}

// The ring of three free edges, by the middle one, which becomes the free edge of the ring behind it.
void Molecule::removeOuterRing(SiteNumber number) {
  const SiteNumber a = previous(number), b = next(number);
  Site &site = sites_[number], &before = sites_[previous(a)], &behind = sites_[next(b)];
  const std::int32_t ring = neighbour(site.cell, site.first);
  toggleRing(ring);
  --sixRings_;
  --before.rings;
  --behind.rings;
  behind.first = static_cast<std::uint8_t>((behind.first + 1U) % 6U);
  site.cell = ring;
  removeSite(a);
  removeSite(b);
}

// A ring with one free edge, which has neighbours on its three other sides; the site becomes an armchair.
bool Molecule::removeInnerRing(SiteNumber number) {
  Site& site = sites_[number];
  const std::int32_t ring = neighbour(site.cell, site.first);
  if (!isInner(ring)) return false;
  toggleRing(ring);
  --sixRings_;
  --sites_[site.previous].rings;
  Site& behind = sites_[site.next];
  --behind.rings;
  behind.first = static_cast<std::uint8_t>((behind.first + 1U) % 6U);
  site.cell = ring;
  site.first = static_cast<std::uint8_t>((site.first + 5U) % 6U);
  site.rings = 3;
  updateTypes(site.previous, 3);
  return true;
}

bool Molecule::placeFiveRing(SiteNumber site) {
  if (!isFree(sites_[site])) return false;
  makeRoom(site);
  toggleFiveRing(site);
  updateTypes(site, 1);
  return true;
}

// The ring of five beside the site goes: into it, or to let a ring of six grow there.
bool Molecule::moveFiveRing(SiteNumber number, bool ringGrows) {
  const Site& site = sites_[number];
  const bool isBehind = sites_[site.next].bridged;
  if (!isFreeBesideFive(site)) return false;
  makeRoom(number);
  const SiteNumber five = isBehind ? site.next : site.previous;
  toggleFiveRing(five);
  if (ringGrows) {
    grow(number);
  } else {
    toggleFiveRing(number);
    updateTypes(isBehind ? number : five, 2);
  }
  return true;
}

// The ring of three free edges beside the armchair goes, and the zigzag that is left is bridged.
bool Molecule::shrinkToFiveRing(SiteNumber number, RandomStream& random) {
  SiteNumber middle = next(next(number));
  const SiteNumber other = previous(previous(number));
  if (!isMiddle(middle) || (isMiddle(other) && random.below(2) == 0)) middle = other;
  if (!isFree(sites_[number])) return false;
  makeRoom(number);
  const SiteNumber from = previous(previous(middle));
  removeOuterRing(middle);
  toggleFiveRing(number);
  updateTypes(from, 3);
  return true;
}

}  // namespace lampblack::particles
