// The quadrature method of moments (McGraw 1997): every integral over the distribution is a sum over the nodes of the
// Gaussian quadrature that has the current moments.
#include <array>
#include <cmath>

#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/moments/moment_system.hpp"
#include "particles/population/moments/quadrature_inversion.hpp"

namespace lampblack::particles {
namespace {

class QmomSystem final : public MomentSystem {
 public:
  QmomSystem(const PopulationModel& model, const InitialPopulation& initial, const MomentOptions& options)
      : MomentSystem(model, initial, options.moments), inversion_(options.inversion), sphere_(model.density) {
    if (model.coagulation) kernel_.emplace(*model.coagulation);
  }

  bool hasVanishing(const double* y) const override {
    if (!(y[0] > 0)) return false;
    const double limit = vanishingVolume(y[1] / y[0]);
    if (!(limit > 0)) return false;
    const auto q = quadrature(y);
    return q.count > 0 && q.nodes[0] <= limit;
  }

  std::vector<double> withoutVanishing(double /*time*/, const double* y) const override {
    return momentsAbove(y, vanishingVolume(y[1] / y[0]) * (1 + 1e-9));  // the time was found from above
  }
  std::vector<double> simplified(const double* y) const override { return momentsAbove(y, 0); }

  bool limited(const double* y) const override { return y[0] > 0 && quadrature(y).count < size() / 2; }

  double geometricDeviation(const double* y) const override {
    const auto q = quadrature(y);
    double number = 0, mean = 0, square = 0;
    for (std::size_t i = 0; i < q.count; ++i) {
      number += q.weights[i];
      mean += q.weights[i] * std::log(q.nodes[i]);
    }
    if (!(number > 0)) return 1;
    mean /= number;
    for (std::size_t i = 0; i < q.count; ++i) square += q.weights[i] * std::pow(std::log(q.nodes[i]) - mean, 2);
    return std::exp(std::sqrt(square / number) / 3);
  }

 protected:
  bool addClosed(const double* y, double* f) const override {
    const auto q = quadrature(y);
    if (q.count == 0) return false;
    for (std::size_t i = 0; i < q.count; ++i) {
      const double x = q.nodes[i];
      const double broken =
          model().breakage ? model().breakage->rate * std::pow(x * unit(), model().breakage->exponent) : 0;
      const double lost = lossRate(x), grown = surfaceFactor() != 0 ? surfaceFactor() * std::cbrt(x * x) / x : 0.0;
      double power = q.weights[i];
      for (std::size_t k = 0; k < size(); ++k, power *= x) {
        double rate = static_cast<double>(k) * grown - lost;
        if (broken > 0) rate += broken * (share(k) - 1);
        f[k] += rate * power;
      }
    }
    if (kernel_) addCoagulation(q, f);
    return true;
  }

 private:
  [[nodiscard]] MomentQuadrature quadrature(const double* y) const {
    return momentQuadrature(std::span(y, size()), inversion_);
  }

  // Of the nodes above a volume.
  [[nodiscard]] std::vector<double> momentsAbove(const double* y, double limit) const {
    const auto q = quadrature(y);
    std::vector<double> result(size(), 0.0);
    for (std::size_t i = 0; i < q.count; ++i) {
      if (q.nodes[i] <= limit) continue;
      double power = q.weights[i];
      for (double& m : result) {
        m += power;
        power *= q.nodes[i];
      }
    }
    return result;
  }

  // A pair changes v^k by (u + v)^k - u^k - v^k, for k > 1 a sum of mixed products.
  void addCoagulation(const MomentQuadrature& q, double* f) const {
    std::array<std::array<double, most>, MomentQuadrature::most> powers{};
    std::array<CollisionKernel::Properties, MomentQuadrature::most> properties;
    for (std::size_t i = 0; i < q.count; ++i) {
      double power = 1;
      for (std::size_t k = 0; k < size(); ++k, power *= q.nodes[i]) powers[i][k] = power;
      properties[i] = kernelProperties(*kernel_, sphere_, sphere_.make(q.nodes[i] * unit()));
    }
    for (std::size_t i = 0; i < q.count; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const double events =
            (i == j ? 0.5 : 1.0) * q.weights[i] * q.weights[j] * kernel_->value(properties[i], properties[j]);
        f[0] -= events;
        for (std::size_t k = 2; k < size(); ++k) {
          double mixed = 0;
          for (std::size_t l = 1; l < k; ++l) mixed += binomial(k, l) * powers[i][l] * powers[j][k - l];
          f[k] += events * mixed;
        }
      }
    }
  }

  QuadratureInversion inversion_;
  Sphere sphere_;
  std::optional<CollisionKernel> kernel_;
};

}  // namespace

std::unique_ptr<MomentSystem> makeQmomSystem(const PopulationModel& model, const InitialPopulation& initial,
                                             const MomentOptions& options) {
  return std::make_unique<QmomSystem>(model, initial, options);
}

}  // namespace lampblack::particles
