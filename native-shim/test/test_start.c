#define _XOPEN_SOURCE 700
#include <jni.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined(_WIN32)
#include <windows.h>

#include <direct.h>
#endif
#include "prim.h"
#include "test.h"

/* ---- Files ----------------------------------------------------------------------------------------------------------- */

static void write_file(const char *folder, const char *name, const char *text, mode_t mode) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    CHECK(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0 && chmod(path, mode) == 0);
}

/* Creates a home that contains only the lib folder of the real JVM. */
static const char *make_home_with_lib(void) {
#if defined(_WIN32)
    skip("on Windows, the JVM's libraries are in bin beside java.exe, and only administrators can create symbolic links");
#else
    const char *home = scratch_folder();
    char target[4096], link[4096];
    snprintf(target, sizeof target, "%s/lib", java_home());
    snprintf(link, sizeof link, "%s/lib", home);
    CHECK(symlink(target, link) == 0);
    return home;
#endif
}

static int32_t start_home(const char *home) { return start_at(home, host_classes, NULL, true, 60000); }

/* Checks that a correct start succeeds after a rejected one. */
static void check_start_still_works(void) {
    CHECK(clk_jvm_state() == CLK_STATE_NONE);
    CHECK_OK(start(NULL));
    CHECK(clk_jvm_state() == CLK_STATE_RUNNING);
}

void home_missing(void) {
    CHECK_CODE(CLK_JVM_NOT_FOUND, "/no/such/jvm does not exist", start_home("/no/such/jvm"));
    check_start_still_works();
}

void home_is_a_file(void) {
    char path[4096];
    snprintf(path, sizeof path, "%s/release", java_home());
    CHECK_CODE(CLK_JVM_NOT_FOUND, "is not a folder", start_home(path));
    check_start_still_works();
}

void home_without_libjvm(void) {
    CHECK_CODE(CLK_JVM_NOT_FOUND, PRIM_LIBJVM " is missing", start_home(scratch_folder()));
    check_start_still_works();
}

static const char *make_broken_home(void) {
    const char *home = scratch_folder();
    make_folder(home, "bin");
    make_folder(home, "bin/server");
    make_folder(home, "lib");
    make_folder(home, "lib/server");
    write_file(home, PRIM_LIBJVM, "no library", 0644);
    return home;
}

void home_without_modules(void) {
    CHECK_CODE(CLK_JVM_NOT_FOUND, "lib/modules is missing", start_home(make_broken_home()));
    check_start_still_works();
}

void home_of_an_old_version(void) {
    const char *home = make_broken_home();
    write_file(home, "lib/modules", "x", 0644);
    write_file(home, "release", "IMPLEMENTOR=\"x\"\nJAVA_VERSION=\"11.0.2\"\n", 0644);
    CHECK_CODE(CLK_JVM_NOT_FOUND, "Java 11", start_home(home));
    check_start_still_works();
}

void home_of_another_platform(void) {
    const char *home = make_broken_home();
    write_file(home, "lib/modules", "x", 0644);
    write_file(home, "release", "JAVA_VERSION=\"25\"\nOS_ARCH=\"riscv64\"\nOS_NAME=\"" PRIM_SYSTEM "\"\n", 0644);
    CHECK_CODE(CLK_JVM_NOT_FOUND, " on riscv64; this process needs one for " PRIM_PLATFORM, start_home(home));
    write_file(home, "release", "JAVA_VERSION=\"25\"\nOS_ARCH=\"" PRIM_ARCHITECTURE "\"\nOS_NAME=\"SunOS\"\n", 0644);
    CHECK_CODE(CLK_JVM_NOT_FOUND, "is for SunOS on", start_home(home));
    check_start_still_works();
}

void home_with_a_broken_libjvm(void) {
    const char *home = make_broken_home();
    write_file(home, "lib/modules", "", 0644);
    CHECK_CODE(CLK_JVM_NOT_FOUND, own_or(PRIM_JAVA, "; install a JVM for " PRIM_PLATFORM), start_home(home));
    check_start_still_works();
}

