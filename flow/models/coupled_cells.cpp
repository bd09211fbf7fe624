#include "flow/models/coupled_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/gather.hpp"
#include "core/packed_doubles.hpp"

namespace lampblack::flow {
namespace {

constexpr double solved = 1e-6;       // of the largest change, what the last iteration of an implicit part changed
constexpr int mostIterations = 1000;  // of an implicit part

std::vector<double> nextRow(PackedDoubles& values, std::size_t count) {
  const std::span<const double> row = values.nextRow(count);
  return {row.begin(), row.end()};
}

}  // namespace

void CoupledCells::gather(MPI_Comm comm) {
  std::vector<double> cells, links;
  std::vector<std::int64_t> own;
  for (const Cell& cell : cells_) {
    own.push_back(cell.number);
    cells.insert(cells.end(), {static_cast<double>(cell.number), cell.mass, cell.pressure, cell.temperature,
                               cell.enthalpy, cell.referenceTemperature, cell.referenceEnthalpy, cell.heat,
                               cell.mixing.reactingShare, cell.mixing.fineTime});
    for (const auto* row : {&cell.Y, &cell.reference, &cell.brought, &cell.reacts})
      cells.insert(cells.end(), row->begin(), row->end());
  }
  for (const Link& link : links_) {
    links.insert(links.end(), {static_cast<double>(link.face), static_cast<double>(link.low),
                               static_cast<double>(link.high), link.flow, link.conducts});
    links.insert(links.end(), link.diffuses.begin(), link.diffuses.end());
  }
  cells_.clear();
  links_.clear();
  const std::vector<double> allCells = gatheredFromAll<double>(comm, cells);
  const std::vector<double> allLinks = gatheredFromAll<double>(comm, links);
  for (PackedDoubles values(allCells); values.left() > 0;) {
    Cell& cell = cells_.emplace_back();
    cell.number = static_cast<std::int64_t>(values.next());
    for (double* value : {&cell.mass, &cell.pressure, &cell.temperature, &cell.enthalpy, &cell.referenceTemperature,
                          &cell.referenceEnthalpy, &cell.heat, &cell.mixing.reactingShare, &cell.mixing.fineTime})
      *value = values.next();
    for (auto* row : {&cell.Y, &cell.reference, &cell.brought, &cell.reacts}) *row = nextRow(values, n_);
  }
  for (PackedDoubles values(allLinks); values.left() > 0;) {
    Link& link = links_.emplace_back();
    for (std::int64_t* number : {&link.face, &link.low, &link.high}) *number = static_cast<std::int64_t>(values.next());
    link.flow = values.next();
    link.conducts = values.next();
    link.diffuses = nextRow(values, n_);
  }
  std::ranges::sort(cells_, {}, &Cell::number);
  std::ranges::sort(links_,
                    [](const Link& a, const Link& b) { return std::pair(a.face, a.low) < std::pair(b.face, b.low); });
  // From here on links have places in place of numbers.
  for (Link& link : links_)
    for (std::int64_t* number : {&link.low, &link.high})
      if (*number != Link::none) *number = static_cast<std::int64_t>(placeOf(*number));
  own_.clear();
  for (const std::int64_t number : own) own_.push_back(placeOf(number));
}

std::size_t CoupledCells::placeOf(std::int64_t number) const {
  const auto found = std::ranges::lower_bound(cells_, number, {}, &Cell::number);
  if (found == cells_.end() || found->number != number) throw std::logic_error("this cell is not coupled");
  return static_cast<std::size_t>(found - cells_.begin());
}

std::span<const double> CoupledCells::made(std::int64_t number) const {
  return made_.at(placeOf(number));
}

// The neighbours of each cell, and how much of the difference of each comes into it, by field; the last is heat.
void CoupledCells::connect() {
  struct Side {
    std::size_t cell;
    std::int64_t other;
    const Link* link;
    double enters;  // kg/s
  };
  std::vector<Side> sides;
  for (const Link& link : links_) {
    sides.push_back({static_cast<std::size_t>(link.low), link.high, &link, std::max(-link.flow, 0.0)});
    if (link.high != Link::none)
      sides.push_back({static_cast<std::size_t>(link.high), link.low, &link, std::max(link.flow, 0.0)});
  }
  std::ranges::stable_sort(sides, {}, &Side::cell);
  const std::size_t count = cells_.size();
  first_.assign(count + 1, 0);
  other_.clear();
  weights_.assign(n_ + 1, {});
  outward_.assign(n_ + 1, std::vector<double>(count, 0.0));
  for (const Side& side : sides) {
    for (std::size_t k = 0; k <= n_; ++k) {
      const double weight = k < n_ ? side.link->diffuses[k] + side.enters : side.link->conducts;
      outward_[k][side.cell] += weight;
      if (side.other != Link::none) weights_[k].push_back(weight);
    }
    if (side.other == Link::none) continue;
    other_.push_back(static_cast<std::size_t>(side.other));
    ++first_[side.cell + 1];
  }
  for (std::size_t i = 0; i < count; ++i) first_[i + 1] += first_[i];
}

// What cells differ from the reference by, x, so that inertia (x - x at the call) is what their differences bring in
// dt. Gauss-Seidel: the inertia outweighs diffusion but for the lightest species.
void CoupledCells::solve(std::size_t field, double dt, std::span<const double> inertia, std::vector<double>& x) const {
  const std::vector<double> start = x;
  const std::vector<double>& weights = weights_[field];
  for (int iteration = 0; iteration < mostIterations; ++iteration) {
    double change = 0.0, size = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double held = inertia[i] / dt;
      double sum = held * start[i];
      for (std::size_t side = first_[i]; side < first_[i + 1]; ++side) sum += weights[side] * x[other_[side]];
      const double fresh = sum / (held + outward_[field][i]);
      change = std::max(change, std::abs(fresh - x[i]));
      size = std::max(size, std::abs(fresh));
      x[i] = fresh;
    }
    if (change <= solved * size) return;
  }
  throw NumericsError(
      fmt::format("the transport of cells that go together has not come to rest in {} iterations", mostIterations));
}

