// Entry point of the MPI tests: PETSc (and with it MPI) lives for the whole run, only rank 0 prints, and the result is
// the worst of all ranks, so that a failure on any rank fails the test.
#include <gtest/gtest.h>
#include <petscsys.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0)
    delete testing::UnitTest::GetInstance()->listeners().Release(
        testing::UnitTest::GetInstance()->listeners().default_result_printer());
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  if (PetscFinalize() != 0) return 1;
  return failed;
}
