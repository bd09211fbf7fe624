#include "particles/population/exact_solutions/exact_solution.hpp"

#include "particles/population/exact_solutions/solutions.hpp"

namespace lampblack::particles {
namespace {

using Distribution = InitialPopulation::Distribution;

// Without the parts that do nothing.
PopulationModel withoutIdle(PopulationModel model) {
  if (model.coagulation && !(model.coagulation->rate * model.coagulation->efficiency > 0)) {
    const auto type = model.coagulation->type;
    if (type == CollisionKernelType::constant || type == CollisionKernelType::additive ||
        type == CollisionKernelType::multiplicative) {
      model.coagulation.reset();
    }
  }
  if (model.breakage && !(model.breakage->rate > 0)) model.breakage.reset();
  if (model.deposition && !(model.deposition->rate > 0)) model.deposition.reset();
  if (model.nucleation) {
    const auto& n = *model.nucleation;
    const bool idle = n.source == NucleationOptions::Source::constant    ? !(n.rate > 0)
                      : n.source == NucleationOptions::Source::precursor ? !(n.rateConstant * n.precursor > 0)
                                                                         : n.times.empty();
    if (idle) model.nucleation.reset();
  }
  return model;
}

// Whether the kernel is one of those with solutions of closed form; `degree` is that of its growth with volume.
bool simpleKernel(const CollisionKernelOptions& kernel, double& degree) {
  degree = kernel.type == CollisionKernelType::constant ? 0 : kernel.type == CollisionKernelType::additive ? 1 : 2;
  return kernel.efficiencyDiameter == 0 &&
         (kernel.type == CollisionKernelType::constant || kernel.type == CollisionKernelType::additive ||
          kernel.type == CollisionKernelType::multiplicative);
}

}  // namespace

std::unique_ptr<ExactSolution> exactSolution(const PopulationModel& given, const InitialPopulation& start) {
  const PopulationModel model = withoutIdle(given);
  InitialPopulation initial = start;
  if (!(initial.number > 0)) initial.distribution = Distribution::none;
  if (initial.distribution == Distribution::none) initial.number = 0;

  if (!model.coagulation && !model.breakage) {
    if (auto solution = exact::transported(model, initial)) return solution;
  }
  double degree = 0;
  if (model.coagulation && !simpleKernel(*model.coagulation, degree)) return nullptr;
  const auto& growth = model.growth;
  const bool jumps = growth.active() && growth.treatment == GrowthOptions::Treatment::jumps;
  if (growth.surfaceGrowth != 0 || growth.oxidation != 0) return nullptr;
  if (growth.condensation < 0 && (jumps || growth.smallestVolume > 0)) return nullptr;  // particles vanish
  if (model.deposition && model.deposition->exponent != 0) return nullptr;
  // Dust in finite time: the mass of the particles is not conserved.
  if (model.breakage && model.breakage->exponent < 0) return nullptr;

  const bool one =
      !model.nucleation && !jumps && initial.number > 0 && model.coagulation.has_value() != model.breakage.has_value();
  if (one) {
    const double loss = model.dilution + (model.deposition ? model.deposition->rate : 0.0);
    auto alone = model.coagulation
                     ? exact::coagulation(model.coagulation->type,
                                          model.coagulation->rate * model.coagulation->efficiency, initial)
                     : exact::breakage(*model.breakage, initial);
    if (alone) {
      return exact::scaledInTime(std::move(alone), model.coagulation ? degree : model.breakage->exponent,
                                 model.coagulation.has_value(), loss, growth.condensation);
    }
  }
  if (auto solution = exact::exponentialForever(model, initial)) return solution;
  return exact::closedMoments(model, initial);
}

}  // namespace lampblack::particles