#if defined(_WIN32)
/* Opens a file exclusively, as another program could do. */
static void *block_reading(const char *folder, const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    HANDLE file = CreateFileA(path, GENERIC_READ, 0, NULL, OPEN_EXISTING, 0, NULL);
    CHECK(file != INVALID_HANDLE_VALUE);
    return file;
}

static void unblock_reading(void *file) { CloseHandle(file); }
#else
/* Removes the permissions of a file, and drops root privileges, because root can read everything. */
static void *block_reading(const char *folder, const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    CHECK(chmod(path, 0) == 0 && (geteuid() != 0 || setreuid(65534, (uid_t)-1) == 0));
    return NULL;
}

static void unblock_reading(void *file) {
    (void)file;
    CHECK(geteuid() != 0 || setreuid(0, (uid_t)-1) == 0);
}
#endif

void files_that_cannot_be_read(void) {
    char path[4096];
    const char *home = make_broken_home();
    write_file(home, "lib/modules", "", 0644);
    write_file(home, "host.jar", "", 0644);
    snprintf(path, sizeof path, "%s/host.jar", home);
    void *library = block_reading(home, PRIM_LIBJVM);
    CHECK_CODE(CLK_JVM_NOT_FOUND, PRIM_LIBJVM "; " PRIM_READ_ADVICE, start_home(home));
    unblock_reading(library);
    void *jar = block_reading(home, "host.jar");
    CHECK_CODE(CLK_HOST, "host.jar on the host's class path; " PRIM_READ_ADVICE, start_at(java_home(), path, NULL, true, 60000));
    unblock_reading(jar);
    check_start_still_works();
}

void home_without_java_command(void) {
    const char *home = make_home_with_lib();
    CHECK_CODE(placement == CLK_OWN_PROCESS ? CLK_JVM_NOT_FOUND : CLK_OK, own_or(PRIM_JAVA " is missing", NULL), start_home(home));
    CHECK(log_mentions("not checked before the start"));
}

void class_path_missing(void) {
    char path[8192];
    snprintf(path, sizeof path, "%s%c/no/such/host.jar", host_classes, PRIM_PATH_SEPARATOR);
    CHECK_CODE(CLK_HOST, "/no/such/host.jar", start_at(java_home(), path, NULL, true, 60000));
    check_start_still_works();
}

#if defined(_WIN32)
/* Only the UTF-8 code page contains both characters of the path. */
void class_path_beyond_ascii(void) {
    char path[4096];
    if (GetACP() == CP_UTF8) skip("this system's code page is UTF-8, which can encode all characters");
    snprintf(path, sizeof path, "%s/\xC3\xA4\xE4\xB8\xAD", scratch_folder());
    wchar_t wide[4096];
    MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, 4096);
    CHECK(_wmkdir(wide) == 0);
    CHECK_CODE(CLK_HOST, "the Windows code page cannot encode", start_at(java_home(), path, NULL, true, 60000));
    CHECK_CODE(CLK_JVM_NOT_FOUND, "is missing", start_home(path));
    check_start_still_works();
}
#else
void class_path_beyond_ascii(void) {
    char path[4096];
    snprintf(path, sizeof path, "%s/\xC3\xA4", scratch_folder());
    CHECK(symlink(host_classes, path) == 0);
    CHECK(setenv("LC_ALL", "C", 1) == 0);
    CHECK_CODE(CLK_HOST, "LC_ALL=C.UTF-8", start_at(java_home(), path, NULL, true, 60000));
    CHECK(setenv("LC_ALL", "C.UTF-8", 1) == 0);
    CHECK_OK(start_at(java_home(), path, NULL, true, 60000));
}
#endif

static void check_lost(void) {
    clk_session session;
    if (placement == CLK_OWN_PROCESS) {
        check_start_still_works();
        return;
    }
    CHECK(clk_jvm_state() == CLK_STATE_LOST);
    CHECK_CODE(CLK_JVM_LOST, "the JVM has crashed or stopped responding", clk_session_open(1, 0, 8, 1000, &session, &answer));
    CHECK_CODE(CLK_JVM_LOST, "the JVM has crashed or stopped responding", start(NULL));
    CHECK_CODE(CLK_JVM_LOST, "the JVM has crashed or stopped responding", clk_jvm_stop(1000));
}

