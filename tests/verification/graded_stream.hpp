// A stream against which heat or a species diffuses, whose steady state is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "flow_exact.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Gas is drawn in through an open end, with what it has there, and sucked out at the other, where a temperature or a
// composition is held: what diffuses against the stream is what is carried less what came in. With the distance along
// the stream, or the logarithm of the radius, and the stream through unity of the one or per radian of the other,
//   lambda dT/ds = m (h - h0),    rho D dY/ds = m (Y - Y0).
class GradedStream : public FlowExact {
 protected:
  std::vector<double> held = gas.massFractions("O2: 0.8, N2: 0.2");

  struct Setting {
    Geometry geometry;
    bool ofComposition;
  };

  const std::size_t oxygen = gas.mechanism.speciesIndex("O2"), nitrogen = gas.mechanism.speciesIndex("N2");

  // Of a temperature or a mass fraction of oxygen.
  [[nodiscard]] std::vector<double> mixture(const Setting& setting, double value) const {
    std::vector<double> Y = n2;
    if (setting.ofComposition) Y[oxygen] = value, Y[nitrogen] = 1.0 - value;
    return Y;
  }

  // Largest error over the difference of the ends.
  double error(const Setting& setting, int cells) {
    return error(setting,
                 {gradedAxis(innerOf(setting), {{innerOf(setting) + 0.01, cells, 0.25}}), uniformAxis(1e-3, 1)});
  }
  [[nodiscard]] static double innerOf(const Setting& setting) {
    return setting.geometry == Geometry::Axisymmetric ? 5e-3 : 0.0;
  }
  // The same on any axes and cells; sides that are not ends are planes of symmetry.
  double error(const Setting& setting, Axes axes, std::optional<Split> split = {}, double* mean = nullptr) {
    const bool axisymmetric = setting.geometry == Geometry::Axisymmetric;
    const double outer = innerOf(setting) + 0.01;
    const double T0 = 300.0, T1 = setting.ofComposition ? 300.0 : 450.0;
    const std::vector<double>& Y1 = setting.ofComposition ? held : n2;
    const double speed = axisymmetric ? 0.025 : 0.04;  // at the held end
    Side out = opening(BoundaryKind::Inlet, 0, true, -speed, T1, Y1);
    out.condition.fixedComposition = true;
    std::vector<Side> sides{opening(BoundaryKind::Outlet, 0, false, 0.0, T0, n2), out};
    const int cells = static_cast<int>(axes[0].size()) - 1;
    for (int axis = 1; axis < (axes[2].empty() ? 2 : 3); ++axis)
      for (const bool atMax : {false, true}) sides.push_back(side(BoundaryKind::Symmetry, axis, atMax));
    double smallest = outer;
    for (std::size_t i = 1; i < axes[0].size(); ++i) smallest = std::min(smallest, axes[0][i] - axes[0][i - 1]);
    if (split) smallest *= 0.2;
    Box box(setting.geometry, std::move(axes), sides, gas, split);
    const double m = gas.thermo.density(T1, 101325.0, Y1) * speed * (axisymmetric ? outer : 1.0);
    const auto along = [&](double x) { return axisymmetric ? std::log(x / outer) : x - outer; };
    const double h0 = gas.thermo.enthalpyMass(T0, n2);
    std::vector<double> X(n2.size()), D(n2.size());
    // Slope along s of the temperature or the mass fraction of oxygen.
    const auto slope = [&](double value) {
      const std::vector<double> Y = mixture(setting, value);
      const double T = setting.ofComposition ? T0 : value;
      gas.thermo.massToMole(Y, X);
      const auto found = gas.transport.mixture(T, 101325.0, X, D);
      if (!setting.ofComposition) return m * (gas.thermo.enthalpyMass(T, Y) - h0) / found.conductivity;
      // The mixture-averaged coefficient of a gas in another is that of the pair times 1 - Y over 1 - X.
      const double pair = D[oxygen] * (1.0 - X[oxygen]) / (1.0 - Y[oxygen]);
      return m * value / (gas.thermo.density(T, 101325.0, Y) * pair);
    };
    const double end = setting.ofComposition ? held[oxygen] : T1;
    const auto exact = [&](double x) {
      constexpr int parts = 200;
      const double ds = along(x) / parts;
      double value = end;
      for (int i = 0; i < parts; ++i) {
        const double a = slope(value), b = slope(value + 0.5 * ds * a), c = slope(value + 0.5 * ds * b);
        value += ds / 6.0 * (a + 2.0 * b + 2.0 * c + slope(value + ds * c));
      }
      return value;
    };
    State state = box.state([&](const Place& x) {
      const double value = exact(x[0]);
      return Box::Local{{0.6 * speed, 0.0}, setting.ofComposition ? T0 : value, mixture(setting, value)};
    });
    TransportOperator transport(box.context, state);
    const double dt = 0.4 * smallest / speed;
    transport.initialise(state, dt);
    const auto valueOf = [&](int c) {
      return setting.ofComposition ? state.Y[at(c) * n2.size() + oxygen] : state.temperature[at(c)];
    };
    double change = 1.0;
    std::vector<double> before(at(box.mesh.owned));
    for (int step = 0; step < (split ? 1000 : 200) * cells && change > 1e-11; ++step) {
      for (int c = 0; c < box.mesh.owned; ++c) before[at(c)] = valueOf(c);
      transport.advance(state, 0.0, dt);
      change = largest(box.mesh, [&](int c) { return std::abs(valueOf(c) - before[at(c)]); }) /
               (setting.ofComposition ? 1.0 : T1 - T0);
    }
    // The limiter of cells without order has kinks that a steady state may swing about.
    EXPECT_LT(change, split ? 1e-5 : 1e-9) << "not steady";
    if (mean != nullptr)
      *mean = meanError(box, [&](int c) { return valueOf(c) - exact(box.mesh.centre[at(c)][0]); }) /
              (setting.ofComposition ? 1.0 : T1 - T0);
    return largest(box.mesh, [&](int c) { return std::abs(valueOf(c) - exact(box.mesh.centre[at(c)][0])); }) /
           (setting.ofComposition ? 1.0 : T1 - T0);
  }
};

}  // namespace lampblack::test
