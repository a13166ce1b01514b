# `rangezip mesh` on real scans, judged by CGAL: one clean component each, closed where the object
# is, as near to it as its points are. Run by CTest, which takes "SKIPPED" for skipped:
#   cmake -D PROGRAM=<rangezip-compare> -D RANGEZIP=<rangezip> -D SCRATCH=<folder>
#     -D DATA=<folder of the scans> -P real_scans_test.cmake
# The folder may also come from the environment: RANGEZIP_SHARED, whose `data` is meant.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect.cmake)
if(DEFINED ENV{RANGEZIP_SHARED})
  set(DATA $ENV{RANGEZIP_SHARED}/data)
endif()
if(NOT EXISTS ${DATA})
  message("SKIPPED: there are no scans in ${DATA}")
  return()
endif()
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

# mesh(<name> <input> <options>...): makes NAME.ply and lets CGAL judge it into NAME.json.
function(mesh name input)
  execute_process(COMMAND ${RANGEZIP} mesh ${input} -o ${name}.ply --quiet
    WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE result ERROR_VARIABLE err)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "rangezip mesh ${input}: exit code ${result}, ${err}")
  endif()
  expect(0 "manifold, oriented; 0 self-intersecting" mesh ${name}.ply --json ${name}.json ${ARGN})
endfunction()

# demand(<name> <least> <most> <member>...): a figure of NAME.json must be from `least` to `most`.
function(demand name least most)
  file(READ ${SCRATCH}/${name}.json report)
  string(JSON value GET "${report}" ${ARGN})
  if(value LESS least OR value GREATER most)
    list(JOIN ARGN " " member)
    message(SEND_ERROR "${name}: ${member} must be ${least} to ${most}, got ${value}")
  endif()
endfunction()

# A simulated scan with noise and outliers of a part with a hole through it, which is known.
mesh(rocker_arm ${DATA}/cloud/rocker-arm_virtual_scan.xyz --truth ${DATA}/mesh/rocker-arm.obj)
demand(rocker_arm 1 1 mesh components)
demand(rocker_arm 0 0 mesh boundary_loops)
demand(rocker_arm 0 0 mesh euler)
demand(rocker_arm 0 0.0005 accuracy p95)
demand(rocker_arm 0 0.0005 completeness p95)

# Ten range scans of the Stanford bunny: open only where it was not scanned, mostly underneath.
mesh(bunny ${DATA}/range/bunny/bun.conf --cloud ${DATA}/range/bunny/bun.conf)
demand(bunny 1 1 mesh components)
demand(bunny 1 12 mesh boundary_loops)
demand(bunny 0.998 1 cloud within_0.5_percent)

# Polygons of a machined part with sharp edges.
mesh(fandisk ${DATA}/mesh/fandisk.obj --truth ${DATA}/mesh/fandisk.obj)
demand(fandisk 1 1 mesh components)
demand(fandisk 2 2 mesh euler)
demand(fandisk 0 0.00005 accuracy rms)

# Polygons of a part with bores deeper than any planned view sees.
mesh(bracket ${DATA}/cad/featuretype.STL --truth ${DATA}/cad/featuretype.STL)
demand(bracket 1 1 mesh components)
demand(bracket 0 0 mesh boundary_loops)
demand(bracket -16 -16 mesh euler)
demand(bracket 0 0.00006 accuracy rms)
