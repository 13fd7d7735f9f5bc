# The C# assemblies: build/csharp/NAME. Roslyn runs on Mono, since a .NET SDK may not be installed.
set(CSHARP "${COLLEKTIVE_BUILD}/csharp")
set(ROSLYN "${COLLEKTIVE_BUILD}/roslyn")
collektive_python(csc build/csharp.py)

collektive_step(roslyn OUTPUT "${ROSLYN}/roslyn.exe"
  BYPRODUCTS "${ROSLYN}/Newtonsoft.Json.dll" COMMAND ${csc} --roslyn DEPENDS scripts/build/csharp.py tools/roslyn/Roslyn.cs "${COLLEKTIVE_BUILD}/stamp/npm")

# Symbols of the bridge in Unity, which the code of FlatBuffers also needs.
set(symbols --symbols)
set(UNITY "${PROJECT_SOURCE_DIR}/unity")
set(HEADLESS "${UNITY}/Headless~")
set(GENERATED "${COLLEKTIVE_BUILD}/generated")
include(Ide)

add_custom_target(csharp)
# assembly(NAME SOURCES DIR-OR-FILE... [REFERENCES NAME...] [OPTIONS WORD...] [DEPENDS TARGET...]): references are names of our assemblies or paths.
function(assembly NAME)
  cmake_parse_arguments(PARSE_ARGV 1 A "" "" "SOURCES;REFERENCES;OPTIONS;DEPENDS")
  set(references)
  foreach(reference ${A_REFERENCES})
    cmake_path(ABSOLUTE_PATH reference BASE_DIRECTORY "${CSHARP}")
    list(APPEND references "${reference}")
  endforeach()
  set(options ${A_OPTIONS})
  if(NAME MATCHES "\\.exe$")
    list(APPEND options -target:exe)
  endif()
  if("--symbols" IN_LIST options)
    list(APPEND A_DEPENDS "${UNITY}/Runtime/Bridge/csc.rsp")
  endif()
  list(TRANSFORM references PREPEND "-r:" OUTPUT_VARIABLE flags)
  string(REPLACE "/" "-" target "${NAME}")
  collektive_step(${target} OUTPUT "${CSHARP}/${NAME}" COMMAND ${csc} "${CSHARP}/${NAME}" ${A_SOURCES} -- ${options} ${flags}
    DEPENDS "${ROSLYN}/roslyn.exe" scripts/build/csharp.py ${references} ${A_DEPENDS} FOLDERS ${A_SOURCES})
  add_dependencies(csharp ${target})
  if(NOT NAME MATCHES "/")
    ide_project(${NAME} "${A_SOURCES}" "${references}")
  endif()
endfunction()

# library(FILE): copies a third-party assembly to the folder of our assemblies, where CoreCLR searches.
function(library FILE)
  cmake_path(GET FILE FILENAME name)
  collektive_step(${name} OUTPUT "${CSHARP}/${name}" COMMAND "${CMAKE_COMMAND}" -E copy "${FILE}" "${CSHARP}/${name}" DEPENDS ${ARGN} "${FILE}")
endfunction()

set(generator "${COLLEKTIVE_JAVA_HOME}/bin/java" -XX:+UseSerialGC -XX:TieredStopAtLevel=1 -jar "${GENERATOR_JAR}" --flatc "${COLLEKTIVE_FLATC}"
  --include "${PROJECT_SOURCE_DIR}/schema")

# The runtime of FlatBuffers in its own namespace.
collektive_python(rename_flatbuffers build/rename_flatbuffers.py)
collektive_step(flatbuffers_code OUTPUT "${GENERATED}/flatbuffers.stamp"
  COMMAND ${rename_flatbuffers} "${GENERATED}/flatbuffers" "${COLLEKTIVE_BUILD}/flatbuffers/net/FlatBuffers"
  AND "${CMAKE_COMMAND}" -E touch "${GENERATED}/flatbuffers.stamp" DEPENDS scripts/build/rename_flatbuffers.py
  FOLDERS "${COLLEKTIVE_BUILD}/flatbuffers/net/FlatBuffers")

# Generated C# of frames and value types.
collektive_step(bridge_code OUTPUT "${GENERATED}/bridge.stamp"
  COMMAND "${CMAKE_COMMAND}" -E rm -rf "${GENERATED}/bridge"
  AND "${COLLEKTIVE_FLATC}" --csharp -o "${GENERATED}/bridge" "${PROJECT_SOURCE_DIR}/schema/types.fbs" "${PROJECT_SOURCE_DIR}/schema/frame.fbs"
  AND ${rename_flatbuffers} "${GENERATED}/bridge"
  AND "${CMAKE_COMMAND}" -E touch "${GENERATED}/bridge.stamp"
  DEPENDS "${COLLEKTIVE_FLATC}" scripts/build/rename_flatbuffers.py schema/types.fbs schema/frame.fbs)

