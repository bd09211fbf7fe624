// Runs a convergence study and says how fast the errors fall (Shekar, Smith, Kraft, Wagner 2011, eqs. 73-81).
//
// A quantity F is estimated by the mean over L repeats of its value in a sample of N particles. At the rows t_j of the
// history after time zero, relative to the reference zeta:
//   error        e_r = 1/M sum_j |mean(t_j) - zeta(t_j)| / zeta(t_j)                       (eqs. 78-81)
//   confidence   c   = 1/M sum_j 3.29 s(t_j) / sqrt(L) / zeta(t_j), s^2 the variance of the repeats (eq. 76; 99.9 %)
//   scatter      1/M sum_j s(t_j) / zeta(t_j), of a single repeat
// An error below c is one that L repeats cannot tell from none.
#pragma once

#include <mpi.h>

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/shell/study/convergence_options.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

struct ConvergencePoint {
  std::string method;
  std::int64_t particles = 0, repeats = 0;
  std::array<double, 4> error{}, confidence{}, scatter{};  // of M_0 to M_3, relative; NaN where there is no reference
};

// The three numbers above from the history of a moment: means, their standard errors and the reference, without the row
// at time zero. `repeats` is L.
struct MeanErrors {
  double error = 0, confidence = 0, scatter = 0;
};
MeanErrors meanErrors(std::span<const double> mean, std::span<const double> standardError,
                      std::span<const double> reference, std::int64_t repeats);

// Collective. Whether the study can be carried out: its deck, the names of methods, a reference. InputError at the keys
// of `study`.
void checkConvergence(MPI_Comm comm, const Deck& study, const ConvergenceOptions& options);

// Collective. Writes convergence.csv, convergence_slopes.csv and convergence_history.csv into the folder and prints the
// table with the slopes. InputError, NumericsError.
void runConvergence(MPI_Comm comm, const ConvergenceOptions& options, const std::filesystem::path& folder);

}  // namespace lampblack::app
