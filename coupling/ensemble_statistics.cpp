#include "coupling/ensemble_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "coupling/block_statistics.hpp"

namespace lampblack::coupling {
namespace {

constexpr double nearly = 1.0 - 1e-9;  // of a time: steps add up to it but for round-off
// Distributions change as slowly as everything else, and cost a logarithm a particle to look at.
constexpr double looksInBlock = 20.0;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Names without the material.
const std::array<Quantity, EnsembleStatistics::amounts> amountFields{
    {{"number_density", "1/m^3", "aggregates, mean over time"},
     {"volume_fraction", "1", "particle volume per volume of gas, mean over time"},
     {"primaries", "1/m^3", "primary particles, per volume, mean over time"},
     {"surface_area", "m^2/m^3", "surface of all particles, mean over time"},
     {"mobility_diameter", "m", "mean mobility diameter: of the mean sum of diameters and the mean number"}}};

}  // namespace

EnsembleStatistics::EnsembleStatistics(const Mesh& mesh, std::string material, Options options,
                                       std::optional<SizeBins> bins)
    : mesh_(mesh), material_(std::move(material)), options_(options), bins_(bins) {
  clear();
}

void EnsembleStatistics::clear() {
  const auto owned = static_cast<std::size_t>(mesh_.owned);
  since_.reset();
  blockTime_ = sizesTime_ = sinceSizes_ = 0.0;
  blocks_ = 0;
  running_ = {};
  series_.clear();
  block_.assign(owned * amounts, 0.0);
  sums_.assign(owned * width, 0.0);
  sizes_.assign(owned * sizeCount(), 0.0);
}

void EnsembleStatistics::addStep(double time, double dt, const Source& source) {
  if (options_.start && !since_) {
    if (time - dt < *options_.start * nearly) return;
    since_ = time - dt;
  }
  const auto owned = static_cast<std::size_t>(mesh_.owned);
  for (std::size_t c = 0; c < owned; ++c) {
    const CellAmounts now = source.cell(static_cast<int>(c));
    running_[0] += dt * mesh_.volume[c] * now[volume];
    running_[1] += dt * mesh_.volume[c] * now[number];
    if (!since_) continue;
    for (std::size_t a = 0; a < amounts; ++a) block_[c * amounts + a] += dt * now[a];
  }
  blockTime_ += dt;
  const bool full = blockTime_ >= options_.block * nearly;
  if (since_ && bins_) {
    sinceSizes_ += dt;
    if (full || sinceSizes_ >= options_.block / looksInBlock * nearly) {
      std::vector<double> sizes(sizeCount());
      for (std::size_t c = 0; c < owned; ++c) {
        std::ranges::fill(sizes, 0.0);
        source.sizes(static_cast<int>(c), sizes);
        for (std::size_t b = 0; b < sizes.size(); ++b) sizes_[c * sizes.size() + b] += sinceSizes_ * sizes[b];
      }
      sizesTime_ += sinceSizes_;
      sinceSizes_ = 0.0;
    }
  }
  if (full) closeBlock(time);
}

void EnsembleStatistics::closeBlock(double time) {
  std::array<double, totals> all = running_;
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(totals), MPI_DOUBLE, MPI_SUM, mesh_.comm);
  for (const double total : all) series_.push_back(total / blockTime_);
  if (since_)
    addBlock();
  else if (isStationary(series(0, false), options_.drift) && isStationary(series(1, false), options_.drift))
    since_ = time;
  running_ = {};
  blockTime_ = 0.0;
}

// The recurrence of Welford (1962).
void EnsembleStatistics::addBlock() {
  const auto n = static_cast<double>(++blocks_);
  const auto owned = static_cast<std::size_t>(mesh_.owned);
  for (std::size_t c = 0; c < owned; ++c) {
    double* block = &block_[c * amounts];
    double* sums = &sums_[c * width];
    std::array<double, amounts> before{};
    for (std::size_t a = 0; a < amounts; ++a) {
      const double value = block[a] / blockTime_;
      before[a] = value - sums[a];
      sums[a] += before[a] / n;
      sums[amounts + a] += before[a] * (value - sums[a]);
      block[a] = 0.0;
    }
    sums[products] += before[number] * before[diameters] * (n - 1.0) / n;
  }
}

std::vector<double> EnsembleStatistics::series(std::size_t total, bool averagedOnly) const {
  std::vector<double> values;
  const std::size_t all = series_.size() / totals;
  for (std::size_t b = averagedOnly ? all - blocks_ : 0; b < all; ++b) values.push_back(series_[b * totals + total]);
  return values;
}

