#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#if defined(_WIN32)
#include <windows.h>

#include <direct.h>
#endif
#include "test.h"

const char *const host_classes = TEST_HOST_CLASSES;
const char *const host_jar = TEST_HOST_JAR;
const char *const incompatible_classes = TEST_INCOMPATIBLE_CLASSES;
int32_t placement = CLK_IN_PROCESS;
clk_slot request;
clk_memory request_memory = {.size = sizeof request_memory};
clk_answer answer = {.size = sizeof answer};

static _Thread_local uint64_t random_state = 1;

/* ---- Checks ---------------------------------------------------------------------------------------------------------- */

_Noreturn void fail(const char *file, int line, const char *what) {
    char text[4096];
    int32_t level;
    clk_last_error(text, sizeof text);
    fprintf(stderr, "%s:%d: %s\n  last error: %s\n", file, line, what, text);
    while (clk_log_read(&level, text, sizeof text) >= 0) fprintf(stderr, "  log %d: %s\n", level, text);
    fflush(NULL);
    _exit(1);
}

_Noreturn void skip(const char *reason) {
    printf("SKIPPED: %s\n", reason);
    fflush(NULL);
    _exit(77);
}

void check_code(const char *file, int line, const char *call, int32_t expected, const char *mention, int32_t got) {
    char text[4096];
    char what[8192];
    clk_last_error(text, sizeof text);
    if (got == expected && (mention == NULL || strstr(text, mention) != NULL)) {
        if (mention != NULL) printf("%s: %s\n", clk_error_name(got), text);
        return;
    }
    snprintf(what, sizeof what, "%s returned %s instead of %s%s%s", call, clk_error_name(got), clk_error_name(expected),
             mention != NULL ? " with " : "", mention != NULL ? mention : "");
    fail(file, line, what);
}

/* ---- Paths ---------------------------------------------------------------------------------------------------------- */

/* Returns the value of CLK_TEST_JAVA_HOME in UTF-8, or NULL if the variable is not set. */
static const char *named_java_home(void) {
#if defined(_WIN32)
    static char home[4096];
    const wchar_t *wide = _wgetenv(L"CLK_TEST_JAVA_HOME");
    return wide != NULL && WideCharToMultiByte(CP_UTF8, 0, wide, -1, home, sizeof home, NULL, NULL) > 0 ? home : NULL;
#else
    return getenv("CLK_TEST_JAVA_HOME");
#endif
}

const char *own_or(const char *own, const char *in_process) { return placement == CLK_OWN_PROCESS ? own : in_process; }

const char *java_home(void) {
    const char *named = named_java_home();
    return named != NULL ? named : TEST_JAVA_HOME;
}

bool java_is_17(void) {
    char path[4096];
    char line[256];
    bool is_17 = false;
    snprintf(path, sizeof path, "%s/release", java_home());
    FILE *file = fopen(path, "r");
    CHECK(file != NULL);
    while (fgets(line, sizeof line, file) != NULL) is_17 |= strncmp(line, "JAVA_VERSION=\"17", 16) == 0;
    fclose(file);
    return is_17;
}

static bool make_path(const char *path) {
#if defined(_WIN32)
    return _mkdir(path) == 0;
#else
    return mkdir(path, 0755) == 0;
#endif
}

void make_folder(const char *folder, const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    CHECK(make_path(path));
}

const char *scratch_folder(void) {
    static char path[64];
    int64_t number = now_ns();
    do {
        snprintf(path, sizeof path, "scratch-%d-%lld", (int)getpid(), (long long)number++);
    } while (!make_path(path) && errno == EEXIST);
    return path;
}

/* ---- The JVM --------------------------------------------------------------------------------------------------------- */

static clk_jvm_config config_of(const char *home, const char *class_path, const char *const *options, bool check_options,
                                int32_t limit_ms) {
    clk_jvm_config config = {.size = sizeof config,
                             .home = home,
                             .class_path = class_path,
                             .options = options,
                             .start_limit_ms = limit_ms,
                             .check_options = check_options,
                             .placement = placement};
    while (options != NULL && options[config.option_count] != NULL) config.option_count++;
    return config;
}

