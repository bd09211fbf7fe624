#include "particles/pah/site_closure.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

constexpr std::array<const char*, siteGroups> groupNames{"FE",  "ZZ",  "AC",  "BY6",     "R5",    "RFE",
                                                         "RZZ", "RAC", "FE3", "FE_HACA", "AC_FE3"};

// The counted sites that a group is a share of.
SiteType baseOf(SiteGroup group) {
  switch (group) {
    case SiteGroup::ZZ:
      return SiteType::ZZ;
    case SiteGroup::AC:
    case SiteGroup::AC_FE3:
      return SiteType::AC;
    case SiteGroup::BY6:
      return SiteType::BY6;
    case SiteGroup::R5:
    case SiteGroup::RFE:
    case SiteGroup::RZZ:
    case SiteGroup::RAC:
      return SiteType::R5;
    default:
      return SiteType::FE;
  }
}

}  // namespace

SitesBeside sitesBeside(const Molecule& m, SiteGroup group, Molecule::SiteNumber site) {
  const Molecule::SiteNumber next = m.next(site), previous = m.previous(site);
  switch (group) {
    case SiteGroup::FE:
    case SiteGroup::AC:
    case SiteGroup::BY6:
    case SiteGroup::FE_HACA:
      return {{previous, next}, 2};
    case SiteGroup::FE3:
      return {{m.previous(previous), m.next(next)}, 2};
    case SiteGroup::RFE:
    case SiteGroup::RAC:
      return {{m.type(next) == SiteType::R5 ? previous : next}, 1};
    case SiteGroup::AC_FE3:  // behind the three free edges
      return {{m.isMiddle(m.next(next)) ? m.next(m.next(m.next(next))) : m.previous(m.previous(m.previous(previous)))},
              1};
    default:
      return {};
  }
}

std::size_t SiteClosure::classOf(int carbon, int hydrogen) {
  const double size = 8 * std::log2(std::max(carbon, 4) / 4.0);
  const double relative = hydrogen / std::sqrt(6.0 * carbon);
  std::size_t k = 0;
  while (k + 1 < compactness && relative >= compactnessEdges[k]) ++k;
  return std::min(static_cast<std::size_t>(size + 1e-9), carbonClasses - 1) * compactness + k;
}

void SiteClosure::add(const Molecule& molecule) {
  Seen& seen = seen_[classOf(static_cast<int>(molecule.carbon()), static_cast<int>(molecule.hydrogen()))];
  ++seen.molecules;
  for (std::size_t t = 0; t < siteTypes; ++t) {
    const auto type = static_cast<SiteType>(t);
    seen.sites[static_cast<std::size_t>(countedType(type))] += molecule.count(type);
  }
  for (std::size_t g = 0; g < siteGroups; ++g) {
    const auto group = static_cast<SiteGroup>(g);
    for (std::size_t i = 0; i < molecule.count(group); ++i) {
      const auto site = molecule.member(group, i);
      if (!molecule.hasRoom(group, site)) continue;
      ++seen.groups[g];
      const SitesBeside beside = sitesBeside(molecule, group, site);
      for (std::size_t k = 0; k < beside.count; ++k)
        ++seen.beside[g][static_cast<std::size_t>(countedType(molecule.type(beside.site[k])))];
    }
  }
}

void SiteClosure::prepare() {
  std::vector<std::size_t> known;
  for (std::size_t k = 0; k < seen_.size(); ++k)
    if (seen_[k].molecules > 0) known.push_back(k);
  if (known.empty()) throw InputError("site counting: the table of neighbours has no molecule");
  const auto distance = [](std::size_t a, std::size_t b) {  // first by size, then by compactness
    const auto apart = [](std::size_t x, std::size_t y) { return x > y ? x - y : y - x; };
    return compactness * apart(a / compactness, b / compactness) + apart(a % compactness, b % compactness);
  };
  laws_.assign(seen_.size(), {});
  for (std::size_t k = 0; k < seen_.size(); ++k) {
    const Seen& seen = seen_[*std::ranges::min_element(known, {}, [&](std::size_t i) { return distance(i, k); })];
    for (std::size_t g = 0; g < siteGroups; ++g) {
      const auto base = static_cast<double>(seen.sites[static_cast<std::size_t>(baseOf(static_cast<SiteGroup>(g)))]);
      laws_[k].share[g] = base > 0 ? static_cast<double>(seen.groups[g]) / base : 0;
      if (static_cast<SiteGroup>(g) == SiteGroup::R5) laws_[k].share[g] = 1;  // all of them
      for (std::size_t t = 0; t < countedSites; ++t) laws_[k].beside[g][t] = static_cast<double>(seen.beside[g][t]);
    }
  }
}