void class_path_without_host(void) {
    CHECK_CODE(CLK_HOST, own_or("does not contain org.collektive.host.Main", "org/collektive/host/shim/Shim"),
               start_at(java_home(), scratch_folder(), NULL, true, 60000));
    check_lost();
}

void class_path_with_incompatible_host(void) {
    CHECK_CODE(CLK_HOST, "lacks a method", start_at(java_home(), incompatible_classes, NULL, true, 60000));
    check_lost();
    check_threads_stand_still(); /* clk_jvm_stop halted the thread of the incompatible host */
}

/* ---- Options --------------------------------------------------------------------------------------------------------- */

void start_arguments(void) {
    CHECK_CODE(CLK_ARGUMENT, "config is NULL", clk_jvm_start(NULL));
    CHECK_CODE(CLK_ARGUMENT, "home is empty", start_at("", "x", NULL, true, 1000));
    CHECK_CODE(CLK_ARGUMENT, "home is empty", start_at(NULL, "x", NULL, true, 1000));
    CHECK_CODE(CLK_ARGUMENT, "class_path is empty", start_at(java_home(), "", NULL, true, 1000));
    CHECK_CODE(CLK_ARGUMENT, "start_limit_ms is 0", start_at(java_home(), host_classes, NULL, true, 0));
    clk_jvm_config config = {.size = sizeof config, .home = "/", .class_path = "x", .start_limit_ms = 1, .option_count = 1};
    CHECK_CODE(CLK_ARGUMENT, "option_count is 1", clk_jvm_start(&config));
    config.options = (const char *const[]){NULL};
    CHECK_CODE(CLK_ARGUMENT, "option 0 is NULL", clk_jvm_start(&config));
    config.option_count = -1;
    CHECK_CODE(CLK_ARGUMENT, "option_count is -1", clk_jvm_start(&config));
}

void options_refused_by_text(void) {
    /* clang-format off */
    static const char *const refused[] = {
        "-XX:+ExitOnOutOfMemoryError", "-XX:+CrashOnOutOfMemoryError", "-XX:OnOutOfMemoryError=ls", "-XX:OnError=gdb",
        "-XX:+AbortVMOnSafepointTimeout", "-XX:AbortVMOnException=java.lang.Error", "-XX:SelfDestructTimer=1", "-XX:+ShowMessageBoxOnError",
        "-XX:+AllowUserSignalHandlers", "-XX:-UseSignalChaining", "-XX:-ReduceSignalUsage", "-XX:Flags=x", "-XX:VMOptionsFile=x",
        "-Djava.class.path=x", "-version", "--version", "-X", "-help", "-jar", "x.jar", "@file", "", "vfprintf", "-cp", "-Xinternalversion",
        "-Xmx64m\n-Xint", "-Dcom.sun.management.jmxremote.port=7091", "-Dcom.sun.management.config.file=x",
    };
    /* clang-format on */
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        CHECK_CODE(CLK_JVM_OPTIONS, "is not allowed", start_at(java_home(), host_classes, OPTIONS(refused[i]), false, 60000));
    }
    check_start_still_works();
}

