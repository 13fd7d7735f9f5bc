/* Start and end of the JVM. */
#include <jni.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "child.h"
#include "collektive_shim.h"
#include "engine.h"
#include "error.h"
#include "host.h"
#include "launch.h"
#include "log.h"
#include "options.h"
#include "prim.h"
#include "session.h"
#include "slots.h"
#include "text.h"

#define HALT_LIMIT_MS 10000 /* long, because halting waits for a garbage collection to end, and the heap may be large */
#define HALT_STACK_BYTES ((size_t)1024 * 1024)
#define DETACH_LIMIT_MS 1000

typedef jint(JNICALL create_function)(JavaVM **, void **, void *);
typedef jint(JNICALL created_function)(JavaVM **, jsize, jsize *);
typedef void(JNICALL halt_function)(jint);

/* Guarded by the turn, except atomics and semaphores. */
static struct {
    struct launch launch; /* of the last start */
    JavaVM *vm;
    char version[256];
    int32_t stop_limit_ms;
    prim_mutex describing;
    char *description;    /* guarded by `describing` */
    atomic_bool creating; /* JNI_CreateJavaVM was called */
    atomic_bool created;  /* JNI_CreateJavaVM succeeded */
    atomic_bool stopping; /* clk_jvm_stop was called */
    atomic_bool parked;   /* the JVM ended itself, and one of its threads is parked in a hook */

    halt_function *halt;      /* JVM_Halt; NULL if this JVM lacks it */
    atomic_bool halt_thread;  /* the halt thread was started, and need not detach yet */
    atomic_bool halting;      /* the halt thread halts the JVM when it wakes; otherwise it detaches */
    prim_semaphore halt_wake; /* posted to wake it */
    prim_semaphore detached;  /* posted when it has left the JVM */
    prim_semaphore halted;    /* posted when all threads of the JVM are halted */
} jvm = {.describing = PRIM_MUTEX_INIT};

/* ---- Hooks of the JVM ------------------------------------------------------------------------------------------------ */

static jint JNICALL __attribute__((format(printf, 2, 0))) hook_print(FILE *file, const char *format, va_list arguments) {
    if (file != stdout && file != stderr) return vfprintf(file, format, arguments); /* a log file of the JVM */
    int32_t level = file == stderr ? CLK_LOG_WARNING : CLK_LOG_INFO;
    char text[LOG_LINE_CAPACITY + 4];
    int length = vsnprintf(text, sizeof text, format, arguments);
    if (length >= 0) log_jvm_text(level, text);
    if (length >= (int)sizeof text) log_jvm_text(level, "\n"); /* the text was truncated, so its line break is missing */
    return length;
}

/* Sets the state to lost, and parks a thread of the JVM that would end the process if it returned. If the JVM had not started, restores the signal
 * handlers of the process. Otherwise, restores HotSpot's normal handlers: during a crash, HotSpot installs other handlers, with which every null
 * reference in the process's own language would hang its thread. */
static _Noreturn void lose_and_park(const char *what) {
    char why[LOG_LAST_CAPACITY] = "";
    atomic_store(&jvm.parked, true);
    if (atomic_load(&jvm.created)) {
        prim_signals_repair();
        text_export("see hs_err_pid*.log and the standard error of the process", why, sizeof why);
    } else {
        prim_signals_restore();
        log_jvm_last(why, sizeof why);
        if (why[0] == '\0') text_export("see the standard error of the process", why, sizeof why);
    }
    engine_lose("it %s: %s", what, why);
    prim_park();
}

static void JNICALL hook_exit(jint code) {
    char what[64];
    if (atomic_load(&jvm.stopping)) {
        engine_set_state(CLK_STATE_STOPPED);
        prim_semaphore_post(&jvm.halted);
        prim_park();
    }
    snprintf(what, sizeof what, "ended itself with exit code %d", code);
    lose_and_park(what);
}

static void JNICALL hook_abort(void) { lose_and_park("aborted"); }

