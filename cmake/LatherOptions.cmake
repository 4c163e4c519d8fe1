# One place for the flags of all targets. Link lather_options privately to every target of the project.
# Everything but the kernels is built with -O2, which compiles faster; they ask for -O3 themselves.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
add_library(lather_options INTERFACE)
target_include_directories(lather_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(lather_options INTERFACE LATHER_VERSION="${PROJECT_VERSION}")
target_compile_options(lather_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-psabi)
# g++ 12 reports these falsely inside its own and Eigen's headers (std::string concatenation, fixed-size matrices).
target_compile_options(lather_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-maybe-uninitialized>)
if(LATHER_WERROR)
  target_compile_options(lather_options INTERFACE -Werror)
endif()
if(LATHER_SANITIZE)
  add_compile_options(-fsanitize=${LATHER_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${LATHER_SANITIZE})
  add_compile_definitions(LATHER_LEAST_KERNEL_LEVEL_ALONE)
endif()
# OpenVDB's loops are synchronised inside TBB's library, which is not instrumented: the thread sanitizer would report
# them falsely. And its PointPartitioner.h takes &vector[0] of an empty vector, which is harmless but a null reference;
# TBB's concurrent_hash_map.h makes a pointer to a node from that to a marker which is aligned to less.
# Call it with the target and its sources that include OpenVDB.
function(lather_uses_openvdb target)
  if(LATHER_SANITIZE MATCHES thread)
    set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS -fno-sanitize=thread)
  elseif(LATHER_SANITIZE MATCHES undefined)
    set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS -fno-sanitize=null,alignment)
  endif()
endfunction()
# Baseline of everything but the kernels, which are compiled once per level (sim/mpm).
add_compile_options(-march=x86-64-v2)

# A rebuild from nothing takes seconds where ccache is installed. It is used, never required.
find_program(LATHER_CCACHE ccache)
if(LATHER_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${LATHER_CCACHE})
endif()
