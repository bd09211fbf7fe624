# lampblack_room(<room> SOURCES <files> [PUBLIC <libraries>] [PRIVATE <libraries>])
#
# A room is a static library `lampblack_<room>` whose headers are included as "<room>/<header>.hpp". Rooms see each
# other only through what they link, so that an arrow against docs/architecture.md fails to link.
function(lampblack_room room)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(lampblack_${room} STATIC ${ARG_SOURCES})
  target_include_directories(lampblack_${room} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(lampblack_${room} PUBLIC ${ARG_PUBLIC} PRIVATE lampblack_options ${ARG_PRIVATE})
endfunction()
