# flatc, the shim with its tests, and the physics of the headless player.
set(COLLEKTIVE_FLATBUFFERS "${COLLEKTIVE_BUILD}/flatbuffers")
set(FLATBUFFERS_BUILD_TESTS OFF)
set(FLATBUFFERS_BUILD_FLATLIB OFF)
set(FLATBUFFERS_BUILD_FLATHASH OFF)
set(FLATBUFFERS_INSTALL OFF)
block()
  # flatc runs for milliseconds, so a fast build matters more than fast code.
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O0")
  add_subdirectory("${COLLEKTIVE_FLATBUFFERS}" flatbuffers EXCLUDE_FROM_ALL)
endblock()
set(COLLEKTIVE_FLATC "${COLLEKTIVE_BUILD}/flatc")
set_target_properties(flatc PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${COLLEKTIVE_BUILD}")

add_subdirectory(native-shim)

set(COLLEKTIVE_PHYSX "${COLLEKTIVE_BUILD}/physx")
add_subdirectory("unity/Headless~/NativePhysics" physics EXCLUDE_FROM_ALL)
# Mono looks for native libraries beside the assembly that calls them.
set_target_properties(collektive_physics PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${COLLEKTIVE_BUILD}/csharp")
