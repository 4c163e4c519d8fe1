# Tests PREFIX.symbols_stay_within_LEVEL_REAL: the objects of lather_add_kernels(NAME …) define no symbol that another
# level could be given. An unsanitised build only: sanitizers add symbols of their own to every object.
function(lather_test_kernel_symbols prefix name)
  if(LATHER_SANITIZE)
    return()
  endif()
  foreach(level v2 v3 v4)
    foreach(real float double)
      set(test ${prefix}.symbols_stay_within_${level}_${real})
      add_test(NAME ${test}
        COMMAND ${PROJECT_SOURCE_DIR}/tests/unit/sim/mpm/kernel_symbols $<TARGET_OBJECTS:${name}_${real}_${level}> ${level})
      set_tests_properties(${test} PROPERTIES LABELS unit)
    endforeach()
  endforeach()
endfunction()

# Kernels, once per instruction set and precision, as object libraries NAME_float_v2 … NAME_double_v4 that go into
# lather_sim. SOURCE hands its table out by a function FLOAT_OR_DOUBLE_TABLE_LEVEL(), e.g. float_kernels_v2().
#
# Eigen is renamed per level and symbols are hidden, so that the linker can merge no template of one level with another's.
# Without EIGEN_FAST_MATH=0 its square roots would start from the processor's approximate instructions, whose bits are
# each maker's own: a job that goes on on another machine would no longer be bit-equal.
function(lather_add_kernels name source table)
  set(level_flags_v2 -march=x86-64-v2)
  set(level_flags_v3 -march=x86-64-v3)
  set(level_flags_v4 -march=x86-64-v4 -mprefer-vector-width=512)
  set(optimize -O3)
  set(levels v2 v3 v4)
  if(LATHER_SANITIZE)
    set(optimize -O2) # where every access is instrumented g++ takes five times as long for -O3
    set(levels v2)    # the same code at each level; see sim/kernel_table.h
  endif()
  foreach(level ${levels})
    foreach(real float double)
      set(target ${name}_${real}_${level})
      add_library(${target} OBJECT ${source})
      target_compile_definitions(${target} PRIVATE
        LATHER_LEVEL=${level} LATHER_REAL=${real} LATHER_TABLE=${real}_${table}_${level} Eigen=Eigen_${level}
        EIGEN_FAST_MATH=0)
      target_compile_options(${target} PRIVATE ${level_flags_${level}}
        $<$<NOT:$<CONFIG:Debug>>:${optimize}> -fvisibility=hidden
        -fno-math-errno -fno-trapping-math
        # g++ 12: its own avx512 headers start "undefined" vectors from themselves
        $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized -Wno-maybe-uninitialized>)
      target_include_directories(${target} SYSTEM PRIVATE
        $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)
      target_link_libraries(${target} PRIVATE lather_options)
      target_sources(lather_sim PRIVATE $<TARGET_OBJECTS:${target}>)
    endforeach()
  endforeach()
endfunction()
