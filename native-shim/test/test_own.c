/* Tests of the JVM in its own process: the child or the parent ends unexpectedly, or a start fails. They run only as `shim_test CASE own`. */
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "test.h"
#if defined(_WIN32)
#include <windows.h>

#include "prim.h"
void own_without_resources(void) { skip("Windows has no POSIX resource limits"); }
void own_without_processes(void) { skip("Windows has no POSIX resource limits"); }
void own_out_of_memory(void) { skip("Windows has no POSIX resource limits"); }
void own_needs_no_shared_memory_folder(void) { skip("the folder /dev/shm exists only on Linux"); }
void own_continues_after_a_suspension(void) { skip("Windows has no signals to suspend a process"); }

static DWORD handles(void) {
    DWORD count = 0;
    CHECK(GetProcessHandleCount(GetCurrentProcess(), &count));
    return count;
}

static DWORD WINAPI kill_later(void *unused) {
    (void)unused;
    HANDLE process = OpenProcess(PROCESS_TERMINATE, FALSE, (DWORD)stats().process);
    sleep_ms((int)(random_next() % 30));
    CHECK(process != NULL && TerminateProcess(process, 9) && CloseHandle(process));
    return 0;
}

static void join(HANDLE thread) { CHECK(thread != NULL && WaitForSingleObject(thread, 10000) == WAIT_OBJECT_0 && CloseHandle(thread)); }

void own_survives_kills(void) {
    DWORD before = 0;
    for (int i = 0; i < 8; i++) {
        clk_session session;
        int32_t result = CLK_OK;
        CHECK_OK(start_at(java_home(), host_classes, OPTIONS("-Xmx64m", "-XX:ErrorFile=NUL"), false, 60000));
        if (i == 0) CHECK_OK(clk_slot_acquire(1 << 20, &request, &request_memory));
        CHECK_OK(open_session(&session));
        HANDLE killer = i % 4 < 3 ? CreateThread(NULL, 0, kill_later, NULL, 0, NULL) : NULL;
        if (killer == NULL) result = step(session, CRASH, 0, 60000);
        for (int n = 0; result == CLK_OK; n++) result = n % 3 == 0 ? step(session, GROW, 1 << 12, 60000) : step(session, LOG, 3, 60000);
        CHECK(result == CLK_JVM_LOST && clk_jvm_state() == CLK_STATE_LOST);
        CHECK_CODE(CLK_JVM_LOST, "start it again", step(session, EMPTY, 0, 1000));
        if (killer != NULL) join(killer);
        while (clk_log_read(NULL, NULL, 0) >= 0) {
        }
        if (i == 3) before = handles();
        CHECK(i <= 3 || handles() <= before);
    }
    CHECK_OK(start(NULL));
    CHECK_OK(clk_jvm_stop(60000));
    CHECK(stats().slots == 1 && stats().sessions == 0);
}

void own_reports_its_death_at_once(void) {
    clk_session session;
    start_plain();
    CHECK_OK(open_session(&session));
    HANDLE killer = CreateThread(NULL, 0, kill_later, NULL, 0, NULL);
    int64_t begin = now_ns();
    CHECK_CODE(CLK_JVM_LOST, "exit code 9", step(session, SLEEP, 30000, 60000));
    CHECK(now_ns() - begin < 2000000000);
    join(killer);
}

void parent(void) {
    placement = CLK_OWN_PROCESS;
    CHECK_OK(start(NULL));
    printf("%lu %d\n", GetCurrentProcessId(), stats().process);
    fflush(stdout);
    for (;;) sleep_ms(900);
}

