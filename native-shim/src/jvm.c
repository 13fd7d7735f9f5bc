/* Start and end of the JVM. */
#include <jni.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "collektive_shim.h"
#include "engine.h"
#include "error.h"
#include "host.h"
#include "log.h"
#include "options.h"
#include "prim.h"
#include "session.h"
#include "signals.h"

#define OLDEST_JAVA 17
#define FREEZE_LIMIT_MS 10000 /* a collection of a large heap on a busy machine may have to end first */
#define KEEPER_STACK_BYTES ((size_t)1024 * 1024)
#define KEEPER_LIMIT_MS 1000

typedef jint(JNICALL create_function)(JavaVM **, void **, void *);
typedef jint(JNICALL created_function)(JavaVM **, jsize, jsize *);
typedef void(JNICALL halt_function)(jint);

/* What a JVM is to be started with, in one piece of words. */
struct launch {
    char *home;
    char *configuration; /* home, class path and options, to compare with */
    char **options;      /* all words for the JVM */
    int32_t option_count;
    int32_t own_count; /* how many of these are ours, at the begin */
};

/* By the turn, but for the atomics. */
static struct {
    struct launch launch; /* of the last start: what the JVM was given stays for ever */
    char *checked;        /* the configuration that was last found good by a child process */
    JavaVM *vm;
    char version[256];
    int32_t stop_limit_ms;
    atomic_bool began;     /* JNI_CreateJavaVM was called */
    atomic_bool created;   /* and was successful */
    atomic_bool stopping;  /* its end is wanted */
    atomic_bool parked;    /* it ended itself: a thread of its own stays in a hook */
    halt_function *halt;   /* NULL when this JVM has none */
    atomic_bool keeper;    /* the keeper is there */
    atomic_bool halting;   /* and is to halt the JVM */
    prim_semaphore wanted; /* posted to wake it */
    prim_semaphore left;   /* posted when it left the JVM */
    prim_semaphore frozen; /* posted when it halted the JVM */
    _Atomic(char *) description;
} jvm;

/* ---- Configuration --------------------------------------------------------------------------------------------------- */

static int32_t check_config(const clk_jvm_config *config) {
    if (config == NULL) return error_set(CLK_ARGUMENT, "config is NULL");
    if (config->size < sizeof *config) {
        return error_set(CLK_ARGUMENT, "config->size is %u; set it to sizeof(clk_jvm_config)", config->size);
    }
    /* A newer caller's fields may be there as long as they say nothing. */
    for (const uint8_t *at = (const uint8_t *)config + sizeof *config; at < (const uint8_t *)config + config->size; at++) {
        if (*at != 0) return error_set(CLK_ARGUMENT, "the configuration has fields that this shim does not know; update the shim");
    }
    if (config->home == NULL || config->home[0] == '\0') return error_set(CLK_ARGUMENT, "home is empty; give the root of a JRE or JDK");
    if (config->class_path == NULL || config->class_path[0] == '\0') {
        return error_set(CLK_ARGUMENT, "class_path is empty; give the jars of the host");
    }
    if (config->option_count < 0 || (config->option_count > 0 && config->options == NULL)) {
        return error_set(CLK_ARGUMENT, "option_count is %d and does not fit options", config->option_count);
    }
    for (int32_t i = 0; i < config->option_count; i++) {
        if (config->options[i] == NULL) return error_set(CLK_ARGUMENT, "option %d is NULL", i);
    }
    if (config->start_limit_ms < 1) {
        return error_set(CLK_ARGUMENT, "start_limit_ms is %d; it is 1 or greater", config->start_limit_ms);
    }
    return CLK_OK;
}

/* `first`, `second` and the words, each on a line of its own. NULL when there is no memory. */
static char *join(const char *first, const char *second, const char *const *words, int32_t count) {
    size_t size = strlen(first) + strlen(second) + 2;
    for (int32_t i = 0; i < count; i++) size += strlen(words[i]) + 1;
    char *text = malloc(size);
    if (text == NULL) return NULL;
    int used = snprintf(text, size, "%s\n%s", first, second);
    for (int32_t i = 0; i < count; i++) used += snprintf(text + used, size - (size_t)used, "\n%s", words[i]);
    return text;
}

