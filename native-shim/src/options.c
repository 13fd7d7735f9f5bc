#include "options.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "error.h"
#include "log.h"
#include "prim.h"
#include "text.h"

/* ---- Checks of the text ---------------------------------------------------------------------------------------------- */

/* A text that ends in '*' matches all options that begin with the part before it. */
struct rule {
    const char *text;
    const char *reason;
};

static const struct rule forbidden[] = {
    {"-Dcom.sun.management.*", "it opens ports to other machines; jcmd and JDK Mission Control find this JVM without a port"},
    {"-XX:+ExitOnOutOfMemoryError", "it ends the whole process when a program exhausts the heap"},
    {"-XX:+CrashOnOutOfMemoryError", "it crashes the whole process when a program exhausts the heap"},
    {"-XX:OnOutOfMemoryError=*", "it forks the process to run a command"},
    {"-XX:OnError=*", "it forks the process to run a command"},
    {"-XX:+AbortVMOn*", "it aborts the whole process"},
    {"-XX:AbortVMOnException*", "it aborts the whole process"},
    {"-XX:SelfDestructTimer=*", "it ends the whole process after the given number of minutes"},
    {"-XX:+ShowMessageBoxOnError", "it waits for input on the console"},
    {"-XX:+AllowUserSignalHandlers", "the signal handlers of the process and of the JVM would conflict"},
    {"-XX:-UseSignalChaining", "the signal handlers of the process would no longer be called"},
    {"-XX:-ReduceSignalUsage", "the JVM would handle the signals that end the process"},
    {"-XX:Flags=*", "options in a file cannot be checked; list them one by one"},
    {"-XX:VMOptionsFile=*", "options in a file cannot be checked; list them one by one"},
    {"-Djava.class.path=*", "the class path is reserved for the host; programs are loaded from the jars of a session"},
    {"-X", "only the java command supports it"},
    {"-Xinternalversion", "it prints the version and ends the process"},
    {"-XshowSettings*", "only the java command supports it"},
    {"-Xdiag*", "only the java command supports it"},
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

#define JDWP "-agentlib:jdwp=transport=dt_socket,server=y,suspend=n,address=127.0.0.1:"

/* Only options of the form JDWP and a port are safe. Other options of the debugger agent can open its port to other machines, run commands, write
 * files, end the process or wait for a debugger. */
static bool is_unsafe_debugger(const char *option) {
    bool is_debugger = matches(option, "-agentlib:jdwp*") || matches(option, "-Xrunjdwp*") ||
                       (matches(option, "-agentpath:*") && strstr(option, "jdwp") != NULL);
    if (!is_debugger || !matches(option, JDWP "*")) return is_debugger;
    const char *port = option + strlen(JDWP);
    return port[0] == '\0' || port[strspn(port, "0123456789")] != '\0';
}

static int32_t reject(const char *option, const char *reason) {
    return error_set(CLK_JVM_OPTIONS, "the JVM option '%s' is not allowed: %s", option, reason);
}

static int32_t check_one(const char *option) {
    if (strchr(option, '\n') != NULL) return reject(option, "it contains a line break");
    for (size_t i = 0; i < sizeof forbidden / sizeof forbidden[0]; i++) {
        if (matches(option, forbidden[i].text)) return reject(option, forbidden[i].reason);
    }
    if (is_unsafe_debugger(option))
        return reject(option, "it may open the port to other machines, run commands or delay the start; use " JDWP "PORT");
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (matches(option, known[i])) return CLK_OK;
    }
    return reject(option, "an embedded JVM does not support it; write each option as one word, with '=' before its value");
}

/* Windows limits a command line to 32 KiB, so longer options could not be tried in a child process. */
enum { OPTION_BYTES = 8 << 10, ALL_BYTES = 24 << 10 };

int32_t options_check(const char *const options[], int32_t count) {
    size_t bytes = 0;
    int32_t result = CLK_OK;
    for (int32_t i = 0; result == CLK_OK && i < count; i++) {
        size_t length = strlen(options[i]);
        bytes += length + 1;
        if (length > OPTION_BYTES || bytes > ALL_BYTES) {
            return error_set(CLK_JVM_OPTIONS, "the JVM option '%.40s...' is too long: %s; shorten the JVM options", options[i],
                             length > OPTION_BYTES ? "an option may have at most 8 KiB" : "all options together may have at most 24 KiB");
        }
        result = check_one(options[i]);
    }
    return result;
}

