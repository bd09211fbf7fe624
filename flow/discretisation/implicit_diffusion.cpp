#include "flow/discretisation/implicit_diffusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "numerics/lanes.hpp"

namespace lampblack::flow {
namespace {

// Of the source: below the one a residual does not fall, and above the other none is left, as where diffusion is so
// fast that the guess is no solution by far.
constexpr double roundOff = 1e-14, largestShare = 1e-7;

// How far a field's iteration is: eigenvalues lie between 1 - radius and 1 + radius.
class Chebyshev {
 public:
  explicit Chebyshev(double radius) : radius_(radius), ratio_(radius) {}
  // Shares of the last change and of the residual in the next.
  double old = 0.0, fresh = 1.0;
  void next() {
    if (radius_ == 0.0) return;
    const double ratio = 1.0 / (2.0 / radius_ - ratio_);
    old = ratio * ratio_;
    fresh = 2.0 * ratio / radius_;
    ratio_ = ratio;
  }

 private:
  double radius_, ratio_;
};

// Of a radius that is the same on all ranks. The residual falls by Chebyshev's polynomial of that degree, which is one
// over the radius outside its interval.
int iterationsFor(MPI_Comm comm, double radius, double reduction, int most) {
  if (reduction >= 1.0) return 0;
  const double needed = radius > 0.0 ? std::ceil(std::acosh(1.0 / reduction) / std::acosh(1.0 / radius)) : 1.0;
  if (!(needed <= most))
    raiseTogether(comm, NumericsError(fmt::format(
                            "implicit diffusion would not converge in {} iterations: it moves {:g} times what "
                            "a cell holds in a step; take a shorter step or larger cells",
                            most, 1.0 / (1.0 - radius))));
  return static_cast<int>(needed);
}

// Eight values of single precision.
numerics::Lanes loadSingles(const float* from) {
  float __attribute__((vector_size(numerics::laneCount * sizeof(float)))) v;
  std::memcpy(&v, from, sizeof v);
  return __builtin_convertvector(v, numerics::Lanes);
}

}  // namespace

void ImplicitDiffusion::subtract(int fields, std::span<const double> diagonal, std::span<const double> conductance,
                                 std::span<const double> x, std::span<double> source) const {
  const Mesh& m = mesh_;
  for (int c = 0; c < m.owned; ++c) {
    const double* own = &x[c * fields];
    double* left = &source[c * fields];
    for (int k = 0; k < fields; ++k) left[k] -= diagonal[c * fields + k] * own[k];
    for (int i = m.faceStart[c]; i < m.faceStart[c + 1]; ++i) {
      const int face = m.faceOfCell[i];
      if (m.high[face] < 0) continue;
      const double* other = &x[(m.low[face] == c ? m.high[face] : m.low[face]) * fields];
      const double* g = &conductance[face * fields];
      for (int k = 0; k < fields; ++k) left[k] -= g[k] * (own[k] - other[k]);
    }
  }
}

ImplicitDiffusion::Targets ImplicitDiffusion::targets(int fields, std::span<const double> source,
                                                      double tolerance) const {
  const auto n = static_cast<std::size_t>(fields);
  // Largest of all cells: share of the neighbours in the diagonal; what preconditioned residual and source come to.
  std::vector<double> largest(3 * n, 0.0);
  for (int c = 0; c < mesh_.owned; ++c)
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = c * n + k;
      largest[k] = std::max(largest[k], neighbours_[i] * inverse_[i]);
      largest[n + k] = std::max(largest[n + k], std::abs(residual_[i] * inverse_[i]));
      largest[2 * n + k] = std::max(largest[2 * n + k], std::abs(source[i] * inverse_[i]));
    }
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_DOUBLE, MPI_MAX, mesh_.comm);
  Targets result{{largest.begin(), largest.begin() + fields}, std::vector<double>(n, 1.0)};
  for (std::size_t k = 0; k < n; ++k) {
    const double residual = largest[n + k], size = largest[2 * n + k];
    if (residual <= std::max(roundOff * size, std::numeric_limits<double>::min())) continue;
    result.reduction[k] = std::max(std::min(tolerance, largestShare * size / residual), roundOff * size / residual);
  }
  return result;
}

