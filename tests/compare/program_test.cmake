# rangezip-compare as a user runs it: exit codes and the words that matter. Run by CTest:
#   cmake -D PROGRAM=<rangezip-compare> -D SCRATCH=<folder> -P program_test.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

# expect(<exit code> <pattern in what it prints> <arguments>...)
function(expect code pattern)
  execute_process(COMMAND ${PROGRAM} ${ARGN} WORKING_DIRECTORY ${SCRATCH}
    RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT result EQUAL code OR NOT "${out}${err}" MATCHES "${pattern}")
    message(SEND_ERROR "rangezip-compare ${ARGN}: expected exit code ${code} and '${pattern}', "
      "got ${result} and:\n${out}${err}")
  endif()
endfunction()

set(corners "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n")
file(WRITE ${SCRATCH}/tetrahedron.obj "${corners}f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
file(WRITE ${SCRATCH}/turned_face.obj "${corners}f 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
file(WRITE ${SCRATCH}/shifted.obj
  "v 0 0 0.1\nv 1 0 0.1\nv 0 1 0.1\nv 0 0 1.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
file(WRITE ${SCRATCH}/corners.xyz "0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
file(WRITE ${SCRATCH}/broken.obj "v 0 0 zero\n")

expect(0 "0 boundary loops, Euler number 2\nmanifold, oriented; 0 self-intersecting"
  mesh tetrahedron.obj)
expect(1 "NOT MANIFOLD: .* 3 edges between faces of opposite" mesh turned_face.obj)
expect(0 "mesh to truth:  mean 0.0000" mesh tetrahedron.obj --truth tetrahedron.obj)
# The corner (0, 0, 1.1) is 0.1 from the truth, whose diagonal is sqrt(3).
expect(0 "mesh to truth: .* max 5.[67][0-9]+ " mesh shifted.obj --truth tetrahedron.obj)
expect(0 "cloud to mesh:  mean 0.0000.*max 0.0000"
  mesh tetrahedron.obj --cloud corners.xyz --json report.json)
expect(3 "nowhere.ply" mesh nowhere.ply)
expect(3 "broken.obj" mesh broken.obj)
expect(3 "the report cannot be written" mesh tetrahedron.obj --json no_such_folder/report.json)
expect(2 "MESH is required" mesh)
expect(2 "samples" mesh tetrahedron.obj --samples 0)
expect(2 "subcommand" )
expect(0 "Exit codes: 0 .*GNU General Public License" --help)

file(READ ${SCRATCH}/report.json report)
string(JSON clean GET "${report}" mesh clean)
string(JSON euler GET "${report}" mesh euler)
string(JSON max GET "${report}" cloud max)
if(NOT clean STREQUAL "ON" OR NOT euler EQUAL 2 OR max GREATER 1e-15)
  message(SEND_ERROR "report.json: clean ${clean}, euler ${euler}, cloud max ${max}")
endif()
