# lampblack_precompile(<target> [<target of the same kind>] [HEADERS <headers>])
#
# Parsing the standard library and the heavy libraries takes half of the time of building: their headers are parsed once a
# target, or once for all targets of the same options where another target is named. Sources include what they need even so,
# as builds without this (LAMPBLACK_PRECOMPILE=OFF, preset debug) have to work.
set(lampblack_common_headers
  <algorithm> <array> <chrono> <cmath> <cstddef> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numeric>
  <optional> <set> <span> <string> <string_view> <tuple> <unordered_map> <utility> <variant> <vector>
  <fmt/format.h> <mpi.h>)

function(lampblack_precompile target)
  cmake_parse_arguments(ARG "" "" "HEADERS" ${ARGN})
  if(NOT LAMPBLACK_PRECOMPILE)
    return()
  endif()
  if(ARG_UNPARSED_ARGUMENTS)
    target_precompile_headers(${target} REUSE_FROM ${ARG_UNPARSED_ARGUMENTS})
  else()
    target_precompile_headers(${target} PRIVATE ${lampblack_common_headers} ${ARG_HEADERS})
  endif()
  # ccache asks for it.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()