/* ---- Start on the engine thread -------------------------------------------------------------------------------------- */

static int32_t load(create_function **create) {
    char path[4096];
    char why[512];
    snprintf(path, sizeof path, "%s/" PRIM_LIBJVM, jvm.launch.home);
    void *library = prim_library_open(path, why, sizeof why);
    if (library == NULL) return error_set(CLK_JVM_NOT_FOUND, "cannot load %s: %s; install a JVM for " PRIM_PLATFORM, path, why);
    created_function *created;
    *(void **)create = prim_library_symbol(library, "JNI_CreateJavaVM");
    *(void **)&created = prim_library_symbol(library, "JNI_GetCreatedJavaVMs");
    if (*create == NULL || created == NULL)
        return error_set(CLK_JVM_NOT_FOUND, "%s is not a JVM library: it lacks JNI_CreateJavaVM; reinstall the JVM", path);
    *(void **)&jvm.halt = prim_library_symbol(library, "JVM_Halt");
    /* This check must come before JNI_CreateJavaVM, because after a second JNI_CreateJavaVM the count is 0. */
    JavaVM *other;
    jsize count = 0;
    if (created(&other, 1, &count) == JNI_OK && count > 0) {
        return error_set(CLK_JVM_START,
                         "another library has already started a JVM in this process, which can have only one; remove that library");
    }
    return CLK_OK;
}

static int32_t create(create_function *create_vm, JNIEnv **env) {
    enum { HOOKS = 3 };
    jint count = jvm.launch.option_count + HOOKS;
    JavaVMOption *options = malloc((size_t)count * sizeof *options);
    if (options == NULL) return error_set(CLK_MEMORY, "out of memory for %d JVM options", count);
    options[0] = (JavaVMOption){(char[]){"vfprintf"}, (void *)(uintptr_t)hook_print};
    options[1] = (JavaVMOption){(char[]){"exit"}, (void *)(uintptr_t)hook_exit};
    options[2] = (JavaVMOption){(char[]){"abort"}, (void *)(uintptr_t)hook_abort};
    /* The strings are not freed, because the JVM reads them until it ends. */
    for (int32_t i = 0; i < jvm.launch.option_count; i++) {
        options[HOOKS + i] = (JavaVMOption){prim_jvm_text(jvm.launch.options[i]), NULL};
        if (options[HOOKS + i].optionString == NULL) return error_set(CLK_MEMORY, "out of memory for %d JVM options", count);
    }
    JavaVMInitArgs arguments = {.version = JNI_VERSION_10, .nOptions = count, .options = options, .ignoreUnrecognized = JNI_FALSE};
    prim_signals_save();
    prim_semaphore_init(&jvm.halt_wake, 0);
    prim_semaphore_init(&jvm.detached, 0);
    prim_semaphore_init(&jvm.halted, 0);
    atomic_store(&jvm.creating, true);
    jint result = create_vm(&jvm.vm, (void **)env, &arguments);
    free(options);
    if (result != JNI_OK) {
        char last[LOG_LAST_CAPACITY];
        prim_signals_restore();
        log_jvm_last(last, sizeof last);
        return error_set(CLK_JVM_START, "JNI_CreateJavaVM failed (%d): %s; correct the JVM options and restart the process", result,
                         last[0] != '\0' ? last : "the JVM did not state a reason");
    }
    prim_signals_adopt();
    atomic_store(&jvm.created, true); /* from now on, lose_and_park may repair signal handlers */
    return CLK_OK;
}

/* The halt thread, which halts a JVM that does not shut down. It attaches to the JVM at the start, because a full heap has no room for another
 * thread. */
static void halt_main(void) {
    JNIEnv *env;
    JavaVMAttachArgs arguments = {.version = JNI_VERSION_10, .name = (char[]){"collektive-halt"}};
    if ((*jvm.vm)->AttachCurrentThreadAsDaemon(jvm.vm, (void **)&env, &arguments) != JNI_OK) return;
    prim_semaphore_wait(&jvm.halt_wake);
    if (atomic_load(&jvm.halting)) jvm.halt(0);
    (*jvm.vm)->DetachCurrentThread(jvm.vm);
    prim_semaphore_post(&jvm.detached);
}

