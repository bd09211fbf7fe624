// A flat molecule of hexagonal rings, some of whose zigzags are bridged by rings of five carbon atoms. It is a set of
// cells of the lattice; the sites of its edge, in their order around it, are kept up to date as rings come and go,
// which changes at most five of them. docs/theory/pah.md.
//
// Sites are numbered; a number is valid until the next event. Sizes are limited: NumericsError above mostSites.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/pah/lattice.hpp"
#include "particles/pah/pah_process.hpp"
#include "particles/pah/site.hpp"

namespace lampblack::particles {

class Molecule {
 public:
  using SiteNumber = std::uint16_t;
  static constexpr std::size_t mostSites = 60000;

  // From its rings of six and of five, in any order. InputError where these are no molecule of the lattice: no ring,
  // one said twice, not connected, a hole, a ring of five that is not on a zigzag or touches another.
  explicit Molecule(std::span<const LatticeCell> rings, std::span<const LatticeCell> fiveRings = {});

  [[nodiscard]] std::size_t sixRings() const { return sixRings_; }
  [[nodiscard]] std::size_t fiveRings() const { return fiveRings_; }
  [[nodiscard]] std::size_t rings() const { return sixRings_ + fiveRings_; }
  [[nodiscard]] std::size_t hydrogen() const { return siteCount_; }  // one C-H a site
  [[nodiscard]] std::size_t carbon() const { return siteCount_ + 2 * (rings() - 1); }

  [[nodiscard]] std::size_t count(SiteType type) const { return counts_[static_cast<std::size_t>(type)]; }
  // Sites that a process may start from.
  [[nodiscard]] std::size_t count(SiteGroup group) const { return groupSizes_[static_cast<std::size_t>(group)]; }
  [[nodiscard]] SiteNumber member(SiteGroup group, std::size_t i) const { return members_[place(group, i)]; }

  // Carries a process out at a site of its group; `random` draws the side where it may go to two. False, and nothing is
  // changed, where another ring is in the way.
  bool apply(PahProcess process, SiteNumber site, RandomStream& random);

  // Whether nothing is in the way of a process that starts from a site of this group.
  [[nodiscard]] bool hasRoom(SiteGroup group, SiteNumber site) const;

  // The sites in their order around the molecule, from any of them on.
  [[nodiscard]] SiteNumber firstSite() const { return someSite_; }
  [[nodiscard]] SiteNumber next(SiteNumber site) const { return sites_[site].next; }
  [[nodiscard]] SiteNumber previous(SiteNumber site) const { return sites_[site].previous; }
  [[nodiscard]] SiteType type(SiteNumber site) const { return sites_[site].type; }
  // Whether it is the middle of a ring with four H, which has three free edges; benzene has none.
  [[nodiscard]] bool isMiddle(SiteNumber site) const;
  // A ring at a site of any type that is not bridged. False, as apply().
  bool addRing(SiteNumber site);

  // Cells of the rings of six and of five, in the order of the lattice's rows.
  [[nodiscard]] std::vector<LatticeCell> cells(bool ofFiveRings) const;
  // Memory that it takes, in bytes.
  [[nodiscard]] std::size_t bytes() const;

  // std::logic_error where the sites that are kept are not those of the cells, or the numbers of atoms, rings and sites
  // do not obey C - H = 2 (R - 1), H = sites and H - B = 6 - R5, B the edge carbon atoms without H.
  void requireConsistent() const;

 private:
  // What the lattice has in a cell: bit k a ring in direction k, bit 6 + k a ring of five there, and its own.
  using CellBits = std::uint16_t;
  static constexpr CellBits ringBit = 1U << 12U, fiveRingBit = 1U << 13U;

  struct Site {
    std::int32_t cell = 0;              // the empty one
    SiteNumber previous = 0, next = 0;  // in the direction of next the run of rings ends
    std::array<SiteNumber, 2> place{};  // in the groups of `group`
    std::uint8_t first = 0, rings = 0;  // direction of the first ring of its run, and how many there are
    SiteType type = SiteType::FE;       // R5 where it is bridged
    bool bridged = false;
    std::array<SiteGroup, 2> group{SiteGroup::none, SiteGroup::none};  // by its type, and by what is near
  };

  // Of the lattice.
  [[nodiscard]] std::int32_t neighbour(std::int32_t cell, unsigned direction) const {
    return cell + steps_[direction % 6];
  }
  // Whether nothing but its own run of rings, and a ring of five in a direction that moves away, is around it.
  [[nodiscard]] bool isFree(const Site& site, unsigned fiveRingsThatMove = 0) const;
  [[nodiscard]] bool isFreeBesideFive(const Site& site) const;  // but for the ring of five that moves there
  [[nodiscard]] bool isInner(std::int32_t ring) const;          // three rings around it
  [[nodiscard]] LatticeCell coordinates(std::int32_t cell) const;
  void setSide(std::int32_t side);
  // Room for a ring at a site.
  void makeRoom(SiteNumber site);
  void toggle(std::int32_t cell, CellBits own, unsigned shift);
  void toggleRing(std::int32_t cell) { toggle(cell, ringBit, 0); }
  void toggleFiveRing(SiteNumber site);

  // Of the edge.
  void findEdge();
  void findFiveRings(std::span<const LatticeCell> fiveRings);
  SiteNumber addSite(SiteNumber after, std::int32_t cell, unsigned first, unsigned rings);
  void removeSite(SiteNumber site);
  SiteNumber newSite();
  void enlargePool();
  // So many sites from this one on have changed.
  void updateTypes(SiteNumber from, std::size_t changed);
  void setGroup(SiteNumber site, std::size_t which, SiteGroup group);
  [[nodiscard]] SiteType typeOf(SiteNumber site) const;
  [[nodiscard]] SiteGroup nearGroupOf(SiteNumber site) const;
  [[nodiscard]] bool isFreeEdge(SiteNumber site) const { return sites_[site].type == SiteType::FE; }
  [[nodiscard]] std::size_t place(SiteGroup group, std::size_t i) const {
    return static_cast<std::size_t>(group) * sites_.size() + i;
  }

  // What happens to cells and sites.
  void grow(SiteNumber site);
  void close(SiteNumber site);
  void removeOuterRing(SiteNumber site);
  bool removeInnerRing(SiteNumber site);
  bool placeFiveRing(SiteNumber site);
  bool moveFiveRing(SiteNumber site, bool ringGrows);
  bool shrinkToFiveRing(SiteNumber site, RandomStream& random);

  std::int32_t side_ = 0;  // cells along the lattice's two axes
  std::int32_t originQ_ = 0, originR_ = 0;
  std::array<std::int32_t, 6> steps_{};  // from a cell to its neighbours
  std::vector<CellBits> lattice_;

  std::vector<Site> sites_;  // a pool; `next` chains those that are not in use
  SiteNumber unused_ = 0, someSite_ = 0;
  std::vector<SiteNumber> members_;  // groups x size of the pool
  std::array<SiteNumber, siteGroups> groupSizes_{};
  std::array<SiteNumber, siteTypes> counts_{};
  std::size_t siteCount_ = 0, sixRings_ = 0, fiveRings_ = 0;
};

}  // namespace lampblack::particles
