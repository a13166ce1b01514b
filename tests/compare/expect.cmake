# expect(<exit code> <pattern in what it prints> <arguments>...): runs ${PROGRAM} in ${SCRATCH}.
function(expect code pattern)
  execute_process(COMMAND ${PROGRAM} ${ARGN} WORKING_DIRECTORY ${SCRATCH}
    RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT result EQUAL code OR NOT "${out}${err}" MATCHES "${pattern}")
    message(SEND_ERROR "rangezip-compare ${ARGN}: expected exit code ${code} and '${pattern}', "
      "got ${result} and:\n${out}${err}")
  endif()
endfunction()
