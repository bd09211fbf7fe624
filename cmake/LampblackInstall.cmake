# Where things go (`cmake --install`), and the same layout in the folder of the build: the program finds what ships with it by
# a path from its own place, so that both may be moved as a whole.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(lampblack_share "${CMAKE_INSTALL_DATADIR}/lampblack")
set(lampblack_package "${CMAKE_INSTALL_LIBDIR}/cmake/Lampblack")
file(RELATIVE_PATH lampblack_share_from_program "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_DATADIR}/lampblack")

# Libraries outside the system's folders (modules of a cluster, Spack) are found where they were when it was built.
option(LAMPBLACK_KEEP_LIBRARY_PATHS "Installed programs look for libraries where the build found them" ON)
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ${LAMPBLACK_KEEP_LIBRARY_PATHS})

# The build's own share/lampblack: links to the sources.
function(lampblack_share_of_build)
  get_filename_component(share "${CMAKE_CURRENT_BINARY_DIR}/${lampblack_share_from_program}" ABSOLUTE)
  file(MAKE_DIRECTORY "${share}")
  foreach(part cases python)
    file(CREATE_LINK "${CMAKE_SOURCE_DIR}/${part}" "${share}/${part}" SYMBOLIC)
  endforeach()
endfunction()

# The program and what it runs with.
function(lampblack_install_program program)
  set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME lampblack)
  install(TARGETS ${program} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/cases" "${CMAKE_SOURCE_DIR}/python" DESTINATION "${lampblack_share}"
          PATTERN "__pycache__" EXCLUDE)
  install(FILES "${CMAKE_SOURCE_DIR}/packaging/completion.bash" RENAME lampblack
          DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  set(page "${CMAKE_SOURCE_DIR}/packaging/lampblack.1")
  if(LAMPBLACK_DEBIAN_PACKAGE)
    configure_file("${page}" "${CMAKE_BINARY_DIR}/debian/lampblack.1" COPYONLY)
    execute_process(COMMAND gzip -9nf "${CMAKE_BINARY_DIR}/debian/lampblack.1" COMMAND_ERROR_IS_FATAL ANY)
    set(page "${CMAKE_BINARY_DIR}/debian/lampblack.1.gz")
  endif()
  install(FILES "${page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  install(FILES "${CMAKE_SOURCE_DIR}/README.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/docs/" DESTINATION "${CMAKE_INSTALL_DOCDIR}/docs")
endfunction()

# A module: its library as Lampblack::<module>, its headers as "<module>/<header>.hpp".
function(lampblack_install_module module)
  set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME lampblack-dev)
  set_target_properties(lampblack_${module} PROPERTIES EXPORT_NAME ${module})
  add_library(Lampblack::${module} ALIAS lampblack_${module})
  install(TARGETS lampblack_${module} EXPORT LampblackTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/${module}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lampblack"
          FILES_MATCHING PATTERN "*.hpp")
endfunction()

# find_package(Lampblack): the modules, and the libraries they need, found as this build found them.
function(lampblack_install_package)
  set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME lampblack-dev)
  configure_package_config_file("${CMAKE_SOURCE_DIR}/cmake/LampblackConfig.cmake.in" "${CMAKE_BINARY_DIR}/LampblackConfig.cmake"
                                INSTALL_DESTINATION "${lampblack_package}" PATH_VARS lampblack_share)
  write_basic_package_version_file("${CMAKE_BINARY_DIR}/LampblackConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
  install(FILES "${CMAKE_BINARY_DIR}/LampblackConfig.cmake" "${CMAKE_BINARY_DIR}/LampblackConfigVersion.cmake"
                "${CMAKE_SOURCE_DIR}/cmake/LampblackDependencies.cmake" DESTINATION "${lampblack_package}")
  install(EXPORT LampblackTargets NAMESPACE Lampblack:: DESTINATION "${lampblack_package}")
endfunction()