/* Tries to bypass the check of the debugger options. Only one form of them is allowed. */
void options_of_debuggers(void) {
    static const char *const refused[] = {
        "",
        "help",
        "transport=dt_socket,server=y,address=127.0.0.1:5005",
        "transport=dt_socket,server=y,suspend=y,address=127.0.0.1:5005",
        "transport=dt_socket,server=y,suspend=n",
        "transport=dt_socket,server=y,suspend=n,address=5005",
        "transport=dt_socket,server=y,suspend=n,address=*:5005",
        "transport=dt_socket,server=y,suspend=n,address=127.0.0.1:",
        "transport=dt_socket,server=y,suspend=n,address=127.0.0.1:5005,address=*:5005",
        "transport=dt_socket,server=y,suspend=n,address=127.0.0.1.example.org:5005",
        "transport=dt_socket,server=y,suspend=n,address=127.0.0.1:5005,onuncaught=y,launch=/bin/ls",
        "transport=dt_socket,server=y,suspend=n,address=127.0.0.1:5005,suspend=y",
        "transport=dt_other,server=y,suspend=n,address=127.0.0.1:5005",
    };
    static const char *const agents[] = {"-agentlib:jdwp=", "-Xrunjdwp:", "-agentpath:/x/libjdwp.so=", "-agentpath:C:/x/jdwp.dll="};
    char option[256];
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        for (size_t agent = 0; agent < sizeof agents / sizeof agents[0]; agent++) {
            snprintf(option, sizeof option, "%s%s", agents[agent], refused[i]);
            CHECK_CODE(CLK_JVM_OPTIONS, "suspend=n,address=127.0.0.1:PORT", check_texts(OPTIONS(option)));
        }
    }
    CHECK_CODE(CLK_JVM_OPTIONS, "suspend=n,address=127.0.0.1:PORT", check_texts(OPTIONS("-agentlib:jdwp")));
    CHECK_OK(check_texts(OPTIONS("-agentlib:jdwp=transport=dt_socket,server=y,suspend=n,address=127.0.0.1:5005")));
}

void options_too_long(void) {
    static char option[1 << 20];
    memset(option, 'x', sizeof option - 1);
    memcpy(option, "-Dx=", 4);
    CHECK_CODE(CLK_JVM_OPTIONS, "an option may have at most 8 KiB", check(OPTIONS(option)));
    option[8 << 10] = '\0';
    CHECK_OK(check_texts(OPTIONS(option)));
    CHECK_OK(check(OPTIONS(option, option)));
    CHECK_CODE(CLK_JVM_OPTIONS, "all options together", check(OPTIONS(option, option, option)));
}

void options_refused_by_child(void) {
    CHECK_CODE(CLK_JVM_OPTIONS, "NoSuchOption", start(OPTIONS("-XX:+NoSuchOption")));
    CHECK_CODE(CLK_JVM_OPTIONS, "heap size", start(OPTIONS("-Xms128m", "-Xmx64m")));
    CHECK_CODE(CLK_JVM_OPTIONS, "ollector", start(OPTIONS("-XX:+UseSerialGC", "-XX:+UseParallelGC")));
    CHECK_CODE(CLK_JVM_OPTIONS, "heap", start(OPTIONS("-Xms200000g", "-Xmx200000g")));
    CHECK_CODE(CLK_JVM_OPTIONS, "-Xmx64q", start(OPTIONS("-Xmx64q")));
    CHECK_CODE(CLK_JVM_OPTIONS, "no.such.module", start(OPTIONS("--add-modules=no.such.module")));
    CHECK_CODE(CLK_JVM_OPTIONS, "no_such_agent", start(OPTIONS("-agentlib:no_such_agent")));
    check_start_still_works();
}

void options_that_make_the_jvm_print(void) { CHECK_OK(start(OPTIONS("-verbose:class"))); }

void jvm_log_in_a_file(void) {
    char option[128], line[1024];
    snprintf(option, sizeof option, "-Xlog:gc+init:file=%s/gc.log", scratch_folder());
    CHECK_OK(start(OPTIONS(option)));
    CHECK_OK(clk_jvm_stop(60000));
    FILE *file = fopen(strchr(option, '=') + 1, "r");
    CHECK(file != NULL && fgets(line, sizeof line, file) != NULL && strstr(line, "[gc,init]") != NULL);
    fclose(file);
    CHECK(!log_mentions("[gc,init]"));
}

/* The JVM logs its class path in one line, except Java 17. */
void long_lines_of_the_jvm(void) {
    if (java_is_17()) return;
    static char class_path[12000];
    char line[8192];
    int32_t level, cut = 0;
    int used = snprintf(class_path, sizeof class_path, "%s", host_classes);
    while (used < 9000) used += snprintf(class_path + used, sizeof class_path - (size_t)used, "%c%s", PRIM_PATH_SEPARATOR, host_classes);
    CHECK_OK(start_at(java_home(), class_path, OPTIONS("-Xlog:arguments=info"), false, 60000));
    while (clk_log_read(&level, line, sizeof line) >= 0) {
        if (strstr(line, " VM warning: ") != NULL) continue; /* the JVM prints a warning with Wine */
        CHECK(line[0] == '[');                               /* all other lines begin with the time */
        if (strlen(line) == sizeof line - 1) cut++;
    }
    CHECK(cut > 0);
}

