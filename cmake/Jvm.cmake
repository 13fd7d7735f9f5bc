# The JVM side. Maven builds the changed modules; the POMs declare modules, dependencies and versions.
set(JVM "${PROJECT_SOURCE_DIR}/jvm-host")
set(GENERATOR_JAR "${JVM}/generator/target/collektive-generator.jar")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS jvm-host/pom.xml)
file(GLOB poms "${JVM}/*/pom.xml")
file(GLOB mains "${JVM}/*/src/main")
file(GLOB schemas "${PROJECT_SOURCE_DIR}/unity/Samples~/*/*.fbs")
collektive_python(maven build/maven.py)

# jvm_step(TARGET COMMENT [WORDS WORD...] [FOLDERS DIR...] [BYPRODUCTS FILE...]): one call of scripts/build/maven.py.
function(jvm_step TARGET COMMENT)
  cmake_parse_arguments(PARSE_ARGV 2 J "" "" "WORDS;FOLDERS;BYPRODUCTS")
  set(stamp "${COLLEKTIVE_BUILD}/stamp/${TARGET}")
  collektive_step(${TARGET} OUTPUT "${stamp}" COMMAND ${maven} "${stamp}" ${J_WORDS} COMMENT "${COMMENT}" TERMINAL
    BYPRODUCTS ${J_BYPRODUCTS}
    DEPENDS "${COLLEKTIVE_FLATC}" "${COLLEKTIVE_BUILD}/stamp/flatbuffers" scripts/build/maven.py "${JVM}/pom.xml" ${poms}
    FOLDERS ${mains} ${J_FOLDERS} "${PROJECT_SOURCE_DIR}/schema" ${schemas})
endfunction()

# The modules that run scenes and the samples, all modules, and all tests. Each step uses the terminal, so Ninja runs one at a time.
jvm_step(jvm "JVM side" WORDS host tools generator compiler-plugin programs BYPRODUCTS "${GENERATOR_JAR}")
jvm_step(jvm_modules "all modules of the JVM side")
file(GLOB tests "${JVM}/*/src")
jvm_step(jvm_tests "tests of the JVM side" WORDS --tests FOLDERS ${tests})

# A library of programs for each sample, from the jar of all samples.
collektive_python(sample_programs build/sample_programs.py)
set(libraries "${COLLEKTIVE_BUILD}/generated/sample-programs")
collektive_step(sample_programs OUTPUT "${libraries}.stamp" COMMAND ${sample_programs} "${libraries}" AND "${CMAKE_COMMAND}" -E touch "${libraries}.stamp"
  DEPENDS "${COLLEKTIVE_BUILD}/stamp/jvm" scripts/build/sample_programs.py ${schemas})
