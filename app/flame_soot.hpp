// Puts a soot model behind what a flame carries: names of species become indices of the mechanism, carbon and hydrogen
// become elements, and soot radiates. And reads from a deck which model that is.
#pragma once

#include <memory>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "flow/flame/carried_model.hpp"
#include "io/deck.hpp"
#include "particles/soot/soot_model.hpp"

namespace lampblack {

// The keys of the section `soot`, for the schema of a problem. An absent section is no soot.
void addSootModelKeys(DeckSchema& schema);

// The soot model that a deck asks for, with the mechanism's atomic weights; empty for `model: none` and for a deck
// without the section. InputError, pointing into the deck, for what the mechanism or the model cannot do.
[[nodiscard]] std::unique_ptr<SootModel> readSootModel(const Deck& deck, const Mechanism& mechanism);

class FlameSoot final : public CarriedModel {
 public:
  // Owns the model and does not refer to the mechanism afterwards. Without `diffusion` soot moves with the gas and by
  // thermophoresis only, as particles on their paths do. InputError where the mechanism lacks a species or element that
  // the model needs.
  FlameSoot(const Mechanism& mechanism, std::unique_ptr<SootModel> model, bool diffusion = true);

  [[nodiscard]] const SootModel& model() const { return *model_; }

  [[nodiscard]] const std::vector<Scalar>& scalars() const override { return scalars_; }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return exchanged_; }
  [[nodiscard]] std::vector<std::vector<double>> gridSums() const override { return model_->gridSums(); }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) override;
  void jacobian(const ParticleGas& gas, std::span<const double> densities, const CarriedJacobian& out) override;
  void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) override;
  // Soot carbon has the enthalpy of graphite, soot hydrogen that of H2.
  void enthalpies(double temperature, std::span<double> h, std::span<double> slope) override;
  // 700 f_v T 1/m (thesis 7.2.4).
  double absorption(double temperature, std::span<const double> densities) override;

 private:
  std::unique_ptr<SootModel> model_;
  bool diffusion_;
  std::vector<Scalar> scalars_;
  std::vector<std::size_t> exchanged_;
};

}  // namespace lampblack
