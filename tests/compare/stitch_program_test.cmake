# `rangezip-compare stitch` and `rangezip mesh --verify` as a user runs them. Run by CTest:
#   cmake -D PROGRAM=<rangezip-compare> -D RANGEZIP=<rangezip>
#     -D MAKE_IMAGES=<make_test_images> -D SCRATCH=<folder> -P stitch_program_test.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect.cmake)
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

execute_process(COMMAND ${MAKE_IMAGES} WORKING_DIRECTORY ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${PROGRAM} sample torus.ply -o torus.xyz --points 30000
  WORKING_DIRECTORY ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)

# Both methods: what is judged is there, keeps the limits, and --verify passes that on.
foreach(method auto paper)
  execute_process(COMMAND ${RANGEZIP} mesh torus.xyz -o ${method}.ply --method ${method} --verify
      --session ${method}.json
    WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT result EQUAL 0 OR NOT "${out}" MATCHES "written .*samples, nearest face: .*verdict: holds")
    message(SEND_ERROR "--verify of ${method}: ${result}, ${out}${err}")
  endif()
  expect(0 "verdict: holds" stitch ${method}.json --json ${method}.report.json)
  file(READ ${SCRATCH}/${method}.report.json report)
  foreach(member "samples;located" "samples;acceptance" "insertions;located"
          "insertions;acceptance" "segments;inserted" "segments;followed" "segments;ratio_p99")
    string(JSON value GET "${report}" ${member})
    list(JOIN member _ name)
    set(${name} ${value})
  endforeach()
  string(JSON good GET "${report}" good)
  string(JSON commands LENGTH "${report}" commands)
  string(JSON unlocated GET "${report}" samples unlocated)
  string(JSON missed GET "${report}" samples missed)
  string(JSON crossings GET "${report}" new_self_intersections)
  string(JSON missing ERROR_VARIABLE nothing_missing GET "${report}" nothing_to_judge 0)
  if(method STREQUAL "auto" AND NOT missing STREQUAL "insertions" OR method STREQUAL "paper"
      AND NOT nothing_missing OR NOT crossings EQUAL 0 OR unlocated LESS 1
      OR NOT missed EQUAL 0)
    message(SEND_ERROR "${method}.report.json, of nothing to judge: ${report}")
  endif()
  if(NOT good OR commands LESS 3 OR samples_located LESS 500 OR samples_acceptance LESS 0.999)
    message(SEND_ERROR "${method}.report.json: ${report}")
  endif()
  if(method STREQUAL "paper" AND (insertions_located LESS 200 OR insertions_acceptance LESS 0.999
      OR segments_followed LESS 200 OR segments_ratio_p99 GREATER 1.05))
    message(SEND_ERROR "paper.report.json: ${report}")
  endif()
endforeach()
file(GLOB left ${SCRATCH}/*verify*)
if(left)
  message(SEND_ERROR "sessions of --verify are left: ${left}")
endif()

# Sharp edges, a thin body and slices, where the nearest face is often one that is not seen.
foreach(body cube plate)
  execute_process(COMMAND ${PROGRAM} sample ${body}.ply -o ${body}.xyz --points 30000
    WORKING_DIRECTORY ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
foreach(body cube plate contours)
  execute_process(COMMAND ${RANGEZIP} mesh ${body}.xyz -o ${body}.mesh.ply --method paper --verify
    WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT result EQUAL 0 OR NOT "${out}" MATCHES "samples, nearest face: [1-9].*verdict: holds")
    message(SEND_ERROR "--verify of ${body}: ${result}, ${out}${err}")
  endif()
endforeach()

# A mesh that crosses itself while no finish has been made is counted, not judged.
file(WRITE ${SCRATCH}/crossing.obj "v -2 -1 0\nv 2 -1 0\nv 0 2 0\nv 0 0 -1\nv 0 0.5 1\nv 0 -0.5 1\n"
  "f 1 2 3\nf 4 5 6\n")
file(WRITE ${SCRATCH}/counted.json [[{"version": 1, "inputs": [],
  "initial_mesh": {"path": "crossing.obj"},
  "commands": [{"command": "smooth", "iterations": 1}]}]])
expect(0 "1 crossing" stitch counted.json --json counted.report.json)
expect(0 "nearest face: .*nothing to judge.*of the meshes alone holds; nothing to judge: samples, "
  stitch counted.json)
file(READ ${SCRATCH}/counted.report.json report)
string(JSON acceptance TYPE "${report}" samples acceptance)
string(JSON ratio TYPE "${report}" segments ratio_p99)
string(JSON missing LENGTH "${report}" nothing_to_judge)
if(NOT "${acceptance} ${ratio} ${missing}" STREQUAL "NULL NULL 3")
  message(SEND_ERROR "counted.report.json: ${report}")
endif()

# A referee that finds fault: --verify passes its 1 on as 5, other failures as 6, none there as 1.
file(MAKE_DIRECTORY ${SCRATCH}/bin)
file(COPY ${RANGEZIP} DESTINATION ${SCRATCH}/bin)
function(expect_verify code pattern script)
  file(REMOVE ${SCRATCH}/bin/rangezip-compare)
  if(script)
    file(WRITE ${SCRATCH}/bin/rangezip-compare "#!/bin/sh\n${script}\n")
    file(CHMOD ${SCRATCH}/bin/rangezip-compare PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  endif()
  execute_process(COMMAND ${SCRATCH}/bin/rangezip mesh torus.ply -o fault.ply --verify -q
      --triangles 1500
    WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT result EQUAL code OR NOT "${err}" MATCHES "${pattern}")
    message(SEND_ERROR "--verify with '${script}': ${result}, ${out}${err}")
  endif()
endfunction()
expect_verify(5 "fault.ply: the mesh is written, but .*not find all stitches good" "exit 1")
expect_verify(6 "rangezip-compare: failed with exit code 2" "exit 2")
expect_verify(130 "interrupted" "exit 130")
expect_verify(0 "^$" "test \"$1\" = stitch && test -s \"$2\" && test \"$4\" = cpu")
expect_verify(1 "--verify: needs the program .*rangezip-compare, which is not installed" "")

expect(2 "nowhere.json" stitch nowhere.json)
expect(3 "there is no folder nowhere" stitch auto.json --json nowhere/r.json)
expect(4 "no backend 'abacus'" stitch auto.json --backend abacus)
expect(5 "SESSION is required" stitch)
