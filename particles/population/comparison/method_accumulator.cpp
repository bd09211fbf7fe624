#include "particles/population/comparison/method_accumulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lampblack::particles {
namespace {

// Scatter of the repeats below this part of the mean is round-off, not noise.
constexpr double scatterRoundOff = 1e-12;

FourMoments all(double value) {
  return {value, value, value, value};
}

double relative(double value, double exact) {
  return value == exact ? 0.0 : value / exact - 1;
}

void addCounters(PopulationCounters& sum, const PopulationCounters& more) {
  for (const PopulationCounter& counter : populationCounters) sum.*counter.value += more.*counter.value;
}

}  // namespace

MethodAccumulator::MethodAccumulator(const PopulationCase& populationCase, const PopulationMethod& method,
                                     const PopulationStatistics& frame, const RepeatRecord::Shape& shape)
    : case_(populationCase),
      method_(method),
      frame_(frame),
      shape_(shape),
      reachedRows_(shape.rows),
      reachedTimes_(shape.times),
      rows_(shape.rows),
      sigma_(shape.rows, all(0)),
      number_(shape.times, std::vector<RunningMean>(shape.bins)) {
  made_.name = method.name;
  made_.type = method.type;
  made_.deterministic = method.deterministic();
}

void MethodAccumulator::add(const RepeatRecord& record) {
  RepeatResult result;
  reachedRows_ = std::min(reachedRows_, record.rows());
  const auto& exact = frame_.exact.moments;
  FourMoments integral = all(0), before = all(0);
  const bool conserved = case_.conservesMass();
  for (std::size_t row = 0; row < reachedRows_; ++row) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double value = record.moment(row, k);
      rows_[row][k].add(value);
      result.moments[k] = value;
      const double away = exact.empty() ? noValue : relative(value, exact[row][k]);
      // The trapezoidal rule over the rows.
      const double time = frame_.rows[row], square = away * away;
      if (row > 0) integral[k] += 0.5 * (time - frame_.rows[row - 1]) * (square + before[k]);
      before[k] = square;
      result.sigma[k] = std::sqrt(row > 0 ? integral[k] / time : square);
      sigma_[row][k] += result.sigma[k];
    }
    rows_[row][4].add(record.geometricDeviation(row));
    rows_[row][5].add(record.particles(row));
    result.particles = record.particles(row);
    const double reference = conserved ? record.moment(0, 1) : exact.empty() ? noValue : exact[row][1];
    const double away = std::abs(relative(record.moment(row, 1), reference));
    result.massError = row == 0 || std::isnan(away) ? away : std::max(result.massError, away);
  }
  std::size_t times = 0;
  for (; times < reachedTimes_ && !std::isnan(record.number(times, 0)); ++times)
    for (std::size_t b = 0; b < shape_.bins; ++b) number_[times][b].add(record.number(times, b));
  reachedTimes_ = times;
  result.seconds = record.seconds();
  result.counters = record.counters();
  addCounters(made_.counters, result.counters);
  if (const auto gelation = record.gelation()) made_.gelation = std::min(made_.gelation.value_or(*gelation), *gelation);
  made_.repeats.push_back(result);
}

MethodStatistics MethodAccumulator::finish() const {
  MethodStatistics made = made_;
  const auto count = static_cast<double>(made.repeats.size());
  for (std::size_t row = 0; row < reachedRows_; ++row) {
    FourMoments mean{}, error{}, sigma{};
    for (std::size_t k = 0; k < 4; ++k) {
      mean[k] = rows_[row][k].mean();
      error[k] = rows_[row][k].standardError();
      sigma[k] = sigma_[row][k] / count;
    }
    made.mean.push_back(mean);
    made.error.push_back(error);
    made.sigma.push_back(sigma);
    made.geometricDeviation.push_back(rows_[row][4].mean());
    made.geometricDeviationError.push_back(rows_[row][4].standardError());
    made.particles.push_back(rows_[row][5].mean());
  }
  for (std::size_t t = 0; t < reachedTimes_; ++t) {
    std::vector<double> mean, error;
    for (const RunningMean& bin : number_[t]) {
      mean.push_back(bin.mean());
      error.push_back(bin.standardError());
    }
    made.number.push_back(std::move(mean));
    made.numberError.push_back(std::move(error));
  }
  made.deviation = made.z = all(noValue);
  const std::size_t last = reachedRows_ - 1;
  for (std::size_t k = 0; k < 4 && reachedRows_ > 0 && !frame_.exact.moments.empty(); ++k) {
    const double exact = frame_.exact.moments[last][k], away = made.mean[last][k] - exact;
    made.deviation[k] = relative(made.mean[last][k], exact);
    if (made.error[last][k] * std::sqrt(count) > scatterRoundOff * std::abs(exact))
      made.z[k] = away / made.error[last][k];
  }
  double seconds = 0;
  made.massError = 0;
  for (const RepeatResult& repeat : made.repeats) {
    seconds += repeat.seconds;
    made.massError = std::isnan(repeat.massError) ? repeat.massError : std::max(made.massError, repeat.massError);
  }
  made.secondsPerRepeat = seconds / count;
  made.eventsPerSecond = seconds > 0 ? static_cast<double>(made.counters.events()) / seconds : noValue;
  judge(case_, method_, made);
  return made;
}

}  // namespace lampblack::particles
