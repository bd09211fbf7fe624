#!/usr/bin/env bash
# Builds Lampblack on a cluster with the libraries of its modules, below a prefix.
#
# Usage: packaging/cluster/build_with_modules.sh PREFIX
# Change the names of the modules to those of the machine (module avail). What no module has - CLI11, fmt, yaml-cpp, muParser, Random123
# are small - goes below one prefix of your own, named in CMAKE_PREFIX_PATH. Configuring says what is missing, all at once.
set -euo pipefail
prefix="${1:?usage: build_with_modules.sh PREFIX}"
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"

if command -v module >/dev/null; then
  module purge
  # GCC 12 or newer; MPI, HDF5 and PETSc of the same MPI.
  module load gcc/13 openmpi/4.1 hdf5/1.14-mpi petsc/3.20 sundials/6.7 cmake/3.27 ninja
fi

# Nodes may have other processors than the one that builds: LAMPBLACK_NATIVE=OFF unless they are all the same. Kernels that count have
# code for AVX2 and AVX-512 in any case.
cmake -S "$root" -B "$root/build/cluster" -G Ninja -DCMAKE_BUILD_TYPE=Release -DLAMPBLACK_NATIVE=OFF -DLAMPBLACK_TESTS=OFF \
  ${PETSC_DIR:+-DPETSC_DIR="$PETSC_DIR"} ${HDF5_ROOT:+-DHDF5_ROOT="$HDF5_ROOT"}
cmake --build "$root/build/cluster" --parallel "${LAMPBLACK_JOBS:-8}"
cmake --install "$root/build/cluster" --prefix "$prefix"
"$prefix/bin/lampblack" --version
