#include "options.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "debugger.h"
#include "error.h"
#include "log.h"
#include "prim.h"
#include "text.h"

/* ---- By their text --------------------------------------------------------------------------------------------------- */

/* A rule whose text ends in '*' matches all options that begin with the rest. */
struct rule {
    const char *text;
    const char *reason;
};

static const struct rule refused[] = {
    {"-Dcom.sun.management.*", "its ports are open to other machines; jcmd and JDK Mission Control find this JVM without a port"},
    {"-XX:+ExitOnOutOfMemoryError", "it ends the whole process when a program exhausts the heap"},
    {"-XX:+CrashOnOutOfMemoryError", "it crashes the whole process when a program exhausts the heap"},
    {"-XX:OnOutOfMemoryError=*", "it forks the whole process to run a command"},
    {"-XX:OnError=*", "it forks the whole process to run a command"},
    {"-XX:+AbortVMOn*", "it aborts the whole process"},
    {"-XX:AbortVMOnException*", "it aborts the whole process"},
    {"-XX:SelfDestructTimer=*", "it ends the whole process after that many minutes"},
    {"-XX:+ShowMessageBoxOnError", "it waits at the console of the process for ever"},
    {"-XX:+AllowUserSignalHandlers", "the signal handlers of the host process and of the JVM would shut each other out"},
    {"-XX:-UseSignalChaining", "the signal handlers of the host process would not be called any more"},
    {"-XX:-ReduceSignalUsage", "the JVM would take over the signals that end the host process"},
    {"-XX:Flags=*", "options in a file cannot be checked; give them one by one"},
    {"-XX:VMOptionsFile=*", "options in a file cannot be checked; give them one by one"},
    {"-Djava.class.path=*", "the class path is that of the host; programs load from the jars of a session"},
    {"-X", "only the java command knows it"},
    {"-Xinternalversion", "it prints the version and ends the process"},
    {"-XshowSettings*", "only the java command knows it"},
    {"-Xdiag*", "only the java command knows it"},
};

/* clang-format off */
static const char *const known[] = {
    "-X*", "-D*", "-verbose", "-verbose:*", "-ea", "-ea:*", "-da", "-da:*", "-esa", "-dsa", "-enableassertions",
    "-enableassertions:*", "-disableassertions", "-disableassertions:*", "-enablesystemassertions", "-disablesystemassertions",
    "-agentlib:*", "-agentpath:*", "-javaagent:*", "--add-exports=*", "--add-modules=*", "--add-opens=*", "--add-reads=*",
    "--enable-final-field-mutation=*", "--enable-native-access=*", "--enable-preview", "--finalization=*",
    "--illegal-access=*", "--illegal-final-field-mutation=*", "--illegal-native-access=*", "--limit-modules=*",
    "--module-path=*", "--patch-module=*", "--sun-misc-unsafe-memory-access=*", "--upgrade-module-path=*",
};
/* clang-format on */

static bool matches(const char *option, const char *text) {
    size_t length = strlen(text);
    return text[length - 1] == '*' ? strncmp(option, text, length - 1) == 0 : strcmp(option, text) == 0;
}

static int32_t refuse(const char *option, const char *reason) {
    return error_set(CLK_JVM_OPTIONS, "remove '%s' from the JVM options; it is refused, as %s", option, reason);
}

static int32_t check_one(const char *option) {
    if (strchr(option, '\n') != NULL) return refuse(option, "it has a line break");
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        if (matches(option, refused[i].text)) return refuse(option, refused[i].reason);
    }
    const char *fault = debugger_fault(option);
    if (fault != NULL) return refuse(option, fault);
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (matches(option, known[i])) return CLK_OK;
    }
    return refuse(option, "a JVM inside another process knows no such option (give each as one word, with '=' before its value)");
}

/* What is longer could not be tried in a child: Windows has room for 32 KiB in a command line. */
enum { OPTION_BYTES = 8 << 10, ALL_BYTES = 24 << 10 };