library("${ROSLYN}/Newtonsoft.Json.dll")
# Part of Mono, but not on CoreCLR.
library(/usr/lib/mono/4.5/Mono.Posix.dll)
assembly(Collektive.FlatBuffers.dll SOURCES "${GENERATED}/flatbuffers"
  OPTIONS ${symbols} -warnaserror- -nowarn:1570,1572,1573,1587,1591,0618 -debug- DEPENDS "${GENERATED}/flatbuffers.stamp")
assembly(Collektive.Bridge.dll SOURCES "${UNITY}/Runtime/Bridge" "${GENERATED}/bridge" OPTIONS ${symbols} REFERENCES Collektive.FlatBuffers.dll
  DEPENDS "${GENERATED}/bridge.stamp")
assembly(UnityEngine.dll SOURCES "${HEADLESS}/UnityEngine" OPTIONS -unsafe+)
assembly(Collektive.Unity.dll SOURCES "${UNITY}/Runtime/Unity" REFERENCES Collektive.FlatBuffers.dll Collektive.Bridge.dll UnityEngine.dll)
set(package Collektive.FlatBuffers.dll Collektive.Bridge.dll UnityEngine.dll Collektive.Unity.dll)
assembly(Collektive.Player.exe SOURCES "${HEADLESS}/Player" "${HEADLESS}/Replay" REFERENCES ${package} Newtonsoft.Json.dll Mono.Posix.dll)
# The start of a run takes a quarter less processor time. Ticks take the same time as with the JIT compiler,
# except that sensors would take a sixth more time with a compiled Collektive.Unity.dll.
set(compiled Newtonsoft.Json.dll Collektive.FlatBuffers.dll Collektive.Bridge.dll UnityEngine.dll Collektive.Player.exe)
list(TRANSFORM compiled PREPEND "${CSHARP}/")
set(machine_code ${compiled})
list(POP_BACK machine_code)
list(TRANSFORM machine_code APPEND ".so")
collektive_step(player OUTPUT "${CSHARP}/Collektive.Player.exe.so" BYPRODUCTS ${machine_code} COMMAND ${csc} --machine-code ${compiled}
  DEPENDS ${compiled} scripts/build/csharp.py)

# generated_code(TARGET FOLDER SCHEMA...): generates the C# of each schema in a folder below FOLDER, named after the sample, the folder below
# build/generated, or the schema.
function(generated_code TARGET FOLDER)
  set(commands)
  foreach(schema ${ARGN})
    cmake_path(GET schema STEM name)
    if(schema MATCHES "/(Samples~|generated)/([^/]*)/")
      set(name "${CMAKE_MATCH_2}")
    endif()
    list(APPEND commands AND ${generator} --schema "${schema}" --csharp "${FOLDER}/${name}")
  endforeach()
  collektive_step(${TARGET} OUTPUT "${FOLDER}.stamp" COMMAND "${CMAKE_COMMAND}" -E rm -rf "${FOLDER}" ${commands}
    AND "${CMAKE_COMMAND}" -E touch "${FOLDER}.stamp" DEPENDS "${COLLEKTIVE_FLATC}" "${GENERATOR_JAR}" ${ARGN} FOLDERS "${PROJECT_SOURCE_DIR}/schema")
endfunction()

file(GLOB samples "${UNITY}/Samples~/*/*.fbs")
# Another commit may have other schemas.
file(GLOB folders "${UNITY}/Samples~" "${UNITY}/Samples~/*")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folders} "${PROJECT_SOURCE_DIR}/schema/test")
generated_code(sample_code "${GENERATED}/samples" ${samples})
assembly(Collektive.Samples.dll SOURCES "${UNITY}/Samples~" "${GENERATED}/samples" REFERENCES ${package} DEPENDS "${GENERATED}/samples.stamp")
generated_code(standard_code "${GENERATED}/standard" "${HEADLESS}/Standard/standard.fbs")
# Finds errors early: runs compile it like the scripts of any scenario.
assembly(Collektive.Standard.dll SOURCES "${HEADLESS}/Standard" "${GENERATED}/standard" REFERENCES ${package} Collektive.Player.exe
  DEPENDS "${GENERATED}/standard.stamp")
assembly(Collektive.SerializedFields.exe SOURCES "${HEADLESS}/SerializedFields" REFERENCES UnityEngine.dll)
assembly(SampleReplay.exe SOURCES "${HEADLESS}/SampleReplay" "${HEADLESS}/Replay" REFERENCES Newtonsoft.Json.dll Mono.Posix.dll)
assembly(Collektive.Headless.Bench.exe SOURCES "${HEADLESS}/Bench" "${HEADLESS}/Player/Quantiles.cs" "${GENERATED}/samples/GradientAscent"
  OPTIONS ${symbols} REFERENCES ${package} Newtonsoft.Json.dll DEPENDS "${GENERATED}/samples.stamp")
