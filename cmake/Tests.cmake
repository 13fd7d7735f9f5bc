# The test suites. Each is a CTest test and writes JUnit XML to build/results/NAME, which `./collektive test` adds up.
include(Suite)

# LD_PRELOAD library that makes one system call fail.
collektive_step(failing OUTPUT "${COLLEKTIVE_BUILD}/failing.so"
  COMMAND "${CMAKE_C_COMPILER}" -std=gnu11 -O1 -Wall -Wextra -Werror -shared -fPIC -o "${COLLEKTIVE_BUILD}/failing.so" "${SCRIPTS}/tests/chaos/failing.c"
  DEPENDS "${SCRIPTS}/tests/chaos/failing.c")
set(csharp_needs build:runtime)
if(COLLEKTIVE_NUNIT)
  add_custom_target(csharp_tests DEPENDS Collektive.Headless.Tests.dll Collektive.Samples.dll Collektive.TestRunner.exe Collektive.Unity.Tests.dll
    Collektive.Unity.PublicApi.Tests.dll Collektive.Unity.Editor.Tests.dll Collektive.TwoEditors.exe Collektive.WithoutLibrary.exe
    Collektive.Faults.exe Collektive.Soak.exe nunit.framework.dll stubs-Collektive.Bridge.dll documentation sample_programs)
  list(APPEND csharp_needs build:csharp_tests)
  set(runner build:Collektive.TestRunner.exe build:nunit.framework.dll)
endif()
# A host jar of an incompatible version.
set(incompatible "${CMAKE_BINARY_DIR}/native-shim/test/incompatible")
collektive_step(incompatible_host OUTPUT "${COLLEKTIVE_BUILD}/incompatible-host.jar"
  COMMAND "${COLLEKTIVE_JAVA_HOME}/bin/jar" --create --file "${COLLEKTIVE_BUILD}/incompatible-host.jar" -C "${incompatible}" .
  DEPENDS shim_test_hosts "${incompatible}/stamp")
assembly(TestSchemas.dll SOURCES "${GENERATED}/tests" OPTIONS ${symbols} REFERENCES ${package} DEPENDS "${GENERATED}/tests.stamp")
set(schema "${HEADLESS}/Tests/Schema")
assembly(RoundTrip.exe SOURCES "${schema}/Dump.cs" "${schema}/RandomData.cs" "${schema}/RoundTrip.cs"
  REFERENCES ${package})
add_custom_target(roundtrip DEPENDS TestSchemas.dll RoundTrip.exe)

suite(lint lint LABELS quick all NEEDS setup:npm setup:ktlint setup:prose PYTEST "${SCRIPTS}/checks/test_lint.py" -m "not slow" -n 2)
suite(workflows lint LABELS extra NEEDS setup:go PYTEST "${SCRIPTS}/checks/test_lint.py" -m slow)
suite(scripts scripts LABELS quick all UNLOCKED PYTEST "${SCRIPTS}/tests/scripts" "--ignore=${SCRIPTS}/tests/scripts/test_maven.py" -n 2)
suite(maven scripts LABELS extra NEEDS build:jvm_tests UNLOCKED PYTEST "${SCRIPTS}/tests/scripts/test_maven.py" -n 2)
suite(jvm jvm LABELS all NEEDS build:jvm_tests TIMEOUT 1800 PARALLEL SCRIPT jvm.py RESULTS -DexcludedGroups=repeats)
suite(jvm-repeats jvm LABELS extra NEEDS build:jvm_tests SCRIPT jvm.py RESULTS -Dgroups=repeats)
suite(jvm-quick jvm LABELS quick NEEDS build:jvm_tests
  SCRIPT jvm.py RESULTS -DexcludedGroups=slow,repeats "-Dtest.jvm.flags=-XX:+UseSerialGC -XX:TieredStopAtLevel=1 -XX:ReservedCodeCacheSize=128m")
# Takes under a minute on two idle processors, with the server compiler only, one fork and about 100,000 attempts of each race. Pool threads must
# not inherit the processor to which jcstress pins an actor.
suite(stress stress LABELS all NEEDS build:jvm_modules
  SCRIPT stress.py RESULTS/stress.xml -f 1 -fsm 1 -iters 3 -time 200 -sc false -af NONE -jvmArgs -XX:-TieredCompilation)

