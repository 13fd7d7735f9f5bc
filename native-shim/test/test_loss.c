#define _XOPEN_SOURCE 700
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#if defined(_WIN32)
#include <windows.h>
#else
#include <setjmp.h>
#include <signal.h>
#include <sys/wait.h>
#endif
#include "prim.h"
#include "test.h"

static clk_session session;

static void start_with_session(void) {
    start_plain();
    CHECK_OK(open_session(&session));
}

static void check_all_lost(const char *reason) {
    clk_session other;
    clk_memory memory = {.size = sizeof memory};
    CHECK(clk_jvm_state() == CLK_STATE_LOST);
    CHECK_CODE(CLK_JVM_LOST, reason, open_session(&other));
    CHECK_CODE(CLK_JVM_LOST, reason, step(session, EMPTY, 0, 1000));
    CHECK_CODE(CLK_JVM_LOST, reason, clk_session_close(session, 1000));
    CHECK_CODE(CLK_JVM_LOST, reason, clk_jvm_stop(1000));
    if (placement == CLK_IN_PROCESS) CHECK_CODE(CLK_JVM_LOST, reason, start(NULL));
    char description[1024];
    CHECK(clk_jvm_description(description, sizeof description) > 0);
    CHECK_OK(clk_slot_release(request)); /* slots do not depend on the JVM */
    CHECK_OK(clk_slot_acquire(100, &request, &memory));
    if (placement == CLK_OWN_PROCESS) {
        CHECK_OK(start(NULL));
        CHECK_CODE(CLK_HANDLE, "already closed", clk_session_close(session, 1000));
    }
}

void hang_loses_the_jvm(void) {
    start_with_session();
    int64_t begin = now_ns();
    CHECK_CODE(CLK_JVM_LOST, "did not answer", step(session, HANG, 0, 300));
    CHECK(now_ns() - begin >= 10300000000 && now_ns() - begin < 100000000000);
    CHECK(log_mentions("the JVM has crashed or stopped responding"));
    check_all_lost("did not answer");
}

static void *wait_for_turn(void *result) {
    clk_answer own = {.size = sizeof own};
    *(int32_t *)result = clk_step(session, request, 0, 8, 60000, &own);
    return NULL;
}

static void *hang(void *result) {
    *(int32_t *)result = step(session, HANG, 0, 300);
    return NULL;
}

void waiting_callers_return_after_a_loss(void) {
    pthread_t threads[4];
    int32_t results[4];
    start_with_session();
    int64_t begin = now_ns();
    CHECK(pthread_create(&threads[0], NULL, hang, &results[0]) == 0);
    while (stats().steps == 0) sleep_ms(1);
    for (int i = 1; i < 4; i++) CHECK(pthread_create(&threads[i], NULL, wait_for_turn, &results[i]) == 0);
    for (int i = 0; i < 4; i++) CHECK(pthread_join(threads[i], NULL) == 0 && results[i] == CLK_JVM_LOST);
    CHECK(now_ns() - begin < 40000000000);
}

/* ---- Faults in a process with its own handlers --------------------------------------------------------------- */

#if defined(_WIN32)
/* Like Mono's handler, this handler handles faults in its own memory and passes on all others. */
static char *guarded;

static LONG CALLBACK on_fault(EXCEPTION_POINTERS *exception) {
    DWORD before;
    const EXCEPTION_RECORD *record = exception->ExceptionRecord;
    if (record->ExceptionCode != (DWORD)EXCEPTION_ACCESS_VIOLATION || record->ExceptionInformation[1] != (ULONG_PTR)guarded)
        return EXCEPTION_CONTINUE_SEARCH;
    return VirtualProtect(guarded, 1, PAGE_READWRITE, &before) ? EXCEPTION_CONTINUE_EXECUTION : EXCEPTION_CONTINUE_SEARCH;
}

static void catch_faults(void) {
    guarded = VirtualAlloc(NULL, 1, MEM_RESERVE | MEM_COMMIT, PAGE_NOACCESS);
    CHECK(guarded != NULL && AddVectoredExceptionHandler(1, on_fault) != NULL);
}

static void fault(void) {
    DWORD before;
    *(volatile char *)guarded = 1;
    CHECK(VirtualProtect(guarded, 1, PAGE_NOACCESS, &before) && before == PAGE_READWRITE);
}
#else
static sigjmp_buf recover;

static void on_fault(int signal, siginfo_t *info, void *context) {
    (void)signal;
    (void)info;
    (void)context;
    siglongjmp(recover, 1);
}

static void catch_faults(void) {
    CHECK(sigaction(SIGSEGV, &(struct sigaction){.sa_sigaction = on_fault, .sa_flags = SA_SIGINFO}, NULL) == 0);
}

