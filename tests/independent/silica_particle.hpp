// A particle of silica as a tree of collisions, by plain lists: what it is made of, its sizes and rates, and how two of
// its primaries become one. For silica_by_events.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace silica {

const double pi = std::acos(-1.0), k_b = 1.380649e-23, avogadro = 6.02214076e23;
const double temperature = 1173, pressure = 101325, density = 2200;
const double mass_si = 28.08e-3, mass_o = 16.00e-3, mass_oh = 17.01e-3;  // kg/mol
const double tau_prefactor = 1.1e-16, tau_temperature = 1.2e5, critical = 4.4e-9, fractal = 1.8;
const double shortest_tau = 1e-18;  // what is faster is at once in any case
const double reaction = 1e7;        // m3/mol/s for each site, of the surface reaction and of two OH
const double molecule_mass = 9.981e-26, molecule_size = 0.32e-9, enhancement = 2.2;
const double fused = 0.95, q = std::cbrt(0.5);

struct Options {
  int capacity = 4096, seeds = 4, first_seed = 1;
  double end = 0.8, full_at = 1e18, tolerance = 1e-6,
         viscosity = 14.58e-7 * std::pow(temperature, 1.5) / (temperature + 110.4);
  bool frozen = false;   // the rate of sintering stays what it was when the particle was last looked at
  double looks = 1;      // frozen: looks at all particles in each interval of the table of times
  bool inner = false;    // parts inside a particle lose surface at S/tau instead of (S - S_sph)/tau
  bool bridges = false;  // a primary without the sites it should lose gains O all the same
  bool pooled = false;   // frozen: rate of two OH from sums over all particles, and also where no two OH are
  bool quanta = false;   // frozen: Poisson numbers of a thousandth of the sphere's surface
  bool narrow = false;   // frozen: the narrower, unproved majorant 1.4178 in place of 2, so that fewer looks happen
  bool held = false;     // volumes stay while necks sinter, until a fusion or the end of the time that was looked at
  bool given = false;    // Si(OH)4 as given, instead of what its given source and these particles make of it
  bool spheres = false;  // begins with spheres of Si2107 O3960 OH398 and no gas to grow from, instead of with gas alone
  bool uncapped = false;  // necks of a fused primary keep their level even where that is more surface than both have
  bool swapped = false;   // which part is hung below the other where two primaries fuse
  bool surface = false;   // particles by volume and surface alone: one node, and the surface in Particle::s
  bool slip = false;      // collisions by the continuum kernel with slip alone, whatever the size
  bool sinter = true, coagulate = true, condense = true, grow = true, incept = true;
  double constant_kernel = 0;  // m3/s, for the test
};
inline Options options;
inline long majorant_violations = 0, attempts = 0, looks_done = 0, fusions = 0, lacked = 0;

// A tree of collisions. Leaves are primaries; every other node is the neck that a collision made, between the parts
// left and right, touching at the primaries a and b. Children stand before their parents.
struct Node {
  int left = -1, right = -1, a = -1, b = -1;
  double common = 0, last_rate = 0;                  // of a neck: common surface, and the rate at the last look
  double si = 0, o = 0, oh = 0;                      // of a primary
  double v = 0, s = 0, d = 0, sites = 0, level = 0;  // derived; v, s, sites of all below
  double count = 1, levels = 0;
};

struct Particle {
  std::vector<Node> nodes;
  double time = 0;
  double v = 0, s = 0, mass = 0, sites = 0, d_c = 0, level = 1, d_p = 0, primaries = 1;
  int root() const { return static_cast<int>(nodes.size()) - 1; }
};

inline double sphere(double v) {
  return std::cbrt(pi) * std::pow(6 * v, 2.0 / 3);
}

inline bool volumes_held = false;

inline void primary(Node& p) {
  p.sites = p.oh;
  if (volumes_held) return;
  p.v = (p.si * mass_si + p.o * mass_o + p.oh * mass_oh) / (avogadro * density);
  p.s = sphere(p.v);
  p.d = std::sqrt(p.s / pi);
  p.count = 1;
  p.levels = 0;
}

inline double level_of(const Particle& p, const Node& neck, double common) {
  const double s = sphere(p.nodes[neck.a].v + p.nodes[neck.b].v);
  return (s / common - q) / (1 - q);
}

inline double fractal_size(double v, double s) {
  return 6 * v / s * std::pow(s * s * s / (36 * pi * v * v), 1 / fractal);
}

// By volume and surface: with S as it is, but the sphere's at least, and where it is that but for a millionth.
inline void derive_by_surface(Particle& p) {
  Node& whole = p.nodes[0];
  primary(whole);
  p.v = whole.v;
  if (p.s < whole.s * (1 + 1e-6)) p.s = whole.s;
  p.sites = whole.oh;
  p.mass = p.v * density;
  p.primaries = p.s * p.s * p.s / (36 * pi * p.v * p.v);
  p.d_p = 6 * p.v / p.s;
  p.level = whole.s / p.s;
  p.d_c = fractal_size(p.v, p.s);
}

