"""What configuring says of libraries that are missing, too old or of another kind, and that it takes those of other places
(cmake/LampblackDependencies.cmake).

Usage: dependencies_test.py CMAKE
"""

import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import running

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(needs LANGUAGES C CXX)
include("{file}")
get_target_property(petsc External::PETSc INTERFACE_LINK_LIBRARIES)
get_target_property(hdf5 External::HDF5 INTERFACE_LINK_LIBRARIES)
message("PETSC ${{PETSC_VERSION}} ${{PETSC_PREFIX}} HDF5 ${{HDF5_VERSION}} ${{hdf5}}")
"""


def petsc_of(folder, version, complex_numbers):
    """A folder that looks like PETSC_DIR/PETSC_ARCH."""
    (folder / "lib/pkgconfig").mkdir(parents=True)
    (folder / "include").mkdir()
    (folder / "lib/libpetsc.so").touch()
    (folder / "include/petscconf.h").write_text("#define PETSC_USE_COMPLEX 1\n" if complex_numbers else "#define PETSC_USE_SHARED 1\n")
    (folder / "lib/pkgconfig/PETSc.pc").write_text(f"prefix={folder}\nName: PETSc\nDescription: of the test\nVersion: {version}\n"
                                                  f"Cflags: -I{folder}/include\nLibs: -L{folder}/lib -lpetsc\n")


def main(cmake):
    pkg_config = shutil.which("pkg-config")
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        (work / "source").mkdir()
        (work / "source/CMakeLists.txt").write_text(PROJECT.format(file=running.SOURCE / "cmake/LampblackDependencies.cmake"))
        (work / "nothing").mkdir()
        petsc_of(work / "petsc/own-arch", "3.22.1", False)
        petsc_of(work / "old", "3.12.4", False)
        petsc_of(work / "complex", "3.20.0", True)
        # pkg-config without the files of HDF5, which CMake then looks for itself.
        (work / "some").mkdir()
        for file in map(pathlib.Path, subprocess.run([pkg_config, "--variable", "pc_path", "pkg-config"], capture_output=True, text=True,
                                                     check=True).stdout.strip().split(":")):
            for pc in file.glob("*.pc"):
                if not pc.name.startswith("hdf5") and not (work / "some" / pc.name).exists():
                    (work / "some" / pc.name).symlink_to(pc)

        def configure(task):
            what, code, texts, env, options = task
            env = dict({k: v for k, v in os.environ.items() if not k.startswith(("PETSC_", "PKG_CONFIG"))}, **env)
            done = subprocess.run([cmake, "-S", str(work / "source"), "-B", str(work / what), "-G", "Ninja", *options], env=env,
                                  capture_output=True, text=True, check=False)
            said = " ".join((done.stdout + done.stderr).split())
            good = (done.returncode != 0) == (code != 0) and all(text in said for text in texts)
            print(f"{'ok' if good else 'FAILED'}  {what}" + ("" if good else f": {said}"))
            return good

        tasks = [
            ("as installed", 0, ["PETSC 3.", "HDF5 1.", "PkgConfig::HDF5"], {}, []),
            ("PETSC_DIR and PETSC_ARCH", 0, [f"PETSC 3.22.1 {work}/petsc/own-arch"],
             {"PETSC_DIR": str(work / "petsc"), "PETSC_ARCH": "own-arch"}, []),
            ("PETSC_DIR as an option", 0, [f"PETSC 3.22.1 {work}/petsc/own-arch"], {}, [f"-DPETSC_DIR={work}/petsc/own-arch"]),
            ("old PETSc", 1, ["PETSc 3.18 or newer: found 3.12.4", "PETSC_DIR (and PETSC_ARCH)"], {"PETSC_DIR": str(work / "old")}, []),
            ("complex PETSc", 1, ["PETSc with real numbers of double precision", "PETSC_USE_COMPLEX"],
             {"PETSC_DIR": str(work / "complex")}, []),
            ("HDF5 by CMake", 0, ["hdf5::hdf5"], {"PKG_CONFIG_LIBDIR": str(work / "some")}, []),
            ("nothing", 1, [f"{one} or newer: not found" for one in ("PETSc 3.18", "muParser 2.3", "SUNDIALS 6.4", "yaml-cpp 0.7", "fmt 9")]
             + ["Random123/philox.h not found", "LAPACK: not found", "scripts/setup"],
             {"PKG_CONFIG_LIBDIR": str(work / "nothing")},
             ["-DCMAKE_FIND_ROOT_PATH=" + str(work / "nothing"), "-DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY",
              "-DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY", "-DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY"]),
        ]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            return 0 if all(list(pool.map(configure, tasks))) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