__attribute__((no_sanitize("address", "undefined"))) static void fault(void) {
    static int *volatile nowhere = NULL;
    if (sigsetjmp(recover, 1) == 0) {
        *(volatile int *)nowhere = 1;
        fail(__FILE__, __LINE__, "the fault was not handled");
    }
}
#endif

void implicit_null_checks_and_host_faults(void) {
    catch_faults();
    start_with_session();
    for (int i = 0; i < 20; i++) {
        int32_t caught;
        fault();
        CHECK_OK(step(session, IMPLICIT_NULL, 1000000, 60000));
        memcpy(&caught, answer.address, sizeof caught);
        CHECK(caught == 20);
    }
}

/* Does not call catch_faults, because HotSpot would pass the crash to the process's handler first. */
void crash_loses_the_jvm(void) {
    start_with_session();
    CHECK_CODE(CLK_JVM_LOST, own_or("hs_err", "it aborted"), step(session, CRASH, 0, 60000));
    check_all_lost(own_or("hs_err", "it aborted"));
}

#if defined(_WIN32)
void signal_handlers_are_repaired(void) { skip("Windows has no signal handlers"); }

void fork_loses_the_jvm(void) { skip("Windows has no fork"); }

void stop_while_the_start_hangs(void) { skip("Windows has no pipes in the file system, which would make a start hang"); }
#else
void signal_handlers_are_repaired(void) {
    struct sigaction before, now;
    clk_session other;
    if (placement == CLK_OWN_PROCESS) skip("the JVM's own process has its own signal handlers");
    start_with_session();
    CHECK(sigaction(SIGSEGV, NULL, &before) == 0 && (before.sa_flags & SA_ONSTACK) != 0);
    CHECK(sigaction(SIGFPE, NULL, &now) == 0 && (now.sa_flags & SA_ONSTACK) == 0); /* the flag is as before the start */
    catch_faults();
    CHECK_OK(open_session(&other));
    CHECK(sigaction(SIGSEGV, NULL, &now) == 0 && now.sa_sigaction == before.sa_sigaction && (now.sa_flags & SA_ONSTACK) != 0);
    CHECK(stats().signal_repairs == 1 && log_mentions("restored"));
    CHECK_OK(open_session(&other));
    CHECK(stats().signal_repairs == 1);
    catch_faults();
    CHECK_OK(step(session, IMPLICIT_NULL, 1000000, 60000));
    CHECK(stats().signal_repairs == 2);
    catch_faults();
    CHECK_OK(clk_session_close(session, 60000));
    CHECK(stats().signal_repairs == 3);
    catch_faults();
    CHECK_OK(clk_jvm_stop(60000));
    CHECK(stats().signal_repairs == 4);
}

void fork_loses_the_jvm(void) {
    start_with_session();
    pid_t child = fork();
    CHECK(child >= 0);
    if (child == 0) {
        int64_t begin = now_ns();
        CHECK_CODE(CLK_JVM_LOST, "forked", step(session, EMPTY, 0, 60000));
        CHECK_CODE(CLK_JVM_LOST, "forked", clk_jvm_stop(60000));
        CHECK(now_ns() - begin < 5000000000);
        _exit(7);
    }
    int status;
    CHECK(waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 7);
    CHECK_OK(step(session, EMPTY, 0, 60000));
}

/* JNI_CreateJavaVM hangs, because its log file is a pipe without a reader. */
void stop_while_the_start_hangs(void) {
    char pipe[128], log[192];
    snprintf(pipe, sizeof pipe, "%s/pipe", scratch_folder());
    snprintf(log, sizeof log, "-Xlog:gc:file=%s", pipe);
    CHECK(mkfifo(pipe, 0600) == 0);
    CHECK_CODE(CLK_TIMEOUT, NULL, start_at(java_home(), host_classes, (const char *const[]){log, NULL}, false, 1000));
    if (placement == CLK_IN_PROCESS) CHECK_CODE(CLK_JVM_LOST, "did not start within 1000 ms", clk_jvm_stop(1000));
}

#endif

/* ---- Orderly stop ------------------------------------------------------------------------------------------------ */

