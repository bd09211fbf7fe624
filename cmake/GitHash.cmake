# Run at every build (cmake -P): writes the commit's hash to OUTPUT, touching the file only when the hash has changed.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE hash ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  set(hash unknown)
endif()
set(content "#define LAMPBLACK_GIT_HASH \"${hash}\"\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} present)
endif()
if(NOT "${present}" STREQUAL "${content}")
  file(WRITE ${OUTPUT} "${content}")
endif()
