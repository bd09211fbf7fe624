"""Lampblack for Spack, of the checkout that this file lies in."""

import pathlib

from spack.package import *


class Lampblack(CMakePackage):
    """Soot in reacting flows: finite volumes, one-dimensional flames and reactors with detailed chemistry and particles."""

    git = pathlib.Path(__file__).resolve().parents[4].as_uri()

    version("main", branch="main")

    variant("native", default=True, description="Code for the processor of the machine that builds")
    variant("tests", default=False, description="Build the tests")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("mpi")
    depends_on("petsc@3.18: +mpi +double ~complex")
    depends_on("sundials@6.4: +cvodes +shared")
    depends_on("hdf5@1.10: +mpi ~cxx")
    depends_on("muparser@2.3:")
    depends_on("metis@5.1:")
    depends_on("yaml-cpp@0.7:")
    depends_on("fmt@9:")
    depends_on("cli11@2.1:")
    depends_on("random123")
    depends_on("lapack")
    depends_on("googletest@1.12: +gmock", when="+tests")
    depends_on("python@3.9:", type="run")
    depends_on("py-numpy", type="run")
    depends_on("py-h5py", type="run")
    depends_on("py-matplotlib", type="run")
    depends_on("py-scipy", type="run")
    depends_on("py-pyyaml", type="run")

    generator("ninja")
    conflicts("%gcc@:11", msg="C++20 as Lampblack uses it needs GCC 12 or newer")

    def cmake_args(self):
        return [
            self.define_from_variant("LAMPBLACK_NATIVE", "native"),
            self.define_from_variant("LAMPBLACK_TESTS", "tests"),
            self.define("HDF5_ROOT", self.spec["hdf5"].prefix),
            self.define("PETSC_DIR", self.spec["petsc"].prefix),
        ]

    def setup_run_environment(self, env):
        env.prepend_path("PYTHONPATH", join_path(self.prefix, "share", "lampblack", "python"))
