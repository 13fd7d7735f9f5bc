#include "debugger.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* One `key=value` of the agent's list, not NUL-terminated; `value` is empty without '='. */
struct word {
    const char *key, *value;
    size_t key_length, value_length;
};

static bool is(const char *text, size_t length, const char *expected) {
    return length == strlen(expected) && memcmp(text, expected, length) == 0;
}

static bool begins(const struct word *word, const char *prefix) {
    return word->value_length >= strlen(prefix) && memcmp(word->value, prefix, strlen(prefix)) == 0;
}

static struct word word_at(const char *text, size_t length) {
    const char *equals = memchr(text, '=', length);
    size_t key_length = equals != NULL ? (size_t)(equals - text) : length;
    struct word word = {text, text + length, key_length, 0};
    if (equals != NULL) {
        word.value = equals + 1;
        word.value_length = length - key_length - 1;
    }
    return word;
}

/* Returns the agent's list of sub-options, which follows its name, or NULL if the option loads another agent or none. */
static const char *list_of(const char *option) {
    const char *name = NULL;
    if (strncmp(option, "-agentlib:jdwp", 14) == 0) name = option + 14;
    if (strncmp(option, "-Xrunjdwp", 9) == 0) name = option + 9;
    if (strncmp(option, "-agentpath:", 11) == 0) name = strstr(option, "libjdwp");
    if (name == NULL) return NULL;
    size_t rest = strcspn(name, option[1] == 'X' ? ":" : "=");
    return name[rest] == '\0' ? name + rest : name + rest + 1;
}

/* The agent uses the last of several equal keys. Unknown keys are rejected because they may do anything: `launch` runs a command. */
const char *debugger_problem(const char *option) {
    const char *list = list_of(option);
    bool no_suspend = false, loopback = false;
    if (list == NULL) return NULL;
    while (*list != '\0') {
        size_t length = strcspn(list, ",");
        struct word word = word_at(list, length);
        if (is(word.key, word.key_length, "suspend")) {
            no_suspend = is(word.value, word.value_length, "n");
        } else if (is(word.key, word.key_length, "address")) {
            loopback = begins(&word, "127.0.0.1:") || begins(&word, "localhost:") || begins(&word, "[::1]:");
        } else if (is(word.key, word.key_length, "transport")) {
            if (!is(word.value, word.value_length, "dt_socket")) return "only transport=dt_socket is allowed";
        } else if (!is(word.key, word.key_length, "server") && !is(word.key, word.key_length, "quiet") &&
                   !is(word.key, word.key_length, "timeout")) {
            return "only the debugger options transport, server, suspend, address, quiet and timeout are allowed; others can run "
                   "commands, write files or end the process";
        }
        list += length;
        if (*list == ',') list++;
    }
    if (!no_suspend) return "the JVM would wait for a debugger to attach; add suspend=n";
    if (!loopback) return "anyone who can reach the debug port can run code in this process; use address=127.0.0.1:PORT";
    return NULL;
}
