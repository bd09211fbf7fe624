// Checks of silica_by_events.cpp by itself.
#pragma once

#include <cmath>
#include <cstdio>

#include "silica_sample.hpp"

namespace silica {

inline bool check(const char* what, double value, double exact, double allowed) {
  const bool good = std::abs(value / exact - 1) <= allowed;
  std::printf("%-4s %s: %.6g, exact %.6g (%+.2g, allowed %.2g)\n", good ? "ok" : "BAD", what, value, exact,
              value / exact - 1, allowed);
  return good;
}

inline Particle ball(double d, double sites) {
  Particle p;
  p.nodes.resize(1);
  const double molecules = pi / 6 * d * d * d * density * avogadro / (mass_si + 2 * mass_o);
  p.nodes[0].si = molecules;
  p.nodes[0].o = 2 * molecules;
  p.nodes[0].oh = sites;
  derive(p);
  return p;
}

// Exact limits: coagulation of a constant kernel, the decay of spheres of a self-preserving distribution in the
// free-molecular limit (Friedlander 2000: 6.67), two spheres that sinter against a fine quadrature, a part in a part.
inline int verify() {
  bool good = true;
  const Gas none{{0, 1e3}, {0, 0}, {0, 0}};
  const auto decay = [&](double constant, double number, double until, double size, double* volume) {
    options.constant_kernel = constant;
    options.capacity = 4096;
    options.full_at = number;
    double mean = 0;
    for (int seed = 1; seed <= 8; ++seed) {
      Sample sample(none, static_cast<unsigned long>(seed));
      for (int i = 0; i < options.capacity; ++i) sample.add(ball(size, 0));
      double t = 0;
      sample.advance(t, until, 0);
      if (volume != nullptr) *volume = means(sample)[1];
      mean += static_cast<double>(sample.particles.size()) / sample.volume() / 8;
    }
    options.constant_kernel = 0;
    return mean;
  };
  good &= check("number left by a constant kernel", decay(2e-15, 1e16, 1, 3e-9, nullptr), 1e16 / (1 + 10), 0.01);
  // From a far smaller number on, 1/N^(5/6) grows as (5/12) alpha times the rest; tiny, so that the continuum is
  // nothing.
  double volume = 0;
  const double alpha = 6.67, viscosity = options.viscosity;
  options.viscosity = 1e-30;
  const double left = decay(0, 1e18, 3e-2, 1e-9, &volume);
  const double factor = enhancement * std::pow(3 / (4 * pi), 1.0 / 6) * std::sqrt(6 * k_b * temperature / density) *
                        std::pow(volume, 1.0 / 6);
  const double then = decay(0, 1e18, 1e-2, 1e-9, &volume);
  good &= check("growth of N^(-5/6) of a self-preserving distribution",
                (std::pow(left, -5.0 / 6) - std::pow(then, -5.0 / 6)) / 2e-2, 5.0 / 12 * alpha * factor, 0.02);
  options.viscosity = viscosity;

  for (const double d : {6.5e-9, 7.2e-9, 8e-9}) {
    // Sites so few that they weigh nothing; the time to a level of 0.95 by the midpoint rule in C/S.
    const double end = 1 / (fused * (1 - q) + q);
    double time = 0;
    const int parts = 200000;
    for (int i = 0; i < parts; ++i) {
      const double u = 1 / q - (i + 0.5) / parts * (1 / q - end), size = d / q / u;
      time += (1 / q - end) / parts * tau_prefactor * size *
              std::exp(tau_temperature / temperature * (1 - critical / size)) / (u - 1);
    }
    const auto pair = [&] {
      Particle p = ball(d, 1e-6);
      p.nodes.push_back(p.nodes[0]);
      Node neck;
      neck.left = neck.a = 0;
      neck.right = neck.b = 1;
      neck.common = 2 * p.nodes[0].s;
      p.nodes.push_back(neck);
      derive(p);
      return p;
    };
    double low = 0, high = 2 * time;
    while (high - low > 1e-7 * time) {
      const double middle = 0.5 * (low + high);
      Particle p = pair();
      sinter_exactly(p, middle);
      (p.nodes.size() > 1 ? low : high) = middle;
    }
    char what[80];
    std::snprintf(what, sizeof what, "time until two spheres of %.1f nm fuse, s", 1e9 * d);
    good &= check(what, high, time, 1e-4);
    Particle p = pair();
    sinter_exactly(p, 2 * time);
    good &= check("sites left", p.sites, 2e-6 * end * q, 1e-5);
    // Parts inside a particle lose surface at a constant rate: the same pair hung on a large sphere by a slow neck.
    Particle inside = pair();
    Particle large = ball(60e-9, 0);
    inside.nodes.push_back(large.nodes[0]);
    Node slow;
    slow.left = 2;
    slow.right = slow.b = 3;
    slow.a = 0;
    slow.common = inside.nodes[0].s + large.nodes[0].s;
    inside.nodes.push_back(slow);
    derive(inside);
    const double constant = (pair().nodes[2].common - end * sphere(2 * pair().nodes[0].v)) / loss(inside, 2);
    Particle sooner = inside, later = inside;
    sinter_exactly(sooner, 0.999 * constant);
    sinter_exactly(later, 1.001 * constant);
    good &=
        check("primaries of a part just before it fuses, and after", sooner.primaries + 10 * later.primaries, 23, 0);
  }
  // Two nuclei: sites go as the common surface, and mass with the sites, so that the sphere that they become shrinks.
  Particle nuclei;
  nuclei.nodes.resize(3);
  for (int i = 0; i < 2; ++i) {
    nuclei.nodes[i].si = 2;
    nuclei.nodes[i].o = 1;
    nuclei.nodes[i].oh = 6;
    primary(nuclei.nodes[i]);
  }
  Node& neck = nuclei.nodes[2];
  neck.left = neck.a = 0;
  neck.right = neck.b = 1;
  neck.common = 2 * nuclei.nodes[0].s;
  derive(nuclei);
  double sites = 12;
  for (int i = 0; i < 100; ++i) {
    const double v = (4 * mass_si + (2 + 0.5 * (12 - sites)) * mass_o + sites * mass_oh) / (avogadro * density);
    sites = 12 * sphere(v) / (fused * (1 - q) + q) / neck.common;
  }
  Particle coupled = nuclei;
  sinter_exactly(coupled, 1e-3);
  good &= check("sites left of two nuclei", coupled.sites, sites, 1e-5);
  options.held = true;
  sinter_exactly(nuclei, 1e-3);
  options.held = false;
  good &= check("the same while volumes are held", nuclei.sites, 12 * q / (fused * (1 - q) + q), 1e-5);
  std::printf("%ld pairs above the bound\n", majorant_violations);
  return good && majorant_violations == 0 ? 0 : 1;
}

}  // namespace silica