void own_ends_with_its_parent(void) {
    char self[MAX_PATH], command[MAX_PATH + 16];
    unsigned long process = 0, jvm = 0;
    CHECK(GetModuleFileNameA(NULL, self, sizeof self) > 0);
    snprintf(command, sizeof command, "\"%s\" parent", self);
    FILE *output = _popen(command, "r");
    CHECK(output != NULL && fscanf(output, "%lu %lu", &process, &jvm) == 2);
    HANDLE parent = OpenProcess(PROCESS_TERMINATE, FALSE, process), child = OpenProcess(SYNCHRONIZE, FALSE, jvm);
    CHECK(parent != NULL && child != NULL && TerminateProcess(parent, 1));
    CHECK(WaitForSingleObject(child, 1000) == WAIT_OBJECT_0);
}

static void write_file(const char *home, const char *name, const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", home, name);
    FILE *file = fopen(path, "wb");
    CHECK(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0);
}

void own_with_a_bad_launcher(void) {
    char java[128], system[MAX_PATH], shell[MAX_PATH + 16];
    const char *home = scratch_folder();
    make_folder(home, "bin");
    make_folder(home, "bin/server");
    make_folder(home, "lib");
    write_file(home, PRIM_LIBJVM, "");
    write_file(home, "lib/modules", "");
    CHECK_CODE(CLK_JVM_NOT_FOUND, "java.exe is missing", start_at(home, host_classes, NULL, false, 10000));
    write_file(home, PRIM_JAVA, "not a program");
    CHECK_CODE(CLK_JVM_START, "cannot run", start_at(home, host_classes, NULL, false, 10000));
    /* The launcher is a program that prints something else and exits. */
    CHECK(GetSystemDirectoryA(system, sizeof system) > 0);
    snprintf(shell, sizeof shell, "%s\\cmd.exe", system);
    snprintf(java, sizeof java, "%s/" PRIM_JAVA, home);
    CHECK(CopyFileA(shell, java, FALSE));
    CHECK_CODE(CLK_JVM_START, "exit code", start_at(home, host_classes, NULL, false, 10000));
    CHECK(clk_jvm_state() == CLK_STATE_NONE);
    CHECK_OK(start(NULL));
}
#else
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include "prim.h"

extern char **environ;

/* Returns the process id of the JVM, which is the only child of this process, or 0 if this process has no child. */
static pid_t jvm_process(void) {
    char path[300], line[64];
    pid_t found = 0;
    DIR *tasks = opendir("/proc/self/task");
    CHECK(tasks != NULL);
    for (struct dirent *task; (task = readdir(tasks)) != NULL;) {
        snprintf(path, sizeof path, "/proc/self/task/%s/children", task->d_name);
        FILE *children = task->d_name[0] != '.' ? fopen(path, "r") : NULL;
        if (children == NULL) continue;
        if (fgets(line, sizeof line, children) != NULL && line[0] != '\0') found = (pid_t)strtol(line, NULL, 10);
        fclose(children);
    }
    closedir(tasks);
    return found;
}

static int descriptors(void) {
    int count = 0;
    for (int i = 0; i < 64; i++) count += fcntl(i, F_GETFD) >= 0;
    return count;
}

/* Returns whether the process ends within the limit. A zombie that has not been reaped counts as ended. */
static bool ends_within(pid_t process, int limit_ms) {
    char path[64], line[256];
    for (int64_t end = now_ns() + limit_ms * 1000000L;;) {
        snprintf(path, sizeof path, "/proc/%d/stat", (int)process);
        FILE *status = fopen(path, "r");
        if (status == NULL) return true;
        bool zombie = fgets(line, sizeof line, status) == NULL || strstr(line, ") Z ") != NULL;
        fclose(status);
        if (zombie) return true;
        if (now_ns() > end) return false;
        sleep_ms(1);
    }
}

static void start_own(void) {
    CHECK_OK(start_at(java_home(), host_classes, OPTIONS("-Xmx64m", "-XX:ErrorFile=/dev/null", "-Dtest.overflow=" TEST_OVERFLOW_LIBRARY),
                      false, 60000));
}

/* ---- Termination of the child --------------------------------------------------------------------------------------------- */