static void launch_free(struct launch *launch) {
    for (int32_t i = 0; i < launch->option_count; i++) free(launch->options[i]);
    free(launch->options);
    free(launch->configuration);
    free(launch->home);
    *launch = (struct launch){0};
}

static char *copy(const char *prefix, const char *word) {
    size_t size = strlen(prefix) + strlen(word) + 1;
    char *text = malloc(size);
    if (text != NULL) snprintf(text, size, "%s%s", prefix, word);
    return text;
}

static bool add_option(struct launch *launch, const char *prefix, const char *word) {
    char *option = copy(prefix, word);
    if (option != NULL) launch->options[launch->option_count++] = option;
    return option != NULL;
}

/* Ours come first, so that the user may change what is a mere default. -Xrs leaves the host process its signals; the log
 * option silences warnings about host_refuse_exit. Without conditional card marks, threads that run rounds write to the same few
 * cache lines in every round, and two of them take up to twice the processor time. */
static int32_t launch_fill(struct launch *launch, const clk_jvm_config *config) {
    launch->home = copy("", config->home);
    launch->configuration = join(config->home, config->class_path, config->options, config->option_count);
    launch->options = malloc(((size_t)config->option_count + 5) * sizeof *launch->options);
    bool good = launch->home != NULL && launch->configuration != NULL && launch->options != NULL && add_option(launch, "-Xrs", "") &&
                add_option(launch, "-Djava.awt.headless=true", "") && add_option(launch, "-Xlog:jni+resolve=error", "") &&
                add_option(launch, "-XX:+UseCondCardMark", "") && add_option(launch, "-Djava.class.path=", config->class_path);
    launch->own_count = launch->option_count;
    for (int32_t i = 0; good && i < config->option_count; i++) good = add_option(launch, config->options[i], "");
    return good ? CLK_OK : error_set(CLK_MEMORY, "no memory for %d JVM options", config->option_count);
}

/* ---- Checks before the start ----------------------------------------------------------------------------------------- */

static int32_t check_home_file(const char *home, const char *file) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", home, file);
    switch (prim_file_kind(path)) {
        case PRIM_FILE: return CLK_OK;
        case PRIM_UNREADABLE: return error_set(CLK_JVM_NOT_FOUND, "%s cannot be read; check its permissions", path);
        default:
            return error_set(CLK_JVM_NOT_FOUND, "%s is missing; the JVM's home must be the root of a JRE or JDK of version 17 or newer",
                             path);
    }
}

/* The file `release` of a JDK or JRE names its version; one without the file is taken as it is. */
static int32_t check_version(const char *home) {
    char text[4096];
    snprintf(text, sizeof text, "%s/release", home);
    FILE *file = fopen(text, "r");
    if (file == NULL) return CLK_OK;
    int version = OLDEST_JAVA;
    while (fgets(text, sizeof text, file) != NULL) {
        if (sscanf(text, "JAVA_VERSION=\"%d", &version) == 1) break;
    }
    fclose(file);
    if (version >= OLDEST_JAVA) return CLK_OK;
    return error_set(CLK_JVM_NOT_FOUND, "the JVM of %s is of Java %d; use a JRE or JDK of version %d or newer", home, version, OLDEST_JAVA);
}

/* A JVM without these files ends the process before any hook is known to it. */
static int32_t check_home(const char *home) {
    switch (prim_file_kind(home)) {
        case PRIM_DIRECTORY: break;
        case PRIM_MISSING: return error_set(CLK_JVM_NOT_FOUND, "the JVM's home %s does not exist; give the root of a JRE or JDK", home);
        case PRIM_UNREADABLE: return error_set(CLK_JVM_NOT_FOUND, "the JVM's home %s cannot be read; check its permissions", home);
        default: return error_set(CLK_JVM_NOT_FOUND, "the JVM's home %s is no folder; give the root of a JRE or JDK", home);
    }
    int32_t result = check_home_file(home, PRIM_LIBJVM);
    if (result == CLK_OK) result = check_home_file(home, "lib/modules");
    return result != CLK_OK ? result : check_version(home);
}

