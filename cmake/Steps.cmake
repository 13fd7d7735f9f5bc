# collektive_step(TARGET OUTPUT FILE COMMAND WORD... [DEPENDS FILE-OR-TARGET...] [FOLDERS DIR...] [COMMENT TEXT] [TERMINAL])
#
# Adds a target whose command makes one file. It runs again if an input is newer: a file, another target's output, or anything below a folder.
# The command ends with the words that COMMAND gives; a step that makes many files makes a stamp last.
function(collektive_step TARGET)
  cmake_parse_arguments(PARSE_ARGV 1 STEP "TERMINAL" "OUTPUT;COMMENT" "COMMAND;DEPENDS;FOLDERS")
  set(depfile)
  if(STEP_FOLDERS)
    set(file "${CMAKE_BINARY_DIR}/depfiles/${TARGET}.d")
    set(depfile COMMAND "${COLLEKTIVE_PYTHON}" -I "${PROJECT_SOURCE_DIR}/scripts/build/depfile.py" "${STEP_OUTPUT}" "${file}" ${STEP_FOLDERS}
      DEPFILE "${file}")
  endif()
  set(terminal)
  if(STEP_TERMINAL)
    set(terminal USES_TERMINAL)
  endif()
  if(NOT STEP_COMMENT)
    cmake_path(GET STEP_OUTPUT FILENAME STEP_COMMENT)
  endif()
  add_custom_command(OUTPUT "${STEP_OUTPUT}" COMMAND ${STEP_COMMAND} ${depfile} DEPENDS ${STEP_DEPENDS} COMMENT "${STEP_COMMENT}" ${terminal} VERBATIM)
  add_custom_target(${TARGET} DEPENDS "${STEP_OUTPUT}")
  set_property(TARGET ${TARGET} PROPERTY COLLEKTIVE_OUTPUT "${STEP_OUTPUT}")
endfunction()

# collektive_python(VARIABLE SCRIPT): the words that run a script of scripts/, isolated from the caller's settings.
function(collektive_python VARIABLE SCRIPT)
  set(${VARIABLE} "${COLLEKTIVE_PYTHON}" -I "${PROJECT_SOURCE_DIR}/scripts/${SCRIPT}" PARENT_SCOPE)
endfunction()
