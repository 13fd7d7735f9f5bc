# CMake toolchain file for cross-compiling with zig. COLLEKTIVE_ZIG is the path of zig, and COLLEKTIVE_TARGET is zig's name for the target platform.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES COLLEKTIVE_ZIG COLLEKTIVE_TARGET)
if(COLLEKTIVE_TARGET MATCHES windows)
  set(CMAKE_SYSTEM_NAME Windows)
elseif(COLLEKTIVE_TARGET MATCHES macos)
  set(CMAKE_SYSTEM_NAME Darwin)
else()
  set(CMAKE_SYSTEM_NAME Linux)
endif()
string(REGEX REPLACE "-.*" "" CMAKE_SYSTEM_PROCESSOR "${COLLEKTIVE_TARGET}")
set(CMAKE_C_COMPILER "${COLLEKTIVE_ZIG}" cc -target "${COLLEKTIVE_TARGET}")
set(CMAKE_CXX_COMPILER "${COLLEKTIVE_ZIG}" c++ -target "${COLLEKTIVE_TARGET}")
# Libraries are found on the build machine.
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY NEVER)
