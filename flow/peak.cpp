#include "flow/peak.hpp"

namespace lampblack::flow {

Peak peakOf(const Mesh& mesh, const std::function<double(int)>& value) {
  struct {
    double value;
    int rank;
  } best{-1.0, mesh.rank};
  Peak peak;
  for (int c = 0; c < mesh.owned; ++c) {
    const double v = value(c);
    if (v <= best.value) continue;
    best.value = v;
    peak.place = mesh.centre[c];
  }
  MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MAXLOC, mesh.comm);
  MPI_Bcast(peak.place.data(), 3, MPI_DOUBLE, best.rank, mesh.comm);
  peak.value = best.value;
  return peak;
}

}  // namespace lampblack::flow