int32_t options_check(const char *const options[], int32_t count) {
    size_t bytes = 0;
    int32_t result = CLK_OK;
    for (int32_t i = 0; result == CLK_OK && i < count; i++) {
        size_t length = strlen(options[i]);
        bytes += length + 1;
        if (length > OPTION_BYTES || bytes > ALL_BYTES) {
            return error_set(CLK_JVM_OPTIONS, "shorten the JVM options; '%.40s...' is refused, as %s", options[i],
                             length > OPTION_BYTES ? "one option has at most 8 KiB" : "all options together have at most 24 KiB");
        }
        result = check_one(options[i]);
    }
    return result;
}

/* ---- In a child process ---------------------------------------------------------------------------------------------- */

/* Puts the JVM's output on one line, without the launcher's general message. */
static void tidy(char *text) {
    char *general = strstr(text, "Error: Could not create the Java Virtual Machine");
    if (general != NULL) *general = '\0';
    char *end = text + strlen(text);
    while (end > text && (end[-1] == '\n' || end[-1] == ' ')) *--end = '\0';
    for (char *at = text; (at = strchr(at, '\n')) != NULL;) *at = ' ';
}

bool options_write_archive(const char *option) {
    return matches(option, "-XX:ArchiveClassesAtExit=*") || matches(option, "-XX:+AutoCreateSharedArchive");
}

const char *options_archive(char *const options[], int32_t count) {
    const char *file = NULL;
    bool writes = false;
    for (int32_t i = 0; i < count; i++) {
        writes = writes || options_write_archive(options[i]);
        if (matches(options[i], "-XX:ArchiveClassesAtExit=*") || matches(options[i], "-XX:SharedArchiveFile=*"))
            file = strchr(options[i], '=') + 1;
    }
    return writes ? file : NULL;
}

#define OUTPUT_SHOWN 1000

int32_t options_try(const char *home, char *const options[], int32_t count, int64_t deadline) {
    char java[4096];
    char output[16384]; /* some options make the JVM write a lot before the error */
    int status = 0;
    static char version[] = "-version";
    static char no_report[] = "-XX:ErrorFile=" PRIM_NULL_FILE; /* a child that crashes needs no report */
    snprintf(java, sizeof java, "%s/" PRIM_JAVA, home);
    if (!prim_executable(java)) {
        log_format(CLK_LOG_INFO, "the JVM options are not tried before the start, as %s is missing or not executable", java);
        return CLK_OK;
    }
    char **arguments = malloc(((size_t)count + 4) * sizeof *arguments);
    if (arguments == NULL) return error_set(CLK_MEMORY, "no memory for %d JVM options", count);
    arguments[0] = java;
    int32_t used = 1;
    for (int32_t i = 0; i < count; i++) {
        /* The child would write an archive of its own few classes. */
        if (!options_write_archive(options[i])) arguments[used++] = options[i];
    }
    arguments[used++] = no_report;
    arguments[used++] = version;
    arguments[used] = NULL;
    enum prim_run run = prim_process_run(arguments, deadline, output, sizeof output, &status);
    free(arguments);
    /* Some options end the JVM with code 0 before it is up, and so before it prints its version. */
    bool came_up = strstr(output, " version \"") != NULL;
    size_t length = strlen(output);
    char *end = length > OUTPUT_SHOWN ? text_next_character(output + length - OUTPUT_SHOWN) : output;
    tidy(end);
    const char *wrote = end[0] != '\0' ? end : "nothing";
    switch (run) {
        case PRIM_NOT_STARTED:
            log_format(CLK_LOG_WARNING, "the JVM options are not tried before the start, as %s could not be run", java);
            return CLK_OK;
        case PRIM_TIMED_OUT:
            return error_set(CLK_TIMEOUT, "trying the JVM options took longer than the time limit; %s wrote: %s", java, wrote);
        default: break;
    }
    if (status == 0 && came_up) return CLK_OK;
    if (status == 0) return error_set(CLK_JVM_OPTIONS, "correct the JVM options: one of them ends the JVM of %s before it is up", home);
    if (status > 128) {
        return error_set(CLK_JVM_OPTIONS,
                         "the JVM of %s crashes with these options (signal %d): correct them, or reinstall it if its files are "
                         "damaged; it wrote: %s",
                         home, status - 128, wrote);
    }
    return error_set(CLK_JVM_OPTIONS, "correct the JVM options; the JVM of %s refuses them (exit code %d): %s", home, status, wrote);
}
