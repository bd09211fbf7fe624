#include "flow/models/combustion/combustion_operator.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <limits>
#include <utility>

#include "core/errors.hpp"
#include "flow/cell_errors.hpp"

namespace lampblack::flow {
namespace {

constexpr double hardlyReacts = 0.01;  // of the reacting share
constexpr double hardlyMixes = 1.0;    // of the eddy viscosity over that of the molecules

}  // namespace

CombustionOperator::CombustionOperator(const FlowContext& context, const Options& options,
                                       const TurbulenceOperator& turbulence, HeatRelease heatRelease)
    : context_(context),
      options_(options),
      turbulence_(turbulence),
      heatRelease_(std::move(heatRelease)),
      chemicalTime_(context.mechanism, options.chemicalTime),
      present_(static_cast<std::size_t>(context.mesh.owned)),
      ofState_(present_.size()),
      times_(present_.size()) {
  if (!turbulence.knowsDissipation() && !options.dissipationOfShear)
    throw InputError("combustion needs a model of turbulence that knows its dissipation");
}

void CombustionOperator::find(const State& state, std::span<CellMixing> mixing, std::span<Times> times) {
  const auto n = static_cast<std::size_t>(state.species);
  inEachCell(context_.mesh, [&](int c) {
    const auto cell = static_cast<std::size_t>(c);
    const Eddies eddies = turbulence_.eddies(state, c, options_.dissipationOfShear);
    Times of;
    // Fine structures do not ask for it.
    if (options_.model == Model::PartiallyStirred || !times.empty())
      of.chemical = chemicalTime_.of(state.temperature[cell], state.density[cell], {&state.Y[cell * n], n});
    if (options_.model == Model::PartiallyStirred) {
      of.mixing = mixingTime(eddies, options_.mixingTime, options_.mixingConstant);
      mixing[cell] = {isLaminar(eddies) ? 1.0 : stirredShare(of.chemical, of.mixing), 0.0};
    } else {
      of.mixing = options_.fine.mixing(eddies);
      mixing[cell] = isLaminar(eddies) ? CellMixing{}
                     : !std::isfinite(of.mixing)
                         ? CellMixing{0.0, 0.0}  // what never mixes does not react
                         : CellMixing{options_.fine.share(options_.fine.size(eddies)), of.mixing};
    }
    if (!times.empty()) times[cell] = of;
  });
}

std::span<const CellMixing> CombustionOperator::of(const State& state) {
  find(state, ofState_);
  return ofState_;
}

// d ln kappa = (1 - kappa) d ln tau_c.
void CombustionOperator::slopesOfShare(const State& state, int cell, std::span<double> slopes) {
  const auto c = static_cast<std::size_t>(cell), n = static_cast<std::size_t>(state.species);
  const double mixes = 1.0 - ofState_[c].reactingShare;
  if (options_.model != Model::PartiallyStirred || mixes == 0.0) return std::ranges::fill(slopes, 0.0), void();
  chemicalTime_.slopes(state.temperature[c], state.density[c], {&state.Y[c * n], n}, slopes);
  for (double& slope : slopes) slope *= mixes;
}

void CombustionOperator::endSweep(State& state) {
  find(state, present_, times_);
}

std::vector<Quantity> CombustionOperator::historyColumns() const {
  return {{"reacting_share_min", "1", "smallest share of the reactions that mixing lets go, kappa or chi"},
          {"reacting_share_mean", "1", "the same, its mean over the heat release"},
          {"damkoehler_max", "1", "largest time of mixing over that of the reactions"},
          {"heat_release_unmixed", "1", "part of the heat release where less than a hundredth of the reactions goes"},
          {"heat_release_laminar", "1",
           "part of the heat release where the eddy viscosity is below that of the molecules"}};
}

std::vector<double> CombustionOperator::historyValues(const State& state) {
  const Mesh& m = context_.mesh;
  const std::vector<double> heat = heatRelease_(state);
  std::array<double, 4> sums{};  // W of heat that is set free: all, times its share, where unmixed, where laminar
  std::array<double, 2> extremes{-1.0, 0.0};
  for (std::size_t c = 0; c < present_.size(); ++c) {
    const Eddies eddies = turbulence_.eddies(state, static_cast<int>(c), options_.dissipationOfShear);
    const double share = present_[c].reactingShare, power = heat[c] > 0.0 ? heat[c] * m.volume[c] : 0.0;
    sums[0] += power;
    sums[1] += power * share;
    if (share < hardlyReacts) sums[2] += power;
    if (eddies.eddyViscosity < hardlyMixes * eddies.viscosity) sums[3] += power;
    extremes[0] = std::max(extremes[0], -share);
    extremes[1] = std::max(extremes[1], damkoehler(c));
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, extremes.data(), static_cast<int>(extremes.size()), MPI_DOUBLE, MPI_MAX, m.comm);
  const double all = sums[0] > 0.0 ? sums[0] : std::numeric_limits<double>::quiet_NaN();
  told_ = {-extremes[0], sums[1] / all, extremes[1], sums[2] / all, sums[3] / all};
  return {told_.begin(), told_.end()};
}

std::vector<std::string> CombustionOperator::closingLines() const {
  if (std::isnan(told_[1])) return {"combustion: no heat is released"};
  return {
      fmt::format("combustion: mixing lets {:.3g} of the reactions go, mean over the heat release (least {:.3g}); "
                  "of the heat release {:.2g} % is where less than 0.01 goes, {:.2g} % where eddies are weaker "
                  "than molecules",
                  told_[1], told_[0], 100.0 * told_[3], 100.0 * told_[4])};
}

// At most what a file of results can hold.
double CombustionOperator::damkoehler(std::size_t cell) const {
  return std::min(times_[cell].mixing / times_[cell].chemical, 1e30);
}

void CombustionOperator::fields(const State&, const FieldSink& sink) const {
  std::vector<double> column(present_.size());
  const auto give = [&](const Quantity& quantity, const auto& valueOf) {
    for (std::size_t c = 0; c < column.size(); ++c) column[c] = valueOf(c);
    sink(quantity, column);
  };
  give({"reacting_share", "1", "share of the reactions that mixing lets go: kappa of PaSR, chi of EDC"},
       [&](std::size_t c) { return present_[c].reactingShare; });
  give({"chemical_time", "s", "time of the reactions, tau_c, as the deck defines it"},
       [&](std::size_t c) { return times_[c].chemical; });
  give({"mixing_time", "s", "time of mixing: tau_mix of PaSR, tau* of EDC"},
       [&](std::size_t c) { return std::min(times_[c].mixing, 1e30); });
  give({"damkoehler", "1", "time of mixing over that of the reactions"}, [&](std::size_t c) { return damkoehler(c); });
}

}  // namespace lampblack::flow
