// Numerical particles of different weights in flat arrays, as the method that draws pairs keeps them: what a candidate
// pair is judged by lies together in one row of 24 bytes, what only an event looks at in another array. The kernel's
// terms of a row cost most: they are computed when they are asked for, of all rows that lack them at once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/model/pair_kernel.hpp"
#include "particles/population/model/particle_type.hpp"

namespace lampblack::particles {

template <ParticleType Type>
class PairPopulation {
 public:
  using Particle = typename Type::Particle;
  struct Row {
    double weight;  // 1/m3
    PairKernel::Terms terms;
    float volume;  // m3
  };
  static_assert(sizeof(Row) == 24);
  struct Entry {
    const Particle& particle;
    double weight;  // 1/m3
  };

  PairPopulation(const Type& type, const std::optional<CollisionKernelOptions>& kernel) : type_(type) {
    if (kernel) kernel_.emplace(*kernel);
  }

  [[nodiscard]] const Type& type() const { return type_; }
  [[nodiscard]] const PairKernel& kernel() const { return *kernel_; }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] std::size_t bytes() const {
    return rows_.capacity() * sizeof(Row) + particles_.capacity() * sizeof(Particle);
  }
  [[nodiscard]] const Row& row(std::size_t k) const { return rows_[k]; }
  [[nodiscard]] const Row* rows() const { return rows_.data(); }
  [[nodiscard]] double weight(std::size_t k) const { return rows_[k].weight; }
  [[nodiscard]] const Particle& particle(std::size_t k) const { return particles_[k]; }
  [[nodiscard]] double volume(std::size_t k) const { return type_.volume(particles_[k]); }
  [[nodiscard]] double rateOf(std::size_t i, std::size_t j) const {  // m3/s, whatever the kernel
    const CollisionKernel& kernel = kernel_->kernel();
    return kernel.value(kernelProperties(kernel, type_, particles_[i]), kernelProperties(kernel, type_, particles_[j]));
  }

  // Another kernel for the particles that there are.
  void setKernel(const CollisionKernelOptions& kernel) {
    kernel_.emplace(kernel);
    forgetTerms();
  }
  // Gives all rows their terms.
  void findTerms();
  // Before many rows change with no pair to be asked for in between.
  void forgetTerms() { known_ = 0; }
  void clear() {
    rows_.clear();
    particles_.clear();
    known_ = 0;
  }
  void reserve(std::size_t count) {
    rows_.reserve(count);
    particles_.reserve(count);
  }
  void add(const Particle& particle, double weight) {
    rows_.push_back({weight, {}, static_cast<float>(type_.volume(particle))});
    particles_.push_back(particle);
  }
  void set(std::size_t k, const Particle& particle, double weight) {
    rows_[k].weight = weight;
    rows_[k].volume = static_cast<float>(type_.volume(particle));
    if (kernel_ && k < known_) rows_[k].terms = kernel_->terms(kernelProperties(kernel_->kernel(), type_, particle));
    particles_[k] = particle;
  }
  void copy(std::size_t from, std::size_t to) {
    rows_[to] = rows_[from];
    particles_[to] = particles_[from];
  }
  // All particles change: f(Particle&, weight) -> bool changes one of them, false drops it.
  template <class F>
  void change(F&& f);
  void setWeight(std::size_t k, double weight) { rows_[k].weight = weight; }
  void scaleWeights(double factor) {
    for (Row& row : rows_) row.weight *= factor;
  }
  // Takes out all for which gone(k).
  template <class Gone>
  void remove(Gone&& gone) {
    std::size_t kept = 0;
    const std::size_t known = known_;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (gone(k)) {
        if (k < known) --known_;
        continue;
      }
      if (kept != k) {
        rows_[kept] = rows_[k];
        particles_[kept] = std::move(particles_[k]);
      }
      ++kept;
    }
    rows_.resize(kept);
    particles_.erase(particles_.begin() + static_cast<std::ptrdiff_t>(kept), particles_.end());
  }

  [[nodiscard]] double number() const {  // 1/m3
    double sum = 0;
    for (const Row& row : rows_) sum += row.weight;
    return sum;
  }
  [[nodiscard]] double heaviest() const {  // 1/m3; zero without particles
    std::array<double, 4> most{};          // side by side, not one after the other
    std::size_t k = 0;
    for (; k + most.size() <= rows_.size(); k += most.size())
      for (std::size_t l = 0; l < most.size(); ++l) most[l] = std::max(most[l], rows_[k + l].weight);
    for (; k < rows_.size(); ++k) most[0] = std::max(most[0], rows_[k].weight);
    return std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  }
  template <class F>
  void forEach(F&& f) const {
    for (std::size_t k = 0; k < rows_.size(); ++k) f(Entry{particles_[k], rows_[k].weight});
  }

 private:
  Type type_;
  std::optional<PairKernel> kernel_;
  std::vector<Row> rows_;
  std::vector<Particle> particles_;
  std::size_t known_ = 0;  // so many of the first rows have their terms
};

template <ParticleType Type>
void PairPopulation<Type>::findTerms() {
  if (!kernel_) return;
  constexpr std::size_t block = 128;
  double volume[block], mass[block], diameter[block];
  PairKernel::Terms terms[block];
  for (; known_ < rows_.size();) {
    const std::size_t n = std::min(block, rows_.size() - known_);
    for (std::size_t k = 0; k < n; ++k) {
      const auto one = kernelProperties(kernel_->kernel(), type_, particles_[known_ + k]);
      volume[k] = one.volume;
      mass[k] = one.mass;
      diameter[k] = one.diameter;
    }
    kernel_->terms(volume, mass, diameter, n, terms);
    for (std::size_t k = 0; k < n; ++k) rows_[known_ + k].terms = terms[k];
    known_ += n;
  }
}

template <ParticleType Type>
template <class F>
void PairPopulation<Type>::change(F&& f) {
  known_ = 0;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (!f(particles_[k], rows_[k].weight)) continue;
    if (kept != k) particles_[kept] = std::move(particles_[k]);
    rows_[kept].weight = rows_[k].weight;
    rows_[kept].volume = static_cast<float>(type_.volume(particles_[kept]));
    ++kept;
  }
  rows_.resize(kept);
  particles_.erase(particles_.begin() + static_cast<std::ptrdiff_t>(kept), particles_.end());
}

}  // namespace lampblack::particles