inline double tau(double d) {
  const double power = std::max(tau_temperature / temperature * (1 - critical / d), -300.0);
  return std::max(tau_prefactor * d * std::exp(power), shortest_tau);
}

// Sums of all nodes; the root has the surface of equation 15, other parts that of their primaries.
inline void derive(Particle& p) {
  if (options.surface) return derive_by_surface(p);
  for (Node& n : p.nodes) {
    if (n.left < 0) {
      primary(n);
      continue;
    }
    const Node &l = p.nodes[n.left], &r = p.nodes[n.right];
    n.v = l.v + r.v;
    n.s = l.s + r.s;
    n.sites = l.sites + r.sites;
    n.count = l.count + r.count;
    n.d = l.d + r.d;
    n.level = level_of(p, n, n.common);
    n.levels = l.levels + r.levels + std::clamp(n.level, 0.0, 1.0);
  }
  Node& root = p.nodes.back();
  p.v = root.v;
  p.primaries = root.count;
  p.level = root.count > 1 ? root.levels / (root.count - 1) : 1;
  const double third = 1 / std::cbrt(root.count);
  p.s = root.count > 1 ? sphere(p.v) / (p.level * (1 - third) + third) : root.s;
  root.s = p.s;
  p.sites = root.sites;
  p.mass = p.v * density;
  p.d_p = root.d / root.count;
  p.d_c = fractal_size(p.v, p.s);
}

// Rate at which the neck n loses surface, by volume and surface of all that its collision joined.
inline double loss(const Particle& p, int n) {
  const Node& part = p.nodes[n];
  const double above = options.inner && n != p.root() ? part.s : std::max(part.s - sphere(part.v), 0.0);
  return above / tau(6 * part.v / part.s);
}

inline double all_losses(const Particle& p) {
  if (options.surface) return (p.s - p.nodes[0].s) / tau(p.d_p);
  double sum = 0;
  for (int n = 0; n <= p.root(); ++n)
    if (p.nodes[n].left >= 0) sum += loss(p, n);
  return sum;
}

inline void take_sites(Node& n, double oh, double o, double asked) {  // from what it had before
  n.oh = std::max(oh - asked, 0.0);
  n.o = o + 0.5 * (options.bridges ? asked : oh - n.oh);
}

inline int copy_in_order(const std::vector<Node>& from, int n, std::vector<Node>& to, std::vector<int>& place) {
  Node node = from[n];
  if (node.left >= 0) {
    node.left = copy_in_order(from, node.left, to, place);
    node.right = copy_in_order(from, node.right, to, place);
  }
  to.push_back(node);
  return place[n] = static_cast<int>(to.size()) - 1;
}

// All below the root, left before right before their neck; where the node `wanted` then is.
int put_in_order(Particle& p, int root, int wanted = 0) {
  std::vector<Node> ordered;
  std::vector<int> place(p.nodes.size(), -1);
  copy_in_order(p.nodes, root, ordered, place);
  for (Node& x : ordered)
    if (x.left >= 0) {
      x.a = place[x.a];
      x.b = place[x.b];
    }
  p.nodes = ordered;
  return place[wanted];
}

// The primaries at the neck k become one; the larger part is hung where the smaller one's primary was. Necks of the two
// keep their level, up to point contact. Returns what now stands in the place of k.
inline int fuse(Particle& p, int k) {
  ++fusions;
  const Node neck = p.nodes[k];
  const bool left_below = (p.nodes[neck.left].count >= p.nodes[neck.right].count) != options.swapped;
  const int kept = left_below ? neck.a : neck.b, gone = left_below ? neck.b : neck.a;
  const int moved = left_below ? neck.left : neck.right, other = left_below ? neck.right : neck.left;
  const int top = other == gone ? moved : other;
  Node& into = p.nodes[kept];
  into.si += p.nodes[gone].si;
  into.o += p.nodes[gone].o;
  into.oh += p.nodes[gone].oh;
  primary(into);
  const int old_root = p.root();
  for (int n = 0; n <= old_root; ++n) {
    Node& x = p.nodes[n];
    if (x.left < 0 || n == k) continue;
    if (x.left == gone) x.left = moved;
    if (x.right == gone) x.right = moved;
    if (x.left == k) x.left = top;
    if (x.right == k) x.right = top;
    const bool touched = x.a == gone || x.b == gone || x.a == kept || x.b == kept;
    if (x.a == gone) x.a = kept;
    if (x.b == gone) x.b = kept;
    if (touched) {
      const double s = sphere(p.nodes[x.a].v + p.nodes[x.b].v);
      x.common = s / (std::clamp(x.level, 0.0, 1.0) * (1 - q) + q);
      if (!options.uncapped) x.common = std::min(x.common, p.nodes[x.a].s + p.nodes[x.b].s);
    }
  }
  const int now = put_in_order(p, k == old_root ? top : old_root, top);
  derive(p);
  return now;
}

}  // namespace silica