/* ---- Checks in a child process --------------------------------------------------------------------------------------- */

/* Joins the lines of the JVM's output, without the launcher's general message at the end. */
static void join_lines(char *text) {
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

#define KILL_LIMIT_MS 1000

enum run { EXITED, NOT_STARTED, TIMED_OUT };

/* Runs a program and kills it at the deadline. Copies its output to `output`. If the output does not fit, keeps the end, at least a quarter of
 * `size`. */
static enum run run(char *const argv[], int64_t deadline, char *output, size_t size, int *status) {
    prim_child child;
    size_t used = 0;
    output[0] = '\0';
    if (prim_child_start(argv, false, &child, output, size) == 0) return NOT_STARTED;
    while (prim_child_read(&child, deadline, output + used, size - used)) {
        used += strlen(output + used);
        if (used <= size / 2) continue;
        memmove(output, output + used - size / 4, size / 4 + 1);
        used = size / 4;
    }
    if (prim_child_reap(&child, deadline, status)) return EXITED;
    prim_child_kill(&child);
    prim_child_reap(&child, prim_now() + KILL_LIMIT_MS * PRIM_MILLI, status);
    return TIMED_OUT;
}

#define OUTPUT_SHOWN 1000

int32_t options_try(const char *home, char *const options[], int32_t count, int64_t deadline) {
    char java[4096];
    char output[16384]; /* with some options, the JVM prints a lot before the error */
    int status = 0;
    static char version[] = "-version";
    static char no_report[] = "-XX:ErrorFile=" PRIM_NULL_FILE; /* a child that crashes must not write a report */
    snprintf(java, sizeof java, "%s/" PRIM_JAVA, home);
    if (!prim_executable(java)) {
        log_format(CLK_LOG_INFO, "the JVM options are not checked before the start: %s is missing or not executable", java);
        return CLK_OK;
    }
    char **arguments = malloc(((size_t)count + 4) * sizeof *arguments);
    if (arguments == NULL) return error_set(CLK_MEMORY, "out of memory for %d JVM options", count);
    arguments[0] = java;
    int32_t used = 1;
    for (int32_t i = 0; i < count; i++) {
        /* The child must not write the class archive, because its archive would contain few classes. */
        if (!options_write_archive(options[i])) arguments[used++] = options[i];
    }
    arguments[used++] = no_report;
    arguments[used++] = version;
    arguments[used] = NULL;
    enum run end = run(arguments, deadline, output, sizeof output, &status);
    free(arguments);
    /* The exit code is not enough: some options end the JVM with exit code 0 before it prints its version. */
    bool has_started = strstr(output, " version \"") != NULL;
    size_t length = strlen(output);
    char *last = length > OUTPUT_SHOWN ? text_next_character(output + length - OUTPUT_SHOWN) : output;
    join_lines(last);
    const char *printed = last[0] != '\0' ? last : "nothing";
    if (end == NOT_STARTED) {
        log_format(CLK_LOG_WARNING, "the JVM options are not checked before the start: cannot run %s", java);
        return CLK_OK;
    }
    if (end == TIMED_OUT)
        return error_set(CLK_TIMEOUT, "the check of the JVM options took longer than the time limit; %s printed: %s", java, printed);
    if (status == 0 && has_started) return CLK_OK;
    if (status == 0) return error_set(CLK_JVM_OPTIONS, "one of the JVM options ends the JVM in %s during its start; remove it", home);
    if (status < 0) {
        return error_set(CLK_JVM_OPTIONS,
                         "the JVM in %s crashes with these options (signal %d); correct them, or reinstall the JVM if its files are "
                         "corrupt; it printed: %s",
                         home, -status, printed);
    }
    return error_set(CLK_JVM_OPTIONS, "the JVM in %s rejects its options (exit code %d): %s; correct the JVM options", home, status,
                     printed);
}
