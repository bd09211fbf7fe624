// A sample of particles in a gas whose history is given, every process as jumps at their own times, by thinning of
// bounds (Lewis and Shedler 1979). For silica_by_events.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "silica_sintering.hpp"

namespace silica {

// Of the continuum kernel with slip, a ((1 + slip/d1)/d1 + (1 + slip/d2)/d2) (d1 + d2): m3/s and m.
const double slip = 1.257 * 4.74e-5 * temperature / pressure;
inline double continuum_factor() {
  return 2 * k_b * temperature / (3 * options.viscosity);
}

inline double kernel(double m1, double d1, double m2, double d2) {
  if (options.constant_kernel > 0) return options.constant_kernel;
  const double continuum = continuum_factor() * ((1 + slip / d1) / d1 + (1 + slip / d2) / d2) * (d1 + d2);
  if (options.slip) return continuum;
  const double free = enhancement * std::sqrt(pi * k_b * temperature / 2 * (1 / m1 + 1 / m2)) * (d1 + d2) * (d1 + d2);
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
  double at(size_t i) const { return tree_[i + size_]; }
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
        losses_(1),
        size_(1),
        per_size_(1),
        per_size2_(1),
        one_(1) {
    while (slots_ < 2 * static_cast<size_t>(options.capacity)) slots_ *= 2;
    for (Sums* s : all_sums()) *s = Sums(slots_);
    // A bound of the kernel as a sum of products of what one particle has and what the other has. Of the free-molecular
    // kernel, above the harmonic mean; of the continuum the kernel itself, with room for particles that shrink until
    // they are looked at, as they sinter.
    if (options.slip) {
      const double a = 1.5 * continuum_factor();
      terms_ = {
          {&one_, &one_, a}, {&size_, &per_size_, a}, {&per_size_, &one_, a * slip}, {&size_, &per_size2_, a * slip}};
    } else {
      const double a = enhancement * std::sqrt(pi * k_b * temperature / 2) * (options.narrow ? 1.4178 : 2.0) *
                       (options.frozen ? 1 : 1.1);
      terms_ = {{&both_, &one_, a}, {&size2_, &inverse_, a}};
    }
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
    for (;;) {
      const double inception = options.incept ? pair * most * most * volume_ : 0;
      const double growth = options.grow ? reaction * most * sites_.total() : 0;
      const double condensation = options.condense ? reaction * most * sites_.total() : 0;
      double coagulation = 0;
      if (options.coagulate && particles.size() > 1)
        for (const Term& term : terms_)
          coagulation += term.factor / volume_ * term.first->total() * term.second->total();
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
        size_t term = 0;
        while (term + 1 < terms_.size() &&
               (x -= terms_[term].factor / volume_ * terms_[term].first->total() * terms_[term].second->total()) >= 0)
          ++term;
        coagulate(t, terms_[term]);
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
  struct Term {
    const Sums *first, *second;
    double factor;
  };
  std::vector<Sums*> all_sums() {
    return {&size2_, &inverse_, &both_, &sites_, &surface_, &losses_, &size_, &per_size_, &per_size2_, &one_};
  }
  void refresh(size_t i) {
    Particle& p = particles[i];
    derive(p);
    const double a = p.d_c * p.d_c, b = 1 / std::sqrt(p.mass);
    size2_.set(i, a);
    inverse_.set(i, b);
    both_.set(i, a * b);
    size_.set(i, p.d_c);
    per_size_.set(i, 1 / p.d_c);
    per_size2_.set(i, 1 / a);
    one_.set(i, 1);
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
    for (Sums* s : all_sums()) s->set(i, 0);
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
    if (options.surface) return 0;
    auto left = static_cast<int>(uniform() * p.primaries);
    for (size_t n = 0;; ++n)
      if (p.nodes[n].left < 0 && left-- == 0) return n;
  }
  void grow(size_t i) {
    Particle& p = particles[i];
    const size_t n = drawn_primary(p);
    Node& x = p.nodes[n];
    const double v = x.v, d = x.d, s = p.s;
    x.si += 1;
    x.o += 1;
    x.oh += 2;
    primary(x);
    if (options.surface) p.s = std::pow(std::pow(s, 1.5) + 6 * std::sqrt(pi) * (x.v - v), 2.0 / 3);
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
    const double v = x.v;
    x.o += 1;
    x.oh = std::max(x.oh - 2, 0.0);
    primary(x);
    if (options.surface) p.s *= std::pow(x.v / v, 2.0 / 3);
    refresh(i);
  }
  void coagulate(double t, const Term& drawn_by) {
    ++attempts;
    const size_t i = drawn_by.first->draw(uniform()), j = drawn_by.second->draw(uniform());
    if (i == j) return;
    Particle &p = particles[i], &r = particles[j];
    double most = 0;
    for (const Term& term : terms_)
      most += term.factor * (term.first->at(i) * term.second->at(j) + term.first->at(j) * term.second->at(i));
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
    if (options.surface) {
      p.nodes[0].si += r.nodes[0].si;
      p.nodes[0].o += r.nodes[0].o;
      p.nodes[0].oh += r.nodes[0].oh;
      p.s += r.s;
      return derive(p);
    }
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
  Sums size2_, inverse_, both_, sites_, surface_, losses_, size_, per_size_, per_size2_, one_;
  std::vector<Term> terms_;
  bool full_once_ = false;
};

inline const std::vector<std::string> names = {"number", "Fv", "d_c", "primaries", "d_p",
                                               "level",  "Si", "O",   "OH",        "d_sph"};

inline std::vector<double> means(const Sample& sample) {
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

}  // namespace silica
