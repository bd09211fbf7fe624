#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/errors.hpp"
#include "particles/pah/molecule.hpp"

namespace lampblack::particles {
namespace {

constexpr std::size_t leastPool = 32;

// How far away a site is seen: as an R5, by the type of the next; as a free edge, in the middle of a ring; as that, by
// an armchair two places on.
constexpr std::size_t seenInType = 1, seenInGroup = 4;

}  // namespace

void Molecule::enlargePool() {
  const std::size_t old = sites_.size(), size = old == 0 ? leastPool : 2 * old;
  if (old >= mostSites) throw NumericsError(fmt::format("a molecule has grown {} sites", old));
  std::vector<SiteNumber> larger(siteGroups * size);
  for (std::size_t g = 0; g < siteGroups; ++g)
    std::copy_n(members_.begin() + static_cast<std::ptrdiff_t>(g * old), groupSizes_[g],
                larger.begin() + static_cast<std::ptrdiff_t>(g * size));
  members_.swap(larger);
  sites_.resize(size);
  for (std::size_t i = old; i < size; ++i) sites_[i].next = static_cast<SiteNumber>(i + 1);
  unused_ = static_cast<SiteNumber>(old);
}

Molecule::SiteNumber Molecule::newSite() {
  if (siteCount_ == sites_.size()) enlargePool();
  const SiteNumber number = unused_;
  unused_ = sites_[number].next;
  return number;
}

Molecule::SiteNumber Molecule::addSite(SiteNumber after, std::int32_t cell, unsigned first, unsigned rings) {
  const SiteNumber number = newSite();
  Site& site = sites_[number];
  site = Site{};
  site.cell = cell;
  site.first = static_cast<std::uint8_t>(first % 6);
  site.rings = static_cast<std::uint8_t>(rings);
  site.type = siteType(rings, 0);
  if (siteCount_ == 0) {
    site.previous = site.next = number;
    someSite_ = number;
  } else {
    site.previous = after;
    site.next = sites_[after].next;
    sites_[site.next].previous = sites_[after].next = number;
  }
  ++siteCount_;
  ++counts_[static_cast<std::size_t>(site.type)];
  return number;
}

void Molecule::removeSite(SiteNumber number) {
  Site& site = sites_[number];
  setGroup(number, 0, SiteGroup::none);
  setGroup(number, 1, SiteGroup::none);
  --counts_[static_cast<std::size_t>(site.type)];
  if (someSite_ == number) someSite_ = site.previous;
  sites_[site.previous].next = site.next;
  sites_[site.next].previous = site.previous;
  site.next = unused_;
  unused_ = number;
  --siteCount_;
}

void Molecule::setGroup(SiteNumber number, std::size_t which, SiteGroup group) {
  Site& site = sites_[number];
  const SiteGroup before = site.group[which];
  if (before == group) return;
  if (before != SiteGroup::none) {  // the last one takes its place
    const std::size_t last = --groupSizes_[static_cast<std::size_t>(before)];
    const SiteNumber moved = members_[place(before, last)];
    members_[place(before, site.place[which])] = moved;
    sites_[moved].place[which] = site.place[which];
  }
  if (group != SiteGroup::none) {
    site.place[which] = groupSizes_[static_cast<std::size_t>(group)]++;
    members_[place(group, site.place[which])] = number;
  }
  site.group[which] = group;
}

SiteType Molecule::typeOf(SiteNumber number) const {
  const Site& site = sites_[number];
  if (site.bridged) return SiteType::R5;
  return siteType(site.rings, static_cast<unsigned>(sites_[site.previous].bridged) +
                                  static_cast<unsigned>(sites_[site.next].bridged));
}

bool Molecule::isMiddle(SiteNumber number) const {
  const Site& site = sites_[number];
  return sixRings_ > 1 && site.type == SiteType::FE && isFreeEdge(site.previous) && isFreeEdge(site.next);
}

SiteGroup Molecule::nearGroupOf(SiteNumber number) const {
  const Site& site = sites_[number];
  if (site.type == SiteType::FE) {
    const Site &a = sites_[site.previous], &b = sites_[site.next];
    if (a.rings > 1 && b.rings > 1) return SiteGroup::FE_HACA;
    return isMiddle(number) ? SiteGroup::FE3 : SiteGroup::none;
  }
  if (site.type != SiteType::AC) return SiteGroup::none;
  return isMiddle(next(next(number))) || isMiddle(previous(previous(number))) ? SiteGroup::AC_FE3 : SiteGroup::none;
}

void Molecule::updateTypes(SiteNumber from, std::size_t changed) {
  SiteNumber number = from;
  for (std::size_t i = 0; i < seenInType; ++i) number = previous(number);
  SiteNumber seen = number;
  for (std::size_t i = std::min(changed + 2 * seenInType, siteCount_); i > 0; --i, number = next(number)) {
    Site& site = sites_[number];
    const SiteType type = typeOf(number);
    if (type != site.type) {
      --counts_[static_cast<std::size_t>(site.type)];
      ++counts_[static_cast<std::size_t>(type)];
      site.type = type;
    }
    setGroup(number, 0, groupOf(type));
  }
  for (std::size_t i = seenInType; i < seenInGroup; ++i) seen = previous(seen);
  for (std::size_t i = std::min(changed + 2 * seenInGroup, siteCount_); i > 0; --i, seen = next(seen))
    setGroup(seen, 1, nearGroupOf(seen));
}

void Molecule::requireConsistent() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(std::string("molecule: ") + what);
  };
  const std::vector<LatticeCell> six = cells(false), five = cells(true);
  require(six.size() == sixRings_ && five.size() == fiveRings_, "numbers of rings");
  const Molecule fresh(six, five);
  require(fresh.siteCount_ == siteCount_ && fresh.counts_ == counts_ && fresh.groupSizes_ == groupSizes_,
          "numbers of sites");
  SiteNumber there = fresh.someSite_;
  const auto same = [&](const Site& a, const Site& b) {
    return coordinates(a.cell) == fresh.coordinates(b.cell) && a.first == b.first;
  };
  for (std::size_t i = 0; i < siteCount_ && !same(sites_[someSite_], fresh.sites_[there]); ++i)
    there = fresh.next(there);
  SiteNumber here = someSite_;
  std::size_t edgeCarbon = 0;  // without H
  for (std::size_t i = 0; i < siteCount_; ++i, here = next(here), there = fresh.next(there)) {
    const Site &a = sites_[here], &b = fresh.sites_[there];
    require(same(a, b) && a.rings == b.rings && a.bridged == b.bridged && a.type == b.type && a.group == b.group,
            "a site is not that of its cells");
    require(sites_[a.next].previous == here, "the order of the sites");
    for (std::size_t g = 0; g < 2; ++g)
      require(a.group[g] == SiteGroup::none || member(a.group[g], a.place[g]) == here, "the members of a group");
    // Each R5 makes two of those that had H carry none, one for either site beside it.
    edgeCarbon += a.bridged ? 0U : a.rings - 1U;
    edgeCarbon +=
        static_cast<std::size_t>(sites_[a.previous].bridged) + static_cast<std::size_t>(sites_[a.next].bridged);
  }
  require(here == someSite_, "the sites are no ring");
  require(hydrogen() + fiveRings_ == edgeCarbon + 6, "H - B is not 6 - R5");
}

}  // namespace lampblack::particles
