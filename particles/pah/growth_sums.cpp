#include "particles/pah/growth_sums.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

constexpr double missingValue = std::numeric_limits<double>::quiet_NaN();
constexpr SiteGroup nearGroups[] = {SiteGroup::FE3, SiteGroup::FE_HACA, SiteGroup::AC_FE3};
constexpr const char* nearGroupNames[] = {"FE3", "FE_HACA", "AC_FE3"};

[[noreturn]] void refuseSums() {
  throw NumericsError("sums over molecules are more than 2^64: fewer repeats, or a shorter time, are needed");
}

void addTo(std::uint64_t& sum, std::uint64_t value) {
  if (__builtin_add_overflow(sum, value, &sum)) refuseSums();
}

void addEventsOf(const auto& growth, GrowthValues& values) {
  for (const auto* counts : {&growth.events(), &growth.voids()})
    values.insert(values.end(), counts->begin(), counts->end());
}

// Numbers of 64 bits as two of 32, which doubles hold.
void archived(StateArchive& archive, const std::string& name, std::vector<std::uint64_t>& numbers) {
  std::vector<double> halves;
  if (!archive.loading())
    for (const std::uint64_t n : numbers)
      halves.insert(halves.end(), {static_cast<double>(n >> 32U), static_cast<double>(n & 0xffffffffU)});
  archive.shared(name, halves);
  if (!archive.loading()) return;
  numbers.assign(halves.size() / 2, 0);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = (static_cast<std::uint64_t>(halves[2 * i]) << 32U) + static_cast<std::uint64_t>(halves[2 * i + 1]);
}

constexpr std::size_t formulaNumbers = 4;
constexpr std::size_t formulaQuantities = 4;  // atoms and rings, before the sites

std::vector<std::uint64_t> flat(const std::map<RowFormula, std::uint64_t>& formulas) {
  std::vector<std::uint64_t> numbers;
  for (const auto& [formula, count] : formulas)
    numbers.insert(numbers.end(), {formula.row, formula.carbon, formula.hydrogen, count});
  return numbers;
}

void addFlat(const std::vector<std::uint64_t>& numbers, std::map<RowFormula, std::uint64_t>& formulas) {
  for (std::size_t i = 0; i + 3 < numbers.size(); i += formulaNumbers)
    formulas[{numbers[i], numbers[i + 1], numbers[i + 2]}] += numbers[i + 3];
}

}  // namespace

const std::vector<Quantity>& growthQuantities() {
  static const std::vector<Quantity> quantities = [] {
    std::vector<Quantity> all{{"carbon", "1", "carbon atoms of a molecule"},
                              {"hydrogen", "1", "hydrogen atoms of a molecule"},
                              {"six_rings", "1", "rings of six of a molecule"},
                              {"five_rings", "1", "rings of five of a molecule"}};
    for (const char* name : siteTypeNames)
      all.push_back({std::string("sites_") + name, "1", std::string("sites of type ") + name});
    for (const char* name : nearGroupNames)
      all.push_back({std::string("sites_") + name, "1", std::string("sites that are ") + name});
    for (const PahProcessRow& row : pahProcesses)
      all.push_back(
          {std::string("events_") + row.name, "1", std::string("events since the start in which ") + row.description});
    for (const PahProcessRow& row : pahProcesses)
      all.push_back({std::string("void_") + row.name, "1",
                     std::string("events ") + row.name + " since the start that another ring was in the way of"});
    return all;
  }();
  return quantities;
}

GrowthValues valuesOf(const MoleculeGrowth& growth) {
  const Molecule& molecule = growth.molecule();
  GrowthValues values{molecule.carbon(), molecule.hydrogen(), molecule.sixRings(), molecule.fiveRings()};
  for (std::size_t t = 0; t < siteTypes; ++t) values.push_back(molecule.count(static_cast<SiteType>(t)));
  for (const SiteGroup group : nearGroups) values.push_back(molecule.count(group));
  addEventsOf(growth, values);
  return values;
}

bool isCounted(std::size_t quantity) {
  return quantity < formulaQuantities + countedSites ||
         quantity >= formulaQuantities + siteTypes + std::size(nearGroups);
}

GrowthValues valuesOf(const SiteCounting& growth) {
  const SiteCounts& counts = growth.counts();
  const auto whole = [](int n) { return static_cast<std::uint64_t>(n); };
  const int five = counts.count(SiteType::R5);
  GrowthValues values{whole(counts.carbon()), whole(counts.hydrogen()), whole(counts.rings() - five), whole(five)};
  for (const int n : counts.sites()) values.push_back(whole(n));
  values.resize(values.size() + siteTypes - countedSites + std::size(nearGroups), 0);
  addEventsOf(growth, values);
  return values;
}

GrowthSums::GrowthSums(std::size_t rows)
    : count_(rows), sum_(rows * growthQuantities().size()), squares_(sum_.size()) {}

std::size_t GrowthSums::place(std::size_t row, std::size_t quantity) const {
  return row * (sum_.size() / count_.size()) + quantity;
}

