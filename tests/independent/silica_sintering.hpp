// How a particle sinters between its events: by the law, with control of the error, or as MOpS does it. For
// silica_by_events.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "silica_particle.hpp"

namespace silica {

// The law itself: Bogacki and Shampine's pair of orders 3 and 2 for common surfaces and sites, to the instants at which
// primaries fuse. Unknown y: of a neck its common surface, of a primary the sites that it should have lost.
inline void sinter_exactly(Particle& p, double time) {
  double left = time - p.time;
  p.time = time;
  double h = left;
  std::vector<double> y0, y, k1, k2, k3, k4, oh, o;
  const auto put = [&](const std::vector<double>& at) {
    volumes_held = options.held;
    for (size_t n = 0; n < p.nodes.size(); ++n)
      if (p.nodes[n].left >= 0)
        p.nodes[n].common = at[n];
      else
        take_sites(p.nodes[n], oh[n], o[n], at[n]);
    derive(p);
    volumes_held = false;
  };
  const auto slope = [&](std::vector<double>& f) {
    f.assign(p.nodes.size(), 0.0);
    for (size_t n = 0; n < p.nodes.size(); ++n) {
      const Node& x = p.nodes[n];
      if (x.left < 0) continue;
      const double r = loss(p, static_cast<int>(n)), each = 0.5 * x.sites / x.s * r;
      f[n] = -r;
      f[x.a] += each;
      f[x.b] += each;
    }
  };
  while (left > 0 && p.nodes.size() > 1) {
    int ready = -1;
    for (size_t n = 0; n < p.nodes.size() && ready < 0; ++n)
      if (p.nodes[n].left >= 0 && p.nodes[n].level >= fused) ready = static_cast<int>(n);
    if (ready >= 0) {
      fuse(p, ready);
      h = left;
      continue;
    }
    const size_t size = p.nodes.size();
    y0.assign(size, 0.0);
    oh.assign(size, 0.0);
    o.assign(size, 0.0);
    for (size_t n = 0; n < size; ++n) {
      y0[n] = p.nodes[n].left >= 0 ? p.nodes[n].common : 0.0;
      oh[n] = p.nodes[n].oh;
      o[n] = p.nodes[n].o;
    }
    const double sites = p.sites + 1;
    const std::vector<Node> before = p.nodes;
    slope(k1);
    for (size_t n = 0; n < size; ++n)  // a first step that changes no surface by more than a hundredth
      if (k1[n] < 0) h = std::min(h, -0.05 * y0[n] / k1[n]);
    for (;;) {
      h = std::min(h, left);
      y.resize(size);
      for (size_t n = 0; n < size; ++n) y[n] = y0[n] + 0.5 * h * k1[n];
      put(y);
      slope(k2);
      for (size_t n = 0; n < size; ++n) y[n] = y0[n] + 0.75 * h * k2[n];
      put(y);
      slope(k3);
      for (size_t n = 0; n < size; ++n) y[n] = y0[n] + h * (2 * k1[n] + 3 * k2[n] + 4 * k3[n]) / 9;
      put(y);
      slope(k4);
      double error = 0, cut = 1;
      for (size_t n = 0; n < size; ++n) {
        const double e = h * (-5 * k1[n] / 72 + k2[n] / 12 + k3[n] / 9 - k4[n] / 8);
        error = std::max(error, std::abs(e) / (before[n].left >= 0 ? y0[n] : sites) / options.tolerance);
        if (before[n].left >= 0 && p.nodes[n].level > fused + 1e-6)
          cut = std::min(cut, (fused + 5e-7 - before[n].level) / (p.nodes[n].level - before[n].level));
      }
      if (!(error <= 1)) {
        p.nodes = before;
        h *= std::isfinite(error) ? std::clamp(0.9 * std::cbrt(1 / error), 0.1, 0.9) : 0.1;
      } else if (cut < 1) {
        p.nodes = before;
        h *= std::clamp(cut, 0.05, 0.999);
      } else {
        left = h >= left ? 0 : left - h;
        h *= std::clamp(0.9 * std::cbrt(1 / std::max(error, 1e-9)), 0.3, 5.0);
        break;
      }
    }
  }
  derive(p);
}

// By volume and surface: dS/dt = -(S - S_sph)/tau(6V/S), sites as S. The time that S takes to lose a thirtieth of its
// excess, three thousandths of itself at most, by the midpoint rule, again and again; a millionth of the sphere that is
// left is nothing.
inline void sinter_surface(Particle& p, double time) {
  double left = time - p.time;
  p.time = time;
  const double oh = p.nodes[0].oh, o = p.nodes[0].o, start = p.s;
  const auto at = [&](double s) {
    p.nodes[0].oh = oh * s / start;
    p.nodes[0].o = o + 0.5 * (oh - p.nodes[0].oh);
    p.s = s;
    derive(p);
    return s - p.nodes[0].s;
  };
  double s = p.s;
  while (left > 0) {
    const double excess = at(s);
    if (excess <= 1e-6 * s) {
      s -= excess;
      break;
    }
    const double down = std::min(excess / 30, 3e-3 * s), middle = at(s - 0.5 * down),
                 needs = down * tau(p.d_p) / middle;
    s -= needs > left ? down * left / needs : down;
    left -= needs;
  }
  at(s);
}

// As MOpS does it: from the root down, each neck once, with the rate that it has now for all the time since the last
// look.
inline int sinter_frozen(Particle& p, int n, double dt, std::mt19937_64& random) {
  if (p.nodes[n].left < 0) return n;
  Node& neck = p.nodes[n];
  const double s = sphere(p.nodes[neck.a].v + p.nodes[neck.b].v), rate = loss(p, n), quantum = 1e-3 * s;
  double lost = rate * dt;
  if (options.quanta && lost < 2 * neck.common)
    lost = quantum * static_cast<double>(std::poisson_distribution<long>(std::max(lost / quantum, 1e-300))(random));
  lost = std::min(lost, std::max(neck.common - s, 0.0));
  const double asked = 0.5 * neck.sites * lost / neck.s;
  neck.common -= lost;
  neck.last_rate = rate;
  Node &a = p.nodes[neck.a], &b = p.nodes[neck.b];
  take_sites(a, a.oh, a.o, asked);
  take_sites(b, b.oh, b.o, asked);
  derive(p);
  while (p.nodes[n].left >= 0 && p.nodes[n].level > fused) n = fuse(p, n);
  if (p.nodes[n].left < 0) return n;
  // Children are found by their distance from the end, as nodes before them may go.
  const auto below = [&](bool left) {
    const int child = left ? p.nodes[n].left : p.nodes[n].right;
    const int from_end = static_cast<int>(p.nodes.size()) - n;
    sinter_frozen(p, child, dt, random);
    n = static_cast<int>(p.nodes.size()) - from_end;
  };
  below(true);
  below(false);
  return n;
}

inline void sinter(Particle& p, double time, std::mt19937_64& random) {
  ++looks_done;
  if (options.surface) return options.sinter ? sinter_surface(p, time) : void(p.time = time);
  if (!options.frozen) return options.sinter && p.nodes.size() > 1 ? sinter_exactly(p, time) : void(p.time = time);
  const double dt = time - p.time;
  p.time = time;
  if (options.sinter && p.nodes.size() > 1 && dt > 0) sinter_frozen(p, p.root(), dt, random);
}

}  // namespace silica
