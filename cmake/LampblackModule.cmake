# lampblack_module(<module> SOURCES <files> [PUBLIC <libraries>] [PRIVATE <libraries>] [PRECOMPILED <headers> | PRECOMPILED_AS <module>]
#                  [NO_KERNELS])
#
# A module is a static library `lampblack_<module>` whose headers are included as "<module>/<header>.hpp". Modules see each
# other only through what they link, so that an arrow against docs/architecture.md fails to link.
#
# NO_KERNELS: no source has a loop that takes time, so that little optimisation is enough and compiles in half the time.
#
# Sources are compiled eight at a time, as most of the time goes into what they all include. What a source has in a namespace
# without a name is then seen by the seven others: names are one in a module (LAMPBLACK_UNITY=OFF, preset debug: each for itself).
function(lampblack_module module)
  cmake_parse_arguments(ARG "NO_KERNELS" "PRECOMPILED_AS" "SOURCES;PUBLIC;PRIVATE;PRECOMPILED" ${ARGN})
  add_library(lampblack_${module} STATIC ${ARG_SOURCES})
  target_include_directories(lampblack_${module} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>
                                                      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lampblack>)
  target_compile_features(lampblack_${module} PUBLIC cxx_std_20)
  target_link_libraries(lampblack_${module} PUBLIC ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:lampblack_options> ${ARG_PRIVATE})
  if(ARG_NO_KERNELS)
    target_compile_options(lampblack_${module} PRIVATE $<$<CONFIG:Release>:-O1> $<$<CONFIG:RelWithDebInfo>:-O0>)
  endif()
  if(LAMPBLACK_UNITY)
    set_target_properties(lampblack_${module} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    # GCC takes the sources for headers, whose classes would have members of types without a name outside.
    target_compile_options(lampblack_${module} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  if(ARG_PRECOMPILED_AS)  # of the same options, and headers that are enough
    lampblack_precompile(lampblack_${module} lampblack_${ARG_PRECOMPILED_AS})
  else()
    lampblack_precompile(lampblack_${module} HEADERS ${ARG_PRECOMPILED})
  endif()
  if(NOT module STREQUAL "app")  # the program's own
    lampblack_install_module(${module})
  endif()
endfunction()
