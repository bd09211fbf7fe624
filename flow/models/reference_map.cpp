#include "flow/models/reference_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "core/random.hpp"
#include "core/ranks.hpp"

namespace lampblack::flow {
namespace {

constexpr std::uint32_t mapCheckStream = 0x6d617063;
// Of a bin's width, where the first one begins; no fraction of small numbers.
constexpr double beginOfBins = 0.381966;

std::int64_t binOfValue(double value, double width) {
  return std::llround(std::floor(value / width + beginOfBins));
}

// The rank that looks after a bin.
int homeOf(const ReferenceMap::Bin& bin, int ranks) {
  std::uint64_t word = 0;
  for (const std::int64_t number : bin)
    word = RandomStream(word, static_cast<std::uint64_t>(number), mapCheckStream).bits();
  return static_cast<int>(word % static_cast<std::uint64_t>(ranks));
}

}  // namespace

ReferenceMap::Bin ReferenceMap::binOf(double temperature, double density, std::span<const double> Y) const {
  return {binOfValue(mixtureFraction_.of(Y), options_.mixtureWidth), binOfValue(temperature, options_.temperatureWidth),
          binOfValue(std::log(density), options_.densityWidth)};
}

bool ReferenceMap::isChecked(std::int64_t number, double time) const {
  RandomStream random(std::bit_cast<std::uint64_t>(time), static_cast<std::uint64_t>(number), mapCheckStream);
  return random.uniform() < options_.checked;
}

ReferenceCells::ReferenceCells(MPI_Comm comm, std::span<const Cell> cells)
    : binOf_(cells.size()), isReference_(cells.size(), 0) {
  std::map<ReferenceMap::Bin, std::size_t> numbers;
  std::vector<ReferenceMap::Bin> bins;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto [place, isNew] = numbers.try_emplace(cells[i].bin, bins.size());
    binOf_[i] = place->second;
    if (isNew) {
      bins.push_back(cells[i].bin);
      first_.push_back(i);
    } else if (std::size_t& first = first_[place->second]; cells[i].number < cells[first].number) {
      first = i;
    }
  }
  struct Offer {
    ReferenceMap::Bin bin;
    std::int64_t number;
  };
  const int ranks = ranksOf(comm);
  std::vector<Offer> offers;
  std::vector<int> homes;
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    offers.push_back({bins[bin], cells[first_[bin]].number});
    homes.push_back(homeOf(bins[bin], ranks));
  }
  toHome_.emplace(comm, homes);
  const std::vector<Offer> came = toHome_->send(offers, 1);
  std::map<ReferenceMap::Bin, std::size_t> holders;
  for (std::size_t i = 0; i < came.size(); ++i) {
    const auto [place, isNew] = holders.try_emplace(came[i].bin, i);
    if (!isNew && came[i].number < came[place->second].number) place->second = i;
  }
  for (const Offer& offer : came) holder_.push_back(holders.at(offer.bin));
  std::vector<char> holds;
  for (std::size_t i = 0; i < came.size(); ++i) holds.push_back(holder_[i] == i);
  const std::vector<char> isHolder = toHome_->reply(holds, 1);
  for (std::size_t bin = 0; bin < first_.size(); ++bin) isReference_[first_[bin]] = isHolder[bin];
}

void ReferenceCells::spread(std::size_t width, const std::function<void(std::size_t, std::span<double>)>& give,
                            const std::function<void(std::size_t, std::span<const double>)>& take) const {
  PackedRows offered;
  std::vector<double> row(width);
  for (const std::size_t cell : first_) {
    if (isReference(cell)) give(cell, row);
    offered.add(std::span(row).first(isReference(cell) ? width : 0));
  }
  const PackedRows came = toHome_->send(offered);
  std::vector<std::size_t> starts;
  for (std::size_t i = 0, start = 0; i < came.lengths.size(); start += static_cast<std::size_t>(came.lengths[i++]))
    starts.push_back(start);
  PackedRows answers;  // to those without a row of their own
  for (std::size_t i = 0; i < holder_.size(); ++i)
    answers.add(std::span(came.values).subspan(starts[holder_[i]], holder_[i] == i ? 0 : width));
  const PackedRows answered = toHome_->reply(answers);
  std::vector<std::span<const double>> rows;
  std::size_t ownStart = 0, otherStart = 0;
  for (std::size_t bin = 0; bin < first_.size(); ++bin) {
    const auto own = static_cast<std::size_t>(offered.lengths[bin]);
    const auto other = static_cast<std::size_t>(answered.lengths[bin]);
    rows.push_back(own > 0 ? std::span(offered.values).subspan(ownStart, own)
                           : std::span(answered.values).subspan(otherStart, other));
    ownStart += own;
    otherStart += other;
  }
  for (std::size_t cell = 0; cell < binOf_.size(); ++cell)
    if (!isReference(cell)) take(cell, rows[binOf_[cell]]);
}

void MapTally::add(const MapTally& other) {
  cells += other.cells;
  mapped += other.mapped;
  refused += other.refused;
  checked += other.checked;
  heat += other.heat;
  heatError += other.heatError;
  temperatureError = std::max(temperatureError, other.temperatureError);
  fractionError = std::max(fractionError, other.fractionError);
}

MapTally MapTally::overRanks(MPI_Comm comm) const {
  std::array<double, 6> sums{cells, mapped, refused, checked, heat, heatError};
  std::array<double, 2> largest{temperatureError, fractionError};
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 6, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, comm);
  return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], largest[0], largest[1]};
}

void MapTally::saveOrLoad(StateArchive& archive, MPI_Comm comm) {
  std::array<double, 6> sums{cells, mapped, refused, checked, heat, heatError};
  archive.sums("reference_map_counts", sums);
  std::vector<double> largest{temperatureError, fractionError};
  if (!archive.loading()) MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, comm);
  archive.shared("reference_map_errors", largest);
  *this = {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], largest.at(0), largest.at(1)};
}

std::vector<Quantity> MapTally::columns() {
  return {{"mapped_cells", "1", "cells that took the reactions of another cell since the last row, over all stages"},
          {"map_refused_cells", "1",
           "cells of the reference map that reacted by themselves, as a mass fraction would have been below zero"},
          {"map_checked_cells", "1", "mapped cells whose own reactions were found as well, for the errors"},
          {"map_temperature_error", "K", "largest error of a checked cell's temperature after a step"},
          {"map_fraction_error", "1", "largest error of a checked cell's mass fractions after a step"},
          {"map_heat_error", "1", "error of the heat that checked cells set free, mean of amounts over their mean"}};
}

std::vector<double> MapTally::values() const {
  return {mapped, refused, checked, temperatureError, fractionError, relativeHeatError()};
}

std::string MapTally::line() const {
  const double share = cells > 0.0 ? 100.0 * mapped / cells : 0.0;
  const std::string did = fmt::format("reference map: {:.3g} % of the cells took the reactions of another", share);
  if (checked == 0.0) return did + "; none was checked";
  return did + fmt::format(
                   "; of {:.0f} that were checked the temperature after a step is {:.2g} K off at most, a mass "
                   "fraction {:.2g}, the heat set free {:.2g} % in the mean",
                   checked, temperatureError, fractionError, 100.0 * relativeHeatError());
}

}  // namespace lampblack::flow