void refusals_are_cut_at_a_character(void) {
    char option[2048], text[4096];
    for (int shift = 0; shift < 2; shift++) {
        int used = snprintf(option, sizeof option, "-XX:+NoSuch");
        while (used < 1800) used += snprintf(option + used, sizeof option - (size_t)used, "\xC3\xA4");
        snprintf(option + used, sizeof option - (size_t)used, "%s", shift ? "x" : "");
        CHECK_CODE(CLK_JVM_OPTIONS, shift ? "\xC3\xA4x" : "\xC3\xA4'", check(OPTIONS(option)));
        clk_last_error(text, sizeof text);
        CHECK(((unsigned char)strstr(text, "): ")[3] & 0xC0) != 0x80);
    }
}

void option_that_ends_the_jvm(void) {
    CHECK_CODE(CLK_JVM_OPTIONS, "during its start", start(OPTIONS("-Xlog:help")));
    check_start_still_works();
}

void refused_start_may_be_repeated(void) {
    for (int i = 0; i < 3; i++) CHECK_CODE(CLK_JVM_OPTIONS, NULL, start(OPTIONS("-Xmx64q")));
    CHECK_OK(start(OPTIONS("-Xmx64m", "-XX:+UseSerialGC")));
}

void check_starts_nothing(void) {
    CHECK_CODE(CLK_JVM_OPTIONS, "-Xmx64q", check(OPTIONS("-Xmx64q")));
    CHECK_CODE(CLK_JVM_OPTIONS, "is not allowed", check(OPTIONS("-XX:-UseSignalChaining")));
    CHECK_OK(check(OPTIONS("-Xmx64m")));
    CHECK(clk_jvm_state() == CLK_STATE_NONE);
    /* The configuration has passed, so the child process does not run again. */
    int64_t begin = now_ns();
    for (int i = 0; i < 100; i++) CHECK_OK(check(OPTIONS("-Xmx64m")));
    CHECK(now_ns() - begin < 1000000000);
    CHECK_OK(start(OPTIONS("-Xmx64m")));
}

void check_while_a_jvm_runs(void) {
    char before[1024], after[1024];
    CHECK_OK(start(OPTIONS("-Xmx64m")));
    clk_jvm_description(before, sizeof before);
    CHECK_OK(check(OPTIONS("-Xmx65m")));
    CHECK_CODE(CLK_JVM_OPTIONS, "-Xmx64q", check(OPTIONS("-Xmx64q")));
    clk_jvm_description(after, sizeof after);
    CHECK(strcmp(before, after) == 0 && clk_jvm_state() == CLK_STATE_RUNNING);
    CHECK_OK(start(OPTIONS("-Xmx64m")));
}

/* Creates a home whose java command creates the file bin/java.running and then runs for 30 s. */
static const char *make_home_with_slow_java(void) {
    const char *home = make_home_with_lib();
    make_folder(home, "bin");
    write_file(home, "bin/java", "#!/bin/sh\necho still at it\ntouch \"$0.running\"\nsleep 30\n", 0755);
    return home;
}

static void *check_slowly(void *home) {
    clk_jvm_config config = {.size = sizeof config, .home = home, .class_path = host_classes, .start_limit_ms = 2000, .check_options = 1};
    CHECK_CODE(CLK_TIMEOUT, "still at it", clk_jvm_check(&config));
    return NULL;
}