static void *kill_later(void *signal) {
    int wait = (int)(random_next() % 30);
    sleep_ms(wait);
    CHECK(kill(jvm_process(), (int)(intptr_t)signal) == 0);
    return NULL;
}

/* Steps until the JVM is lost, by a signal (0 to 3), by a crash (4, 5) or by a suspension (6). */
static void lose(clk_session session, int way) {
    static const int signals[] = {SIGKILL, SIGSEGV, SIGABRT, SIGTERM};
    pthread_t killer;
    int32_t result = CLK_OK;
    if (way < 4) {
        CHECK(pthread_create(&killer, NULL, kill_later, (void *)(intptr_t)signals[way]) == 0);
        for (uint64_t i = 0; result == CLK_OK; i++)
            result = i % 3 == 0 ? step(session, GROW, 1 << 12, 60000) : step(session, LOG, 3, 60000);
        CHECK(pthread_join(killer, NULL) == 0);
    } else if (way < 6) {
        result = step(session, way == 4 ? CRASH : OVERFLOW_NATIVELY, 0, 60000);
    } else {
        CHECK(kill(jvm_process(), SIGSTOP) == 0);
        while (result == CLK_OK) result = step(session, EMPTY, 0, 1); /* a few steps may still succeed before the signal arrives */
    }
    CHECK(result == CLK_JVM_LOST && clk_jvm_state() == CLK_STATE_LOST);
    CHECK_CODE(CLK_JVM_LOST, "start it again", step(session, EMPTY, 0, 1000));
}

/* CLK_TEST_KILLS sets the number of losses. Only every fiftieth child is suspended, because each takes the grace period of 10 s. */
void own_survives_kills(void) {
    const char *count = getenv("CLK_TEST_KILLS");
    int before = 0, kills = count != NULL ? atoi(count) : 12;
    uint64_t bytes = 0;
    for (int i = 0; i < kills; i++) {
        clk_session session;
        start_own();
        if (i == 0) CHECK_OK(clk_slot_acquire(1 << 20, &request, &request_memory));
        CHECK_OK(open_session(&session));
        lose(session, i % 50 == 49 ? 6 : i % 6);
        while (clk_log_read(NULL, NULL, 0) >= 0) {
        }
        if (i == 6) before = descriptors();
        if (i == 6) bytes = stats().slot_bytes;
        CHECK(i <= 6 || (stats().slot_bytes == bytes && descriptors() == before));
    }
    start_own();
    CHECK_OK(clk_jvm_stop(60000));
    CHECK(jvm_process() == 0 && waitpid(-1, NULL, WNOHANG) == -1 && errno == ECHILD);
    CHECK(stats().slots == 1 && stats().sessions == 0);
}

void own_reports_its_death_at_once(void) {
    clk_session session;
    pthread_t killer;
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK(pthread_create(&killer, NULL, kill_later, (void *)(intptr_t)SIGKILL) == 0);
    int64_t begin = now_ns();
    CHECK_CODE(CLK_JVM_LOST, "signal 9", step(session, SLEEP, 30000, 60000));
    CHECK(now_ns() - begin < 2000000000 && pthread_join(killer, NULL) == 0);
    /* The JVM may also be killed between two calls. */
    CHECK_OK(start(NULL));
    CHECK(kill(jvm_process(), SIGTERM) == 0);
    while (clk_jvm_state() == CLK_STATE_RUNNING) sleep_ms(1);
    CHECK_CODE(CLK_JVM_LOST, "signal 15", open_session(&session));
}

/* Time of the suspension, which CLK_TEST_SUSPENDED_MS sets. It is shorter than the limit of the call. */
static int suspended_ms;

static void *suspend(void *unused) {
    (void)unused;
    pid_t process = jvm_process();
    CHECK(kill(process, SIGSTOP) == 0);
    for (int left = suspended_ms; left > 0; left -= 100) sleep_ms(100);
    CHECK(kill(process, SIGCONT) == 0);
    return NULL;
}

