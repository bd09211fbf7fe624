#include "flow/steady/steadiness.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace lampblack::flow {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double piecesOfTime = 4.0;
constexpr double leastOfOthers =
    1e-3;  // least scale of a carried scalar: of the largest range of one owner's scalars of one unit
// The record of whole-domain quantities.
constexpr double recordedTimes = 10.0;    // of time(), that it goes back
constexpr double recordsPerTime = 500.0;  // at most
constexpr std::size_t mostRecorded = 8000;
constexpr double heatOfMass = 1e6;  // J/kg, with which heat release is compared
constexpr double leastHeatOfMass = 3e-6 * heatOfMass;

struct RecordedQuantity {
  const char* name;
  const char* unit;
};
// Behind the momentum along each axis.
constexpr std::array<RecordedQuantity, 4> recorded{
    {{"kinetic energy", "J"}, {"mass in the domain", "kg"}, {"largest temperature", "K"}, {"heat release", "W"}}};

// Owner and unit of a carried scalar.
std::string peersOf(const State& state, int scalar) {
  const auto isOf = [&](const ScalarRange& block) { return scalar < block.first + block.count; };
  return std::ranges::find_if(state.blocks, isOf)->owner + " " + state.scalars[static_cast<std::size_t>(scalar)].unit;
}

}  // namespace

Steadiness::Steadiness(const FlowContext& context, const State& state, Options options)
    : context_(&context), options_(options) {
  for (const FieldDeclaration& field : fieldRegistry()) {
    if (!isWatched(field)) continue;
    const int width = widthOf(field, state);
    const bool isCarried = field.width == FieldDeclaration::Width::Carried;
    const bool isEach = isCarried || field.width == FieldDeclaration::Width::Species;
    for (int i = 0; i < (isEach ? width : 1) && width > 0; ++i) {
      fields_.push_back({field.width, field.nameOf(i, state, context.mechanism),
                         isCarried ? peersOf(state, i) : std::string(), width_, isEach ? 1 : width});
      width_ += fields_.back().components;
    }
  }
  signals_.resize(static_cast<std::size_t>(state.dimension) + recorded.size());
  moveTo(context);
}

void Steadiness::moveTo(const FlowContext& context) {
  context_ = &context;
  const Mesh& m = context.mesh;
  low_.assign(static_cast<std::size_t>(m.owned) * static_cast<std::size_t>(width_), 0.0);
  high_ = low_;
  volume_ = 0.0;
  for (int c = 0; c < m.owned; ++c) volume_ += m.volume[static_cast<std::size_t>(c)];
  MPI_Allreduce(MPI_IN_PLACE, &volume_, 1, MPI_DOUBLE, MPI_SUM, m.comm);
}

bool Steadiness::isWatched(const FieldDeclaration& field) const {
  return field.isWatched && (options_.hasParticles || field.width != FieldDeclaration::Width::Carried);
}

// A flow that does not swirl may do so after a restart.
int Steadiness::widthOf(const FieldDeclaration& field, const State& state) const {
  if (field.width == FieldDeclaration::Width::Swirl) return context_->mesh.axisymmetric() ? 1 : 0;
  return field.widthIn(state);
}

// Calls with (index in low_ and high_, value) of each owned cell.
template <typename Take>
void Steadiness::forEachValue(const State& state, Take take) const {
  struct Part {
    const double* values;  // null: zeros
    std::size_t width;
  };
  std::vector<Part> parts;
  for (const FieldDeclaration& field : fieldRegistry())
    if (isWatched(field))
      parts.push_back({field.widthIn(state) > 0 ? field.of(state).data() : nullptr,
                       static_cast<std::size_t>(widthOf(field, state))});
  std::size_t i = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(context_->mesh.owned); ++c)
    for (const Part& part : parts)
      for (std::size_t k = 0; k < part.width; ++k) take(i++, part.values ? part.values[c * part.width + k] : 0.0);
}

void Steadiness::startPiece(const State& state) {
  forEachValue(state, [this](std::size_t i, double value) { low_[i] = high_[i] = value; });
  pressure_ = {state.thermodynamicPressure, state.thermodynamicPressure};
  sums_ = {};
}

void Steadiness::begin(const State& state, double time) {
  pieces_.clear();
  times_.clear();
  for (RecordedSignal& signal : signals_) signal.values.clear();
  periodicity_.reset();
  last_ = time;
  startPiece(state);
}

void Steadiness::adopt(const State& state, const GasProperties& properties, double time) {
  begin(state, time);
  sums_ = totalsOf(state, properties).flow;
}

