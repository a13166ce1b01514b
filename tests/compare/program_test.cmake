# rangezip-compare as a user runs it: exit codes (as with cmp, 1 is a verdict, above is trouble) and the
# words that matter. Run by CTest:
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
file(WRITE ${SCRATCH}/flat.obj "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
file(MAKE_DIRECTORY ${SCRATCH}/folder.json ${SCRATCH}/folder.xyz)

expect(0 "0 boundary loops, Euler number 2\nmanifold, oriented; 0 self-intersecting"
  mesh tetrahedron.obj)
expect(1 "NOT MANIFOLD: .* 3 edges between faces of opposite" mesh turned_face.obj)
expect(0 "mesh to truth:  mean 0.0000" mesh tetrahedron.obj --truth tetrahedron.obj)
# The corner (0, 0, 1.1) is 0.1 from the truth, whose diagonal is sqrt(3).
expect(0 "mesh to truth: .* max 5.[67][0-9]+ " mesh shifted.obj --truth tetrahedron.obj)
expect(0 "cloud to mesh:  mean 0.0000.*max 0.0000"
  mesh tetrahedron.obj --cloud corners.xyz --json report.json)
expect(2 "nowhere.ply" mesh nowhere.ply)
expect(2 "broken.obj" mesh broken.obj)
expect(2 "flat.obj: .* must have an area" mesh flat.obj --truth tetrahedron.obj)
expect(2 "flat.obj: " mesh tetrahedron.obj --truth flat.obj)
expect(1 "1 degenerate faces" mesh flat.obj)
expect(3 "there is no folder no_such_folder" mesh tetrahedron.obj --json no_such_folder/report.json)
expect(3 "must end in .json" mesh tetrahedron.obj --json report.txt)
expect(3 "is a folder" mesh tetrahedron.obj --json folder.json)
expect(5 "MESH is required" mesh)
expect(5 "samples" mesh tetrahedron.obj --samples 0)
expect(5 "must be a whole number greater than 0, got '1.5'" sample tetrahedron.obj -o s.xyz --points 1.5)
expect(5 "not expected: shifted.obj.See rangezip-compare mesh --help" mesh tetrahedron.obj shifted.obj)
expect(5 "subcommand" )
expect(5 "jump: is no command, and no file; there are draw, mesh, " jump tetrahedron.obj)
expect(0 "Exit codes:.*  1  images, .*  5  wrong option.*  130  .*GNU General Public License" --help)
expect(0 "^rangezip-compare [0-9]+\\.[0-9]+\\.[0-9]+\n$" --version)

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
expect(1 "1 differ: 0 missing .* 1 of another value .by up to 0.5 model units.; first at .3, 1."
  images depths.pfm deeper.pfm)
expect(0 "identical" images ids.png ids.png)
expect(1 "2 differ: 1 missing .* 0 in the second only, 1 of another value; first at .1, 2."
  images ids.png other_ids.png)
expect(1 "1 differ: 0 missing in the second, 1 in the second only" images other_mask.png mask.png)
expect(2 "must be of the same kind" images ids.png mask.png)
expect(2 "same extent" images depths.pfm larger.pfm)
expect(2 "colour type 2" images ids.png picture.png)
expect(2 "cut.png: must be a PNG file" images cut.png ids.png)
expect(2 "nowhere.png: cannot be opened: No such file" images nowhere.png ids.png)
expect(2 "nowhere.pfm: cannot be opened: No such file" images depths.pfm nowhere.pfm)
expect(2 "must be an image" images tetrahedron.obj ids.png)
expect(5 "CANDIDATE is required" images ids.png)

expect(0 "^$" sample tetrahedron.obj -o samples.xyz --points 1000)
expect(0 "cloud to mesh: .* max 0.0000" mesh tetrahedron.obj --cloud samples.xyz)
expect(3 "there is no folder no_such_folder" sample tetrahedron.obj -o no_such_folder/samples.xyz)
expect(3 "must end in .xyz" sample tetrahedron.obj -o samples.ply)
expect(3 "is a folder" sample tetrahedron.obj -o folder.xyz)
expect(2 "flat.obj: .* must have an area" sample flat.obj -o flat.xyz)
expect(2 "nowhere.obj" sample nowhere.obj -o samples.xyz)
expect(5 "output is required" sample tetrahedron.obj)
file(STRINGS ${SCRATCH}/samples.xyz lines)
list(LENGTH lines count)
if(NOT count EQUAL 1000)
  message(SEND_ERROR "samples.xyz: ${count} lines")
endif()

# What cannot be written in full is not there at all, and what was there before stays.
file(WRITE ${SCRATCH}/kept.xyz "before")
file(WRITE ${SCRATCH}/kept.json "before")
function(expect_with_small_files pattern kept)
  file(GLOB before ${SCRATCH}/*)
  execute_process(COMMAND sh -c "ulimit -f 0; exec \"$@\"" sh ${PROGRAM} ${ARGN}
    WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  file(GLOB after ${SCRATCH}/* ${SCRATCH}/.rangezip-*)
  file(READ ${SCRATCH}/${kept} content)
  if(NOT result EQUAL 3 OR NOT err MATCHES "${pattern}" OR NOT before STREQUAL after
      OR NOT content STREQUAL "before")
    message(SEND_ERROR "${ARGN} past the file-size limit: ${result}, ${err}, ${kept}: ${content}, "
      "files ${after}")
  endif()
endfunction()
expect_with_small_files("kept.xyz: cannot be written in full" kept.xyz
  sample tetrahedron.obj -o kept.xyz --points 100000)
expect_with_small_files("kept.json: cannot be written in full" kept.json
  mesh tetrahedron.obj --json kept.json)
if(EXISTS /dev/full)
  execute_process(COMMAND sh -c "exec \"$@\" >/dev/full" sh ${PROGRAM} mesh tetrahedron.obj
    WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE result ERROR_VARIABLE err)
  if(NOT result EQUAL 3 OR NOT err MATCHES "standard output: cannot be written")
    message(SEND_ERROR "mesh onto a full disk: ${result}, ${err}")
  endif()
endif()

# Ended while it writes: neither the file nor a rest of it.
execute_process(
  COMMAND sh -c "\"$@\" & while kill -0 $! && ! ls .rangezip-*.tmp; do sleep 0.01; done >/dev/null 2>&1
    kill -TERM $!; wait $!" sh ${PROGRAM} sample tetrahedron.obj -o ended.xyz --points 3000000
  WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE result ERROR_VARIABLE err)
file(GLOB rests ${SCRATCH}/ended* ${SCRATCH}/.rangezip-*)
if(NOT result EQUAL 130 OR NOT err MATCHES "interrupted" OR rests)
  message(SEND_ERROR "sample ended while it writes: ${result}, ${err}, left: ${rests}")
endif()