void own_continues_after_a_suspension(void) {
    const char *time = getenv("CLK_TEST_SUSPENDED_MS");
    clk_session session;
    pthread_t suspender;
    suspended_ms = time != NULL ? atoi(time) : 2000;
    start_plain();
    CHECK_OK(open_session(&session));
    int64_t begin = now_ns();
    CHECK(pthread_create(&suspender, NULL, suspend, NULL) == 0);
    CHECK_OK(step(session, SLEEP, 500, 600000));
    CHECK(pthread_join(suspender, NULL) == 0 && now_ns() - begin > suspended_ms * 1000000L);
    CHECK_OK(step(session, GROW, 1 << 20, 60000));
}

/* ---- Death of the parent --------------------------------------------------------------------------------------------- */

void parent(void) {
    placement = CLK_OWN_PROCESS;
    start_own();
    printf("%d\n", (int)jvm_process());
    fflush(stdout);
    for (;;) sleep_ms(900);
}

/* CLK_TEST_KILLS sets the number of parents. Every second child is suspended. */
void own_ends_with_its_parent(void) {
    const char *count = getenv("CLK_TEST_KILLS");
    static char self[4096];
    char line[32];
    CHECK(readlink("/proc/self/exe", self, sizeof self - 1) > 0);
    for (int i = 0, kills = count != NULL ? atoi(count) : 6; i < kills; i++) {
        int ends[2];
        pid_t process;
        posix_spawn_file_actions_t actions;
        CHECK(pipe(ends) == 0 && fcntl(ends[0], F_SETFD, FD_CLOEXEC) == 0 && fcntl(ends[1], F_SETFD, FD_CLOEXEC) == 0);
        CHECK(posix_spawn_file_actions_init(&actions) == 0);
        CHECK(posix_spawn_file_actions_adddup2(&actions, ends[1], 1) == 0);
        static char name[] = "parent";
        CHECK(posix_spawn(&process, self, &actions, NULL, (char *[]){self, name, NULL}, environ) == 0);
        close(ends[1]);
        FILE *output = fdopen(ends[0], "r");
        CHECK(output != NULL && fgets(line, sizeof line, output) != NULL);
        pid_t jvm = (pid_t)strtol(line, NULL, 10);
        if (i % 2 == 1) CHECK(kill(jvm, SIGSTOP) == 0);
        CHECK(kill(process, i % 4 < 2 ? SIGKILL : SIGTERM) == 0);
        CHECK(ends_within(jvm, 1000));
        CHECK(waitpid(process, NULL, 0) == process && fclose(output) == 0);
        posix_spawn_file_actions_destroy(&actions);
    }
}

/* ---- Starts that fail ------------------------------------------------------------------------------------------------ */

static void write_java(const char *home, const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/" PRIM_JAVA, home);
    FILE *file = fopen(path, "w");
    CHECK(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0 && chmod(path, 0755) == 0);
}

void own_with_a_bad_launcher(void) {
    static const struct {
        const char *java;
        int32_t code;
        const char *mention;
    } bad[] = {{"\x7F"
                "ELF of another architecture",
                CLK_JVM_START, "Exec format error"},
               {"#!/bin/sh\necho not a JVM\n", CLK_JVM_START, "exit code 0; it printed last: not a JVM"},
               {"#!/bin/sh\nexit 9\n", CLK_JVM_START, "exit code 9; it printed last: nothing"},
               {"#!/bin/sh\nhead -c 100000 /dev/urandom\n", CLK_JVM_START, "exit code 0"},
               {"#!/bin/sh\nkill -SEGV $$\n", CLK_JVM_START, "signal 11"},
               {"#!/bin/sh\necho still at it\nsleep 60\n", CLK_TIMEOUT, "it printed: still at it"},
               {"#!/bin/sh\nexec 3>&- 4>&-\nsleep 60\n", CLK_JVM_START, "signal 9"}};
    char lib[4096], link[128];
    const char *home = scratch_folder();
    make_folder(home, "bin");
    snprintf(lib, sizeof lib, "%s/lib", java_home());
    snprintf(link, sizeof link, "%s/lib", home);
    CHECK(symlink(lib, link) == 0);
    int before = 0;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        write_java(home, bad[i].java);
        CHECK_CODE(bad[i].code, bad[i].mention, start_at(home, host_classes, NULL, false, 3000));
        CHECK(clk_jvm_state() == CLK_STATE_NONE && jvm_process() == 0);
        if (i == 0) before = descriptors();
        CHECK(descriptors() == before);
    }
    CHECK_OK(start(NULL));
}

