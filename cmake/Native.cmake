# The shim with its tests, and the physics and SQLite of the headless player.
add_subdirectory(native-shim)

set(COLLEKTIVE_PHYSX "${COLLEKTIVE_BUILD}/physx")
add_subdirectory("unity/Headless~/NativePhysics" physics EXCLUDE_FROM_ALL)
# Mono looks for native libraries beside the assembly that calls them.
set_target_properties(collektive_physics PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${COLLEKTIVE_BUILD}/csharp")

# The case study without the player, for `./collektive bench scene`.
find_package(Threads REQUIRED)
add_executable(case_study EXCLUDE_FROM_ALL "unity/Headless~/NativePhysics/bench/case_study.c" $<TARGET_OBJECTS:collektive_neighbours>
  $<TARGET_OBJECTS:collektive_prim>)
target_include_directories(case_study PRIVATE native-shim/include native-shim/src)
target_compile_options(case_study PRIVATE -O3)
target_link_libraries(case_study PRIVATE collektive_flags collektive_physics Threads::Threads ${CMAKE_DL_LIBS} m)
set_target_properties(case_study PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${COLLEKTIVE_BUILD}/bench")

# Metrics are SQL, possibly untrusted, so extensions, other databases and files are disabled.
add_library(collektive_sqlite SHARED EXCLUDE_FROM_ALL "unity/Headless~/NativeSqlite/insert.c" "${COLLEKTIVE_BUILD}/sqlite/sqlite3.c")
target_include_directories(collektive_sqlite SYSTEM PRIVATE "${COLLEKTIVE_BUILD}/sqlite")
target_compile_definitions(collektive_sqlite PRIVATE SQLITE_DQS=0 SQLITE_THREADSAFE=0 SQLITE_TEMP_STORE=3 SQLITE_MAX_ATTACHED=0
  SQLITE_OMIT_LOAD_EXTENSION SQLITE_OMIT_JSON SQLITE_OMIT_DEPRECATED SQLITE_ENABLE_MATH_FUNCTIONS SQLITE_ENABLE_PERCENTILE)
# No contraction of a*b+c: values are the same on processors with and without fused multiply-add.
target_compile_options(collektive_sqlite PRIVATE -ffp-contract=off)
# Debug information makes this compilation a third longer.
set_source_files_properties("${COLLEKTIVE_BUILD}/sqlite/sqlite3.c" PROPERTIES COMPILE_OPTIONS "-w;-g0")
set_source_files_properties("unity/Headless~/NativeSqlite/insert.c" PROPERTIES COMPILE_OPTIONS "-std=c11;-Wall;-Wextra;-Werror")
target_link_libraries(collektive_sqlite PRIVATE m)
set_target_properties(collektive_sqlite PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${COLLEKTIVE_BUILD}/csharp")