double SiteClosure::expected(std::size_t sizeClass, SiteGroup group, const SiteCounts& counts) const {
  return laws_[sizeClass].share[static_cast<std::size_t>(group)] * counts.count(baseOf(group));
}

bool SiteClosure::drawNeighbour(std::size_t sizeClass, SiteGroup group, const SiteCounts::Numbers& left,
                                RandomStream& random, SiteType& neighbour) const {
  const auto& beside = laws_[sizeClass].beside[static_cast<std::size_t>(group)];
  double total = 0;
  for (std::size_t t = 0; t < countedSites; ++t) total += left[t] > 0 ? beside[t] : 0;
  if (!(total > 0)) return false;
  double at = random.uniform() * total;
  for (std::size_t t = 0; t < countedSites; ++t) {
    if (left[t] <= 0) continue;
    if (!(beside[t] > 0)) continue;
    neighbour = static_cast<SiteType>(t);
    if ((at -= beside[t]) < 0) break;
  }
  return true;
}

template <class F>
void SiteClosure::forEachNumber(auto& seen, F f) {
  f(seen.molecules);
  for (auto& n : seen.sites) f(n);
  for (auto& n : seen.groups) f(n);
  for (auto& group : seen.beside)
    for (auto& n : group) f(n);
}

std::vector<std::uint64_t> SiteClosure::numbers() const {
  std::vector<std::uint64_t> all;
  for (const Seen& seen : seen_) forEachNumber(seen, [&](std::uint64_t n) { all.push_back(n); });
  return all;
}

void SiteClosure::setNumbers(const std::vector<std::uint64_t>& numbers) {
  if (numbers.size() != this->numbers().size())
    throw InputError("site counting: a table of neighbours of another size");
  std::size_t i = 0;
  for (Seen& seen : seen_) forEachNumber(seen, [&](std::uint64_t& n) { n = numbers[i++]; });
}

std::string SiteClosure::write(const std::string& conditions) const {
  std::ostringstream out;
  out << "# Sites of molecules of the lattice and what is beside them, for site counting. " << conditions << "\n";
  out << "class,molecules";
  for (std::size_t t = 0; t < countedSites; ++t) out << "," << siteTypeNames[t];
  for (const char* name : groupNames) out << ",group_" << name;
  for (const char* name : groupNames)
    for (std::size_t t = 0; t < countedSites; ++t) out << "," << name << "_beside_" << siteTypeNames[t];
  out << "\n";
  for (std::size_t k = 0; k < seen_.size(); ++k) {
    const Seen& seen = seen_[k];
    if (seen.molecules == 0) continue;
    out << k;
    forEachNumber(seen, [&](std::uint64_t n) { out << "," << n; });
    out << "\n";
  }
  return out.str();
}

SiteClosure SiteClosure::read(const std::string& text) {
  SiteClosure closure;
  std::istringstream in(text);
  std::string line;
  std::size_t number = 0;
  bool isHead = true;
  while (std::getline(in, line)) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    if (std::exchange(isHead, false)) continue;
    std::istringstream fields(line);
    const auto next = [&] {
      std::string field;
      std::uint64_t value = 0;
      if (!std::getline(fields, field, ',') || field.empty() ||
          field.find_first_not_of("0123456789") != std::string::npos || field.size() > 18)
        throw InputError("site counting: line " + std::to_string(number) +
                         " of the table of neighbours is not one of whole numbers, as many as the head has");
      for (const char c : field) value = 10 * value + static_cast<std::uint64_t>(c - '0');
      return value;
    };
    const std::uint64_t k = next();
    if (k >= closure.seen_.size())
      throw InputError("site counting: line " + std::to_string(number) + " of the table of neighbours has no class");
    forEachNumber(closure.seen_[k], [&](std::uint64_t& n) { n = next(); });
  }
  closure.prepare();
  return closure;
}

}  // namespace lampblack::particles
