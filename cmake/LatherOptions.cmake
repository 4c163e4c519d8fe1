# One place for the flags of all targets. Link lather_options privately to every target of the project.
add_library(lather_options INTERFACE)
target_include_directories(lather_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(lather_options INTERFACE LATHER_VERSION="${PROJECT_VERSION}")
target_compile_options(lather_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-psabi)
if(LATHER_WERROR)
  target_compile_options(lather_options INTERFACE -Werror)
endif()
if(LATHER_SANITIZE)
  add_compile_options(-fsanitize=${LATHER_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${LATHER_SANITIZE})
endif()
# Baseline of everything but the kernels, which are compiled once per level (sim/mpm).
add_compile_options(-march=x86-64-v2)