ImplicitDiffusion::Result ImplicitDiffusion::solve(int fields, std::span<const double> diagonal,
                                                   std::span<const double> conductance, std::span<const double> source,
                                                   std::span<double> x, double tolerance, int maxIterations) {
  const Mesh& m = mesh_;
  const auto n = static_cast<std::size_t>(fields);
  const std::size_t values = static_cast<std::size_t>(m.owned) * n;
  neighbours_.assign(values, 0.0);
  for (int c = 0; c < m.owned; ++c)
    for (int i = m.faceStart[c]; i < m.faceStart[c + 1]; ++i) {
      const int face = m.faceOfCell[i];
      if (m.high[face] < 0) continue;
      for (std::size_t k = 0; k < n; ++k) neighbours_[c * n + k] += conductance[face * n + k];
    }
  inverse_.resize(values);
  for (std::size_t i = 0; i < values; ++i) inverse_[i] = 1.0 / (diagonal[i] + neighbours_[i]);
  halo_.update(x, fields);
  residual_.assign(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(values));
  subtract(fields, diagonal, conductance, x, residual_);

  const Targets wanted = targets(fields, source, tolerance);
  Result result;
  std::vector<Chebyshev> of;
  for (std::size_t k = 0; k < n; ++k) {
    of.emplace_back(wanted.radius[k]);
    result.iterations =
        std::max(result.iterations, iterationsFor(mesh_.comm, wanted.radius[k], wanted.reduction[k], maxIterations));
  }
  change_.assign(static_cast<std::size_t>(m.cells) * n, 0.0);
  for (int iteration = 1; iteration <= result.iterations; ++iteration) {
    for (int c = 0; c < m.owned; ++c)
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = c * n + k;
        change_[i] = of[k].old * change_[i] + of[k].fresh * inverse_[i] * residual_[i];
        x[i] += change_[i];
      }
    if (iteration == result.iterations) break;
    for (Chebyshev& one : of) one.next();
    halo_.update(change_, fields);
    subtract(fields, diagonal, conductance, change_, residual_);
  }
  halo_.update(x, fields);
  return result;
}

std::vector<double> ImplicitDiffusion::radii(int fields, std::span<const double> inertia,
                                             const Conductance& conductance, std::span<const double> sinks) {
  const Mesh& m = mesh_;
  std::vector<double> largest(static_cast<std::size_t>(fields), 0.0);
  std::array<int, width> group{};
  for (int first = 0; first < fields; first += width) {
    const int count = std::min(width, fields - first);
    std::iota(group.begin(), group.begin() + count, first);
    // Of the neighbours, and of all that takes part: boundaries hold the change as the inertia does.
    std::vector<double>&inside = change_, &beyond = neighbours_;
    for (std::vector<double>* sums : {&inside, &beyond}) sums->assign(static_cast<std::size_t>(m.cells) * width, 0.0);
    std::array<double, width> g{};
    for (int face = 0; face < m.faces; ++face) {
      conductance(face, {group.data(), static_cast<std::size_t>(count)}, g.data());
      const int low = m.low[face], high = m.high[face];
      double* of = high >= 0 ? &inside[low * width] : &beyond[low * width];
      for (int k = 0; k < width; ++k) of[k] += g[k];
      if (high < 0) continue;
      for (int k = 0; k < width; ++k) inside[high * width + k] += g[k];
    }
    for (int c = 0; c < m.owned; ++c)
      for (int k = 0; k < count; ++k) {
        const double neighbours = inside[c * width + k];
        const double own = sinks.empty() ? inertia[c] : inertia[c] + sinks[c * fields + first + k];
        largest[first + k] = std::max(largest[first + k], neighbours / (own + beyond[c * width + k] + neighbours));
      }
  }
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), fields, MPI_DOUBLE, MPI_MAX, m.comm);
  return largest;
}

void ImplicitDiffusion::begin(Group& group, std::span<const int> fields, int all, std::span<const double> inertia,
                              std::span<const double> change, const Conductance& conductance,
                              std::span<const double> sinks) {
  const Mesh& m = mesh_;
  group.fields.assign(fields.begin(), fields.end());
  group.conductance.resize(static_cast<std::size_t>(m.faces) * width);
  std::array<double, width> g{};
  for (int face = 0; face < m.faces; ++face) {
    conductance(face, fields, g.data());
    for (int k = 0; k < width; ++k) group.conductance[face * width + k] = static_cast<float>(g[k]);
  }
  // The first iteration is that of no change yet.
  for (std::vector<double>* values : {&group.change, &group.otherChange})
    values->assign(static_cast<std::size_t>(m.cells) * width, 0.0);
  for (std::vector<double>* values : {&group.residual, &group.solution})
    values->assign(static_cast<std::size_t>(m.owned) * width, 0.0);
  for (int c = 0; c < m.owned; ++c)
    for (std::size_t k = 0; k < fields.size(); ++k) group.residual[c * width + k] = change[c * all + fields[k]];
  group.sinks.assign(sinks.empty() ? 0 : static_cast<std::size_t>(m.owned) * width, 0.0);
  for (int c = 0; c < m.owned && !sinks.empty(); ++c)
    for (std::size_t k = 0; k < fields.size(); ++k) group.sinks[c * width + k] = sinks[c * all + fields[k]];
  group.diagonal.resize(group.residual.size());
  for (int c = 0; c < m.owned; ++c) {
    double* diagonal = &group.diagonal[c * width];
    for (int k = 0; k < width; ++k) diagonal[k] = inertia[c] + (sinks.empty() ? 0.0 : group.sinks[c * width + k]);
    for (int i = m.faceStart[c]; i < m.faceStart[c + 1]; ++i) {
      const float* through = &group.conductance[m.faceOfCell[i] * width];
      for (int k = 0; k < width; ++k) diagonal[k] += through[k];
    }
  }
}