int32_t start_at(const char *home, const char *class_path, const char *const *options, bool check_options, int32_t limit_ms) {
    clk_jvm_config config = config_of(home, class_path, options, check_options, limit_ms);
    return clk_jvm_start(&config);
}

int32_t check(const char *const *options) {
    clk_jvm_config config = config_of(java_home(), host_classes, options, true, 60000);
    return clk_jvm_check(&config);
}

int32_t check_texts(const char *const *options) {
    clk_jvm_config config = config_of(java_home(), host_classes, options, false, 60000);
    return clk_jvm_check(&config);
}

int32_t start(const char *const *options) { return start_at(java_home(), host_classes, options, true, 60000); }

void start_plain(void) {
    CHECK_OK(start_at(java_home(), host_classes, (const char *const[]){"-Xmx64m", NULL}, false, 60000));
    CHECK_OK(clk_slot_acquire(1 << 20, &request, &request_memory));
}

static void write_request(enum command command, int32_t argument) {
    int32_t words[] = {(int32_t)command, argument};
    memcpy(request_memory.address, words, sizeof words);
}

int32_t open_with(clk_session *session, enum command command, int32_t argument) {
    write_request(command, argument);
    return clk_session_open(request, 0, 8, 60000, session, &answer);
}

int32_t open_session(clk_session *session) { return open_with(session, EMPTY, 0); }

int32_t step(clk_session session, enum command command, int32_t argument, int32_t limit_ms) {
    write_request(command, argument);
    return clk_step(session, request, 0, 8, limit_ms, &answer);
}

/* ---- Utilities ---------------------------------------------------------------------------------------------------- */

/* The generator SplitMix64. */
uint64_t random_next(void) {
    uint64_t z = random_state += 0x9E3779B97F4A7C15;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
    z = (z ^ z >> 27) * 0x94D049BB133111EB;
    return z ^ z >> 31;
}

void random_seed(uint64_t seed) { random_state = seed; }

int64_t now_ns(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

void sleep_ms(int ms) { nanosleep(&(struct timespec){.tv_nsec = ms * 1000000L}, NULL); }

/* Returns the processor time of this process. On Windows, clock() would return the wall time. */
static int64_t processor_ms(void) {
#if defined(_WIN32)
    FILETIME started, ended, kernel, user;
    GetProcessTimes(GetCurrentProcess(), &started, &ended, &kernel, &user);
    return (int64_t)((uint64_t)kernel.dwLowDateTime + user.dwLowDateTime) / 10000;
#else
    return (int64_t)clock() / (int64_t)(CLOCKS_PER_SEC / 1000);
#endif
}

void check_threads_stand_still(void) {
    int64_t begin = processor_ms();
    sleep_ms(500);
    CHECK(processor_ms() - begin < 100);
}

clk_stats stats(void) {
    clk_stats now = {.size = sizeof now};
    CHECK_OK(clk_get_stats(&now));
    return now;
}

bool log_mentions(const char *text) {
    char line[8192];
    int32_t level;
    while (clk_log_read(&level, line, sizeof line) >= 0) {
        if (strstr(line, text) != NULL) return true;
    }
    return false;
}

int main(int argument_count, char **arguments) {
    static const struct {
        const char *name;
        void (*run)(void);
    } cases[] = {
#define CASE_ENTRY(name) {#name, name},
        CASES(CASE_ENTRY) CASE_ENTRY(bench) CASE_ENTRY(fuzz) CASE_ENTRY(parent)
#undef CASE_ENTRY
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (argument_count >= 2 && strcmp(arguments[1], cases[i].name) == 0) {
            if (argument_count == 3 && strcmp(arguments[2], "own") == 0) placement = CLK_OWN_PROCESS;
            /* The first start in a separate process makes slots use shared memory. */
            if (placement == CLK_OWN_PROCESS && strncmp(cases[i].name, "slot", 4) == 0) CHECK_OK(start(NULL));
            cases[i].run();
            fflush(NULL);
            /* exit() is not possible, because threads of a lost JVM are still running. */
            _exit(0);
        }
    }
    fprintf(stderr, "usage: shim_test CASE | bench | fuzz [own]; the cases are in test.h\n");
    return 2;
}