Steadiness::Totals Steadiness::totalsOf(const State& state, const GasProperties& properties) const {
  const Mesh& m = context_->mesh;
  const auto d = static_cast<std::size_t>(state.dimension);
  Totals totals;
  auto& [duration, mass, through, kinetic, conduction] = totals.flow;
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.owned); ++c) {
    const double ofCell = state.density[c] * m.volume[c];
    double squares = state.swirls ? state.swirl[c] * state.swirl[c] : 0.0;
    for (std::size_t axis = 0; axis < d; ++axis) {
      const double u = state.velocity[c * d + axis];
      squares += u * u;
      totals.momentum[axis] += ofCell * u;
    }
    mass += ofCell;
    kinetic += 0.5 * ofCell * squares;
    conduction += properties.effectiveConductivity()[c] / properties.heatCapacity[c] * m.volume[c];
  }
  for (auto face = static_cast<std::size_t>(m.interiorFaces); face < static_cast<std::size_t>(m.faces); ++face)
    through += 0.5 * std::abs(state.massFlux[face]);
  std::array<double, 7> all{mass, through, kinetic, conduction};
  std::ranges::copy(totals.momentum, all.begin() + 4);
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  totals.flow = {1.0, all[0], all[1], all[2], all[3]};
  std::copy_n(all.begin() + 4, 3, totals.momentum.begin());
  return totals;
}

void Steadiness::add(const State& state, const GasProperties& properties, const HeatRelease& heatRelease, double time) {
  const Mesh& m = context_->mesh;
  forEachValue(state, [this](std::size_t i, double value) {
    low_[i] = std::min(low_[i], value);
    high_[i] = std::max(high_[i], value);
  });
  pressureNow_ = state.thermodynamicPressure;
  pressure_ = {std::min(pressure_[0], pressureNow_), std::max(pressure_[1], pressureNow_)};

  const double expected = this->time();
  const bool isDue =
      times_.empty() || !std::isfinite(expected) || time - times_.back() >= expected / recordsPerTime * (1.0 - 1e-9);
  const Totals totals = totalsOf(state, properties);
  const double dt = time - last_;
  last_ = time;
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += dt * totals.flow[i];
  if (isDue) {
    double hottest = 0.0, heat = 0.0;
    const std::vector<double> released = heatRelease();
    for (std::size_t c = 0; c < released.size(); ++c) {
      heat += released[c] * m.volume[c];
      hottest = std::max(hottest, state.temperature[c]);
    }
    MPI_Allreduce(MPI_IN_PLACE, &heat, 1, MPI_DOUBLE, MPI_SUM, m.comm);
    MPI_Allreduce(MPI_IN_PLACE, &hottest, 1, MPI_DOUBLE, MPI_MAX, m.comm);
    std::vector<double> values(totals.momentum.begin(), totals.momentum.begin() + state.dimension);
    values.insert(values.end(), {totals.flow[KineticEnergy], totals.flow[Mass], hottest, heat});
    record(values, time);
  }
  if (sums_[Duration] >= timeOf(sums_) / piecesOfTime * (1.0 - 1e-9)) closePiece(state);
}

void Steadiness::record(const std::vector<double>& values, double time) {
  times_.push_back(time);
  for (std::size_t i = 0; i < values.size(); ++i) signals_[i].values.push_back(values[i]);
  if (times_.size() <= mostRecorded) return;
  constexpr std::ptrdiff_t oldest = mostRecorded / 4;
  times_.erase(times_.begin(), times_.begin() + oldest);
  for (RecordedSignal& signal : signals_) signal.values.erase(signal.values.begin(), signal.values.begin() + oldest);
}

// By which changes of each field are divided: its range over the domain.
std::vector<double> Steadiness::scales(const State& state) const {
  std::vector<double> ends(2 * fields_.size(), -infinity);  // largest, and smallest with the other sign
  std::vector<std::size_t> fieldOf(static_cast<std::size_t>(width_));
  for (std::size_t f = 0; f < fields_.size(); ++f)
    for (int i = 0; i < fields_[f].components; ++i) fieldOf[static_cast<std::size_t>(fields_[f].first + i)] = f;
  forEachValue(state, [&](std::size_t i, double value) {
    const std::size_t f = fieldOf[i % static_cast<std::size_t>(width_)];
    ends[2 * f] = std::max(ends[2 * f], value);
    ends[2 * f + 1] = std::max(ends[2 * f + 1], -value);
  });
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), static_cast<int>(ends.size()), MPI_DOUBLE, MPI_MAX, context_->mesh.comm);
  std::vector<double> scales(fields_.size());
  std::map<std::string, double> largest;  // range of carried scalars, by owner and unit
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    scales[f] = ends[2 * f] + ends[2 * f + 1];
    if (fields_[f].peers.empty()) continue;
    double& of = largest[fields_[f].peers];
    of = std::max(of, scales[f]);
  }
  const auto leastOf = [&](std::size_t f) {
    switch (fields_[f].width) {
      case FieldDeclaration::Width::Dimension:
      case FieldDeclaration::Width::Swirl:
        return LeastScales::velocity * lengthOfDomain() / timeOf(sums_);
      case FieldDeclaration::Width::One:
      case FieldDeclaration::Width::Eddies:
        return LeastScales::temperature * ends[2 * f];
      case FieldDeclaration::Width::Species:
        return LeastScales::massFraction;
      case FieldDeclaration::Width::Carried:
        return leastOfOthers * largest[fields_[f].peers];
    }
    return 0.0;
  };
  for (std::size_t f = 0; f < fields_.size(); ++f) scales[f] = std::max(scales[f], leastOf(f));
  return scales;
}

