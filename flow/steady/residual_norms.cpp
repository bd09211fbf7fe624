#include "flow/steady/residual_norms.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "flow/steady/steadiness.hpp"

namespace lampblack::flow {
namespace {

constexpr double noEnd = -std::numeric_limits<double>::infinity();

// One equation on this rank: what is left in each cell (or face), and what is made of it.
class Sums {
 public:
  explicit Sums(const Mesh& mesh) : mesh_(mesh) {}

  // `scale`: by what the range of what the gas brings counts beside the mass that brings it.
  void begin(std::string equation, double scale, double leastRange,
             ResidualNorm::Kind kind = ResidualNorm::Kind::Flow) {
    equations_.push_back({std::move(equation), scale, leastRange, kind});
    least_.push_back(0.0);
    values_.insert(values_.end(), {0.0, 0.0});
    ends_.insert(ends_.end(), {noEnd, noEnd});
    most_.push_back({0.0, mesh_.rank});
    places_.push_back({});
  }
  void left(double residual, const Vector3& place) {
    const double size = std::abs(residual);
    values_[values_.size() - 2] += size;
    if (size <= most_.back().value) return;
    most_.back().value = size;
    places_.back() = place;
  }
  void made(double amount) { values_.back() += amount; }
  // That is made at least, of all cells.
  void madeAtLeast(double amount) { least_.back() += amount; }
  void brought(double value) {
    ends_[ends_.size() - 2] = std::max(ends_[ends_.size() - 2], value);
    ends_.back() = std::max(ends_.back(), -value);
  }

  // Collective. `mass` (kg/s) goes through.
  std::vector<ResidualNorm> finish(double mass) {
    const auto count = static_cast<int>(equations_.size());
    MPI_Allreduce(MPI_IN_PLACE, values_.data(), 2 * count, MPI_DOUBLE, MPI_SUM, mesh_.comm);
    MPI_Allreduce(MPI_IN_PLACE, least_.data(), count, MPI_DOUBLE, MPI_SUM, mesh_.comm);
    MPI_Allreduce(MPI_IN_PLACE, ends_.data(), 2 * count, MPI_DOUBLE, MPI_MAX, mesh_.comm);
    MPI_Allreduce(MPI_IN_PLACE, most_.data(), count, MPI_DOUBLE_INT, MPI_MAXLOC, mesh_.comm);
    std::vector<double> places;
    for (std::size_t e = 0; e < equations_.size(); ++e)
      for (const double x : places_[e]) places.push_back(most_[e].rank == mesh_.rank ? x : 0.0);
    MPI_Allreduce(MPI_IN_PLACE, places.data(), 3 * count, MPI_DOUBLE, MPI_SUM, mesh_.comm);
    std::vector<ResidualNorm> norms;
    for (std::size_t e = 0; e < equations_.size(); ++e) {
      const Equation& equation = equations_[e];
      const double range = std::max(ends_[2 * e] + ends_[2 * e + 1], equation.leastRange);
      const double through = mass * range * equation.scale + std::max(values_[2 * e + 1], least_[e]);
      const auto relative = [&](double left) { return left > 0.0 ? left / through : 0.0; };
      norms.push_back({equation.kind,
                       equation.name,
                       relative(values_[2 * e]),
                       relative(most_[e].value),
                       {places[3 * e], places[3 * e + 1], places[3 * e + 2]}});
    }
    return norms;
  }

