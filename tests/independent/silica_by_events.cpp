// Silica particles from Si(OH)4 in a gas whose history is given: a Monte Carlo calculation that shares nothing with
// Lampblack, to decide between it and another program. Every process is a jump at its own time, by thinning of bounds
// (Lewis and Shedler 1979), and each particle sinters by an ordinary differential equation between its jumps, with
// control of the error: there is no splitting step. SI units. README.md says what it is for and what came out.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

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
  bool sinter = true, coagulate = true, condense = true, grow = true, incept = true;
  double constant_kernel = 0;  // m3/s, for the test
};
Options options;
long majorant_violations = 0, attempts = 0, looks_done = 0, fusions = 0, lacked = 0;

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

double sphere(double v) {
  return std::cbrt(pi) * std::pow(6 * v, 2.0 / 3);
}

bool volumes_held = false;

void primary(Node& p) {
  p.sites = p.oh;
  if (volumes_held) return;
  p.v = (p.si * mass_si + p.o * mass_o + p.oh * mass_oh) / (avogadro * density);
  p.s = sphere(p.v);
  p.d = std::sqrt(p.s / pi);
  p.count = 1;
  p.levels = 0;
}

double level_of(const Particle& p, const Node& neck, double common) {
  const double s = sphere(p.nodes[neck.a].v + p.nodes[neck.b].v);
  return (s / common - q) / (1 - q);
}

// Sums of all nodes; the root has the surface of equation 15, other parts that of their primaries.
void derive(Particle& p) {
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
  p.d_c = 6 * p.v / p.s * std::pow(p.s * p.s * p.s / (36 * pi * p.v * p.v), 1 / fractal);
}

// Rate at which the neck n loses surface, by volume and surface of all that its collision joined.
double loss(const Particle& p, int n) {
  const Node& part = p.nodes[n];
  const double d = 6 * part.v / part.s;
  const double power = std::max(tau_temperature / temperature * (1 - critical / d), -300.0);
  const double tau = std::max(tau_prefactor * d * std::exp(power), shortest_tau);
  const double above = options.inner && n != p.root() ? part.s : std::max(part.s - sphere(part.v), 0.0);
  return above / tau;
}

double all_losses(const Particle& p) {
  double sum = 0;
  for (int n = 0; n <= p.root(); ++n)
    if (p.nodes[n].left >= 0) sum += loss(p, n);
  return sum;
}

void take_sites(Node& n, double oh, double o, double asked) {  // from what it had before
  n.oh = std::max(oh - asked, 0.0);
  n.o = o + 0.5 * (options.bridges ? asked : oh - n.oh);
}