// The reactions of all cells over a part, each rank's own on it.
void CoupledCells::advanceReactions(MPI_Comm comm, const React& react, double part) {
  std::vector<Reacting> reacting;
  for (const std::size_t i : own_) {
    Cell& cell = cells_[i];
    reacting.push_back({cell.number,
                        {cell.enthalpy, heating_[i], cell.temperature, cell.pressure, firstStep_[i], cell.mixing},
                        cost_[i],
                        cell.Y,
                        source_[i]});
  }
  react(reacting, part);
  std::vector<double> found;
  for (std::size_t own = 0; own < own_.size(); ++own) {
    const Reacting& cell = reacting[own];
    firstStep_[own_[own]] = cell.gas.firstStep;
    cost_[own_[own]] = cell.cost;
    found.insert(found.end(), {static_cast<double>(cell.number), cell.gas.temperature});
    found.insert(found.end(), cell.Y.begin(), cell.Y.end());
  }
  const std::vector<double> ofAll = gatheredFromAll<double>(comm, found);
  for (PackedDoubles values(ofAll); values.left() > 0;) {
    Cell& cell = cells_[placeOf(static_cast<std::int64_t>(values.next()))];
    cell.temperature = values.next();
    cell.Y = nextRow(values, n_);
  }
}

void CoupledCells::advance(MPI_Comm comm, const React& react, const Thermo& thermo, double dt, int parts) {
  const std::size_t count = cells_.size();
  const double part = dt / parts;
  connect();
  made_.assign(count, std::vector<double>(n_, 0.0));
  source_.assign(count, std::vector<double>(n_));
  heating_.assign(count, 0.0);
  firstStep_.assign(count, 0.0);
  cost_.assign(count, 0.0);
  std::vector<double> masses(count), inertia(count), x(count), enthalpies(n_), h(n_), mean(n_), Y(n_);
  std::vector<std::vector<double>> moved(count, std::vector<double>(n_));  // differences after diffusion
  std::vector<std::vector<double>>& rate = source_;  // kg/s, then 1/s, of everything but the reactions
  std::vector<double>& heating = heating_;           // W, then W/kg
  for (std::size_t i = 0; i < count; ++i) masses[i] = cells_[i].mass;
  const auto difference = [&](std::int64_t i, std::size_t k) {
    return i == Link::none ? 0.0 : moved[static_cast<std::size_t>(i)][k];
  };
  for (int now = 0; now < parts; ++now) {
    // Species, with the rates of the reactions of the part before.
    std::vector<double> gained(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Cell& cell = cells_[i];
      for (const double brought : cell.brought) gained[i] += brought;
    }
    for (std::size_t k = 0; k < n_; ++k) {
      for (std::size_t i = 0; i < count; ++i) {
        const Cell& cell = cells_[i];
        rate[i][k] = cell.brought[k] - cell.Y[k] * gained[i];
        x[i] = cell.Y[k] - cell.reference[k] + part / cell.mass * (rate[i][k] + cell.reacts[k]);
      }
      solve(k, part, masses, x);
      for (std::size_t i = 0; i < count; ++i) moved[i][k] = x[i];
    }
    // What flows because of the differences; of a mass of zero in sum at every face.
    for (std::size_t i = 0; i < count; ++i) heating[i] = cells_[i].heat - cells_[i].enthalpy * gained[i];
    for (const Link& link : links_) {
      const Cell& low = cells_[static_cast<std::size_t>(link.low)];
      const Cell& high = link.high == Link::none ? low : cells_[static_cast<std::size_t>(link.high)];
      double net = 0.0, ofMean = 0.0;
      for (std::size_t k = 0; k < n_; ++k) {
        h[k] = link.diffuses[k] * (difference(link.low, k) - difference(link.high, k));  // from low to high
        mean[k] = 0.5 * (low.Y[k] + high.Y[k]);
        net += h[k];
        ofMean += mean[k];
      }
      thermo.speciesEnthalpies(0.5 * (low.temperature + high.temperature), enthalpies);
      const auto lower = static_cast<std::size_t>(link.low);
      double heat = 0.0;
      for (std::size_t k = 0; k < n_; ++k) {
        h[k] -= net * mean[k] / ofMean;
        heat += enthalpies[k] * h[k];
        rate[lower][k] -= h[k];
        if (link.high != Link::none) rate[static_cast<std::size_t>(link.high)][k] += h[k];
      }
      heating[lower] -= heat;
      if (link.high != Link::none) heating[static_cast<std::size_t>(link.high)] += heat;
      // What convection brings is that of the cell it comes from.
      const std::int64_t to = link.flow > 0.0 ? link.high : link.low, from = link.flow > 0.0 ? link.low : link.high;
      if (to == Link::none) continue;
      const auto enters = static_cast<std::size_t>(to);
      const double flow = std::abs(link.flow);
      const auto enthalpyOf = [&](std::int64_t i) {
        if (i == Link::none) return 0.0;
        const Cell& cell = cells_[static_cast<std::size_t>(i)];
        return cell.enthalpy - cell.referenceEnthalpy;
      };
      for (std::size_t k = 0; k < n_; ++k) rate[enters][k] += flow * (difference(from, k) - difference(to, k));
      heating[enters] += flow * (enthalpyOf(from) - enthalpyOf(to));
    }
    // Heat.
    for (std::size_t i = 0; i < count; ++i) {
      const Cell& cell = cells_[i];
      for (std::size_t k = 0; k < n_; ++k) Y[k] = cell.Y[k] + part / cell.mass * (rate[i][k] + cell.reacts[k]);
      // About the temperature there is, so that a cell at rest stays as it is.
      const double capacity = thermo.cpMass(cell.temperature, Y);
      const double rise = cell.enthalpy + part / cell.mass * heating[i] - thermo.enthalpyMass(cell.temperature, Y);
      inertia[i] = cell.mass * capacity;
      x[i] = cell.temperature - cell.referenceTemperature + rise / capacity;
    }
    solve(n_, part, inertia, x);
    for (const Link& link : links_) {
      const auto lower = static_cast<std::size_t>(link.low);
      const double heat =
          link.conducts * (x[lower] - (link.high == Link::none ? 0.0 : x[static_cast<std::size_t>(link.high)]));
      heating[lower] -= heat;
      if (link.high != Link::none) heating[static_cast<std::size_t>(link.high)] += heat;
    }
    // Reactions, with all that as a constant source.
    for (std::size_t i = 0; i < count; ++i) {
      Cell& cell = cells_[i];
      for (double& value : rate[i]) value /= cell.mass;
      heating[i] /= cell.mass;
      moved[i] = cell.Y;
    }
    advanceReactions(comm, react, part);
    for (std::size_t i = 0; i < count; ++i) {
      Cell& cell = cells_[i];
      cell.enthalpy += part * heating[i];
      for (std::size_t k = 0; k < n_; ++k) {
        cell.reacts[k] = cell.mass * ((cell.Y[k] - moved[i][k]) / part - rate[i][k]);
        made_[i][k] += cell.reacts[k] / parts;
      }
    }
  }
}

}  // namespace lampblack::flow