void stop_ends_all(void) {
    clk_session other;
    start_with_session();
    CHECK_OK(open_session(&other));
    CHECK_OK(clk_jvm_stop(60000));
    CHECK(clk_jvm_state() == CLK_STATE_STOPPED);
    CHECK_CODE(CLK_JVM_NOT_RUNNING, own_or("start it again", "only once"), open_session(&other));
    CHECK_CODE(CLK_JVM_NOT_RUNNING, own_or("start it again", "only once"), step(session, EMPTY, 0, 1000));
    CHECK_CODE(CLK_JVM_NOT_RUNNING, own_or("start it again", "only once"), clk_session_close(session, 1000));
    if (placement == CLK_IN_PROCESS) CHECK_CODE(CLK_JVM_NOT_RUNNING, "only once", start(NULL));
    CHECK_OK(clk_jvm_stop(1000));
    CHECK(stats().sessions == 0 && stats().slots == 1);
    CHECK_OK(clk_slot_release(request));
}

static void *stop_in_a_thread(void *unused) {
    (void)unused;
    CHECK_OK(clk_jvm_stop(60000));
    return NULL;
}

void stop_waits_while_another_writes_its_classes(void) {
    char option[128], base[4096];
    if (java_is_17()) skip("Java 17 lacks -XX:+AutoCreateSharedArchive");
    snprintf(base, sizeof base, "%s/" PRIM_LIBJVM, java_home());
    snprintf(strrchr(base, '/'), sizeof "/classes.jsa", "/classes.jsa");
    if (access(base, F_OK) != 0) skip("this JVM has no default class archive, so it does not create one");
    const char *folder = scratch_folder();
    pthread_t stopping;
    snprintf(option, sizeof option, "-XX:SharedArchiveFile=%s/classes.jsa", folder);
    const char *archive = strchr(option, '=') + 1;
    CHECK_OK(start_at(java_home(), host_jar, OPTIONS("-Xmx64m", "-XX:+AutoCreateSharedArchive", option), true, 60000));
    int other = prim_folder_lock(archive, prim_now());
    CHECK(other >= 0);
    CHECK(pthread_create(&stopping, NULL, stop_in_a_thread, NULL) == 0);
    for (int i = 0; i < 3; i++) sleep_ms(500); /* without the lock, the JVM would end sooner */
    CHECK(clk_jvm_state() == CLK_STATE_RUNNING && access(archive, F_OK) != 0);
    prim_folder_unlock(other);
    CHECK(pthread_join(stopping, NULL) == 0);
    CHECK(access(archive, F_OK) == 0);
}

void stop_without_start(void) {
    CHECK_OK(clk_jvm_stop(1000));
    CHECK(clk_jvm_state() == CLK_STATE_NONE);
}

void stop_halts_threads_that_stay(void) {
    start_with_session();
    CHECK_OK(step(session, STAY, 0, 60000));
    CHECK_OK(step(session, WRITE_AT_EXIT, 0, 60000));
    CHECK_OK(clk_jvm_stop(60000));
    CHECK(clk_jvm_state() == CLK_STATE_STOPPED);
    CHECK(log_mentions("the exit hook ran"));
    CHECK_CODE(CLK_JVM_NOT_RUNNING, own_or("start it again", "only once"), step(session, EMPTY, 0, 1000));
    CHECK_OK(clk_jvm_stop(1000));
}

void stop_times_out(void) {
    start_with_session();
    CHECK_OK(step(session, HANG_AT_STOP, 0, 60000));
    CHECK_CODE(CLK_TIMEOUT, "did not end within 400 ms", clk_jvm_stop(400));
    /* The state is set when the hanging thread is halted. Under load, this can take long. CTest limits the wait. */
    while (clk_jvm_state() != CLK_STATE_STOPPED) sleep_ms(10);
    check_threads_stand_still();
    CHECK_CODE(CLK_JVM_NOT_RUNNING, own_or("start it again", "only once"), step(session, EMPTY, 0, 60000));
}

void stop_after_a_hang(void) {
    start_with_session();
    CHECK_CODE(CLK_JVM_LOST, "did not answer", step(session, HANG, 0, 100));
    catch_faults(); /* clk_jvm_stop must restore HotSpot's handler, because Java threads stop at a fault that only this handler understands */
    int64_t begin = now_ns();
    CHECK_CODE(CLK_JVM_LOST, "did not answer", clk_jvm_stop(1000));
    CHECK(now_ns() - begin < 900000000); /* the JVM was halted before the time limit */
    CHECK_CODE(CLK_JVM_LOST, "did not answer", clk_jvm_stop(1000));
    CHECK(now_ns() - begin < 1800000000);
}

/* The heap has no room for another thread, and the garbage collector runs all the time. */
void stop_while_the_heap_is_full(void) {
    start_with_session();
    CHECK_CODE(CLK_JVM_LOST, "did not answer", step(session, THRASH, 0, 5000));
    CHECK_CODE(CLK_JVM_LOST, "did not answer", clk_jvm_stop(1000));
    check_threads_stand_still();
}
