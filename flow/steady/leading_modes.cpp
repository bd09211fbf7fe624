#include "flow/steady/leading_modes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>

#include "core/errors.hpp"
#include "numerics/arnoldi.hpp"

namespace lampblack::flow {
namespace {

constexpr std::size_t leastVectors = 8;
// Errors of a mode: with more than the first of its rate and angular frequency together it is none, with less than the
// second it is told, with less than the third of its growth rate alone no further vector is asked for its sake.
constexpr double spurious = 0.5, certain = 0.1, exact = 0.05;
constexpr std::size_t mostTold = 8;
// Of one over the time that all vectors have marched: rates below are those of a mode that neither grows nor decays.
constexpr double resolved = 0.1;

class Disturbances {
 public:
  Disturbances(MPI_Comm comm, const MarchedFlow& flow, double size)
      : comm_(comm), flow_(flow), size_(size), end_(flow.state) {
    flow.march(end_);
  }

  // What becomes of a disturbance.
  void march(std::vector<double>& v) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) largest = std::max(largest, std::abs(v[i]) * flow_.scales[i]);
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, comm_);
    if (!(largest > 0.0)) throw NumericsError("a disturbance of the flow has vanished");
    const double amount = size_ / largest;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = flow_.state[i] + amount * v[i];
    flow_.march(v);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = (v[i] - end_[i]) / amount;
  }

  // Values that follow from others have no part in it: what holds of the others holds of all.
  [[nodiscard]] double product(std::span<const double> a, std::span<const double> b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += flow_.shares[i] * flow_.scales[i] * flow_.scales[i] * a[i] * b[i];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm_);
    return sum;
  }

 private:
  MPI_Comm comm_;
  const MarchedFlow& flow_;
  double size_;
  std::vector<double> end_;  // of the undisturbed flow
};

struct Found {
  std::vector<Mode> modes;
  bool isDecided = true;  // whether a further vector is likely to tell nothing new of those that lead
};

Found modesOf(const numerics::Arnoldi& arnoldi, double time) {
  const double least = resolved / (static_cast<double>(arnoldi.dimension()) * time);
  Found found;
  std::vector<Mode> all;
  for (const numerics::RitzPair& pair : arnoldi.pairs()) {
    if (pair.value.imag() < 0.0 || !(std::abs(pair.value) > 0.0)) continue;
    const std::complex<double> rate = std::log(pair.value) / time;
    const double error = pair.residual / (std::abs(pair.value) * time), size = std::max(std::abs(rate), least);
    if (error > spurious * size) continue;
    all.push_back({rate.real(), rate.imag() / (2.0 * std::numbers::pi), error});
    if (error <= certain * size) found.modes.push_back(all.back());
  }
  std::ranges::sort(all, std::ranges::greater{}, &Mode::growthRate);
  std::ranges::sort(found.modes, std::ranges::greater{}, &Mode::growthRate);
  if (found.modes.size() > mostTold) found.modes.resize(mostTold);
  if (all.empty()) return {{}, false};
  const Mode& first = all.front();
  found.isDecided = first.error <= exact * std::max(std::abs(first.growthRate), least);
  return found;
}

}  // namespace

LeadingModes leadingModes(MPI_Comm comm, const MarchedFlow& flow, std::vector<double> start,
                          const ModeOptions& options) {
  const Disturbances disturbances(comm, flow, options.disturbance);
  numerics::Arnoldi arnoldi(
      [&](std::vector<double>& v) { disturbances.march(v); }, std::move(start),
      [&](std::span<const double> a, std::span<const double> b) { return disturbances.product(a, b); });
  const auto most = static_cast<std::size_t>(options.vectors);
  while (true) {
    const bool more = arnoldi.extend();
    const bool isLast = !more || arnoldi.dimension() >= most;
    if (!isLast && arnoldi.dimension() < leastVectors) continue;
    Found found = modesOf(arnoldi, flow.time);
    if (isLast || found.isDecided) return {std::move(found.modes), static_cast<int>(arnoldi.dimension())};
  }
}

}  // namespace lampblack::flow
