# rangezip-compare as a user runs it: exit codes and the words that matter. Run by CTest:
#   cmake -D PROGRAM=<rangezip-compare> -D MAKE_IMAGES=<make_test_images> -D SCRATCH=<folder>
#     -P program_test.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect.cmake)
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

set(corners "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n")
file(WRITE ${SCRATCH}/tetrahedron.obj "${corners}f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
file(WRITE ${SCRATCH}/turned_face.obj "${corners}f 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
file(WRITE ${SCRATCH}/shifted.obj
  "v 0 0 0.1\nv 1 0 0.1\nv 0 1 0.1\nv 0 0 1.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
file(WRITE ${SCRATCH}/corners.xyz "0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
file(WRITE ${SCRATCH}/broken.obj "v 0 0 zero\n")

expect(0 "0 boundary loops, Euler number 2\nmanifold, oriented; 0 self-intersecting"
  mesh tetrahedron.obj)
expect(5 "NOT MANIFOLD: .* 3 edges between faces of opposite" mesh turned_face.obj)
expect(0 "mesh to truth:  mean 0.0000" mesh tetrahedron.obj --truth tetrahedron.obj)
# The corner (0, 0, 1.1) is 0.1 from the truth, whose diagonal is sqrt(3).
expect(0 "mesh to truth: .* max 5.[67][0-9]+ " mesh shifted.obj --truth tetrahedron.obj)
expect(0 "cloud to mesh:  mean 0.0000.*max 0.0000"
  mesh tetrahedron.obj --cloud corners.xyz --json report.json)
expect(2 "nowhere.ply" mesh nowhere.ply)
expect(2 "broken.obj" mesh broken.obj)
expect(3 "the report cannot be written" mesh tetrahedron.obj --json no_such_folder/report.json)
expect(1 "MESH is required" mesh)
expect(1 "samples" mesh tetrahedron.obj --samples 0)
expect(1 "subcommand" )
expect(0 "Exit codes: 0 .*GNU General Public License" --help)

file(READ ${SCRATCH}/report.json report)
string(JSON clean GET "${report}" mesh clean)
string(JSON euler GET "${report}" mesh euler)
string(JSON max GET "${report}" cloud max)
if(NOT clean STREQUAL "ON" OR NOT euler EQUAL 2 OR max GREATER 1e-15)
  message(SEND_ERROR "report.json: clean ${clean}, euler ${euler}, cloud max ${max}")
endif()

execute_process(COMMAND ${MAKE_IMAGES} WORKING_DIRECTORY ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${SCRATCH}/cut.png "PNG")
expect(0 "12 pixels, identical" images depths.pfm depths.pfm)
expect(5 "1 differ: 0 missing .* 1 of another value .by up to 0.5 model units.; first at .3, 1."
  images depths.pfm deeper.pfm)
expect(0 "identical" images ids.png ids.png)
expect(5 "2 differ: 1 missing .* 0 in the second only, 1 of another value; first at .1, 2."
  images ids.png other_ids.png)
expect(5 "1 differ: 0 missing in the second, 1 in the second only" images other_mask.png mask.png)
expect(2 "must be of the same kind" images ids.png mask.png)
expect(2 "same extent" images depths.pfm larger.pfm)
expect(2 "colour type 2" images ids.png picture.png)
expect(2 "cut.png: cannot be opened, or ends" images cut.png ids.png)
expect(2 "must be an image" images tetrahedron.obj ids.png)
expect(1 "CANDIDATE is required" images ids.png)

expect(0 "^$" sample tetrahedron.obj -o samples.xyz --points 1000)
expect(0 "cloud to mesh: .* max 0.0000" mesh tetrahedron.obj --cloud samples.xyz)
expect(3 "the cloud cannot be written" sample tetrahedron.obj -o no_such_folder/samples.xyz)
expect(2 "nowhere.obj" sample nowhere.obj -o samples.xyz)
expect(1 "output is required" sample tetrahedron.obj)
file(STRINGS ${SCRATCH}/samples.xyz lines)
list(LENGTH lines count)
if(NOT count EQUAL 1000)
  message(SEND_ERROR "samples.xyz: ${count} lines")
endif()
