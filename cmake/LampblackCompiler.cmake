# Compiler settings shared by every target, as the interface library `lampblack_options`.
add_library(lampblack_options INTERFACE)
target_compile_features(lampblack_options INTERFACE cxx_std_20)
target_compile_options(lampblack_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wconversion -Wno-sign-conversion
  # Value-preserving: no code here reads errno of <cmath> or installs floating-point traps.
  -fno-math-errno -fno-trapping-math)
if(LAMPBLACK_NATIVE)
  target_compile_options(lampblack_options INTERFACE -march=native)
endif()
if(LAMPBLACK_WERROR)
  target_compile_options(lampblack_options INTERFACE -Werror)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15)
    # GCC 12 to 14 see overruns inside std::string and std::vector where there are none, depending on how long the checkout's path
    # is (GCC bugs 105329, 105651): they stay warnings there. The sanitizers look for the real ones.
    target_compile_options(lampblack_options INTERFACE -Wno-error=array-bounds -Wno-error=restrict
                                                       -Wno-error=stringop-overflow)
    if(CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
      # Likewise members of an empty std::optional that are used (GCC bug 80635); GCC 12 looks for the real ones.
      target_compile_options(lampblack_options INTERFACE -Wno-error=maybe-uninitialized)
    endif()
  endif()
endif()
if(LAMPBLACK_SANITIZE)
  # Two fifths of the time of compiling are for what others see: AddressSanitizer reports pointers that are zero, beyond their object
  # or of another class where memory is read or written by them, warnings report functions without a value; alignment does no
  # harm on the processors that this runs on.
  target_compile_options(lampblack_options INTERFACE -fsanitize=address,undefined
                                                     -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow
                                                     -fno-sanitize=nonnull-attribute,returns-nonnull-attribute,unreachable,return
                                                     -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(lampblack_options INTERFACE -fsanitize=address,undefined)
  if(LAMPBLACK_WERROR AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # What the sanitizers insert makes GCC see values without a beginning where there are none, as its manual says; the release
    # build looks for the real ones.
    target_compile_options(lampblack_options INTERFACE -Wno-error=maybe-uninitialized)
  endif()
endif()

# Some sixty programs, most of them tests, are linked: by gold, where it is there, in a third of the time of the usual linker. Not what
# is packaged, and not what is optimised where it is linked.
option(LAMPBLACK_GOLD "Link with gold where the compiler finds it" ON)
if(LAMPBLACK_GOLD AND NOT LAMPBLACK_DEBIAN_PACKAGE AND NOT CMAKE_INTERPROCEDURAL_OPTIMIZATION)
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold LAMPBLACK_HAS_GOLD)
  if(LAMPBLACK_HAS_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What ccache has to be told before it stores what is compiled with a precompiled header.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
  set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()