int copy_in_order(const std::vector<Node>& from, int n, std::vector<Node>& to, std::vector<int>& place) {
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
int fuse(Particle& p, int k) {
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

// The law itself: Bogacki and Shampine's pair of orders 3 and 2 for common surfaces and sites, to the instants at which
// primaries fuse. Unknown y: of a neck its common surface, of a primary the sites that it should have lost.
void sinter_exactly(Particle& p, double time) {
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

// As MOpS does it: from the root down, each neck once, with the rate that it has now for all the time since the last
// look.
int sinter_frozen(Particle& p, int n, double dt, std::mt19937_64& random) {
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

void sinter(Particle& p, double time, std::mt19937_64& random) {
  ++looks_done;
  if (!options.frozen) return options.sinter && p.nodes.size() > 1 ? sinter_exactly(p, time) : void(p.time = time);
  const double dt = time - p.time;
  p.time = time;
  if (options.sinter && p.nodes.size() > 1 && dt > 0) sinter_frozen(p, p.root(), dt, random);
}

double kernel(double m1, double d1, double m2, double d2) {
  if (options.constant_kernel > 0) return options.constant_kernel;
  const double slip = 1.257 * 4.74e-5 * temperature / pressure;
  const double free = enhancement * std::sqrt(pi * k_b * temperature / 2 * (1 / m1 + 1 / m2)) * (d1 + d2) * (d1 + d2);
  const double continuum =
      2 * k_b * temperature / (3 * options.viscosity) * ((1 + slip / d1) / d1 + (1 + slip / d2) / d2) * (d1 + d2);
  return free * continuum / (free + continuum);
}

// Sums of weights, and draws by them, in O(log n).
class Sums {
 public:
  explicit Sums(size_t n) : size_(n), tree_(2 * n, 0.0) {}
  void set(size_t i, double x) {
    for (tree_[i += size_] = x; i > 1; i /= 2) tree_[i / 2] = tree_[i] + tree_[i ^ 1];
  }
  double total() const { return tree_[1]; }
  size_t draw(double u) const {
    double x = u * total();
    size_t i = 1;
    while (i < size_) {
      i *= 2;
      if (x >= tree_[i] && tree_[i + 1] > 0) x -= tree_[i++];
    }
    return i - size_;
  }

 private:
  size_t size_;
  std::vector<double> tree_;
};

struct Gas {
  std::vector<double> time, molar, source;  // mol/m3: Si(OH)4; Si that has left the other species until then
  double of(const std::vector<double>& x, double t, size_t k) const {
    return x[k] + (x[k + 1] - x[k]) * (t - time[k]) / (time[k + 1] - time[k]);
  }
};

class Sample {
 public:
  Sample(const Gas& gas, unsigned long seed)
      : gas_(gas),
        random_(seed),
        slots_(1),
        volume_(options.capacity / options.full_at),
        size2_(1),
        inverse_(1),
        both_(1),
        sites_(1),
        surface_(1),
        losses_(1) {
    while (slots_ < 2 * static_cast<size_t>(options.capacity)) slots_ *= 2;
    for (Sums* s : {&size2_, &inverse_, &both_, &sites_, &surface_, &losses_}) *s = Sums(slots_);
  }
  std::vector<Particle> particles;
  double taken = 0;  // Si per m3 that came by inception and growth

  double volume() const { return volume_; }
  void scale_volume(double factor) { volume_ *= factor; }
  double uniform() { return std::uniform_real_distribution<>(0, 1)(random_); }

  void add(const Particle& p) {
    if (particles.size() == 2 * static_cast<size_t>(options.capacity)) halve();
    particles.push_back(p);
    refresh(particles.size() - 1);
  }

  // All events until the end of the interval k of the gas's table, or until `end` if that is earlier.
  void advance(double& t, double end, size_t k) {
    const double most = options.given ? std::max(gas_.molar[k], gas_.molar[k + 1])
                                      : std::max(std::max(gas_.source[k], gas_.source[k + 1]) - taken / avogadro, 0.0);
    const double pair = 0.5 * kernel(molecule_mass, molecule_size, molecule_mass, molecule_size) * avogadro * avogadro;
    const double bound = enhancement * std::sqrt(pi * k_b * temperature / 2) * (options.narrow ? 1.4178 : 2.0) *
                         (options.frozen ? 1 : 1.1);
    for (;;) {
      const double inception = options.incept ? pair * most * most * volume_ : 0;
      const double growth = options.grow ? reaction * most * sites_.total() : 0;
      const double condensation = options.condense ? reaction * most * sites_.total() : 0;
      const double n = static_cast<double>(particles.size());
      const double one = n > 1 ? (n - 1) * both_.total() : 0, two = n > 1 ? size2_.total() * inverse_.total() : 0;
      const double coagulation = options.coagulate ? bound / volume_ * (one + two) : 0;
      const double total = inception + growth + condensation + coagulation;
      if (total <= 0) break;
      t -= std::log(1 - uniform()) / total;
      if (t >= end) break;
      const double c =
          options.given ? gas_.of(gas_.molar, t, k) : std::max(gas_.of(gas_.source, t, k) - taken / avogadro, 0.0);
      double x = uniform() * total;
      if ((x -= inception) < 0) {
        if (uniform() * most * most < c * c) incept(t);
      } else if ((x -= growth) < 0) {
        const size_t i = sites_.draw(uniform());
        const double sites = particles[i].sites;
        look(i, t);
        if (uniform() * most * sites < c * particles[i].sites) grow(i);
      } else if ((x -= condensation) < 0) {
        condense(t, c, most);
      } else {
        coagulate(t, x < bound / volume_ * one, bound);
      }
      if (full_once_ && 2 * particles.size() < static_cast<size_t>(options.capacity) && particles.size() > 0) twice();
    }
    t = end;
  }

  void look_at_all(double t) {
    for (size_t i = 0; i < particles.size(); ++i) {
      sinter(particles[i], t, random_);
      refresh(i);
    }
  }

 private:
  void refresh(size_t i) {
    Particle& p = particles[i];
    derive(p);
    const double a = p.d_c * p.d_c, b = 1 / std::sqrt(p.mass);
    size2_.set(i, a);
    inverse_.set(i, b);
    both_.set(i, a * b);
    sites_.set(i, p.sites);
    surface_.set(i, p.s);
    if (options.pooled) {
      double sum = 0;
      for (const Node& n : p.nodes) sum += n.last_rate;
      losses_.set(i, sum);
    }
    if (particles.size() * 2 > static_cast<size_t>(options.capacity)) full_once_ = true;
  }
  void clear(size_t i) {
    for (Sums* s : {&size2_, &inverse_, &both_, &sites_, &surface_, &losses_}) s->set(i, 0);
  }
  void remove(size_t i) {
    const size_t last = particles.size() - 1;
    clear(last);
    if (i != last) particles[i] = particles[last];
    particles.pop_back();
    if (i != last) refresh(i);
  }
  void halve() {
    for (size_t left = particles.size() / 2; left > 0; --left)
      remove(std::min(static_cast<size_t>(uniform() * static_cast<double>(particles.size())), particles.size() - 1));
    volume_ /= 2;
  }
  void twice() {
    const size_t n = particles.size();
    volume_ *= 2;
    for (size_t i = 0; i < n; ++i) {
      const Particle copy = particles[i];
      particles.push_back(copy);
      refresh(particles.size() - 1);
    }
  }
  void look(size_t i, double t) {
    if (options.frozen) return;
    sinter(particles[i], t, random_);
    refresh(i);
  }
  void incept(double t) {
    Particle p;
    p.nodes.resize(1);
    p.nodes[0].si = 2;
    p.nodes[0].o = 1;
    p.nodes[0].oh = 6;
    p.time = t;
    derive(p);
    taken += 2 / volume_;
    add(p);
  }
  size_t drawn_primary(const Particle& p) {
    auto left = static_cast<int>(uniform() * p.primaries);
    for (size_t n = 0;; ++n)
      if (p.nodes[n].left < 0 && left-- == 0) return n;
  }
  void grow(size_t i) {
    Particle& p = particles[i];
    const size_t n = drawn_primary(p);
    Node& x = p.nodes[n];
    const double v = x.v, d = x.d;
    x.si += 1;
    x.o += 1;
    x.oh += 2;
    primary(x);
    for (Node& neck : p.nodes)
      if (neck.left >= 0 && (neck.a == static_cast<int>(n) || neck.b == static_cast<int>(n)))
        neck.common += 2 * (x.v - v) / d;
    taken += 1 / volume_;
    refresh(i);
  }
  void condense(double t, double c, double most) {
    const size_t i = sites_.draw(uniform());
    Particle& p = particles[i];
    const double sites = p.sites;
    look(i, t);
    double rate = reaction * c * p.sites;
    double ceiling = reaction * most * sites;
    if (options.pooled) {
      rate = reaction * c * sites_.total() - 0.5 * sites_.total() / surface_.total() * losses_.total();
      ceiling = reaction * most * sites_.total();
    } else {
      rate -= 0.5 * p.sites / p.s * all_losses(p);
    }
    if (uniform() * ceiling >= rate) return;
    Node& x = p.nodes[drawn_primary(p)];
    if (x.oh < 2) {
      ++lacked;
      if (!options.pooled) return;
    }
    x.o += 1;
    x.oh = std::max(x.oh - 2, 0.0);
    refresh(i);
  }
  void coagulate(double t, bool uniform_partner, double bound) {
    ++attempts;
    const size_t n = particles.size();
    size_t i = uniform_partner ? both_.draw(uniform()) : size2_.draw(uniform());
    size_t j = uniform_partner ? static_cast<size_t>(uniform() * static_cast<double>(n - 1)) : inverse_.draw(uniform());
    if (uniform_partner && j >= i) ++j;
    if (i == j) return;
    Particle &p = particles[i], &r = particles[j];
    const double most = bound * (p.d_c * p.d_c + r.d_c * r.d_c) * (1 / std::sqrt(p.mass) + 1 / std::sqrt(r.mass));
    sinter(p, t, random_);
    sinter(r, t, random_);
    refresh(i);
    refresh(j);
    const double rate = kernel(p.mass, p.d_c, r.mass, r.d_c);
    if (rate > most) ++majorant_violations;
    if (uniform() * most >= rate) return;
    join(p, r);
    refresh(i);
    remove(j);
  }
  void join(Particle& p, const Particle& r) {
    Node neck;
    neck.a = static_cast<int>(drawn_primary(p));
    const int shift = static_cast<int>(p.nodes.size());
    neck.b = static_cast<int>(drawn_primary(r)) + shift;
    neck.left = p.root();
    for (Node x : r.nodes) {
      if (x.left >= 0)
        for (int* index : {&x.left, &x.right, &x.a, &x.b}) *index += shift;
      p.nodes.push_back(x);
    }
    neck.right = p.root();
    neck.common = p.nodes[neck.a].s + p.nodes[neck.b].s;
    p.nodes.push_back(neck);
    if (uniform() < 0.5) {  // which is left is drawn: on it hangs which part comes below where both are as large
      std::swap(p.nodes.back().left, p.nodes.back().right);
      std::swap(p.nodes.back().a, p.nodes.back().b);
    }
    put_in_order(p, p.root());
    derive(p);
    if (p.nodes.back().level > fused)
      fuse(p, p.root());  // a small primary on a large one, at once and with all its sites
  }

  const Gas& gas_;
  std::mt19937_64 random_;
  size_t slots_;
  double volume_;
  Sums size2_, inverse_, both_, sites_, surface_, losses_;
  bool full_once_ = false;
};

const std::vector<std::string> names = {"number", "Fv", "d_c", "primaries", "d_p", "level", "Si", "O", "OH", "d_sph"};

std::vector<double> means(const Sample& sample) {
  std::vector<double> m(names.size(), 0.0);
  const double n = std::max<double>(1, static_cast<double>(sample.particles.size())), each = 1 / sample.volume();
  for (const Particle& p : sample.particles) {
    const double sums[] = {each, p.v * each, p.d_c / n, p.primaries / n, p.d_p / n, p.level / n};
    for (size_t k = 0; k < 6; ++k) m[k] += sums[k];
    m[9] += std::cbrt(6 * p.v / pi) / n;
    for (const Node& x : p.nodes)
      if (x.left < 0) {
        m[6] += x.si * each;
        m[7] += x.o * each;
        m[8] += x.oh * each;
      }
  }
  return m;
}

std::vector<std::vector<double>> table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

// Columns: time in s, mol/m3 of Si(OH)4, mol/m3 of Si that has left all other species of the gas until then.
Gas read_gas(const std::string& path) {
  Gas gas;
  for (const auto& row : table(path)) {
    gas.time.push_back(row.at(0));
    gas.molar.push_back(row.at(1));
    gas.source.push_back(options.given ? 0.0 : row.at(2));
  }
  return gas;
}

// The times of MOpS's table, each interval in so many parts.
std::vector<double> times_of_looks(double parts) {
  std::vector<double> times;
  const auto add = [&](double from, double to, double step) {
    const long n = std::lround((to - from) / step * parts);
    for (long i = 1; i <= n; ++i) times.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(n));
  };
  add(0, 0.02, 0.001);
  add(0.02, 0.1, 0.005);
  add(0.1, 0.8, 0.025);
  return times;
}

// Whether all Si that was taken is there, and no pair was above the bound of its rate.
bool run(const Gas& gas, const std::vector<double>& rows) {
  std::vector<std::vector<double>> sum(rows.size(), std::vector<double>(names.size())), squares = sum;
  double worst = 0;
  for (int s = 0; s < options.seeds; ++s) {
    Sample sample(gas, static_cast<unsigned long>(options.first_seed + s));
    if (options.spheres) {
      Particle p;
      p.nodes.resize(1);
      p.nodes[0].si = 2107;
      p.nodes[0].o = 3960;
      p.nodes[0].oh = 398;
      derive(p);
      for (int i = 0; i < options.capacity; ++i) sample.add(p);
      sample.taken = means(sample)[6];
    }
    std::map<double, int> stops;  // 0: interval of the gas's table, 1: look at all, 2: row
    for (double t : gas.time) stops[t] = 0;
    if (options.frozen)
      for (double t : times_of_looks(options.looks)) stops[t] = 1;
    for (double t : rows) stops[t] = 2;
    double t = 0;
    size_t k = 0, row = 0;
    for (const auto& [end, what] : stops) {
      if (end <= 0 || end > options.end * (1 + 1e-12)) continue;
      while (k + 2 < gas.time.size() && gas.time[k + 1] <= t * (1 + 1e-12)) ++k;
      sample.advance(t, end, k);
      if (what > 0) sample.look_at_all(t);
      if (what == 2) {
        const auto m = means(sample);
        for (size_t i = 0; i < m.size(); ++i) {
          sum[row][i] += m[i];
          squares[row][i] += m[i] * m[i];
        }
        worst = std::max(worst, std::abs(m[6] / sample.taken - 1));
        ++row;
      }
    }
    std::fprintf(stderr, "seed %d: %zu particles, %ld looks, %ld fusions\n", options.first_seed + s,
                 sample.particles.size(), looks_done, fusions);
  }
  const double n = options.seeds;
  std::printf("time");
  for (const auto& name : names) std::printf(",%s,%s_error", name.c_str(), name.c_str());
  std::printf("\n");
  for (size_t r = 0; r < rows.size(); ++r) {
    std::printf("%g", rows[r]);
    for (size_t i = 0; i < names.size(); ++i) {
      const double mean = sum[r][i] / n;
      const double error = n > 1 ? std::sqrt(std::max(squares[r][i] / n - mean * mean, 0.0) / (n - 1)) : 0;
      std::printf(",%.6g,%.2g", mean, error);
    }
    std::printf("\n");
  }
  std::fprintf(stderr,
               "%ld collisions tried, %ld pairs above the bound; Si in particles differs from what they took by %.2g "
               "at most; two OH not there %ld times\n",
               attempts, majorant_violations, worst, lacked);
  return worst < 1e-9 && (options.frozen || majorant_violations == 0);
}

bool check(const char* what, double value, double exact, double allowed) {
  const bool good = std::abs(value / exact - 1) <= allowed;
  std::printf("%-4s %s: %.6g, exact %.6g (%+.2g, allowed %.2g)\n", good ? "ok" : "BAD", what, value, exact,
              value / exact - 1, allowed);
  return good;
}

Particle ball(double d, double sites) {
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
int verify() {
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

}  // namespace

int main(int count, char** words) try {
  std::string gas;
  std::vector<double> rows = {0.01, 0.02, 0.025, 0.03, 0.045, 0.06, 0.095, 0.2, 0.4, 0.8};
  bool verifying = false;
  std::map<std::string, bool*> flags = {
      {"frozen", &options.frozen},     {"inner", &options.inner},     {"bridges", &options.bridges},
      {"pooled", &options.pooled},     {"quanta", &options.quanta},   {"spheres", &options.spheres},
      {"uncapped", &options.uncapped}, {"held", &options.held},       {"given", &options.given},
      {"narrow", &options.narrow},     {"swapped", &options.swapped}, {"verify", &verifying}};
  std::map<std::string, bool*> without = {{"no-sintering", &options.sinter},
                                          {"no-coagulation", &options.coagulate},
                                          {"no-condensation", &options.condense},
                                          {"no-growth", &options.grow},
                                          {"no-inception", &options.incept}};
  std::map<std::string, double*> numbers = {{"end", &options.end},
                                            {"tolerance", &options.tolerance},
                                            {"viscosity", &options.viscosity},
                                            {"looks", &options.looks},
                                            {"full_at", &options.full_at}};
  std::map<std::string, int*> counts = {
      {"particles", &options.capacity}, {"seeds", &options.seeds}, {"first", &options.first_seed}};
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const size_t equal = word.find('=');
    const std::string name = word.substr(0, equal), value = equal == std::string::npos ? "" : word.substr(equal + 1);
    if (flags.count(name) > 0)
      *flags[name] = true;
    else if (without.count(name) > 0)
      *without[name] = false;
    else if (numbers.count(name) > 0)
      *numbers[name] = std::stod(value);
    else if (counts.count(name) > 0)
      *counts[name] = std::stoi(value);
    else if (name == "gas")
      gas = value;
    else
      throw std::runtime_error("unknown option " + word);
  }
  if (verifying) return verify();
  while (!rows.empty() && rows.back() > options.end * (1 + 1e-12)) rows.pop_back();
  if (options.spheres) rows = {0.1, 0.5, 1, 2, 5, 10};
  return run(options.spheres ? Gas{{0, 10}, {0, 0}, {0, 0}} : read_gas(gas), rows) ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
