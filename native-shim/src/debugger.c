#include "debugger.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* One word of the agent's list, not ended by NUL: `key=value`, of which `value` is empty when there is no '='. */
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

/* The agent's list, behind its name; NULL when the option loads another agent or none. */
static const char *list_of(const char *option) {
    const char *name = NULL;
    if (strncmp(option, "-agentlib:jdwp", 14) == 0) name = option + 14;
    if (strncmp(option, "-Xrunjdwp", 9) == 0) name = option + 9;
    if (strncmp(option, "-agentpath:", 11) == 0) name = strstr(option, "libjdwp");
    if (name == NULL) return NULL;
    size_t rest = strcspn(name, option[1] == 'X' ? ":" : "=");
    return name[rest] == '\0' ? name + rest : name + rest + 1;
}

/* The agent takes the last of words with the same key. Keys that are not known may do anything: `launch` runs a command. */
const char *debugger_fault(const char *option) {
    const char *list = list_of(option);
    bool goes_on = false, local = false;
    if (list == NULL) return NULL;
    while (*list != '\0') {
        size_t length = strcspn(list, ",");
        struct word word = word_at(list, length);
        if (is(word.key, word.key_length, "suspend")) {
            goes_on = is(word.value, word.value_length, "n");
        } else if (is(word.key, word.key_length, "address")) {
            local = begins(&word, "127.0.0.1:") || begins(&word, "localhost:") || begins(&word, "[::1]:");
        } else if (is(word.key, word.key_length, "transport")) {
            if (!is(word.value, word.value_length, "dt_socket")) return "only the transport dt_socket is known to stay on this machine";
        } else if (!is(word.key, word.key_length, "server") && !is(word.key, word.key_length, "quiet") &&
                   !is(word.key, word.key_length, "timeout")) {
            return "of the debugger's options only transport, server, suspend, address, quiet and timeout are allowed: others run "
                   "commands, write files or end the process";
        }
        list += length;
        if (*list == ',') list++;
    }
    if (!goes_on) return "the start would wait for a debugger; add suspend=n";
    if (!local) return "whoever reaches a debugger's port runs code of his own here; use address=127.0.0.1:PORT";
    return NULL;
}