void Steadiness::closePiece(const State& state) {
  const Mesh& m = context_->mesh;
  const std::vector<double> scale = scales(state);
  const std::size_t count = fields_.size(), width = static_cast<std::size_t>(width_);
  struct Found {
    double value;
    int rank;
  };
  std::vector<Found> most(count, {0.0, m.rank});
  std::vector<double> squares(count, 0.0), places(3 * count, 0.0);
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.owned); ++c)
    for (std::size_t f = 0; f < count; ++f) {
      for (int i = 0; i < fields_[f].components; ++i) {
        const std::size_t at = c * width + static_cast<std::size_t>(fields_[f].first + i);
        const double change = high_[at] - low_[at];
        squares[f] += change * change * m.volume[c];
        if (change <= most[f].value) continue;
        most[f].value = change;
        std::ranges::copy(m.centre[c], places.begin() + static_cast<std::ptrdiff_t>(3 * f));
      }
    }
  MPI_Allreduce(MPI_IN_PLACE, most.data(), static_cast<int>(count), MPI_DOUBLE_INT, MPI_MAXLOC, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, squares.data(), static_cast<int>(count), MPI_DOUBLE, MPI_SUM, m.comm);
  for (std::size_t f = 0; f < count; ++f)
    if (most[f].rank != m.rank) std::fill_n(places.begin() + static_cast<std::ptrdiff_t>(3 * f), 3, 0.0);
  MPI_Allreduce(MPI_IN_PLACE, places.data(), static_cast<int>(places.size()), MPI_DOUBLE, MPI_SUM, m.comm);

  Piece piece{sums_, {}, {}, std::move(places)};
  const auto ofScale = [](double change, double by) { return by > 0.0 ? change / by : 0.0; };
  for (std::size_t f = 0; f < count; ++f) {
    piece.maximum.push_back(ofScale(most[f].value, scale[f]));
    piece.rms.push_back(ofScale(std::sqrt(squares[f] / volume_), scale[f]));
  }
  const double compressed = ofScale(pressure_[1] - pressure_[0], pressureNow_);
  piece.maximum.push_back(compressed);
  piece.rms.push_back(compressed);
  pieces_.push_back(std::move(piece));
  dropOldPieces();
  startPiece(state);
  findPeriod();
}

void Steadiness::findPeriod() {
  const std::size_t axes = signals_.size() - recorded.size();
  const auto latest = [&](std::size_t i) { return signals_[i].values.empty() ? 0.0 : signals_[i].values.back(); };
  const double energy = latest(axes), mass = latest(axes + 1);
  for (std::size_t i = 0; i < signals_.size(); ++i)
    signals_[i].scale = i < axes       ? std::sqrt(2.0 * energy * mass)
                        : i < axes + 3 ? std::abs(latest(i))
                                       : heatOfMass * mass / time();
  for (RecordedSignal& signal : signals_) signal.scale = std::max(signal.scale, std::numeric_limits<double>::min());
  periodicity_ = periodicityOf(times_, signals_);
}

double Steadiness::leastHeat() const {
  const Integrals sums = pieces_.empty() ? sums_ : sumsOfPieces();
  const double t = timeOf(sums);
  return sums[Duration] > 0.0 && t > 0.0 ? leastHeatOfMass * sums[Mass] / (sums[Duration] * t) : 0.0;
}

std::vector<std::string> Steadiness::lines() const {
  const double t = time();
  if (!std::isfinite(t)) return {};
  const auto most = change(Norm::Maximum), mean = change(Norm::Rms);
  if (!most || !most->isWhole)
    return {fmt::format("how steady it is can be told after {:.3g} s ({})", t, meaningOfTime())};
  std::vector<std::string> lines{fmt::format(
      "in the last {:.3g} s ({}){} fields changed by {:.2e} of their range at most, {} at {}; RMS {:.2e}, {}", t,
      meaningOfTime(), options_.hasParticles ? "" : " the gas's", most->value, most->field,
      placeText(most->place, context_->mesh.dimension), mean->value, mean->field)};
  if (!periodicity_) return lines;
  std::string text = fmt::format("the flow repeats itself every {:.4g} s ({:.4g} Hz)", periodicity_->period,
                                 1.0 / periodicity_->period);
  const std::size_t axes = signals_.size() - recorded.size();
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    const auto& [low, high] = periodicity_->ranges[i];
    if (high - low <= 1e-4 * signals_[i].scale) continue;
    text += i < axes ? fmt::format("; momentum along {} {:.4g} to {:.4g} {}",
                                   (context_->mesh.axisymmetric() ? "rz" : "xyz")[i], low, high,
                                   integralUnit(context_->mesh, "kg m/s"))
                     : fmt::format("; {} {:.5g} to {:.5g} {}", recorded[i - axes].name, low, high,
                                   std::string(recorded[i - axes].unit) == "K"
                                       ? "K"
                                       : integralUnit(context_->mesh, recorded[i - axes].unit));
  }
  lines.push_back(text);
  return lines;
}

}  // namespace lampblack::flow
