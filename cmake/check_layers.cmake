# Includes go one way. Run by CTest:
#   cmake -D ROOT=<repository> -P cmake/check_layers.cmake
# Fails with one line per include that points upwards or reaches a library it must not know.

cmake_minimum_required(VERSION 3.25)

# What each folder may include besides itself (docs/design.md, "Layers").
set(may_include_core/base "")
set(may_include_core/view core/base)
set(may_include_core/raster ${may_include_core/view} core/view)
set(may_include_core/scene ${may_include_core/raster} core/raster)
set(may_include_core/mesh ${may_include_core/raster} core/raster)
set(may_include_core/image ${may_include_core/mesh} core/scene core/mesh)
set(may_include_core/mask ${may_include_core/image} core/image)
set(may_include_core/render ${may_include_core/mask} core/mask)
set(may_include_core/patch ${may_include_core/mask} core/mask)
set(may_include_core/scan ${may_include_core/patch} core/patch)
set(may_include_core/stitch ${may_include_core/scan} core/scan)
set(may_include_core/plan
  core/base core/view core/raster core/scene core/mesh core/image)
set(may_include_core/finish core/base core/view core/raster core/mesh core/image)
set(may_include_core/session
  ${may_include_core/stitch} core/stitch core/plan core/finish)
set(may_include_core/io
  core/base core/view core/raster core/scene core/mesh core/image core/mask core/session)
set(may_include_core/reconstruct ${may_include_core/session} core/session)
set(all_of_core ${may_include_core/reconstruct} core/reconstruct core/io core/render)
set(may_include_raster_cpu core/base core/view core/raster)
set(may_include_raster_gl core/base core/view core/raster)
set(may_include_compare ${all_of_core})
set(may_include_apps/rangezip ${all_of_core} raster_cpu raster_gl)
set(may_include_apps/rangezip-compare ${all_of_core} compare apps/rangezip)

set(violations "")

# The folder that the rule of a file or include belongs to: core/<module>, apps/<program>, or the
# top-level folder.
function(layer_of path result)
  if(path MATCHES "^((core|apps)/[^/]+)/")
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  elseif(path MATCHES "^([^/]+)/")
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  else()
    set(${result} "" PARENT_SCOPE)
  endif()
endfunction()

file(GLOB_RECURSE files RELATIVE ${ROOT}
  ${ROOT}/core/*.h ${ROOT}/core/*.cpp ${ROOT}/raster_cpu/*.h ${ROOT}/raster_cpu/*.cpp
  ${ROOT}/raster_gl/*.h ${ROOT}/raster_gl/*.cpp ${ROOT}/compare/*.h ${ROOT}/compare/*.cpp
  ${ROOT}/apps/*.h ${ROOT}/apps/*.cpp)
if(NOT files)
  message(FATAL_ERROR "check_layers: no sources under '${ROOT}'")
endif()

foreach(file IN LISTS files)
  layer_of(${file} layer)
  if(NOT DEFINED may_include_${layer})
    list(APPEND violations "${file}: no rule for ${layer} in cmake/check_layers.cmake")
    continue()
  endif()
  file(STRINGS ${ROOT}/${file} includes REGEX "^[ \t]*#[ \t]*include[ \t]")
  foreach(include IN LISTS includes)
    if(include MATCHES "include[ \t]+\"([^\"]+)\"")
      set(path ${CMAKE_MATCH_1})
      layer_of(${path} target)
      if(NOT EXISTS ${ROOT}/${path})
        list(APPEND violations "${file}: \"${path}\" is not a path from the repository's root")
      elseif(NOT target STREQUAL layer AND NOT target IN_LIST may_include_${layer})
        list(APPEND violations "${file}: ${layer} must not include ${path}")
      endif()
    elseif(include MATCHES "<CGAL/" AND NOT layer STREQUAL compare)
      list(APPEND violations "${file}: CGAL (GPL) belongs to compare, tests and benchmarks only")
    elseif(include MATCHES "<OpenMesh/" AND file MATCHES "\\.h$"
           AND NOT file STREQUAL core/mesh/halfedge.h)
      list(APPEND violations "${file}: OpenMesh in a header other than core/mesh/halfedge.h")
    endif()
  endforeach()
endforeach()

if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "check_layers:\n  ${text}")
endif()
list(LENGTH files count)
message(STATUS "check_layers: ${count} files, no include points upwards")
