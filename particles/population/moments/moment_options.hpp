// Moment methods: the population by its first moments M_0 ... M_(n-1) of the volume, closed by quadrature (QMOM; McGraw
// 1997) or by interpolation of the logarithms of the moments (MOMIC; Frenklach and Harris 1987; Frenklach 2002).
//
// Both are exact where the equations of the moments close by themselves: nucleation, constant, additive and
// multiplicative kernels, breakage and deposition at constant rates, condensation in proportion to the volume,
// dilution. Elsewhere the closure is an approximation without a knob that makes it exact;
// docs/theory/population_balance/ moments.md says how good it is. The treatment of growth (GrowthOptions::treatment)
// means nothing here.
//
// What shrinks below the smallest volume: QMOM removes a node when it gets there (counted as vanished), a stepwise
// picture of a continuous loss. MOMIC does not take such particles out at all, and ends with a NumericsError when the
// mean volume reaches the smallest one.
#pragma once

#include <cstddef>
#include <memory>

#include "core/modules.hpp"
#include "particles/population/population_solver.hpp"

namespace lampblack::particles {

enum class MomentMethod { qmom, momic };
enum class QuadratureInversion { wheeler, productDifference };

struct MomentOptions {
  MomentMethod method = MomentMethod::qmom;
  std::size_t moments = 6;  // 4, 6 or 8 for QMOM, twice the number of nodes; 4 to 8 for MOMIC
  QuadratureInversion inversion = QuadratureInversion::wheeler;
  double relativeTolerance = 1e-8;
};

// Coalescing spheres. QMOM does every process of the model. MOMIC does all kernels but the Fuchs transition and the
// gravitational one, without efficiencies that depend on the diameter, breakage at a constant rate and deposition with
// an exponent in [-2/3, 1/3]. Throws InputError for anything else and for a wrong number of moments.
//
// The solver's counters: splitSteps are steps of the integrator, `limited` those of them at which QMOM used fewer nodes
// than asked for since the moments were those of a simpler population (all equal, say) or not those of any; the moments
// beyond are then put back to those of these nodes when they have drifted off.
// geometricDeviation() is that of the nodes (QMOM) or of the log-normal distribution with the same M_0 to M_2 (MOMIC).
// advance() throws NumericsError with time and moments where they have stopped to be those of any population,
// GelationError where the population gels.
[[nodiscard]] std::unique_ptr<PopulationSolver> makeMoments(const PopulationModel& model,
                                                            const InitialPopulation& initial,
                                                            const MomentOptions& options);

}  // namespace lampblack::particles
