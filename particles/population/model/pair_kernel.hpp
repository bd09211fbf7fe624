// Collision kernels for methods that ask for the rates of many pairs: what a particle has to do with the kernel is kept
// beside it in single precision, so that a pair costs neither roots of its particles nor exponentials. The values are
// those of CollisionKernel to the precision of a float.
#pragma once

#include <cmath>
#include <cstddef>

#include "core/modules.hpp"
#include "numerics/vector_math.hpp"
#include "particles/population/model/collision_kernel.hpp"

namespace lampblack::particles {

class PairKernel {
 public:
  // Of a particle; what each is depends on the kernel.
  struct Terms {
    float size = 0, mobility = 0, inverseMass = 0;
  };

  // Throws InputError as CollisionKernel does.
  explicit PairKernel(const CollisionKernelOptions& options);

  [[nodiscard]] const CollisionKernel& kernel() const { return kernel_; }
  [[nodiscard]] Terms terms(const CollisionKernel::Properties& particle) const;
  // The same of n particles after one another: volumes (m3), masses (kg) and diameters (m), of which those count that
  // the kernel asks for.
  void terms(const double* volume, const double* mass, const double* diameter, std::size_t n, Terms* all) const;
  // Whether visit() has a form of this kernel: not of Fuchs interpolation, gravitational settling, and an efficiency
  // that depends on size. Such pairs are asked of kernel().
  [[nodiscard]] bool hasForm() const { return hasForm_; }
  // Calls f(rate), rate(Terms, Terms) being K (m3/s) of a pair: the choice of the kernel is made once for many pairs.
  template <class F>
  void visit(F&& f) const;

 private:
  [[nodiscard]] float mobility(double diameter) const {  // continuum prefactor times C/d
    const double inverse = 1 / diameter, knudsen = slipLength_ * inverse;
    const double slip =
        1 + knudsen * (DaviesSlip::fast + slow_ * numerics::vectormath::expOne(-fallPerDiameter_ * diameter));
    return static_cast<float>(continuum_ * inverse * slip);
  }
  [[nodiscard]] float inverseMass(double mass) const {
    return static_cast<float>(freeMolecular_ * freeMolecular_ / mass);
  }

  CollisionKernel kernel_;
  bool hasForm_;
  double root_ = 0, freeMolecular_ = 0, continuum_ = 0;
  double slipLength_ = 0;  // m
  // Of Davies' slip correction, zero without; 1/m.
  double slow_ = 0, fallPerDiameter_ = 0;
};

inline PairKernel::Terms PairKernel::terms(const CollisionKernel::Properties& x) const {
  const double d = x.diameter;
  switch (kernel_.options().type) {
    case CollisionKernelType::additive:
    case CollisionKernelType::multiplicative:
      return {static_cast<float>(root_ * x.volume)};
    case CollisionKernelType::shear:
      return {static_cast<float>(root_ * d)};
    case CollisionKernelType::freeMolecular:
      return {static_cast<float>(d), 0, inverseMass(x.mass)};
    case CollisionKernelType::continuum:
      return {static_cast<float>(d), mobility(d)};
    case CollisionKernelType::transition:
      return {static_cast<float>(d), mobility(d), inverseMass(x.mass)};
    default:
      return {};
  }
}

template <class F>
void PairKernel::visit(F&& f) const {
  switch (kernel_.options().type) {
    case CollisionKernelType::additive:
      return f([](const Terms& i, const Terms& j) { return i.size + j.size; });
    case CollisionKernelType::multiplicative:
      return f([](const Terms& i, const Terms& j) { return i.size * j.size; });
    case CollisionKernelType::shear:
      return f([](const Terms& i, const Terms& j) {
        const float sum = i.size + j.size;
        return sum * sum * sum;
      });
    case CollisionKernelType::freeMolecular:
      return f([](const Terms& i, const Terms& j) {
        const float sum = i.size + j.size;
        return std::sqrt(i.inverseMass + j.inverseMass) * sum * sum;
      });
    case CollisionKernelType::continuum:
      return f([](const Terms& i, const Terms& j) { return (i.mobility + j.mobility) * (i.size + j.size); });
    case CollisionKernelType::transition:
      return f([](const Terms& i, const Terms& j) {
        const float sum = i.size + j.size, continuum = (i.mobility + j.mobility) * sum;
        const float freeMolecular = std::sqrt(i.inverseMass + j.inverseMass) * sum * sum;
        return continuum * (freeMolecular / (freeMolecular + continuum));
      });
    default:
      return f([rate = static_cast<float>(root_)](const Terms&, const Terms&) { return rate; });
  }
}

}  // namespace lampblack::particles