void checks_take_turns_after_a_loss(void) {
    clk_session session;
    pthread_t slow;
    char home[64], running[128];
    start_plain();
    CHECK_OK(open_session(&session));
    CHECK_CODE(CLK_JVM_LOST, own_or("hs_err", "it aborted"), step(session, CRASH, 0, 60000));
    snprintf(home, sizeof home, "%s", make_home_with_slow_java());
    snprintf(running, sizeof running, "%s/bin/java.running", home);
    CHECK(pthread_create(&slow, NULL, check_slowly, home) == 0);
    while (access(running, F_OK) != 0) sleep_ms(1);
    clk_jvm_config config = {.size = sizeof config, .home = java_home(), .class_path = host_classes, .start_limit_ms = 200};
    CHECK_CODE(CLK_TIMEOUT, "busy with another call", clk_jvm_check(&config));
    CHECK(pthread_join(slow, NULL) == 0);
    CHECK_OK(clk_jvm_check(&config));
}

void check_writes_no_archive(void) {
    const char *folder = scratch_folder();
    char at_exit[128], automatic[128];
    snprintf(at_exit, sizeof at_exit, "-XX:ArchiveClassesAtExit=%s/classes.jsa", folder);
    snprintf(automatic, sizeof automatic, "-XX:SharedArchiveFile=%s/classes.jsa", folder);
    CHECK_OK(check(OPTIONS("-Xmx64m", at_exit)));
    CHECK(access(strchr(at_exit, '=') + 1, F_OK) != 0);
    if (java_is_17()) return; /* Java 17 lacks the option */
    CHECK_OK(check(OPTIONS("-Xmx64m", "-XX:+AutoCreateSharedArchive", automatic)));
    CHECK(access(strchr(at_exit, '=') + 1, F_OK) != 0);
}

static void check_unchecked(const char *const *options, const char *mention) {
    CHECK_CODE(CLK_JVM_START, mention, start_at(java_home(), host_classes, options, false, 60000));
    check_lost();
}

void options_unchecked_heap_order(void) { check_unchecked(OPTIONS("-Xms128m", "-Xmx64m"), "heap size"); }

void options_unchecked_two_collectors(void) { check_unchecked(OPTIONS("-XX:+UseSerialGC", "-XX:+UseParallelGC"), "ollector"); }

void options_unchecked_heap_too_large(void) { check_unchecked(OPTIONS("-Xms200000g", "-Xmx200000g"), "heap"); }

void options_unchecked_unknown(void) { check_unchecked(OPTIONS("-XX:+NoSuchOption"), "NoSuchOption"); }

#if defined(_WIN32)
static LONG CALLBACK on_unhandled(EXCEPTION_POINTERS *exception) {
    (void)exception;
    return EXCEPTION_CONTINUE_SEARCH;
}

void failed_start_restores_signal_handlers(void) {
    SetUnhandledExceptionFilter(on_unhandled);
    check_unchecked(OPTIONS("--add-modules=no.such.module"), NULL);
    CHECK(SetUnhandledExceptionFilter(NULL) == on_unhandled);
}
#else
static void on_fault(int signal, siginfo_t *info, void *context) {
    (void)signal;
    (void)info;
    (void)context;
}

void failed_start_restores_signal_handlers(void) {
    static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};
    struct sigaction mine = {.sa_sigaction = on_fault, .sa_flags = SA_SIGINFO | SA_ONSTACK};
    for (int i = 0; i < 4; i++) CHECK(sigaction(faults[i], &mine, NULL) == 0);
    check_unchecked(OPTIONS("--add-modules=no.such.module"), own_or("no.such.module", "standard error"));
    for (int i = 0; i < 4; i++) {
        struct sigaction now;
        CHECK(sigaction(faults[i], NULL, &now) == 0 && now.sa_sigaction == on_fault);
    }
}

#endif

static void set_variable(const char *name, const char *value) {
#if defined(_WIN32)
    CHECK(_putenv_s(name, value) == 0);
#else
    CHECK(setenv(name, value, 1) == 0);
#endif
}

void environment_is_ignored(void) {
    set_variable("JAVA_TOOL_OPTIONS", "-XX:+NoSuchOption");
    set_variable("JDK_JAVA_OPTIONS", "-version");
    set_variable("_JAVA_OPTIONS", "-XX:+NoSuchOption");
    CHECK_OK(start(NULL));
    CHECK(log_mentions("JAVA_TOOL_OPTIONS is ignored") && log_mentions("_JAVA_OPTIONS is ignored"));
    CHECK(strcmp(getenv("JAVA_TOOL_OPTIONS"), "-XX:+NoSuchOption") == 0 && strcmp(getenv("JDK_JAVA_OPTIONS"), "-version") == 0);
}