static void start_halt_thread(void) {
    if (jvm.halt != NULL) atomic_store(&jvm.halt_thread, prim_thread_start(halt_main, "collektive-halt", HALT_STACK_BYTES));
}

static int32_t work_start(void) {
    create_function *create_vm;
    JNIEnv *env;
    int32_t result = load(&create_vm);
    if (result == CLK_OK) result = create(create_vm, &env);
    if (result != CLK_OK) return result;
    start_halt_thread();
    return host_start(env, jvm.version, sizeof jvm.version);
}

/* ---- Start ----------------------------------------------------------------------------------------------------------- */

/* Environment variables from which the JVM would read options that were not checked. */
static const char *const option_variables[] = {"JAVA_TOOL_OPTIONS", "_JAVA_OPTIONS", "JDK_JAVA_OPTIONS"};
enum { OPTION_VARIABLES = sizeof option_variables / sizeof option_variables[0] };

/* Sets the description and takes ownership of the text, which may be NULL. */
static void describe(char *description) {
    prim_lock(&jvm.describing);
    free(jvm.description);
    jvm.description = description;
    prim_unlock(&jvm.describing);
}

/* Starts the JVM in a child process. Needs the turn. */
static int32_t start_child(int64_t deadline) {
    int32_t result = child_start(&jvm.launch, deadline, jvm.version, sizeof jvm.version);
    if (result != CLK_OK) {
        char why[ERROR_CAPACITY];
        text_export(error_last(), why, sizeof why);
        child_end(); /* if the child does not end, the next start reports it */
        return error_set(result, "%s", why);
    }
    describe(launch_description(&jvm.launch, jvm.version));
    engine_set_state(CLK_STATE_RUNNING);
    child_is_alive(); /* if the child has already ended, this sets the state to lost */
    return CLK_OK;
}

/* Starts the JVM in this process. Needs the turn and the state NONE. */
static int32_t start_in_process(int64_t deadline, int32_t limit_ms) {
    int32_t result = engine_run(work_start, deadline);
    if (result == CLK_TIMEOUT) {
        engine_lose("it did not start within %d ms", limit_ms);
    } else if (result == CLK_JVM_LOST) {
        result = error_set(CLK_JVM_START, "%s", error_last());
    } else if (result != CLK_OK && atomic_load(&jvm.creating)) {
        engine_lose("its start failed: %s", error_last());
    }
    /* After a failed start, the version is not used, because the engine thread may still write it. */
    if (atomic_load(&jvm.creating)) describe(launch_description(&jvm.launch, result == CLK_OK ? jvm.version : ""));
    if (result == CLK_OK) engine_set_state(CLK_STATE_RUNNING);
    return result;
}

/* Checks the configuration and starts the JVM. Needs the turn and the state NONE. */
static int32_t start(const clk_jvm_config *config, int64_t deadline) {
    launch_free(&jvm.launch);
    child_use(config->placement == CLK_OWN_PROCESS);
    int32_t result = launch_prepare(&jvm.launch, config, deadline);
    if (result != CLK_OK) return result;
    return child_is_used() ? start_child(deadline) : start_in_process(deadline, config->start_limit_ms);
}

static int32_t check(const clk_jvm_config *config, int64_t deadline) {
    struct launch launch = {0};
    int32_t result = launch_prepare(&launch, config, deadline);
    launch_free(&launch);
    return result;
}

typedef int32_t configured(const clk_jvm_config *config, int64_t deadline);

