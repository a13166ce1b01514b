# `rangezip-compare draw` and `stages` as a user runs them. Run by CTest:
#   cmake -D PROGRAM=<rangezip-compare> -D RANGEZIP=<rangezip> -D SCRATCH=<folder>
#     -D WITH_GL=<built with OpenGL> -P draw_program_test.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect.cmake)
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH}/images)

# A cube and the same one with its side x = 1 moved to x = 1.1.
function(write_cube name x)
  file(WRITE ${SCRATCH}/${name}
    "v 0 0 0\nv ${x} 0 0\nv ${x} 1 0\nv 0 1 0\nv 0 0 1\nv ${x} 0 1\nv ${x} 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
endfunction()
write_cube(cube.obj 1)
write_cube(longer.obj 1.1)

# Exact backends draw the same; a command is 'draw' unless it says otherwise.
expect(0 "cpu:scalar .* against cpu .*exact: 5 views, 20480 pixels, [1-9][0-9]* covered, identical"
  draw cube.obj --views 5 --size 64,64 --backends cpu,cpu:scalar --json report.json --images images)
expect(0 "6 views, 30000 pixels" cube.obj --size 100,50 --backends cpu,cpu:scalar)
expect(0 "6 views, 30000 pixels" --backends cpu,cpu:scalar --size 100,50 cube.obj longer.obj)
file(READ ${SCRATCH}/report.json report)
string(JSON covered GET "${report}" candidates 0 total covered)
string(JSON view_covered GET "${report}" candidates 0 views 4 covered)
string(JSON width GET "${report}" views 4 extent width)
string(JSON unexplained GET "${report}" candidates 0 total unexplained)
string(JSON tolerance TYPE "${report}" candidates 0 tolerance)
if(covered LESS view_covered OR view_covered EQUAL 0 OR NOT width EQUAL 64 OR NOT unexplained EQUAL 0
    OR NOT tolerance STREQUAL "NULL")
  message(SEND_ERROR "report.json: ${report}")
endif()
file(GLOB pictures ${SCRATCH}/images/*)
if(pictures)
  message(SEND_ERROR "pictures of views that do not differ: ${pictures}")
endif()

# The drawing of another program: what `rangezip scan` drew is what is drawn here.
execute_process(COMMAND ${RANGEZIP} scan cube.obj --depth d.pfm --ids i.png --session s.json -q
  --size 64,64 --direction 1,2,3 --perspective 40
  WORKING_DIRECTORY ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)
set(files --view-of s.json --depth d.pfm --ids i.png)
expect(0 "files .*: 1 view, 4096 pixels, .*identical"
  draw cube.obj --backends cpu ${files} --tolerance 0,0)
# What was drawn of another body is no rounding: red pixels, and the place of the first.
expect(1 "view 0, files: .*coverage.*[1-9][0-9]* unexplained.*first: pixel .*reference: ID .*triangle"
  draw longer.obj --backends cpu ${files} --images images --json differs.json)
if(NOT EXISTS ${SCRATCH}/images/view-00-files.png)
  message(SEND_ERROR "no picture of the view that differs")
endif()
file(READ ${SCRATCH}/differs.json report)
string(JSON cause GET "${report}" candidates 0 views 0 first_unexplained cause)
string(JSON good GET "${report}" candidates 0 good)
string(JSON edge GET "${report}" candidates 0 tolerance edge)
string(JSON corners LENGTH "${report}" candidates 0 views 0 first_unexplained reference triangles 0)
if(NOT cause STREQUAL "unexplained" OR good OR NOT edge EQUAL 3 OR NOT corners EQUAL 3)
  message(SEND_ERROR "differs.json: ${report}")
endif()

expect(4 "no backend 'abacus'; known: cpu, " draw cube.obj --backends cpu,abacus)
expect(4 "no backend 'cpu:abacus'; known: cpu, " draw cube.obj --backends cpu:abacus,cpu)
expect(2 "nowhere.obj" nowhere.obj --backends cpu,cpu)
expect(2 "d.pfm.*cannot be opened|i.png" draw cube.obj --backends cpu --view-of s.json --depth i.png
  --ids i.png)
file(WRITE ${SCRATCH}/no_scan.json [[{"version": 1, "inputs": [{"path": "cube.obj"}],
  "commands": [{"command": "smooth"}]}]])
expect(2 "no_scan.json: /commands: must hold a scan" draw cube.obj --backends cpu,cpu
  --view-of no_scan.json)
expect(3 "no such folder" draw cube.obj --backends cpu,cpu --images nowhere)
expect(3 "there is no folder nowhere" draw cube.obj --backends cpu,cpu --json nowhere/r.json)
expect(5 "nothing to compare with" draw cube.obj --backends cpu)
expect(5 "belong together" draw cube.obj --backends cpu --view-of s.json --ids i.png)
expect(5 "need --view-of" draw cube.obj --backends cpu --depth d.pfm --ids i.png)
expect(5 "excludes" draw cube.obj --backends cpu,cpu --view-of s.json --views 3)
expect(5 "two whole numbers" draw cube.obj --backends cpu ${files} --tolerance 3)
expect(5 "two whole numbers" draw cube.obj --backends cpu ${files} --tolerance=-1,2)
expect(5 "separated by commas" draw cube.obj --backends cpu,,cpu)
expect(5 "backends is required" draw cube.obj)
expect(5 "none of --backends is 'gl'" draw cube.obj --backends cpu,cpu:scalar --strategy compute)
expect(5 "separated by commas" draw cube.obj --backends cpu,gl --strategy compute,,native)
expect(0 "--strategy A,B .*How OpenGL draws" draw --help)
expect(5 "views" draw cube.obj --backends cpu,cpu --views 0)
expect(5 "size" draw cube.obj --backends cpu,cpu --size 9000,1)

# A session, stage by stage.
expect(0 "command 0, scan.*framebuffers: [1-9].*mask: .*mesh: .*cpu:scalar against cpu: 1 command, all"
  stages s.json --backends cpu,cpu:scalar)
expect(5 "must name two" stages s.json --backends cpu)
expect(5 "SESSION is required" stages --backends cpu,cpu)
expect(2 "nowhere.json" stages nowhere.json --backends cpu,cpu)
expect(4 "no backend 'abacus'" stages s.json --backends cpu,abacus)
expect(3 "there is no folder nowhere" stages s.json --backends cpu,cpu --json nowhere/r.json)
file(WRITE ${SCRATCH}/wrong.json [[{"version": 1, "inputs": [{"path": "cube.obj"}],
  "commands": [{"command": "undo"}]}]])
expect(2 "wrong.json: /commands/0: " stages wrong.json --backends cpu,cpu)
file(WRITE ${SCRATCH}/turned.obj "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n")
file(WRITE ${SCRATCH}/turned.json [[{"version": 1, "inputs": [],
  "initial_mesh": {"path": "turned.obj"}, "commands": [{"command": "smooth"}]}]])
expect(2 "turned.json: /initial_mesh: .*turned.obj" stages turned.json --backends cpu,cpu)

# A whole one: several scans and the finish, with every backend of this build.
set(backends cpu:scalar)
if(WITH_GL)
  string(APPEND backends ",gl:osmesa,gl:egl")
endif()
execute_process(COMMAND ${RANGEZIP} mesh cube.obj -o mesh.ply --session whole.json -q
  --triangles 1500 WORKING_DIRECTORY ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)
expect(0 "command 1, scan.*finish.* commands, all stages equal"
  stages whole.json --backends cpu,${backends} --json stages.json)
file(READ ${SCRATCH}/stages.json report)
string(JSON commands GET "${report}" commands)
string(JSON reference GET "${report}" reference name)
string(REPLACE "," ";" backends "${backends}")
list(LENGTH backends count)
string(JSON candidates LENGTH "${report}" candidates)
if(commands LESS 3 OR NOT reference STREQUAL "cpu" OR NOT candidates EQUAL count)
  message(SEND_ERROR "stages.json: ${report}")
endif()
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  list(GET backends ${i} name)
  string(JSON found GET "${report}" candidates ${i} name)
  string(JSON identical GET "${report}" candidates ${i} identical)
  string(JSON played LENGTH "${report}" candidates ${i} commands)
  string(JSON stages LENGTH "${report}" candidates ${i} commands 0 stages)
  string(JSON compared GET "${report}" candidates ${i} commands 0 stages 0 compared)
  if(NOT found STREQUAL name OR NOT identical OR NOT played EQUAL commands OR NOT stages EQUAL 9
      OR compared LESS 1)
    message(SEND_ERROR "stages.json, candidate ${i}: ${report}")
  endif()
endforeach()

if(NOT WITH_GL)
  expect(4 "built without OpenGL" draw cube.obj --backends cpu,gl --strategy compute)
  return()
endif()

# OpenGL, by each strategy: these fail where it does not start.
expect(4 "no strategy 'abacus'; known: compute, fixed_function, native"
  draw cube.obj --backends cpu,gl:osmesa --strategy abacus)
expect(5 "nothing to compare with" draw cube.obj --backends gl:osmesa --strategy compute)
expect(0 "gl:osmesa fixed_function .* against gl:osmesa compute .*exact: .*identical"
  draw cube.obj --backends gl:osmesa --strategy compute,fixed_function --views 2 --size 64,64)
expect(0 "gl:egl .* compute. against cpu .*exact: .*identical"
  draw cube.obj --backends cpu,gl:egl --views 2 --size 64,64)

execute_process(COMMAND ${PROGRAM} sample longer.obj -o points.xyz --points 20000
  WORKING_DIRECTORY ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${RANGEZIP} mesh points.xyz -o triangles.ply --triangles 20000 -q
  WORKING_DIRECTORY ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)

# judge(<scene> <strategies> <options>...): draws it with OSMesa and EGL; gives the report.
function(judge scene strategies)
  execute_process(COMMAND ${PROGRAM} draw ${scene} --backends cpu,gl:osmesa,gl:egl
      --strategy ${strategies} --views 2 --size 256,256 --json gl.json ${ARGN}
    WORKING_DIRECTORY ${SCRATCH} OUTPUT_QUIET)
  file(READ ${SCRATCH}/gl.json report)
  set(report "${report}" PARENT_SCOPE)
endfunction()

# expect_candidate(<number> <name> <exact> <condition>...): of the last report. The condition may
# ask for the figures covered, differing, unexplained.
function(expect_candidate number name exact)
  string(JSON found_name GET "${report}" candidates ${number} name)
  string(JSON found_exact GET "${report}" candidates ${number} exact)
  foreach(figure pixels identical covered unexplained)
    string(JSON ${figure} GET "${report}" candidates ${number} total ${figure})
  endforeach()
  math(EXPR differing "${pixels} - ${identical}")
  if(NOT found_name STREQUAL name OR NOT found_exact STREQUAL exact OR NOT (${ARGN}))
    message(SEND_ERROR "${scene}: ${found_name}, exact ${found_exact}: ${covered} covered, "
      "${differing} differing, ${unexplained} unexplained; expected ${name}, ${exact}, ${ARGN}")
  endif()
endfunction()

# Points and triangles: exact strategies do not differ from the CPU. `native` does, and each of its
# differences is explained; with no tolerance none is, so the judge has looked at them.
foreach(scene points.xyz triangles.ply)
  judge(${scene} compute,fixed_function,native)
  expect_candidate(0 "gl:osmesa compute" ON covered GREATER 10000 AND differing EQUAL 0)
  expect_candidate(1 "gl:osmesa fixed_function" ON covered GREATER 10000 AND differing EQUAL 0)
  expect_candidate(2 "gl:osmesa native" OFF differing GREATER 100 AND unexplained EQUAL 0)
  expect_candidate(3 "gl:egl compute" ON covered GREATER 10000 AND differing EQUAL 0)
  expect_candidate(4 "gl:egl fixed_function" ON covered GREATER 10000 AND differing EQUAL 0)
  expect_candidate(5 "gl:egl native" OFF differing GREATER 100 AND unexplained EQUAL 0)
  judge(${scene} native --tolerance 0,0)
  expect_candidate(0 "gl:osmesa native" OFF differing GREATER 100 AND unexplained EQUAL differing)
  expect_candidate(1 "gl:egl native" OFF differing GREATER 100 AND unexplained EQUAL differing)
endforeach()
