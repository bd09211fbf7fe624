// The branch of solutions of a flame deck with a section `continuation`: followed from the converged flame, with its
// table in results.h5 and branch.csv.
#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "app/problems/flame/flame_case.hpp"
#include "app/problems/flame/flame_soot_output.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_fields.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

struct FlameBranchResult {
  FlameBranch branch;
  std::optional<double> strain;  // 1/s where the load is 1, if the flame has one
};

// Collective. Prints a line for each point. NumericsError where the start is no solution.
FlameBranchResult followBranch(MPI_Comm comm, FlameCase& flame, const FlameProfile& start, const FlameSummary& summary);

// Load, strain rate and temperature where the flame goes out, if the branch got there.
std::vector<NamedNumber> namedBranchNumbers(const FlameBranchResult& result);
// Collective: /continuation.
void writeBranch(ResultsWriter& results, const FlameBranchResult& result);
std::string branchTable(const FlameBranchResult& result);

}  // namespace lampblack::app