static int32_t without_option_variables(configured *work, const clk_jvm_config *config, int64_t deadline) {
    char *hidden[OPTION_VARIABLES] = {NULL};
    for (int i = 0; i < OPTION_VARIABLES; i++) {
        if (prim_environment_hide(option_variables[i], &hidden[i])) {
            log_format(CLK_LOG_WARNING, "the environment variable %s is ignored; set JVM options in the JVM settings", option_variables[i]);
        }
    }
    int32_t result = work(config, deadline);
    for (int i = OPTION_VARIABLES - 1; i >= 0; i--) {
        if (hidden[i] != NULL) prim_environment_show(hidden[i]);
    }
    return result;
}

static bool is_equal(const clk_jvm_config *config) {
    char *configuration = launch_configuration(config);
    bool equal = configuration != NULL && strcmp(configuration, jvm.launch.configuration) == 0;
    free(configuration);
    return equal && child_is_used() == (config->placement == CLK_OWN_PROCESS);
}

static int32_t reject_configuration(void) {
    if (child_is_used()) return error_set(CLK_JVM_RUNNING, "a JVM with other settings has open sessions; close them first");
    return error_set(CLK_JVM_RUNNING,
                     "a JVM is already running with another home, class path or options; restart the process to change them");
}

/* Locks the folder of the class archive, because two JVMs that end at the same time could write to the same file. Returns a negative number if the JVM
 * does not write an archive, or if the lock is not available. */
static int lock_archive(int32_t limit_ms) {
    const char *archive = options_archive(jvm.launch.options, jvm.launch.option_count);
    return archive == NULL ? -1 : prim_folder_lock(archive, prim_now() + limit_ms / 4 * PRIM_MILLI);
}

/* Ends the child, if one exists, and removes its sessions, pins and state, so that another JVM can start. Needs the turn. */
static int32_t end_child(void) {
    int32_t result = child_end();
    if (result != CLK_OK) return result;
    session_remove_all();
    slots_unpin_shared();
    engine_reset();
    return CLK_OK;
}

/* Stops a running child. After an error, the child was killed. Needs the turn. */
static int32_t stop_child(int32_t limit_ms) {
    int64_t deadline = prim_now() + limit_ms * PRIM_MILLI;
    int lock = lock_archive(limit_ms);
    int32_t result = session_complete(deadline);
    engine_set_state(CLK_STATE_STOPPED); /* set in advance, so that the end of the child does not count as a loss */
    if (result == CLK_OK) result = child_stop(limit_ms, deadline);
    int32_t ended = end_child();
    if (lock >= 0) prim_folder_unlock(lock);
    return ended != CLK_OK ? ended : result;
}

static int32_t start_or_compare(const clk_jvm_config *config, int64_t deadline) {
    int32_t state = engine_state();
    if (state == CLK_STATE_RUNNING && is_equal(config)) return CLK_OK;
    if (state != CLK_STATE_NONE && (!child_is_used() || engine_is_forked()))
        return state == CLK_STATE_RUNNING ? reject_configuration() : engine_check_running();
    if (state == CLK_STATE_RUNNING && session_count() > 0) return reject_configuration();
    if (state == CLK_STATE_RUNNING && stop_child((int32_t)((deadline - prim_now()) / PRIM_MILLI / 2) + 1) != CLK_OK)
        log_format(CLK_LOG_WARNING, "%s", error_last());
    int32_t result = end_child();
    return result != CLK_OK ? result : without_option_variables(start, config, deadline);
}

static int32_t check_only(const clk_jvm_config *config, int64_t deadline) { return without_option_variables(check, config, deadline); }

static int32_t in_turn(configured *work, const clk_jvm_config *config) {
    if (launch_check_config(config) != CLK_OK) return CLK_ARGUMENT;
    int64_t deadline = prim_now() + config->start_limit_ms * PRIM_MILLI;
    int32_t result = engine_enter(deadline);
    if (result != CLK_OK) return result;
    result = work(config, deadline);
    engine_leave();
    return result;
}

int32_t clk_jvm_start(const clk_jvm_config *config) { return in_turn(start_or_compare, config); }

int32_t clk_jvm_check(const clk_jvm_config *config) { return in_turn(check_only, config); }

