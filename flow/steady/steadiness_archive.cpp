// What is kept of it in checkpoints.
#include <algorithm>

#include "flow/steady/steadiness.hpp"

namespace lampblack::flow {

void Steadiness::saveOrLoad(StateArchive& archive, const std::string& prefix) {
  archive.cells(prefix + "steady_low", low_, width_);
  archive.cells(prefix + "steady_high", high_, width_);
  std::vector<double> now{last_, pressure_[0], pressure_[1], pressureNow_};
  now.insert(now.end(), sums_.begin(), sums_.end());
  archive.shared(prefix + "steady_piece", now);
  std::vector<double> earlier;
  for (const Piece& piece : pieces_) {
    earlier.insert(earlier.end(), piece.sums.begin(), piece.sums.end());
    for (const auto* values : {&piece.maximum, &piece.rms, &piece.places})
      earlier.insert(earlier.end(), values->begin(), values->end());
  }
  archive.shared(prefix + "steady_pieces", earlier);
  std::vector<double> rows;  // the time and the signals
  for (std::size_t i = 0; i < times_.size(); ++i) {
    rows.push_back(times_[i]);
    for (const RecordedSignal& signal : signals_) rows.push_back(signal.values[i]);
  }
  archive.shared(prefix + "steady_record", rows);
  std::vector<double> period;
  if (periodicity_) {
    period.push_back(periodicity_->period);
    for (const Periodicity::Range& range : periodicity_->ranges) period.insert(period.end(), {range.low, range.high});
  }
  for (const RecordedSignal& signal : signals_) period.push_back(signal.scale);
  archive.shared(prefix + "steady_period", period);
  if (!archive.loading()) return;

  last_ = now.at(0);
  pressure_ = {now.at(1), now.at(2)};
  pressureNow_ = now.at(3);
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] = now.at(4 + i);
  pieces_.clear();
  const std::size_t values = fields_.size() + 1, places = 3 * fields_.size();
  auto from = earlier.cbegin();
  const auto take = [&from](std::size_t number) {
    const auto begin = from;
    from += static_cast<std::ptrdiff_t>(number);
    return std::vector<double>(begin, from);
  };
  while (from != earlier.cend()) {
    Piece& piece = pieces_.emplace_back();
    std::ranges::copy(take(piece.sums.size()), piece.sums.begin());
    piece.maximum = take(values);
    piece.rms = take(values);
    piece.places = take(places);
  }
  times_.clear();
  for (RecordedSignal& signal : signals_) signal.values.clear();
  for (std::size_t i = 0; i < rows.size(); i += 1 + signals_.size()) {
    times_.push_back(rows[i]);
    for (std::size_t s = 0; s < signals_.size(); ++s) signals_[s].values.push_back(rows.at(i + 1 + s));
  }
  const std::size_t scalesBegin = period.size() - signals_.size();
  for (std::size_t s = 0; s < signals_.size(); ++s) signals_[s].scale = period.at(scalesBegin + s);
  periodicity_.reset();
  if (scalesBegin == 0) return;
  periodicity_.emplace().period = period[0];
  for (std::size_t i = 1; i < scalesBegin; i += 2) periodicity_->ranges.push_back({period.at(i), period.at(i + 1)});
}

}  // namespace lampblack::flow