// One iteration: the next change from the last one.
void ImplicitDiffusion::iterate(Group& group, std::span<const double> old, std::span<const double> fresh,
                                std::span<const double> inertia) {
  static_assert(width == static_cast<int>(numerics::laneCount));
  using numerics::Lanes, numerics::loadLanes, numerics::storeLanes;
  const Mesh& m = mesh_;
  const Lanes ofOld = loadLanes(old.data()), ofFresh = loadLanes(fresh.data());
  for (int c = 0; c < m.owned; ++c) {
    const Lanes own = loadLanes(&group.change[c * width]);
    Lanes taken = inertia[c] * own;
    if (!group.sinks.empty()) taken += loadLanes(&group.sinks[c * width]) * own;
    for (int i = m.faceStart[c]; i < m.faceStart[c + 1]; ++i) {
      const int face = m.faceOfCell[i];
      const Lanes g = loadSingles(&group.conductance[face * width]);
      if (m.high[face] < 0)
        taken += g * own;
      else
        taken += g * (own - loadLanes(&group.change[(m.low[face] == c ? m.high[face] : m.low[face]) * width]));
    }
    const Lanes residual = loadLanes(&group.residual[c * width]) - taken;
    const Lanes changed = ofOld * own + ofFresh * residual / loadLanes(&group.diagonal[c * width]);
    storeLanes(&group.residual[c * width], residual);
    storeLanes(&group.otherChange[c * width], changed);
    storeLanes(&group.solution[c * width], loadLanes(&group.solution[c * width]) + changed);
  }
  std::swap(group.change, group.otherChange);
}

ImplicitDiffusion::Result ImplicitDiffusion::changes(int fields, std::span<const double> inertia,
                                                     const Conductance& conductance, std::span<double> change,
                                                     double tolerance, int maxIterations,
                                                     std::span<const double> sinks) {
  const Mesh& m = mesh_;
  const std::vector<double> radius = radii(fields, inertia, conductance, sinks);
  std::vector<int> order(static_cast<std::size_t>(fields));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](int a, int b) { return radius[a] > radius[b]; });
  // Where a rank has few cells, messages cost more than memory: groups then share them.
  constexpr std::int64_t cellsWorthAMessage = 8000;
  const std::size_t together =
      m.ranks > 1 ? static_cast<std::size_t>(std::max<std::int64_t>(cellsWorthAMessage * m.ranks / m.totalCells, 1))
                  : 1;
  const std::size_t count = (order.size() + width - 1) / width;
  groups_.resize(std::max(groups_.size(), std::min(together, count)));
  Result result;
  for (std::size_t first = 0; first < count; first += together) {
    const std::span<Group> batch{groups_.data(), std::min(together, count - first)};
    int most = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::size_t begins = (first + i) * width;
      const std::span<const int> of{order.data() + begins, std::min<std::size_t>(width, order.size() - begins)};
      begin(batch[i], of, fields, inertia, change, conductance, sinks);
      batch[i].iterations = iterationsFor(m.comm, radius[of.front()], tolerance, maxIterations);
      most = std::max(most, batch[i].iterations);
    }
    std::vector<std::vector<Chebyshev>> progress;
    for (const Group& group : batch) {
      progress.emplace_back();
      for (const int field : group.fields) progress.back().emplace_back(radius[field]);
    }
    for (int iteration = 1; iteration <= most; ++iteration) {
      std::vector<FieldView> messages;
      for (std::size_t i = 0; i < batch.size(); ++i) {
        Group& group = batch[i];
        if (iteration > group.iterations) continue;
        std::array<double, width> old{}, fresh{};
        for (std::size_t k = 0; k < group.fields.size(); ++k) {
          old[k] = progress[i][k].old;
          fresh[k] = progress[i][k].fresh;
          progress[i][k].next();
        }
        iterate(group, old, fresh, inertia);
        if (iteration < group.iterations) messages.push_back({group.change, width});
      }
      if (!messages.empty()) halo_.update(messages);
    }
    for (const Group& group : batch)
      for (int c = 0; c < m.owned; ++c)
        for (std::size_t k = 0; k < group.fields.size(); ++k)
          change[c * fields + group.fields[k]] = group.solution[c * width + k];
  }
  halo_.update(change, fields);
  result.iterations = order.empty() ? 0 : iterationsFor(m.comm, radius[order.front()], tolerance, maxIterations);
  return result;
}

}  // namespace lampblack::flow
