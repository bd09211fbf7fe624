// What site counting does not know of a molecule, in the mean over molecules of the lattice of about its size: how many
// of its sites are what processes start from and have room for them, and what is beside these. Whole numbers seen in
// runs of the lattice, so that tables of several runs add up. docs/theory/site_counting.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/pah/site_counts.hpp"

namespace lampblack::particles {

// Neighbours that a process changes which starts from a site of this group: `count` of them.
struct SitesBeside {
  std::array<Molecule::SiteNumber, 2> site{};
  std::size_t count = 0;
};
[[nodiscard]] SitesBeside sitesBeside(const Molecule& molecule, SiteGroup group, Molecule::SiteNumber site);

class SiteClosure {
 public:
  // Classes by carbon atoms, each up to twice as many as its first has: 8 of them between a power of two and the next;
  // in each by H over that of the most compact molecule, sqrt(6 C).
  static constexpr std::size_t compactness = 3;
  static constexpr std::array<double, compactness - 1> compactnessEdges{1.1, 1.25};
  static constexpr std::size_t carbonClasses = 64;
  [[nodiscard]] static std::size_t classOf(int carbon, int hydrogen);

  // Whole numbers: of a class.
  struct Seen {
    std::uint64_t molecules = 0;
    std::array<std::uint64_t, countedSites> sites{};
    std::array<std::uint64_t, siteGroups> groups{};
    std::array<std::array<std::uint64_t, countedSites>, siteGroups> beside{};
  };

  SiteClosure() : seen_(carbonClasses * compactness) {}
  void add(const Molecule& molecule);
  [[nodiscard]] const std::vector<Seen>& seen() const { return seen_; }
  // All of them in a row, to be added up, sent and saved. InputError for another number of them.
  [[nodiscard]] std::vector<std::uint64_t> numbers() const;
  void setNumbers(const std::vector<std::uint64_t>& numbers);

  // Makes it ready to be asked: classes without molecules are as the nearest with some. InputError without any.
  void prepare();
  // Sites of a group that a molecule of these numbers has in the mean.
  [[nodiscard]] double expected(std::size_t sizeClass, SiteGroup group, const SiteCounts& counts) const;
  // Draws a neighbour of a site of the group among those that are left; false where none of them can be one.
  bool drawNeighbour(std::size_t sizeClass, SiteGroup group, const SiteCounts::Numbers& left, RandomStream& random,
                     SiteType& neighbour) const;

  // As text: a line for each class that has molecules. InputError for what write() did not write.
  [[nodiscard]] std::string write(const std::string& conditions) const;
  [[nodiscard]] static SiteClosure read(const std::string& text);

 private:
  struct Law {
    std::array<double, siteGroups> share{};  // of the sites that a group is made of
    std::array<std::array<double, countedSites>, siteGroups> beside{};
  };
  template <class F>
  static void forEachNumber(auto& seen, F f);

  std::vector<Seen> seen_;
  std::vector<Law> laws_;
};

}  // namespace lampblack::particles