static int32_t check_class_path(const char *class_path) {
    char entry[4096];
    for (const char *at = class_path; *at != '\0';) {
        const char *end = strchr(at, PRIM_PATH_SEPARATOR);
        size_t length = end != NULL ? (size_t)(end - at) : strlen(at);
        if (length >= sizeof entry) return error_set(CLK_HOST, "an entry of the class path is longer than a path can be");
        memcpy(entry, at, length);
        entry[length] = '\0';
        enum prim_file kind = length > 0 ? prim_file_kind(entry) : PRIM_DIRECTORY;
        if (kind == PRIM_MISSING) {
            return error_set(CLK_HOST, "%s of the host's class path does not exist; build or reinstall the host", entry);
        }
        if (kind == PRIM_UNREADABLE) return error_set(CLK_HOST, "%s of the host's class path cannot be read; check its permissions", entry);
        at = end != NULL ? end + 1 : at + length;
    }
    return CLK_OK;
}

/* In another locale the JVM reads the bytes of a path as other characters, and misses its own files or the host's. */
static int32_t check_characters(int32_t code, const char *path) {
    for (const char *at = path; *at != '\0'; at++) {
        if ((unsigned char)*at >= 0x80 && !prim_locale_is_utf8()) {
            return error_set(code, "the locale of the process cannot express %s; set LC_ALL=C.UTF-8 or use a path of plain ASCII", path);
        }
    }
    return CLK_OK;
}

static int32_t try_options(const struct launch *launch, int64_t deadline) {
    if (jvm.checked != NULL && strcmp(jvm.checked, launch->configuration) == 0) return CLK_OK;
    int32_t result = options_try(launch->home, launch->options, launch->option_count, deadline);
    if (result == CLK_OK) {
        free(jvm.checked);
        jvm.checked = copy("", launch->configuration);
    }
    return result;
}

/* Fills the launch, which is empty before. */
static int32_t check(const clk_jvm_config *config, struct launch *launch, int64_t deadline) {
    int32_t result = check_home(config->home);
    if (result == CLK_OK) result = check_characters(CLK_JVM_NOT_FOUND, config->home);
    if (result == CLK_OK) result = check_class_path(config->class_path);
    if (result == CLK_OK) result = check_characters(CLK_HOST, config->class_path);
    for (int32_t i = 0; result == CLK_OK && i < config->option_count; i++) result = options_check(config->options[i]);
    if (result == CLK_OK) result = launch_fill(launch, config);
    if (result == CLK_OK && config->check_options != 0) result = try_options(launch, deadline);
    return result;
}

/* ---- Hooks of the JVM ------------------------------------------------------------------------------------------------ */

static jint JNICALL __attribute__((format(printf, 2, 0))) hook_print(FILE *file, const char *format, va_list arguments) {
    if (file != stdout && file != stderr) return vfprintf(file, format, arguments); /* a log file of the JVM's own */
    return log_jvm_output(file == stderr ? CLK_LOG_WARNING : CLK_LOG_INFO, format, arguments);
}

/* The JVM is about to end the process, and must not come back from here: its thread stays. A JVM that did not come up leaves
 * signal handlers behind that nobody answers for. One that crashed has put its crash handlers in place of its usual ones,
 * and they would let every thread hang that only runs into a null reference of the host's own language. */
static _Noreturn void lose(const char *what) {
    char words[1024] = "";
    atomic_store(&jvm.parked, true);
    if (atomic_load(&jvm.created)) {
        signals_repair();
        give_text("its report is on the standard error of the process and in hs_err_pid*.log", words, sizeof words);
    } else {
        signals_restore_host();
        log_jvm_last(words, sizeof words);
        if (words[0] == '\0') give_text("what it wrote is on the standard error of the process", words, sizeof words);
    }
    engine_lose("it %s: %s", what, words);
    prim_park();
}