int32_t clk_jvm_description(char *buffer, int32_t capacity) {
    prim_lock(&jvm.describing);
    int32_t length = jvm.description != NULL ? text_export(jvm.description, buffer, capacity) : -1;
    prim_unlock(&jvm.describing);
    return length >= 0 ? length : error_set(CLK_JVM_NOT_RUNNING, "no JVM was started; call clk_jvm_start first");
}

/* ---- Stop ------------------------------------------------------------------------------------------------------------ */

/* Detaches the halt thread, because DestroyJavaVM waits up to 300 ms for attached threads that are not in Java. */
static void detach_halt_thread(void) {
    if (!atomic_exchange(&jvm.halt_thread, false)) return;
    prim_semaphore_post(&jvm.halt_wake);
    prim_semaphore_wait_until(&jvm.detached, prim_now() + DETACH_LIMIT_MS * PRIM_MILLI);
}

/* Ends the JVM. DestroyJavaVM would wait for non-daemon threads of programs. If some do not end, this function runs the shutdown hooks itself and halts
 * the JVM: JVM_Halt stops all threads at a safepoint and calls hook_exit, which does not return. No Java thread is then running when the process removes
 * its signal handlers. */
static int32_t work_stop(void) {
    bool idle = host_stop(jvm.stop_limit_ms / 2);
    session_remove_all();
    int lock = lock_archive(jvm.stop_limit_ms);
    if (!idle && jvm.halt != NULL && host_run_exit_hooks()) jvm.halt(0);
    detach_halt_thread();
    (*jvm.vm)->DestroyJavaVM(jvm.vm);
    if (lock >= 0) prim_folder_unlock(lock);
    engine_set_state(CLK_STATE_STOPPED);
    return CLK_OK;
}

/* Halts a JVM that does not shut down. False if it cannot be halted: while JNI_CreateJavaVM runs, after the JVM has ended itself, while a debugger may
 * have suspended its threads, or in a forked child, in which its threads do not exist. */
static bool halt(void) {
    if (!atomic_load(&jvm.created) || jvm.halt == NULL || atomic_load(&jvm.parked) || host_is_debugged() || engine_is_forked())
        return false;
    atomic_store(&jvm.stopping, true);
    atomic_store(&jvm.halting, true);
    if (!atomic_load(&jvm.halt_thread)) start_halt_thread();
    prim_signals_repair(); /* without HotSpot's handlers, its threads could not stop at a safepoint */
    prim_semaphore_post(&jvm.halt_wake);
    if (!prim_semaphore_wait_until(&jvm.halted, prim_now() + HALT_LIMIT_MS * PRIM_MILLI)) return false;
    prim_semaphore_post(&jvm.halted); /* the next clk_jvm_stop waits for it too */
    return true;
}

int32_t clk_jvm_stop(int32_t limit_ms) {
    if (limit_ms < 1) return error_set(CLK_ARGUMENT, "limit_ms is %d; it must be 1 or greater", limit_ms);
    int64_t deadline = prim_now() + limit_ms * PRIM_MILLI;
    int32_t result = engine_enter(deadline);
    if (result != CLK_OK) return result;
    if (child_is_used() && engine_state() == CLK_STATE_RUNNING) {
        result = stop_child(limit_ms);
        engine_set_state(CLK_STATE_STOPPED);
    } else if (engine_state() == CLK_STATE_RUNNING) {
        jvm.stop_limit_ms = limit_ms;
        atomic_store(&jvm.stopping, true);
        result = engine_run(work_stop, deadline);
        if (engine_state() == CLK_STATE_STOPPED) {
            result = CLK_OK;
        } else if (result == CLK_TIMEOUT) {
            result = error_set(CLK_TIMEOUT, "the JVM did not end within %d ms; %s", limit_ms,
                               halt() ? "its threads were halted, and flight recordings may be missing" : "it is still running");
        }
    } else if (engine_state() == CLK_STATE_LOST) {
        halt();
        result = engine_check_running();
    }
    engine_leave();
    return result;
}
