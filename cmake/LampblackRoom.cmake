# lampblack_room(<room> SOURCES <files> [PUBLIC <libraries>] [PRIVATE <libraries>] [PRECOMPILED <headers>])
#
# A room is a static library `lampblack_<room>` whose headers are included as "<room>/<header>.hpp". Rooms see each
# other only through what they link, so that an arrow against docs/architecture.md fails to link.
#
# Sources are compiled eight at a time, as most of the time goes into what they all include. What a source has in a namespace
# without a name is then seen by the seven others: names are one in a room (LAMPBLACK_UNITY=OFF, preset debug: each for itself).
function(lampblack_room room)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE;PRECOMPILED" ${ARGN})
  add_library(lampblack_${room} STATIC ${ARG_SOURCES})
  target_include_directories(lampblack_${room} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>
                                                      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lampblack>)
  target_compile_features(lampblack_${room} PUBLIC cxx_std_20)
  target_link_libraries(lampblack_${room} PUBLIC ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:lampblack_options> ${ARG_PRIVATE})
  if(LAMPBLACK_UNITY)
    set_target_properties(lampblack_${room} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    # GCC takes the sources for headers, whose classes would have members of types without a name outside.
    target_compile_options(lampblack_${room} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  lampblack_precompile(lampblack_${room} HEADERS ${ARG_PRECOMPILED})
  if(NOT room STREQUAL "app")  # the program's own
    lampblack_install_room(${room})
  endif()
endfunction()