static void JNICALL hook_exit(jint code) {
    char what[64];
    if (atomic_load(&jvm.stopping)) {
        engine_end();
        prim_semaphore_post(&jvm.frozen);
        prim_park();
    }
    snprintf(what, sizeof what, "ended itself with exit code %d", code);
    lose(what);
}

static void JNICALL hook_abort(void) { lose("aborted"); }

/* ---- Start on the engine thread -------------------------------------------------------------------------------------- */

static int32_t load(create_function **create) {
    char path[4096];
    char why[512];
    snprintf(path, sizeof path, "%s/" PRIM_LIBJVM, jvm.launch.home);
    void *library = prim_library_open(path, why, sizeof why);
    if (library == NULL) return error_set(CLK_JVM_NOT_FOUND, "%s cannot be loaded: %s", path, why);
    created_function *created;
    *(void **)create = prim_library_symbol(library, "JNI_CreateJavaVM");
    *(void **)&created = prim_library_symbol(library, "JNI_GetCreatedJavaVMs");
    if (*create == NULL || created == NULL) return error_set(CLK_JVM_NOT_FOUND, "%s is no library of a JVM", path);
    *(void **)&jvm.halt = prim_library_symbol(library, "JVM_Halt");
    /* Only asked before: after a second JNI_CreateJavaVM it would say 0. */
    JavaVM *other;
    jsize count = 0;
    if (created(&other, 1, &count) == JNI_OK && count > 0) {
        return error_set(CLK_JVM_START,
                         "another library has started a JVM in this process, and there can be only one; remove that library");
    }
    return CLK_OK;
}

static int32_t create(create_function *create_vm, JNIEnv **env) {
    enum { HOOKS = 3 };
    jint count = jvm.launch.option_count + HOOKS;
    JavaVMOption *options = malloc((size_t)count * sizeof *options);
    if (options == NULL) return error_set(CLK_MEMORY, "no memory for %d JVM options", count);
    options[0] = (JavaVMOption){(char[]){"vfprintf"}, (void *)(uintptr_t)hook_print};
    options[1] = (JavaVMOption){(char[]){"exit"}, (void *)(uintptr_t)hook_exit};
    options[2] = (JavaVMOption){(char[]){"abort"}, (void *)(uintptr_t)hook_abort};
    for (int32_t i = 0; i < jvm.launch.option_count; i++) options[HOOKS + i] = (JavaVMOption){jvm.launch.options[i], NULL};
    JavaVMInitArgs arguments = {.version = JNI_VERSION_10, .nOptions = count, .options = options, .ignoreUnrecognized = JNI_FALSE};
    signals_save_host();
    prim_semaphore_init(&jvm.wanted, 0);
    prim_semaphore_init(&jvm.left, 0);
    prim_semaphore_init(&jvm.frozen, 0);
    atomic_store(&jvm.began, true);
    jint result = create_vm(&jvm.vm, (void **)env, &arguments);
    free(options);
    if (result != JNI_OK) {
        char last[1024];
        signals_restore_host();
        log_jvm_last(last, sizeof last);
        return error_set(CLK_JVM_START, "correct the JVM options and restart the process; JNI_CreateJavaVM failed (%d): %s", result,
                         last[0] != '\0' ? last : "the JVM gave no reason");
    }
    signals_adopt_jvm();
    atomic_store(&jvm.created, true); /* from here on lose() repairs with what was adopted */
    return CLK_OK;
}

/* The keeper waits for the end of a JVM that can no longer be ended in order. It is attached while that is still possible: a full heap has no
 * room for one thread more. */
static void keeper_main(void) {
    JNIEnv *env;
    JavaVMAttachArgs arguments = {.version = JNI_VERSION_10, .name = (char[]){"collektive-keeper"}};
    if ((*jvm.vm)->AttachCurrentThreadAsDaemon(jvm.vm, (void **)&env, &arguments) != JNI_OK) return;
    prim_semaphore_wait(&jvm.wanted);
    if (atomic_load(&jvm.halting)) jvm.halt(0);
    (*jvm.vm)->DetachCurrentThread(jvm.vm);
    prim_semaphore_post(&jvm.left);
}