# A run of all suites tests the shim and C# in process on the newest JDK, and C# with the JVM in its own process on the oldest.
list(GET COLLEKTIVE_TEST_JDKS 0 oldest)
list(GET COLLEKTIVE_TEST_JDKS -1 newest)
set(usual mono-sgen --without Slow --without Repeats)
foreach(jdk ${COLLEKTIVE_TEST_JDKS})
  cmake_path(GET jdk FILENAME name)
  # A run of all suites includes slow tests only on the newest JDK.
  set(labels all)
  set(slow extra)
  if(jdk STREQUAL newest)
    set(labels quick all)
    set(slow all)
  endif()
  set(in_process ${labels})
  set(own_process extra)
  if(jdk STREQUAL oldest)
    set(own_process all)
    if(NOT jdk STREQUAL newest)
      set(in_process extra)
    endif()
  endif()
  set(shim ctest --test-dir "${CMAKE_BINARY_DIR}/native-shim" --output-on-failure -j 2 --output-junit RESULTS/shim.xml)
  set(java_home ENVIRONMENT "CLK_TEST_JAVA_HOME=${jdk}")
  suite(shim-on-${name} shim LABELS ${in_process} NEEDS build:shim_test ${java_home} COMMAND ${shim} -LE slow)
  suite(shim-slow-on-${name} shim LABELS ${slow} NEEDS build:shim_test PARALLEL ${java_home} COMMAND ${shim} -L slow)
  suite(sanitized-on-${name} sanitized LABELS extra NEEDS build:sanitized TIMEOUT 1800 ${java_home}
    COMMAND ctest --test-dir "${COLLEKTIVE_BUILD}/sanitized" --output-on-failure -j 2 --output-junit RESULTS/shim.xml)
  suite(csharp-on-${name} csharp LABELS ${in_process} NEEDS ${csharp_needs} NUNIT PARALLEL SCRIPT csharp.py RESULTS "${jdk}" ${usual})
  suite(csharp-own-process-on-${name} csharp LABELS ${own_process} NEEDS ${csharp_needs} NUNIT PARALLEL ENVIRONMENT "COLLEKTIVE_TEST_PLACEMENT=OwnProcess"
    SCRIPT csharp.py RESULTS "${jdk}" ${usual})
  suite(csharp-debugger-on-${name} csharp LABELS ${slow} NEEDS ${csharp_needs} NUNIT PARALLEL SCRIPT csharp.py RESULTS "${jdk}" mono-sgen --only Debugger)
  # These tests measure durations, which suites in parallel would distort.
  suite(csharp-slow-on-${name} csharp LABELS ${slow} NEEDS ${csharp_needs} NUNIT SCRIPT csharp.py RESULTS "${jdk}" mono-sgen --only Slow --without Repeats)
endforeach()
# These suites include all repetitions. On CoreCLR, hashes need OpenSSL 1.1. Time limits need Mono.
set(coreclr csharp.py RESULTS "${newest}" coreclr --without Mono)
suite(csharp-on-coreclr csharp LABELS extra NEEDS ${csharp_needs} NUNIT PARALLEL SCRIPT ${coreclr} --without Slow)
suite(csharp-slow-on-coreclr csharp LABELS extra NEEDS ${csharp_needs} NUNIT PARALLEL SCRIPT ${coreclr} --only Slow)
suite(unity csharp LABELS quick all NEEDS ${csharp_needs} NUNIT PARALLEL SCRIPT unity.py RESULTS)
add_custom_target(sanitized
  COMMAND "${CMAKE_COMMAND}" -S "${PROJECT_SOURCE_DIR}/native-shim" -B "${COLLEKTIVE_BUILD}/sanitized" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo
    -DCOLLEKTIVE_SANITIZE=ON "-DCOLLEKTIVE_JAVA_HOME=${COLLEKTIVE_JAVA_HOME}"
  COMMAND "${CMAKE_COMMAND}" --build "${COLLEKTIVE_BUILD}/sanitized" VERBATIM)