void own_without_resources(void) {
    struct rlimit limit, less;
    CHECK(getrlimit(RLIMIT_FSIZE, &limit) == 0);
    less = (struct rlimit){.rlim_cur = 1 << 30, .rlim_max = limit.rlim_max};
    CHECK(setrlimit(RLIMIT_FSIZE, &less) == 0);
    CHECK_CODE(CLK_MEMORY, "File too large", start_at(java_home(), host_classes, NULL, false, 60000));
    CHECK(setrlimit(RLIMIT_FSIZE, &limit) == 0);
    CHECK(getrlimit(RLIMIT_NOFILE, &limit) == 0);
    less = (struct rlimit){.rlim_cur = 64, .rlim_max = limit.rlim_max};
    CHECK(setrlimit(RLIMIT_NOFILE, &less) == 0);
    while (open("/dev/null", O_RDONLY | O_CLOEXEC) >= 0) {
    }
    CHECK_CODE(CLK_MEMORY, "Too many open files", start_at(java_home(), host_classes, NULL, false, 60000));
    for (int i = 60; i < 63; i++) close(i); /* now the memory and one pipe can be opened, but not the connection */
    CHECK_CODE(CLK_JVM_START, "Too many open files", start_at(java_home(), host_classes, NULL, false, 60000));
    int before = descriptors();
    CHECK_CODE(CLK_JVM_START, "Too many open files", start_at(java_home(), host_classes, NULL, false, 60000));
    CHECK(descriptors() == before && setrlimit(RLIMIT_NOFILE, &limit) == 0);
    CHECK_OK(start(NULL));
}
/* Each limit allows a few more threads than the previous one. First the thread of the shim cannot start, then the child, then threads of the JVM, until
 * the start succeeds. */
void own_without_processes(void) {
    struct rlimit limit = {0};
    int failures = 0, before = 0;
    if (getuid() == 0) CHECK(setgid(65534) == 0 && setuid(65534) == 0); /* the limit does not apply to root */
    if (access(host_classes, R_OK) != 0 || access(java_home(), R_OK) != 0) skip("other users cannot read the build folder or the JVM");
    CHECK(getrlimit(RLIMIT_NPROC, &limit) == 0);
    for (rlim_t processes = 1;; processes += processes < 4 ? 1 : 4) {
        struct rlimit less = {.rlim_cur = processes, .rlim_max = limit.rlim_max};
        CHECK(setrlimit(RLIMIT_NPROC, &less) == 0);
        int32_t result =
            start_at(java_home(), host_classes, OPTIONS("-Xmx64m", "-XX:+UseSerialGC", "-XX:ErrorFile=/dev/null"), false, 10000);
        if (result == CLK_OK) break;
        CHECK(result == CLK_MEMORY || result == CLK_JVM_START || result == CLK_TIMEOUT);
        CHECK(clk_jvm_state() == CLK_STATE_NONE && jvm_process() == 0);
        if (++failures == 3) before = descriptors();
        CHECK(failures < 4 || descriptors() == before);
    }
    CHECK(failures >= 2);
    CHECK_OK(clk_jvm_stop(60000));
}

