#include "app/run/build_info.hpp"

#include <H5public.h>
#include <fmt/format.h>
#include <mpi.h>
#include <petscversion.h>
#include <sundials/sundials_config.h>

#include "app/git_hash.hpp"

namespace lampblack::app {

std::string buildVersion() {
  return LAMPBLACK_VERSION;
}

std::string buildGitHash() {
  return LAMPBLACK_GIT_HASH;
}

std::map<std::string, std::string> libraryVersions() {
  char mpi[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(mpi, &length);
  const std::string full(mpi, static_cast<std::size_t>(length));
  return {{"MPI", full.substr(0, full.find(','))},
          {"PETSc", fmt::format("{}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR)},
          {"HDF5", fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
          {"SUNDIALS", SUNDIALS_VERSION}};
}

}  // namespace lampblack::app