static void start_keeper(void) {
    if (jvm.halt != NULL) atomic_store(&jvm.keeper, prim_thread_start(keeper_main, "collektive-keep", KEEPER_STACK_BYTES));
}

static int32_t work_start(void) {
    create_function *create_vm;
    JNIEnv *env;
    int32_t result = load(&create_vm);
    if (result == CLK_OK) result = create(create_vm, &env);
    if (result != CLK_OK) return result;
    start_keeper();
    if (!host_refuse_exit(env)) {
        log_format(CLK_LOG_WARNING, "this JVM cannot refuse System.exit: a program that calls it will cost the JVM");
    }
    result = host_bind(env);
    return result == CLK_OK ? host_start(jvm.version, sizeof jvm.version) : result;
}

/* ---- Start ----------------------------------------------------------------------------------------------------------- */

/* Variables that bring options past every check. */
static const char *const smuggling[] = {"JAVA_TOOL_OPTIONS", "_JAVA_OPTIONS", "JDK_JAVA_OPTIONS"};
enum { SMUGGLING = sizeof smuggling / sizeof smuggling[0] };

/* The version is "" when the start failed: the engine thread may still be writing it. */
static void describe(const char *version) {
    const struct launch *launch = &jvm.launch;
    const char *const *words = (const char *const *)(launch->options + launch->own_count);
    atomic_store(&jvm.description, join(launch->home, version, words, launch->option_count - launch->own_count));
}

/* What start and check have in common runs under the turn, with the environment cleared of options. */
typedef int32_t configured(const clk_jvm_config *config, int64_t deadline);

/* No JVM was started before. */
static int32_t start(const clk_jvm_config *config, int64_t deadline) {
    launch_free(&jvm.launch);
    int32_t result = check(config, &jvm.launch, deadline);
    if (result != CLK_OK) return result;
    result = engine_run(work_start, deadline);
    if (result == CLK_TIMEOUT) {
        engine_lose("it did not come up within %d ms", config->start_limit_ms);
    } else if (result == CLK_JVM_LOST) {
        result = error_set(CLK_JVM_START, "%s", error_last());
    } else if (result != CLK_OK && atomic_load(&jvm.began)) {
        engine_lose("its start failed: %s", error_last());
    }
    if (atomic_load(&jvm.began)) describe(result == CLK_OK ? jvm.version : "");
    if (result == CLK_OK) engine_set_state(CLK_STATE_RUNNING);
    return result;
}

static int32_t try_only(const clk_jvm_config *config, int64_t deadline) {
    struct launch launch = {0};
    int32_t result = check(config, &launch, deadline);
    launch_free(&launch);
    return result;
}

static int32_t without_smuggling(configured *work, const clk_jvm_config *config, int64_t deadline) {
    char *hidden[SMUGGLING] = {NULL};
    for (int i = 0; i < SMUGGLING; i++) {
        if (prim_environment_hide(smuggling[i], &hidden[i])) {
            log_format(CLK_LOG_WARNING, "the environment variable %s is ignored; give JVM options in the settings", smuggling[i]);
        }
    }
    int32_t result = work(config, deadline);
    for (int i = SMUGGLING - 1; i >= 0; i--) {
        if (hidden[i] != NULL) prim_environment_show(hidden[i]);
    }
    return result;
}

static int32_t start_or_compare(const clk_jvm_config *config, int64_t deadline) {
    if (engine_state() != CLK_STATE_RUNNING && engine_state() != CLK_STATE_NONE) return engine_check_running();
    if (engine_state() == CLK_STATE_NONE) return without_smuggling(start, config, deadline);
    char *configuration = join(config->home, config->class_path, config->options, config->option_count);
    bool equal = configuration != NULL && strcmp(configuration, jvm.launch.configuration) == 0;
    free(configuration);
    return equal ? CLK_OK
                 : error_set(CLK_JVM_RUNNING, "a JVM runs already with another home, class path or options; restart the process "
                                              "to change them");
}

static int32_t check_without_start(const clk_jvm_config *config, int64_t deadline) { return without_smuggling(try_only, config, deadline); }