void EnsembleStatistics::fields(const Operator::FieldSink& sink) const {
  const auto owned = static_cast<std::size_t>(mesh_.owned);
  std::vector<double> mean(owned, unknown), halves(owned, unknown);
  const std::optional<BlockInterval> interval = BlockInterval::of(blocks_);
  for (std::size_t a = 0; a < amounts; ++a) {
    for (std::size_t c = 0; blocks_ > 0 && c < owned; ++c) {
      const double* sums = &sums_[c * width];
      mean[c] = sums[a];
      double squares = sums[amounts + a];
      if (a == diameters) {
        // Of a quotient, to the first order of the deviations.
        const double over = sums[number] > 0.0 ? 1.0 / sums[number] : 0.0;
        mean[c] *= over;
        squares = over * over * (squares - 2.0 * mean[c] * sums[products] + mean[c] * mean[c] * sums[amounts + number]);
      }
      if (interval) halves[c] = interval->half(squares);
    }
    const Quantity& quantity = amountFields[a];
    const std::string name = material_ + "_" + quantity.name;
    if (sink.future || blocks_ > 0) sink({name + "_mean", quantity.unit, quantity.description}, mean);
    if (sink.future || interval)
      sink({name + "_interval", quantity.unit,
            fmt::format("half the width of the 95 % interval of confidence of {}_mean", name)},
           halves);
  }
  if (!bins_ || (!sink.future && !(sizesTime_ > 0.0))) return;
  std::vector<double> sizes(sizes_.size(), unknown);
  if (sizesTime_ > 0.0) std::ranges::transform(sizes_, sizes.begin(), [this](double x) { return x / sizesTime_; });
  sink({material_ + "_size_distribution_mean", "1/m^3", "dN/dlog10(d) by mobility diameter, mean over time"}, sizes);
}

std::vector<std::string> EnsembleStatistics::closingLines() const {
  const double ms = 1e3 * options_.block;
  if (!since_) {
    if (options_.start)
      return {fmt::format("no averages of the {}: they start at t = {:.6g} s", material_, *options_.start)};
    return {fmt::format("no averages of the {}: after {} blocks of {:.4g} ms it is not stationary yet", material_,
                        series_.size() / totals, ms)};
  }
  std::string begin = fmt::format("averages of the {} since t = {:.6g} s{}: {} blocks of {:.4g} ms", material_, *since_,
                                  options_.start ? "" : ", when it was found stationary", blocks_, ms);
  const std::optional<BlockInterval> interval = BlockInterval::of(blocks_);
  if (!interval) return {std::move(begin), fmt::format("no intervals of confidence: they take {} blocks", leastBlocks)};
  const std::array<std::vector<double>, totals> all{series(0, true), series(1, true)};
  std::array<double, totals> relative{};
  double lagOne = 0.0;
  for (std::size_t t = 0; t < totals; ++t) {
    const BlockMean of = meanOf(all[t]);
    if (of.mean > 0.0) relative[t] = interval->half(of.squares) / of.mean;
    if (areCorrelated(all[t])) lagOne = std::max(lagOne, lagOneCorrelation(all[t]));
  }
  std::string within =
      fmt::format("means of the domain's {} volume within {:.2g} %, of its number within {:.2g} % (95 %)", material_,
                  1e2 * relative[0], 1e2 * relative[1]);
  if (!(lagOne > 0.0)) return {std::move(begin), std::move(within)};
  const double time = correlationTime(lagOne) * ms;
  return {
      std::move(begin), std::move(within),
      fmt::format("warning: the blocks of {:.4g} ms are correlated ({:.2f} from one to the next), so that intervals "
                  "are too narrow: the correlation time of {} is about {:.2g} ms; choose blocks of {:.2g} ms",
                  ms, lagOne, material_, time, longBlock * time)};
}

std::vector<double> EnsembleStatistics::kind() const {
  return {static_cast<double>(amounts), static_cast<double>(totals), static_cast<double>(sizeCount()),
          bins_ ? bins_->logMin : 0.0, bins_ ? bins_->logMax : 0.0};
}

void EnsembleStatistics::saveOrLoad(StateArchive& archive, EnsembleStatistics* statistics) {
  std::vector<double> head{0.0};
  if (statistics) head = statistics->head();
  archive.shared("ensemble_statistics", head);
  if (!statistics || (archive.loading() && !statistics->takeHead(head))) return;
  archive.cells("ensemble_statistics_block", statistics->block_, static_cast<int>(amounts));
  archive.cells("ensemble_statistics_sums", statistics->sums_, static_cast<int>(width));
  archive.sums("ensemble_statistics_totals", statistics->running_);
  if (statistics->bins_)
    archive.cells("ensemble_statistics_sizes", statistics->sizes_, static_cast<int>(statistics->sizeCount()));
}

std::vector<double> EnsembleStatistics::head() const {
  std::vector<double> all = kind();
  all.insert(all.end(), {options_.block, since_.value_or(unknown), blockTime_, static_cast<double>(blocks_), sizesTime_,
                         sinceSizes_});
  all.insert(all.end(), series_.begin(), series_.end());
  return all;
}

bool EnsembleStatistics::takeHead(std::span<const double> head) {
  clear();
  const std::vector<double> own = kind();
  if (head.size() < own.size() + clocks || !std::ranges::equal(own, head.first(own.size()))) return false;
  const std::span<const double> clock = head.subspan(own.size());
  options_.block = clock[0];
  if (!std::isnan(clock[1])) since_ = clock[1];
  blockTime_ = clock[2];
  blocks_ = static_cast<std::size_t>(clock[3]);
  sizesTime_ = clock[4];
  sinceSizes_ = clock[5];
  series_.assign(clock.begin() + clocks, clock.end());
  return true;
}

}  // namespace lampblack::coupling
