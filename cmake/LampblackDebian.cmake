# Debian's packages, by CPack: `lampblack`, the program and what it runs with, and `lampblack-dev`, headers and libraries.
# scripts/package builds, makes and checks them.
execute_process(COMMAND git -C "${CMAKE_SOURCE_DIR}" config user.email OUTPUT_VARIABLE git_email OUTPUT_STRIP_TRAILING_WHITESPACE
                ERROR_QUIET)
set(LAMPBLACK_PACKAGER "Lampblack maintainers <${git_email}>" CACHE STRING "Name and address of who makes the packages")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lampblack)
set(CPACK_PACKAGE_CONTACT "${LAMPBLACK_PACKAGER}")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL lampblack lampblack-dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENT_LAMPBLACK_DESCRIPTION
"Soot in reacting flows, from one input deck
Reacting flows in two and three dimensions, one-dimensional flames and
reactors with detailed chemistry and transport, and the soot or other
particles that they make: moments, sections, or stochastic ensembles in
every cell, coupled both ways.")
set(CPACK_COMPONENT_LAMPBLACK-DEV_DESCRIPTION
"Soot in reacting flows: libraries and headers
Static libraries, headers and a CMake package for programs of one's own
with the chemistry, particles and flow of Lampblack.")

# Libraries are found by dpkg-shlibdeps; mpirun and python3 are run.
set(CPACK_DEBIAN_LAMPBLACK_PACKAGE_NAME lampblack)
set(CPACK_DEBIAN_LAMPBLACK_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LAMPBLACK_PACKAGE_DEPENDS "openmpi-bin")
set(CPACK_DEBIAN_LAMPBLACK_PACKAGE_RECOMMENDS "python3, python3-h5py, python3-matplotlib, python3-numpy, python3-scipy, python3-yaml")
set(CPACK_DEBIAN_LAMPBLACK_PACKAGE_SUGGESTS "bash-completion, lampblack-dev, python3-emcee, python3-pandas, python3-xarray")
set(CPACK_DEBIAN_LAMPBLACK_PACKAGE_CONTROL_EXTRA "${CMAKE_SOURCE_DIR}/packaging/debian/prerm")
set(CPACK_DEBIAN_LAMPBLACK-DEV_PACKAGE_NAME lampblack-dev)
set(CPACK_DEBIAN_LAMPBLACK-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LAMPBLACK-DEV_PACKAGE_DEPENDS
  "lampblack (= ${PROJECT_VERSION}-1), libfmt-dev, libhdf5-openmpi-dev, liblapack-dev, libmetis-dev, libmuparser-dev, libopenmpi-dev, librandom123-dev, libsundials-dev, libyaml-cpp-dev, petsc-dev, pkg-config")

# `import lampblack` without a search path.
set(link "${CMAKE_BINARY_DIR}/debian/lampblack")
file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/debian")
file(CREATE_LINK "../../../share/lampblack/python/lampblack" "${link}" SYMBOLIC)
install(FILES "${link}" DESTINATION lib/python3/dist-packages COMPONENT lampblack)

# What Debian's policy asks of every package.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(changelog "${CMAKE_BINARY_DIR}/debian/changelog.Debian")
file(WRITE "${changelog}" "lampblack (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n  * Made of the sources by CPack.\n\n -- ${LAMPBLACK_PACKAGER}  ${now}\n")
execute_process(COMMAND gzip -9nf "${changelog}" COMMAND_ERROR_IS_FATAL ANY)
foreach(package lampblack lampblack-dev)
  install(FILES "${changelog}.gz" "${CMAKE_SOURCE_DIR}/packaging/debian/copyright" DESTINATION "share/doc/${package}" COMPONENT ${package})
endforeach()
include(CPack)