/* ---- Repeated starts ---------------------------------------------------------------------------------------------- */

void second_start(void) {
    char text[4096];
    CHECK_CODE(CLK_JVM_NOT_RUNNING, NULL, clk_jvm_description(text, sizeof text));
    CHECK_OK(start(OPTIONS("-Xmx64m", "-Xss2m")));
    CHECK_OK(start(OPTIONS("-Xmx64m", "-Xss2m")));
    clk_session session;
    CHECK_OK(clk_slot_acquire(1 << 20, &request, &request_memory));
    CHECK_OK(open_session(&session)); /* without an open session, a JVM in its own process would be replaced */
    CHECK_CODE(CLK_JVM_RUNNING, own_or("close them first", "restart the process"), start(OPTIONS("-Xmx65m", "-Xss2m")));
    CHECK_CODE(CLK_JVM_RUNNING, NULL, start(OPTIONS("-Xmx64m")));
    CHECK_CODE(CLK_JVM_RUNNING, NULL, start_at(java_home(), incompatible_classes, OPTIONS("-Xmx64m", "-Xss2m"), true, 60000));
    CHECK(clk_jvm_state() == CLK_STATE_RUNNING);

    char expected[4096];
    snprintf(expected, sizeof expected, "%s\ntest host on %s \xF0\x9F\x9A\x80\n-Xmx64m\n-Xss2m", java_home(), java_is_17() ? "17" : "25");
    CHECK(clk_jvm_description(text, sizeof text) == (int32_t)strlen(expected));
    if (java_is_17() || strstr(text, " 25 ") != NULL) CHECK(strcmp(text, expected) == 0);
}

static void *start_thread(void *result) {
    *(int32_t *)result = start(NULL);
    return NULL;
}

void start_from_two_threads(void) {
    int32_t results[2] = {1, 1};
    pthread_t threads[2];
    for (int i = 0; i < 2; i++) CHECK(pthread_create(&threads[i], NULL, start_thread, &results[i]) == 0);
    for (int i = 0; i < 2; i++) CHECK(pthread_join(threads[i], NULL) == 0 && results[i] == CLK_OK);
}

void start_limit(void) {
    int64_t begin = now_ns();
    CHECK_CODE(CLK_TIMEOUT, "still at it", start_at(make_home_with_slow_java(), host_classes, NULL, true, 300));
    CHECK(now_ns() - begin < 10000000000);
    check_start_still_works();
}

typedef jint(JNICALL create_function)(JavaVM **, void **, void *);

void foreign_jvm(void) {
    char path[4096];
    JavaVM *vm;
    void *env;
    create_function *create;
    char why[256];
    snprintf(path, sizeof path, "%s/" PRIM_LIBJVM, java_home());
    void *library = prim_library_open(path, why, sizeof why);
    CHECK(library != NULL);
    *(void **)&create = prim_library_symbol(library, "JNI_CreateJavaVM");
    JavaVMInitArgs arguments = {.version = JNI_VERSION_10};
    CHECK(create(&vm, &env, &arguments) == JNI_OK);
    if (placement == CLK_OWN_PROCESS) {
        CHECK_OK(start(NULL)); /* another JVM in this process does not matter */
        return;
    }
    CHECK_CODE(CLK_JVM_START, "another library", start(NULL));
    CHECK(clk_jvm_state() == CLK_STATE_NONE);
}

void nothing_runs_without_a_jvm(void) {
    clk_session session;
    CHECK_CODE(CLK_JVM_NOT_RUNNING, "clk_jvm_start", clk_session_open(1, 0, 8, 1000, &session, &answer));
    CHECK_CODE(CLK_JVM_NOT_RUNNING, "clk_jvm_start", clk_step(1, 1, 0, 8, 1000, &answer));
    CHECK_CODE(CLK_JVM_NOT_RUNNING, "clk_jvm_start", clk_session_close(1, 1000));
    CHECK(clk_log_read(NULL, NULL, 0) == -1);
}
