#include "flow/equations/matrix_rows.hpp"

#include <mpi.h>

#include <cstddef>

#include "core/petsc.hpp"

namespace lampblack::flow {

std::vector<PetscInt> matrixRows(const FlowContext& context) {
  const Mesh& m = context.mesh;
  PetscInt first = 0;
  const PetscInt owned = m.owned;
  MPI_Exscan(&owned, &first, 1, MPIU_INT, MPI_SUM, m.comm);
  std::vector<double> row(static_cast<std::size_t>(m.cells));
  for (int c = 0; c < m.owned; ++c) row[static_cast<std::size_t>(c)] = static_cast<double>(first + c);
  context.halo.update(row, 1);
  std::vector<PetscInt> rows;
  rows.reserve(row.size());
  for (const double r : row) rows.push_back(static_cast<PetscInt>(r));
  return rows;
}

}  // namespace lampblack::flow
