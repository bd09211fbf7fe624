// Many soot particles at once, in flat arrays: sums over them and their growth, in loops that are compiled to vector
// instructions. SootMedium does the same one by one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/soot/soot_medium.hpp"

namespace lampblack::particles {

struct SootColumns {
  std::vector<double> carbon, hydrogen;  // kg
  std::vector<double> primaries;
  std::vector<double> diameter;  // m, of collision
  std::vector<double> weight;    // 1/m3

  [[nodiscard]] std::size_t size() const { return carbon.size(); }
  void resize(std::size_t n) {
    for (auto* column : {&carbon, &hydrogen, &primaries, &diameter, &weight}) column->resize(n);
  }
  // Where they are, until there are more or fewer.
  struct Row {
    double *carbon, *hydrogen, *primaries, *diameter, *weight;
    void set(std::size_t k, const SootAggregate::Particle& p, double w) const {
      carbon[k] = p.carbon;
      hydrogen[k] = p.hydrogen;
      primaries[k] = p.primaries;
      diameter[k] = p.diameter;
      weight[k] = w;
    }
  };
  [[nodiscard]] Row row() { return {carbon.data(), hydrogen.data(), primaries.data(), diameter.data(), weight.data()}; }
  void set(std::size_t k, const SootAggregate::Particle& p, double w) { row().set(k, p, w); }
  // The last one takes its place.
  void remove(std::size_t k) {
    for (auto* column : {&carbon, &hydrogen, &primaries, &diameter, &weight}) {
      (*column)[k] = column->back();
      column->pop_back();
    }
  }
  [[nodiscard]] SootAggregate::Particle particle(std::size_t k) const {
    return {carbon[k], hydrogen[k], primaries[k], diameter[k]};
  }
};

// Of a whole population, per m3.
struct SootSums {
  double number = 0, carbon = 0, hydrogen = 0, primaries = 0, area = 0, diameters = 0;
  // With dimers, 1/s, and their change with the logarithm of all diameters: zero where it does not change dimers().
  double collisions = 0, slopes = 0;

  static const std::array<double SootSums::*, 8> all;
  void add(const SootSums& other);
};
inline constexpr std::array<double SootSums::*, 8> SootSums::all{
    &SootSums::number, &SootSums::carbon,    &SootSums::hydrogen,   &SootSums::primaries,
    &SootSums::area,   &SootSums::diameters, &SootSums::collisions, &SootSums::slopes};
inline void SootSums::add(const SootSums& other) {
  for (const auto sum : all) this->*sum += other.*sum;
}

[[nodiscard]] SootSums sumsOf(const SootColumns& all, const SootAggregate& type, const SootMedium& medium);

// Grows all over dt (s), as SootMedium::grow does one of them; those that are oxidised away are left without carbon.
[[nodiscard]] SootTransfer growAll(SootColumns& all, const SootAggregate& type, const SootMedium& medium,
                                   const SootFluxes& fluxes, double dt);

// The same in whole events, a dimer, two atoms of carbon by C2H2 or O2 or one by OH: of each particle and kind as many
// as a Poisson number says whose mean is what growAll() would move. A particle that an event leaves with less carbon
// than the smallest nucleus is oxidised away. Some particles after the other: GrowthByEvents.
[[nodiscard]] SootTransfer growAllByEvents(SootColumns& all, const SootAggregate& type, const SootMedium& medium,
                                           const SootFluxes& fluxes, double dt, RandomStream& random);

}  // namespace lampblack::particles
