#include "flow/streamline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/errors.hpp"
#include "core/gather.hpp"

namespace lampblack::flow {
namespace {

// Derivative at index i of samples f(i) at places x by the parabola through its neighbours (one-sided at the ends).
template <typename Field>
double slopeAt(const std::vector<double>& x, std::size_t i, const Field& f) {
  if (x.size() < 2) return 0.0;
  if (i == 0) return (f(1) - f(0)) / (x[1] - x[0]);
  if (i + 1 == x.size()) return (f(i) - f(i - 1)) / (x[i] - x[i - 1]);
  const double left = x[i] - x[i - 1];
  const double right = x[i + 1] - x[i];
  return ((f(i) - f(i - 1)) / left * right + (f(i + 1) - f(i)) / right * left) / (left + right);
}

}  // namespace

Streamlines::Streamlines(const Mesh& mesh, const State& state, const GasProperties& properties, double thermophoresis)
    : mesh_(mesh) {
  if (!isPossible(mesh))
    throw InputError(
        "paths of particles need a plane mesh that is a whole box: no part left out or bent, no mesh file");
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto& v = mesh.box->vertices[axis];
    for (std::size_t i = 0; i + 1 < v.size(); ++i) centre_[axis].push_back(0.5 * (v[i] + v[i + 1]));
  }
  velocity_ = gatherNatural(mesh, state.velocity, 2);
  const std::vector<double> temperature = gatherNatural(mesh, state.temperature, 1);
  const std::vector<double> density = gatherNatural(mesh, state.density, 1);
  const std::vector<double> viscosity = gatherNatural(mesh, properties.viscosity, 1);
  const std::size_t n0 = centre_[0].size();
  const std::size_t n1 = centre_[1].size();
  for (std::size_t j = 0; j < n1; ++j)
    for (std::size_t i = 0; i < n0; ++i) {
      const std::size_t c = i + j * n0;
      const double factor = -thermophoresis * viscosity[c] / density[c] / temperature[c];
      velocity_[2 * c] += factor * slopeAt(centre_[0], i, [&](std::size_t a) { return temperature[a + j * n0]; });
      velocity_[2 * c + 1] += factor * slopeAt(centre_[1], j, [&](std::size_t a) { return temperature[i + a * n0]; });
    }
  computeDivergence();
}

bool Streamlines::isPossible(const Mesh& mesh) {
  return mesh.box && mesh.box->isWholePlane();
}

void Streamlines::computeDivergence() {
  const std::size_t n0 = centre_[0].size();
  const std::size_t n1 = centre_[1].size();
  divergence_.resize(n0 * n1);
  for (std::size_t j = 0; j < n1; ++j)
    for (std::size_t i = 0; i < n0; ++i) {
      const std::size_t c = i + j * n0;
      divergence_[c] = slopeAt(centre_[0], i, [&](std::size_t a) { return velocity_[2 * (a + j * n0)]; }) +
                       slopeAt(centre_[1], j, [&](std::size_t a) { return velocity_[2 * (i + a * n0) + 1]; });
      if (mesh_.axisymmetric()) divergence_[c] += velocity_[2 * c] / centre_[0][i];
    }
}

BilinearPoint Streamlines::locate(const std::array<double, 2>& position) const {
  std::array<std::size_t, 2> base{};
  std::array<double, 2> share{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto& x = centre_[axis];
    if (x.size() < 2) continue;
    const auto above = std::upper_bound(x.begin(), x.end(), position[axis]);
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(above - x.begin() - 1, 0, static_cast<std::ptrdiff_t>(x.size()) - 2));
    base[axis] = i;
    // Constant beyond the outermost centres.
    share[axis] = std::clamp((position[axis] - x[i]) / (x[i + 1] - x[i]), 0.0, 1.0);
  }
  const std::size_t n0 = centre_[0].size();
  const std::size_t di = n0 > 1 ? 1 : 0;
  const std::size_t dj = centre_[1].size() > 1 ? n0 : 0;
  const std::size_t c = base[0] + base[1] * n0;
  return {{c, c + di, c + dj, c + di + dj},
          {(1 - share[0]) * (1 - share[1]), share[0] * (1 - share[1]), (1 - share[0]) * share[1], share[0] * share[1]}};
}

std::array<double, 2> Streamlines::velocityAt(const std::array<double, 2>& position) const {
  const BilinearPoint place = locate(position);
  std::array<double, 2> w{place.of(velocity_, 2, 0), place.of(velocity_, 2, 1)};
  // On the axis the radial velocity is proportional to the radius.
  if (mesh_.axisymmetric() && position[0] < centre_[0].front()) w[0] *= std::max(position[0], 0.0) / centre_[0].front();
  return w;
}

bool Streamlines::inside(const std::array<double, 2>& position) const {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto& v = mesh_.box->vertices[axis];
    if (position[axis] < v.front() || position[axis] > v.back()) return false;
  }
  return true;
}

std::vector<PathPoint> Streamlines::trace(std::array<double, 2> start, double timeStep, double duration) const {
  std::vector<PathPoint> path;
  std::array<double, 2> x = start;
  const auto steps = static_cast<std::int64_t>(std::ceil(duration / timeStep - 1e-9));
  for (std::int64_t step = 0; step <= steps && inside(x); ++step) {
    const BilinearPoint place = locate(x);
    path.push_back({static_cast<double>(step) * timeStep, x, place, place.of(divergence_)});
    const auto first = velocityAt(x);
    const auto middle = velocityAt({x[0] + 0.5 * timeStep * first[0], x[1] + 0.5 * timeStep * first[1]});
    x = {x[0] + timeStep * middle[0], x[1] + timeStep * middle[1]};
  }
  return path;
}

}  // namespace lampblack::flow