 private:
  struct Equation {
    std::string name;
    double scale, leastRange;
    ResidualNorm::Kind kind;
  };
  struct Found {
    double value;
    int rank;
  };
  const Mesh& mesh_;
  std::vector<Equation> equations_;
  std::vector<double> values_;  // what is left, and what is made, of each equation
  std::vector<double> least_;   // what is made at least
  std::vector<double> ends_;    // of what is brought: the largest, and the least with the other sign
  std::vector<Found> most_;
  std::vector<Vector3> places_;
};

}  // namespace

std::vector<ResidualNorm> residualNorms(const FlowContext& context, const State& state, const FlowResidual& residual,
                                        double time) {
  const Mesh& m = context.mesh;
  const FlowResidual::Rates& rates = residual.rates();
  const std::size_t n = static_cast<std::size_t>(state.species), scalars = state.scalars.size(),
                    d = static_cast<std::size_t>(state.dimension);
  std::array<double, 3> whole{};  // kg, J/K, m^3
  double hottest = 0.0;
  for (int c = 0; c < m.owned; ++c) {
    whole[0] += state.density[c] * m.volume[c];
    whole[1] += state.density[c] * m.volume[c] * residual.properties().heatCapacity[c];
    whole[2] += m.volume[c];
    hottest = std::max(hottest, state.temperature[c]);
  }
  MPI_Allreduce(MPI_IN_PLACE, whole.data(), 3, MPI_DOUBLE, MPI_SUM, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, &hottest, 1, MPI_DOUBLE, MPI_MAX, m.comm);

  const bool isKnown = std::isfinite(time) && time > 0.0;
  const double slow = isKnown ? LeastScales::velocity * lengthOfDomain(m, whole[2]) / time : 0.0;  // m/s
  Sums sums(m);
  const auto forEachCell = [&](auto take) {
    for (int c = 0; c < m.owned; ++c) take(static_cast<std::size_t>(c), m.centre[c]);
  };
  sums.begin("mass", 1.0, 1.0);
  forEachCell([&](std::size_t c, const Vector3& place) { sums.left(rates.mass[c], place); });
  sums.begin("mass fluxes", 0.0, 0.0);  // of all that flows
  for (int face = 0; face < m.faces; ++face) {
    if (m.low[face] >= m.owned) continue;  // another rank has it
    sums.left(rates.massFlux[face], m.faceCentre[face]);
    sums.made(std::abs(state.massFlux[face]));
    sums.madeAtLeast(slow * m.area[face] * whole[0] / whole[2]);
  }
  sums.begin("momentum", 1.0, slow);
  sums.brought(0.0);
  forEachCell([&](std::size_t c, const Vector3& place) {
    double force = 0.0, speed = 0.0;
    for (std::size_t i = 0; i < d; ++i) {
      force += rates.momentum[c * d + i] * rates.momentum[c * d + i];
      speed += state.velocity[c * d + i] * state.velocity[c * d + i];
    }
    sums.left(std::sqrt(force), place);
    sums.brought(std::sqrt(speed));
  });
  if (state.swirls) {
    sums.begin("swirl", 1.0, 0.0);
    forEachCell([&](std::size_t c, const Vector3& place) {
      sums.left(rates.angularMomentum[c], place);
      sums.brought(place[0] * state.swirl[c]);
    });
  }
  sums.begin("enthalpy", whole[1] / whole[0], LeastScales::temperature * hottest);
  std::vector<double> enthalpies(n);  // J/kg, of each species
  forEachCell([&](std::size_t c, const Vector3& place) {
    context.thermo.speciesEnthalpies(state.temperature[c], enthalpies);
    sums.left(rates.enthalpy[c] - std::inner_product(enthalpies.begin(), enthalpies.end(), &rates.species[c * n], 0.0),
              place);
    sums.made(m.volume[c] * std::abs(rates.made.enthalpy[c]));
    sums.brought(state.temperature[c]);
  });
  std::vector<double> made(static_cast<std::size_t>(m.owned) * n);
  forEachCell([&](std::size_t c, const Vector3&) { rates.made.ofSpecies(c, std::span(made).subspan(c * n, n)); });
  for (std::size_t k = 0; k < n; ++k) {
    sums.begin(context.mechanism.speciesName(k), 1.0, LeastScales::massFraction, ResidualNorm::Kind::Species);
    forEachCell([&](std::size_t c, const Vector3& place) {
      sums.left(rates.species[c * n + k] - state.Y[c * n + k] * rates.mass[c], place);
      sums.made(m.volume[c] * std::max(made[c * n + k], 0.0));
      sums.brought(state.Y[c * n + k]);
    });
  }
  for (std::size_t s = 0; s < scalars; ++s) {
    if (!state.scalars[s].isTransported) continue;
    sums.begin(state.scalars[s].name, 1.0, LeastScales::carried * state.scalars[s].negligible,
               ResidualNorm::Kind::Carried);
    forEachCell([&](std::size_t c, const Vector3& place) {
      const double perMass = state.carried[c * scalars + s] / state.density[c];
      sums.left(rates.carried[c * scalars + s] - perMass * rates.mass[c], place);
      sums.made(m.volume[c] * std::max(rates.made.netOfCarried(c * scalars + s, state.carried), 0.0));
      sums.brought(perMass);
    });
  }
  return sums.finish(isKnown ? whole[0] / time : 0.0);
}

std::vector<ResidualNorm> worstOfEachKind(const std::vector<ResidualNorm>& norms) {
  using Kind = ResidualNorm::Kind;
  std::vector<ResidualNorm> found;
  std::ranges::copy_if(norms, std::back_inserter(found), [](const auto& norm) { return norm.kind == Kind::Flow; });
  for (const Kind kind : {Kind::Species, Kind::Carried}) {
    const auto valueOf = [kind](const ResidualNorm& norm) { return norm.kind == kind ? norm.value : -1.0; };
    const auto worst = std::ranges::max_element(norms, {}, valueOf);
    if (worst != norms.end() && worst->kind == kind) found.push_back(*worst);
  }
  return found;
}

std::string residualText(const std::vector<ResidualNorm>& norms, int dimension) {
  std::string text;
  for (const ResidualNorm& norm : worstOfEachKind(norms)) {
    const bool isOfFlow = norm.kind == ResidualNorm::Kind::Flow;
    if (isOfFlow && !std::isfinite(norm.value)) return {};
    text += fmt::format("{}{} {:.1e}", text.empty() ? "" : ", ", norm.equation, norm.value);
    if (!isOfFlow) text += fmt::format(" at {}", placeText(norm.place, dimension));
  }
  return text;
}

}  // namespace lampblack::flow