#if defined(__linux__)
void own_out_of_memory(void) {
    clk_session session;
    struct rlimit limit, less;
    CHECK(getrlimit(RLIMIT_AS, &limit) == 0);
    less = (struct rlimit){.rlim_cur = (rlim_t)8 << 30, .rlim_max = limit.rlim_max};
    CHECK(setrlimit(RLIMIT_AS, &less) == 0);
    CHECK_CODE(CLK_MEMORY, "Cannot allocate memory", start_at(java_home(), host_classes, NULL, false, 60000));
    CHECK(setrlimit(RLIMIT_AS, &limit) == 0);
    start_own();
    CHECK_OK(clk_slot_acquire(1 << 20, &request, &request_memory));
    CHECK_OK(open_session(&session));
    less.rlim_cur = 1 << 20; /* less than the JVM already uses */
    CHECK(prlimit(jvm_process(), RLIMIT_AS, &less, NULL) == 0);
    int32_t result = step(session, EXHAUST, 0, 60000);
    CHECK(result == CLK_JVM_LOST || result == CLK_JAVA);
    CHECK(result == CLK_JVM_LOST || clk_session_close(session, 60000) == CLK_OK);
    clk_jvm_stop(60000);
    start_own();
    CHECK_OK(open_session(&session));
    CHECK_OK(step(session, GROW, 1 << 20, 60000));
}

/* The shared memory has no file in /dev/shm, so the JVM also starts when this folder is full. */
void own_needs_no_shared_memory_folder(void) {
    clk_session session;
    if (unshare(CLONE_NEWNS) != 0) skip("only root can mount file systems");
    CHECK(mount(NULL, "/", NULL, MS_REC | MS_PRIVATE, NULL) == 0 && mount("tmpfs", "/dev/shm", "tmpfs", 0, "size=4k") == 0);
    FILE *file = fopen("/dev/shm/full", "w");
    CHECK(file != NULL);
    setvbuf(file, NULL, _IONBF, 0);
    while (fputs("full", file) >= 0) {
    }
    CHECK(errno == ENOSPC && fclose(file) == 0);
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK_OK(step(session, GROW, 1 << 24, 60000));
}
#else
void own_out_of_memory(void) { skip("only Linux can limit the resources of another process"); }
void own_needs_no_shared_memory_folder(void) { skip("the folder /dev/shm exists only on Linux"); }
#endif
#endif

/* ---- Several starts -------------------------------------------------------------------------------------------------- */

void own_with_older_slots(void) {
    clk_slot older;
    clk_memory memory = {.size = sizeof memory};
    clk_session session;
    CHECK_OK(clk_slot_acquire(100, &older, &memory));
    memset(memory.address, 0, 8);
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK_CODE(CLK_ARGUMENT, "acquire another", clk_step(session, older, 0, 8, 1000, &answer));
    CHECK_OK(step(session, EMPTY, 0, 1000));
    CHECK_OK(clk_slot_release(older));
    CHECK(stats().slots == 2);
}

void own_changes_options(void) {
    clk_session session;
    char description[4096];
    start_plain();
    CHECK_OK(start(OPTIONS("-Xmx99m")));
    CHECK(clk_jvm_description(description, sizeof description) > 0 && strstr(description, "\n-Xmx99m") != NULL);
    CHECK_OK(open_session(&session));
    CHECK_OK(step(session, ECHO, 0, 1000));
    CHECK_CODE(CLK_JVM_RUNNING, "close them first", start(NULL));
    CHECK_OK(clk_session_close(session, 1000));
    CHECK_OK(clk_jvm_stop(60000));
    CHECK_OK(start(NULL));
    /* Afterwards, a JVM can also start in this process, but only once. */
    placement = CLK_IN_PROCESS;
    CHECK_OK(start(NULL));
    CHECK_OK(open_session(&session));
    CHECK_OK(step(session, GROW, 1 << 20, 60000));
    placement = CLK_OWN_PROCESS;
    CHECK_CODE(CLK_JVM_RUNNING, "restart the process", start(NULL));
}