void GrowthSums::add(std::size_t row, const GrowthValues& values) {
  ++count_[row];
  std::size_t at = place(row, 0);
  for (const std::uint64_t value : values) {
    std::uint64_t square = 0;
    if (__builtin_mul_overflow(value, value, &square)) refuseSums();
    addTo(sum_[at], value);
    addTo(squares_[at], square);
    ++at;
  }
}

void GrowthSums::addFormula(std::size_t row, const GrowthValues& values) {
  ++formulas_[{row, values[0], values[1]}];
}

void GrowthSums::add(const GrowthSums& other) {
  for (const auto part : {&GrowthSums::count_, &GrowthSums::sum_, &GrowthSums::squares_})
    for (std::size_t i = 0; i < (this->*part).size(); ++i) addTo((this->*part)[i], (other.*part)[i]);
  addTo(events_, other.events_);
  for (const auto& [formula, count] : other.formulas_) formulas_[formula] += count;
  std::vector<std::uint64_t> numbers = closure_.numbers();
  const std::vector<std::uint64_t> others = other.closure_.numbers();
  for (std::size_t i = 0; i < numbers.size(); ++i) addTo(numbers[i], others[i]);
  closure_.setNumbers(numbers);
}

GrowthSums GrowthSums::ofAllRanks(MPI_Comm comm) const {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  GrowthSums all = *this;
  // What rank 0 cannot hold is seen from the sums of doubles.
  double largest = 0;
  for (const auto part : {&GrowthSums::count_, &GrowthSums::sum_, &GrowthSums::squares_}) {
    std::vector<double> sums((this->*part).begin(), (this->*part).end());
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm);
    for (const double sum : sums) largest = std::max(largest, sum);
    std::vector<std::uint64_t>& own = all.*part;
    MPI_Reduce(rank == 0 ? MPI_IN_PLACE : own.data(), own.data(), static_cast<int>(own.size()), MPI_UINT64_T, MPI_SUM,
               0, comm);
  }
  collectively(comm, [&] {
    if (largest > 1.8e19) refuseSums();
  });
  MPI_Reduce(rank == 0 ? MPI_IN_PLACE : &all.events_, &all.events_, 1, MPI_UINT64_T, MPI_SUM, 0, comm);
  std::vector<std::uint64_t> beside = closure_.numbers();
  MPI_Reduce(rank == 0 ? MPI_IN_PLACE : beside.data(), beside.data(), static_cast<int>(beside.size()), MPI_UINT64_T,
             MPI_SUM, 0, comm);
  all.closure_.setNumbers(beside);

  const std::vector<std::uint64_t> own = flat(formulas_);
  const auto size = static_cast<int>(own.size());
  std::vector<int> sizes(static_cast<std::size_t>(ranks)), starts(sizes.size());
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, comm);
  std::size_t total = 0;
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    starts[r] = static_cast<int>(total);
    total += static_cast<std::size_t>(sizes[r]);
  }
  std::vector<std::uint64_t> gathered(rank == 0 ? total : 0);
  MPI_Gatherv(own.data(), size, MPI_UINT64_T, gathered.data(), sizes.data(), starts.data(), MPI_UINT64_T, 0, comm);
  if (rank == 0) {
    all.formulas_.clear();
    addFlat(gathered, all.formulas_);
  }
  return all;
}

void GrowthSums::saveOrLoad(StateArchive& archive, int rank) {
  std::vector<std::uint64_t> numbers = flat(formulas_), events{events_};
  const std::size_t rows = count_.size(), size = sum_.size();
  archived(archive, "molecules", count_);
  archived(archive, "sums", sum_);
  archived(archive, "squares", squares_);
  archived(archive, "events", events);
  archived(archive, "formulas", numbers);
  std::vector<std::uint64_t> beside = closure_.numbers();
  archived(archive, "neighbours", beside);
  if (!archive.loading()) return;
  if (count_.size() != rows || sum_.size() != size || squares_.size() != size || events.size() != 1)
    throw InputError("the checkpoint has other rows or quantities than this run");
  formulas_.clear();
  events_ = events[0];
  addFlat(numbers, formulas_);
  closure_.setNumbers(beside);
  if (rank != 0) *this = GrowthSums(rows);
}

double GrowthSums::mean(std::size_t row, std::size_t quantity) const {
  if (count_[row] == 0) return missingValue;
  return static_cast<double>(sum_[place(row, quantity)]) / static_cast<double>(count_[row]);
}

double GrowthSums::standardError(std::size_t row, std::size_t quantity) const {
  if (count_[row] < 2) return missingValue;
  const std::size_t at = place(row, quantity);
  // n sum x^2 - (sum x)^2, without loss.
  __extension__ using Wide = unsigned __int128;
  const Wide n = count_[row], sum = sum_[at];
  const auto spread = static_cast<double>(n * squares_[at] - sum * sum);
  const auto count = static_cast<double>(count_[row]);
  return std::sqrt(spread / (count * count * (count - 1)));
}

}  // namespace lampblack::particles
