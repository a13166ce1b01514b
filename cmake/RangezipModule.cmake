# rangezip_add_module(<name> SOURCES <...> HEADERS <...> [PUBLIC <libs>] [PRIVATE <libs>])
# One library rangezip::<name>: its sources beside its headers, included from the repository root
# (#include "core/base/grid.h"). Headers install to include/rangezip/<name>/...; the library is
# the component <name> of the package (find_package(rangezip COMPONENTS <name>)).
function(rangezip_add_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE")
  add_library(rangezip_${name})
  add_library(rangezip::${name} ALIAS rangezip_${name})
  set_target_properties(rangezip_${name} PROPERTIES EXPORT_NAME ${name})
  target_sources(rangezip_${name}
    PRIVATE ${arg_SOURCES}
    PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_HEADERS})
  target_compile_features(rangezip_${name} PUBLIC cxx_std_20)
  rangezip_compile_options(rangezip_${name})
  target_link_libraries(rangezip_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  install(TARGETS rangezip_${name} EXPORT rangezip_${name}_targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rangezip)
  install(EXPORT rangezip_${name}_targets NAMESPACE rangezip::
    FILE rangezip_${name}_targets.cmake DESTINATION ${RANGEZIP_PACKAGE_DIR})
endfunction()

# The warnings and floating-point flags of every target here.
function(rangezip_compile_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    -Wno-missing-field-initializers   # designated initializers leave members to their defaults
    # GCC 12 at -O3 sees overlaps inside std::string that are not there (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    # GCC 12's SLP vectorizer drops the rounding in double -> float -> double where it packs two of
    # them, which changes bits; Clang does not.
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
    -ffp-contract=off                 # the same bits with and without FMA instructions
    $<$<BOOL:${RANGEZIP_STRICT}>:-Werror>)
endfunction()
