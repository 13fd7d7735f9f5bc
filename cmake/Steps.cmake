# collektive_step(TARGET OUTPUT FILE COMMAND WORD... [AND WORD...]... [DEPENDS FILE-OR-TARGET...] [FOLDERS DIR...]
#   [BYPRODUCTS FILE...] [COMMENT TEXT] [TERMINAL])
#
# Adds a target whose command writes OUTPUT. It runs again if an input is newer: a file, another target's output, or any file below a folder.
# A command that writes many files writes a stamp last. Files that other steps depend on are byproducts.
function(collektive_step TARGET)
  cmake_parse_arguments(PARSE_ARGV 1 STEP "TERMINAL" "OUTPUT;COMMENT" "COMMAND;DEPENDS;FOLDERS;BYPRODUCTS")
  set(depfile)
  if(STEP_FOLDERS)
    set(file "${CMAKE_BINARY_DIR}/depfiles/${TARGET}.d")
    set(depfile COMMAND "${COLLEKTIVE_PYTHON}" -I "${PROJECT_SOURCE_DIR}/scripts/build/depfile.py" "${STEP_OUTPUT}" "${file}" ${STEP_FOLDERS}
      DEPFILE "${file}")
  endif()
  list(TRANSFORM STEP_COMMAND REPLACE "^AND$" COMMAND)
  set(terminal)
  if(STEP_TERMINAL)
    set(terminal USES_TERMINAL)
  endif()
  if(NOT STEP_COMMENT)
    cmake_path(GET STEP_OUTPUT FILENAME STEP_COMMENT)
  endif()
  add_custom_command(OUTPUT "${STEP_OUTPUT}" BYPRODUCTS ${STEP_BYPRODUCTS} COMMAND ${STEP_COMMAND} ${depfile} DEPENDS ${STEP_DEPENDS}
    COMMENT "${STEP_COMMENT}" ${terminal} VERBATIM)
  add_custom_target(${TARGET} DEPENDS "${STEP_OUTPUT}")
endfunction()

# collektive_python(VARIABLE SCRIPT): sets a variable to the command that runs a script, isolated from the caller's settings.
function(collektive_python VARIABLE SCRIPT)
  set(${VARIABLE} "${COLLEKTIVE_PYTHON}" -I "${PROJECT_SOURCE_DIR}/scripts/${SCRIPT}" PARENT_SCOPE)
endfunction()