suite(platforms platforms LABELS all NEEDS build:runtime build:jvm_modules setup:zig setup:platforms TIMEOUT 1800 UNLOCKED PARALLEL
  SCRIPT platforms/run.py RESULTS --short linux-arm64)
suite(platforms-all platforms LABELS extra NEEDS build:runtime build:jvm_modules setup:zig setup:platforms TIMEOUT 3600 UNLOCKED
  SCRIPT platforms/run.py RESULTS win-x64 linux-x64 linux-arm64 mac-x64 mac-arm64)
suite(assets assets LABELS quick all NEEDS build:Collektive.SerializedFields.exe build:Collektive.Samples.dll PARALLEL PYTEST "${SCRIPTS}/checks/validator")
suite(faults faults LABELS all NEEDS ${csharp_needs} build:incompatible_host NUNIT PARALLEL SCRIPT faults/faults.py --results RESULTS/faults.xml)
suite(exits exits LABELS all NEEDS ${csharp_needs} NUNIT PARALLEL SCRIPT faults/exits.py 1 --results RESULTS/exits.xml)
suite(soak soak LABELS all NEEDS ${csharp_needs} NUNIT PARALLEL SCRIPT soak.py 0.4 results=RESULTS/soak.xml)
suite(roundtrip roundtrip LABELS all NEEDS build:roundtrip build:jvm_tests PARALLEL PYTEST "${PROJECT_SOURCE_DIR}/schema/test")
suite(page page LABELS all NEEDS build:runtime build:replay_page build:SampleReplay.exe UNLOCKED PARALLEL SCRIPT pages.py page RESULTS)
suite(live page LABELS all NEEDS build:runtime build:replay_page setup:live UNLOCKED SCRIPT pages.py live RESULTS)
suite(site site LABELS extra NEEDS build:runtime build:documentation setup:site-tools UNLOCKED PARALLEL SCRIPT pages.py site RESULTS)

set(acceptance NEEDS setup:junit build:runtime build:sample_code build:jvm_modules build:replay_page build:failing ${runner} UNLOCKED TIMEOUT 1800
  PYTEST "${SCRIPTS}/tests/acceptance")
suite(acceptance-quick acceptance LABELS quick all ${acceptance} -m quick -n 2)
suite(acceptance-alone acceptance LABELS all ${acceptance} -m "alone and not quick")
suite(acceptance-rest acceptance LABELS all ${acceptance} -m "not alone and not quick and not slow" -n 3)
suite(acceptance-slow acceptance LABELS extra ${acceptance} -m slow -n 2)

set(experiments "${PROJECT_SOURCE_DIR}/experiments/tests")
set(experiments_tests build:runtime build:failing setup:experiments-tests setup:tune UNLOCKED
  SCRIPT experiments.py --junitxml RESULTS/pytest.xml)
set(one_machine "${experiments}" "--ignore=${experiments}/test_cluster.py" -n 3)
suite(experiments experiments LABELS all TIMEOUT 1800 NEEDS ${experiments_tests} ${one_machine} -m "not slow")
suite(experiments-slow experiments LABELS extra NEEDS ${experiments_tests} ${one_machine} -m slow)
suite(ray experiments LABELS extra NEEDS setup:ray ${experiments_tests} "${experiments}/test_cluster.py")
suite(chaos chaos LABELS all NEEDS build:runtime build:replay_page build:failing UNLOCKED PARALLEL
  SCRIPT chaos/chaos.py 3 2 2 1 6 --results RESULTS/chaos.xml)
# Corpora and random inputs of the other fuzzers are cases of the suites jvm, roundtrip and shim.
suite(fuzz fuzz LABELS all NEEDS build:runtime build:Collektive.Fuzz.exe SCRIPT fuzz.py 5 RESULTS/scenario.xml)
suite(bench bench LABELS all NEEDS build:runtime build:jvm_modules build:Collektive.Headless.Bench.exe UNLOCKED PARALLEL
  PYTEST "${SCRIPTS}/tests/bench")
suite(gradle gradle LABELS all NEEDS build:jvm_modules UNLOCKED TIMEOUT 3600 PYTEST "${SCRIPTS}/tests/gradle")
