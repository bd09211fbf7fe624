// The time that changes are told for, and the changes over it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "flow/steady/steadiness.hpp"

namespace lampblack::flow {
namespace {

// Of the mass over the time in which heat is conducted over the domain: less that passes is round-off of a gas at rest.
constexpr double leastThroughflow = 1e-6;

}  // namespace

double lengthOfDomain(const Mesh& mesh, double volume) {
  if (mesh.axisymmetric()) return std::cbrt(2.0 * std::numbers::pi * volume);
  return mesh.dimension == 2 ? std::sqrt(volume) : std::cbrt(volume);
}

double Steadiness::lengthOfDomain() const {
  return flow::lengthOfDomain(context_->mesh, volume_);
}

bool Steadiness::hasThroughflow(const Integrals& sums) const {
  const double length = lengthOfDomain();
  return sums[Through] > leastThroughflow * sums[Conduction] / (length * length);
}

double Steadiness::timeOf(const Integrals& sums) const {
  if (options_.time) return *options_.time;
  if (hasThroughflow(sums)) return sums[Mass] / sums[Through];
  const double length = lengthOfDomain();
  double time = std::numeric_limits<double>::infinity();
  if (sums[KineticEnergy] > 0.0) time = length / std::sqrt(2.0 * sums[KineticEnergy] / sums[Mass]);
  if (sums[Conduction] > 0.0) time = std::min(time, length * length * sums[Mass] / sums[Conduction]);
  return time;
}

Steadiness::Integrals Steadiness::sumsOfPieces() const {
  Integrals sums{};
  for (const Piece& piece : pieces_)
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += piece.sums[i];
  return sums;
}

std::string Steadiness::meaningOfTime() const {
  if (options_.time) return "time.steady.time";
  const Integrals sums = pieces_.empty() ? sums_ : sumsOfPieces();
  if (hasThroughflow(sums)) return "residence time: what is in the domain over what flows through it";
  const double length = lengthOfDomain();
  return timeOf(sums) * sums[Conduction] < length * length * sums[Mass] * (1.0 - 1e-9)
             ? "the size of the domain over the RMS velocity"
             : "of conduction over the size of the domain";
}

double Steadiness::time() const {
  return timeOf(pieces_.empty() ? sums_ : sumsOfPieces());
}

// Those that the newer ones do without.
void Steadiness::dropOldPieces() {
  while (pieces_.size() > 1) {
    Integrals rest = sumsOfPieces();
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= pieces_.front().sums[i];
    if (rest[Duration] < timeOf(rest) * (1.0 - 1e-9)) break;
    pieces_.pop_front();
  }
}

double Steadiness::changeOf(std::size_t field, Norm norm) const {
  double change = 0.0;
  for (const Piece& piece : pieces_) change += (norm == Norm::Maximum ? piece.maximum : piece.rms)[field];
  const Integrals sums = sumsOfPieces();
  return change * timeOf(sums) / sums[Duration];
}

std::optional<Steadiness::Change> Steadiness::change(Norm norm) const {
  if (pieces_.empty()) return {};
  Change worst;
  std::size_t field = 0;
  for (std::size_t f = 0; f <= fields_.size(); ++f)
    if (const double value = changeOf(f, norm); value > worst.value) {
      worst.value = value;
      field = f;
    }
  if (field < fields_.size()) {
    worst.field = fields_[field].name;
    std::copy_n(pieces_.back().places.begin() + static_cast<std::ptrdiff_t>(3 * field), 3, worst.place.begin());
  } else {
    worst.field = "thermodynamic pressure";
  }
  const auto rateOf = [norm](const Piece& piece) {
    return std::ranges::max(norm == Norm::Maximum ? piece.maximum : piece.rms) / piece.sums[Duration];
  };
  const Integrals sums = sumsOfPieces();
  double mean = 0.0;
  for (const Piece& piece : pieces_) mean += rateOf(piece) * piece.sums[Duration] / sums[Duration];
  worst.grows = rateOf(pieces_.back()) > mean * (1.0 + 1e-9);
  worst.isWhole = sums[Duration] >= timeOf(sums) * (1.0 - 1e-9);
  return worst;
}

bool Steadiness::isSteady(double tolerance, Norm norm) const {
  const auto found = change(norm);
  return found && found->isWhole && !found->grows && found->value <= tolerance;
}

}  // namespace lampblack::flow