assembly(Collektive.Fuzz.exe SOURCES "${HEADLESS}/Fuzz" REFERENCES ${package} Collektive.Player.exe Newtonsoft.Json.dll)

# XML documentation for tests and the API reference, and the bridge as compiled for platforms without the shim.
set(documentation "${COLLEKTIVE_BUILD}/documentation")
collektive_step(documentation OUTPUT "${documentation}/stamp"
  COMMAND ${csc} --documentation "${documentation}/Bridge.xml" "${UNITY}/Runtime/Bridge" "${GENERATED}/bridge" -- ${symbols}
    "-r:${CSHARP}/Collektive.FlatBuffers.dll"
  AND ${csc} --documentation "${documentation}/Unity.xml" "${UNITY}/Runtime/Unity" --
    "-r:${CSHARP}/Collektive.FlatBuffers.dll" "-r:${CSHARP}/Collektive.Bridge.dll" "-r:${CSHARP}/UnityEngine.dll"
  AND "${CMAKE_COMMAND}" -E touch "${documentation}/stamp"
  DEPENDS scripts/build/csharp.py "${CSHARP}/Collektive.Unity.dll")
assembly(stubs/Collektive.Bridge.dll SOURCES "${UNITY}/Runtime/Bridge" "${GENERATED}/bridge" OPTIONS ${symbols} -define:UNITY_5_3_OR_NEWER
  REFERENCES Collektive.FlatBuffers.dll DEPENDS "${GENERATED}/bridge.stamp")

# Generated C# of the test schemas, and of a copy with sensor and actuator data swapped.
set(probe "${HEADLESS}/Tests/Simulation/Probe")
file(GLOB schemas "${PROJECT_SOURCE_DIR}/schema/test/*.fbs")
collektive_python(swap build/swap_data.py)
set(swapped "${GENERATED}/swapped/features.fbs")
collektive_step(swapped_data OUTPUT "${swapped}" COMMAND ${swap} "${GENERATED}/swapped" "${PROJECT_SOURCE_DIR}/schema/test/features.fbs"
  "${PROJECT_SOURCE_DIR}/schema/test/shared/cells.fbs" DEPENDS scripts/build/swap_data.py FOLDERS "${PROJECT_SOURCE_DIR}/schema/test")
generated_code(test_code "${GENERATED}/tests" "${probe}/probe.fbs" ${schemas} "${swapped}")

if(COLLEKTIVE_NUNIT)
  library("${COLLEKTIVE_NUNIT}")
  set(nunit "${COLLEKTIVE_NUNIT}")
  set(framework UnityEngine.TestRunner.dll ${nunit})
  set(editor UnityEditor.dll Collektive.Unity.Editor.dll)
  assembly(UnityEditor.dll SOURCES "${HEADLESS}/UnityEditor" REFERENCES UnityEngine.dll)
  assembly(Collektive.Unity.Editor.dll SOURCES "${UNITY}/Editor" REFERENCES ${package} UnityEditor.dll)
  assembly(Collektive.Headless.Tests.dll SOURCES "${HEADLESS}/Tests" "${GENERATED}/tests" OPTIONS ${symbols}
    REFERENCES ${package} ${editor} Collektive.Player.exe Newtonsoft.Json.dll ${nunit} DEPENDS "${GENERATED}/tests.stamp")
  assembly(UnityEngine.TestRunner.dll SOURCES "${HEADLESS}/TestFramework" REFERENCES UnityEngine.dll ${nunit})
  assembly(Collektive.TestRunner.exe SOURCES "${HEADLESS}/TestRunner" REFERENCES UnityEngine.dll ${framework})
  assembly(Collektive.Unity.Tests.dll SOURCES "${UNITY}/Tests/Runtime" REFERENCES ${package} ${framework})
  assembly(Collektive.Unity.PublicApi.Tests.dll SOURCES "${UNITY}/Tests/PublicApi" REFERENCES ${package} ${framework})
  assembly(Collektive.Unity.Editor.Tests.dll SOURCES "${UNITY}/Tests/Editor" REFERENCES ${package} ${editor} ${framework})
  assembly(Collektive.TwoEditors.exe SOURCES "${HEADLESS}/TwoEditors" REFERENCES ${package} ${editor})
  assembly(Collektive.WithoutLibrary.exe SOURCES "${HEADLESS}/WithoutLibrary" REFERENCES ${package} ${editor} Collektive.Headless.Tests.dll)
  assembly(Collektive.Faults.exe SOURCES "${HEADLESS}/Faults" REFERENCES ${package} Collektive.Headless.Tests.dll)
  assembly(Collektive.Soak.exe SOURCES "${HEADLESS}/Soak" REFERENCES ${package} Collektive.Headless.Tests.dll)
endif()