static int32_t take_turn(configured *work, const clk_jvm_config *config) {
    if (check_config(config) != CLK_OK) return CLK_ARGUMENT;
    int64_t deadline = prim_now() + config->start_limit_ms * PRIM_MILLI;
    int32_t result = engine_enter(deadline);
    if (result != CLK_OK) return result;
    result = work(config, deadline);
    engine_leave();
    return result;
}

int32_t clk_jvm_start(const clk_jvm_config *config) { return take_turn(start_or_compare, config); }

int32_t clk_jvm_check(const clk_jvm_config *config) { return take_turn(check_without_start, config); }

int32_t clk_jvm_description(char *buffer, int32_t capacity) {
    const char *description = atomic_load(&jvm.description);
    if (description == NULL) return error_set(CLK_JVM_NOT_RUNNING, "no JVM was started; call clk_jvm_start first");
    return give_text(description, buffer, capacity);
}

/* ---- Stop ------------------------------------------------------------------------------------------------------------ */

/* The end of the JVM would wait 300 ms for a thread outside of Java. */
static void dismiss_keeper(void) {
    if (!atomic_exchange(&jvm.keeper, false)) return;
    prim_semaphore_post(&jvm.wanted);
    prim_semaphore_wait_until(&jvm.left, prim_now() + KEEPER_LIMIT_MS * PRIM_MILLI);
}

/* DestroyJavaVM waits for threads of programs that are no daemons. When such do not end, the hooks that it would call are called
 * (one saves flight recordings), and the JVM is frozen: at its exit all threads stand at a safepoint, and hook_exit keeps them there. The
 * process can then end without Java threads that run into signal handlers that are gone. */
static int32_t work_stop(void) {
    bool idle = true;
    if (host_stop(jvm.stop_limit_ms / 2, &idle) != CLK_OK) log_format(CLK_LOG_WARNING, "the JVM goes down all the same: %s", error_last());
    session_forget_all();
    if (!idle && jvm.halt != NULL && host_run_exit_hooks()) jvm.halt(0);
    dismiss_keeper();
    (*jvm.vm)->DestroyJavaVM(jvm.vm);
    engine_set_state(CLK_STATE_STOPPED);
    return CLK_OK;
}

/* Halts a JVM whose engine thread does not come back. One that is still being made can be reached by nobody. */
static bool freeze(void) {
    if (jvm.halt == NULL || !atomic_load(&jvm.created) || atomic_load(&jvm.parked)) return false;
    atomic_store(&jvm.stopping, true);
    atomic_store(&jvm.halting, true);
    if (!atomic_load(&jvm.keeper)) start_keeper();
    prim_semaphore_post(&jvm.wanted);
    if (!prim_semaphore_wait_until(&jvm.frozen, prim_now() + FREEZE_LIMIT_MS * PRIM_MILLI)) return false;
    prim_semaphore_post(&jvm.frozen); /* it stays so for whoever asks again */
    return true;
}

int32_t clk_jvm_stop(int32_t limit_ms) {
    if (limit_ms < 1) return error_set(CLK_ARGUMENT, "limit_ms is %d; it is 1 or greater", limit_ms);
    int64_t deadline = prim_now() + limit_ms * PRIM_MILLI;
    int32_t result = engine_enter(deadline);
    if (result != CLK_OK) return result;
    if (engine_state() == CLK_STATE_RUNNING) {
        jvm.stop_limit_ms = limit_ms;
        atomic_store(&jvm.stopping, true);
        result = engine_run(work_stop, deadline);
        if (engine_state() == CLK_STATE_STOPPED) {
            result = CLK_OK;
        } else if (result == CLK_TIMEOUT) {
            result = error_set(CLK_TIMEOUT, "the JVM did not end within %d ms; %s", limit_ms,
                               freeze() ? "its threads were halted, and flight recordings may be missing" : "it runs on");
        }
    } else if (engine_state() == CLK_STATE_LOST) {
        if (engine_is_busy()) freeze();
        result = engine_check_running();
    }
    engine_leave();
    return result;
}
