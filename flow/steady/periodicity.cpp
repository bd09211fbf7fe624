#include "flow/steady/periodicity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace lampblack::flow {
namespace {

constexpr double constant = 1e-6;      // of a scale
constexpr double minor = 0.05;         // of the largest variation
constexpr double allowed = 0.05;       // of a range, between a value and that a period before
constexpr double hysteresis = 0.2;     // of a range, to either side of the middle
constexpr std::size_t periods = 3;     // that are looked at
constexpr std::size_t perPeriod = 16;  // times at least
constexpr std::size_t crossings = 4;   // upwards within a period, at most
constexpr double shorter = 0.7;        // of the part of the record that is looked at, to the next

class Record {
 public:
  Record(std::span<const double> times, std::span<const RecordedSignal> signals) : t_(times), signals_(signals) {}

  // From the time numbered `first` on.
  [[nodiscard]] Periodicity::Range rangeOf(const RecordedSignal& signal, std::size_t first) const {
    const auto [low, high] =
        std::minmax_element(signal.values.begin() + static_cast<std::ptrdiff_t>(first), signal.values.end());
    return {*low, *high};
  }

  // Times at which the signal passes upwards through the middle of its range, from the time numbered `first` on; a
  // small wiggle there does not count.
  [[nodiscard]] std::vector<double> risesOf(const RecordedSignal& signal, std::size_t first) const {
    const auto [low, high] = rangeOf(signal, first);
    const double middle = 0.5 * (low + high), band = hysteresis * (high - low);
    std::vector<double> rises;
    bool isBelow = false;
    double last = 0.0;  // the latest rise since it was below
    for (std::size_t i = first; i < t_.size(); ++i) {
      const double now = signal.values[i], before = signal.values[i > first ? i - 1 : i];
      if (before < middle && now >= middle) last = t_[i - 1] + (t_[i] - t_[i - 1]) * (middle - before) / (now - before);
      if (now < middle - band) isBelow = true;
      if (isBelow && now > middle + band) {
        rises.push_back(last);
        isBelow = false;
      }
    }
    return rises;
  }

  [[nodiscard]] std::size_t firstFrom(double time) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(t_, time) - t_.begin());
  }

  // By how much of its range, at most, a signal is away from what it was a period before; infinite where the record is
  // too short to tell.
  [[nodiscard]] double misfitOf(double period) const {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const double end = t_.back();
    if (end - static_cast<double>(periods) * period < t_.front() - 1e-9 * period) return unknown;
    const std::size_t last = firstFrom(end - period), looked = firstFrom(end - 2.0 * period);
    if (t_.size() - last < perPeriod) return unknown;
    const auto variationOf = [&](const RecordedSignal& signal) {
      const auto [low, high] = rangeOf(signal, looked);
      return high - low > constant * signal.scale ? (high - low) / signal.scale : 0.0;
    };
    double most = 0.0, misfit = 0.0;
    for (const RecordedSignal& signal : signals_) most = std::max(most, variationOf(signal));
    for (const RecordedSignal& signal : signals_) {
      if (variationOf(signal) <= minor * most) continue;
      const auto [low, high] = rangeOf(signal, last);
      if (!(high > low)) return unknown;
      for (std::size_t i = looked; i < t_.size(); ++i)
        misfit = std::max(misfit, std::abs(signal.values[i] - at(signal, t_[i] - period)) / (high - low));
    }
    return misfit;
  }

 private:
  [[nodiscard]] double at(const RecordedSignal& signal, double time) const {
    const std::size_t i = std::clamp<std::size_t>(firstFrom(time), 1, t_.size() - 1);
    const double part = (time - t_[i - 1]) / (t_[i] - t_[i - 1]);
    return signal.values[i - 1] + part * (signal.values[i] - signal.values[i - 1]);
  }

  std::span<const double> t_;
  std::span<const RecordedSignal> signals_;
};

}  // namespace

std::optional<Periodicity> periodicityOf(std::span<const double> times, std::span<const RecordedSignal> signals) {
  for (const RecordedSignal& signal : signals)
    if (signal.values.size() != times.size()) throw std::logic_error("a signal does not fit the times of the record");
  if (times.size() < periods * perPeriod) return {};
  const Record record(times, signals);
  std::vector<std::pair<double, double>> found;  // periods, and how well they fit
  // A part of the record has the fewer periods the shorter it is, and less of what was before they began.
  for (double part = times.back() - times.front();; part *= shorter) {
    const std::size_t first = record.firstFrom(times.back() - part);
    if (times.size() - first < periods * perPeriod) break;
    for (const RecordedSignal& signal : signals) {
      const auto [low, high] = record.rangeOf(signal, first);
      if (high - low <= constant * signal.scale) continue;
      const std::vector<double> rises = record.risesOf(signal, first);
      for (std::size_t each = 1; each <= crossings && rises.size() > periods * each; ++each) {
        const double period = (rises.back() - rises[rises.size() - 1 - periods * each]) / static_cast<double>(periods);
        if (const double misfit = record.misfitOf(period); misfit <= allowed) found.emplace_back(period, misfit);
      }
    }
  }
  if (found.empty()) return {};
  // Of those that are the shortest but for how well they are known, the one that fits best.
  const double longest = 1.5 * std::ranges::min(found).first;
  const double period = std::ranges::min(found, {}, [&](const auto& each) {
                          return each.first <= longest ? each.second : std::numeric_limits<double>::infinity();
                        }).first;
  Periodicity periodicity{period, {}};
  for (const RecordedSignal& signal : signals)
    periodicity.ranges.push_back(record.rangeOf(signal, record.firstFrom(times.back() - period)));
  return periodicity;
}

}  // namespace lampblack::flow
