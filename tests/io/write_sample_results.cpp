// Writes the sample results to the folder given, for the tests that read them with other programs.
#include "tests/io/sample_mesh.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc == 2) {
    std::filesystem::create_directories(argv[1]);
    lampblack::test::writeSample(MPI_COMM_WORLD, std::filesystem::path(argv[1]) / "results.h5", {});
  }
  MPI_Finalize();
  return argc == 2 ? 0 : 2;
}
