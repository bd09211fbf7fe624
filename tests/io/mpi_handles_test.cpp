// Handles of MPI that files hold are given back. The functions of MPI that make and free them are counted on the way:
// MPI offers each a second time under a name that begins with P.
#include <gtest/gtest.h>
#include <mpi.h>

#include "tests/every_module.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/shared_scratch.hpp"

namespace {
int heldInfos = 0;
}

extern "C" {
int MPI_Info_create(MPI_Info* info) {
  ++heldInfos;
  return PMPI_Info_create(info);
}
int MPI_Info_dup(MPI_Info info, MPI_Info* copy) {
  ++heldInfos;
  return PMPI_Info_dup(info, copy);
}
int MPI_Info_free(MPI_Info* info) {
  --heldInfos;
  return PMPI_Info_free(info);
}
}

namespace lampblack::io {
namespace {

TEST(MpiHandles, OfHintsAreGivenBackWithTheFile) {
  const test::SharedScratchFolder folder;
  const int before = heldInfos;
  for (const int writers : {0, 1})
    test::writeSample(MPI_COMM_WORLD, folder.path() / "out.h5", test::SampleMesh{6, 7}, {0, writers});
  EXPECT_EQ(heldInfos, before);
}

}  // namespace
}  // namespace lampblack::io
