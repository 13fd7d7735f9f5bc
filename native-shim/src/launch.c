#include "launch.h"
#include "log.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "error.h"
#include "options.h"
#include "prim.h"

#define ARCHIVE_BYTES (INT64_C(32) << 20) /* free space that is required to write an archive, which has 5 to 10 MB */
#define OLDEST_JAVA 17

/* ---- The caller's configuration -------------------------------------------------------------------------------------- */

int32_t launch_check_config(const clk_jvm_config *config) {
    if (config == NULL) return error_set(CLK_ARGUMENT, "config is NULL");
    if (config->size < sizeof *config) return error_set(CLK_ARGUMENT, "config->size is %u; set it to sizeof(clk_jvm_config)", config->size);
    /* This version does not know the additional fields of a newer header, so they must be 0. */
    for (const uint8_t *at = (const uint8_t *)config + sizeof *config; at < (const uint8_t *)config + config->size; at++) {
        if (*at != 0) return error_set(CLK_ARGUMENT, "config has fields that this version of the shim does not support; update the shim");
    }
    if (config->home == NULL || config->home[0] == '\0')
        return error_set(CLK_ARGUMENT, "home is empty; set it to the root of a JRE or JDK");
    if (config->class_path == NULL || config->class_path[0] == '\0') {
        return error_set(CLK_ARGUMENT, "class_path is empty; set it to the jars of the host");
    }
    if (config->option_count < 0 || (config->option_count > 0 && config->options == NULL)) {
        return error_set(CLK_ARGUMENT, "option_count is %d; it must be 0 or greater, and 0 if options is NULL", config->option_count);
    }
    for (int32_t i = 0; i < config->option_count; i++) {
        if (config->options[i] == NULL) return error_set(CLK_ARGUMENT, "option %d is NULL; set it to a JVM option", i);
    }
    if (config->placement != CLK_IN_PROCESS && config->placement != CLK_OWN_PROCESS)
        return error_set(CLK_ARGUMENT, "placement is %d; it must be one of enum clk_placement", config->placement);
    if (config->start_limit_ms < 1) return error_set(CLK_ARGUMENT, "start_limit_ms is %d; it must be 1 or greater", config->start_limit_ms);
    return CLK_OK;
}

/* Returns all texts, one per line. NULL if out of memory. */
static char *join(const char *first, const char *second, const char *const *others, int32_t count) {
    size_t size = strlen(first) + strlen(second) + 2;
    for (int32_t i = 0; i < count; i++) size += strlen(others[i]) + 1;
    char *text = malloc(size);
    if (text == NULL) return NULL;
    int used = snprintf(text, size, "%s\n%s", first, second);
    for (int32_t i = 0; i < count; i++) used += snprintf(text + used, size - (size_t)used, "\n%s", others[i]);
    return text;
}

char *launch_configuration(const clk_jvm_config *config) {
    return join(config->home, config->class_path, config->options, config->option_count);
}

char *launch_description(const struct launch *launch, const char *version) {
    const char *const *options = (const char *const *)(launch->options + launch->own_count);
    return join(launch->home, version, options, launch->option_count - launch->own_count);
}

/* ---- The JVM's options ----------------------------------------------------------------------------------------------- */

static char *concatenate(const char *first, const char *second) {
    size_t size = strlen(first) + strlen(second) + 1;
    char *text = malloc(size);
    if (text != NULL) snprintf(text, size, "%s%s", first, second);
    return text;
}

static bool add_option(struct launch *launch, const char *prefix, const char *rest) {
    char *option = concatenate(prefix, rest);
    if (option != NULL) launch->options[launch->option_count++] = option;
    return option != NULL;
}

/* Removes the options that write a class archive if the disk is almost full or the JVM cannot decode the path. The JVM would abort otherwise. */
static void check_archive(struct launch *launch) {
    const char *archive = options_archive(launch->options, launch->option_count);
    if (archive == NULL) return;
    if (!prim_jvm_can_decode(archive)) {
        log_format(CLK_LOG_WARNING, "no class archive is written, so the JVM starts more slowly: " PRIM_FOREIGN_TEXT, archive);
    } else if (prim_disk_free(archive) < ARCHIVE_BYTES) {
        log_format(CLK_LOG_WARNING,
                   "no class archive is written, so the JVM starts more slowly: less than 32 MB of disk space is free for %s", archive);
    } else {
        return;
    }
    int32_t kept = 0;
    for (int32_t i = 0; i < launch->option_count; i++) {
        if (options_write_archive(launch->options[i])) {
            free(launch->options[i]);
        } else {
            launch->options[kept++] = launch->options[i];
        }
    }
    launch->option_count = kept;
}

/* Fills in the command line. The shim's options come first, so that the caller's options can override them:
 *   -Xrs                       leaves signals such as SIGTERM to the process
 *   -Djava.awt.headless=true   prevents Java from opening windows
 *   -Xlog:jni+resolve=error    suppresses a warning about replace_exit() in host.c
 *   -XX:+UseCondCardMark       avoids false sharing of the card table, which would double the processor time of two host threads */
static int32_t fill(struct launch *launch, const clk_jvm_config *config) {
    static const char *const own[] = {"-Xrs", "-Djava.awt.headless=true", "-Xlog:jni+resolve=error", "-XX:+UseCondCardMark"};
    enum { OWN = sizeof own / sizeof own[0] };
    launch->home = concatenate(config->home, "");
    launch->configuration = launch_configuration(config);
    launch->options = malloc(((size_t)config->option_count + OWN + 1) * sizeof *launch->options);
    bool good = launch->home != NULL && launch->configuration != NULL && launch->options != NULL;
    for (int32_t i = 0; good && i < OWN; i++) good = add_option(launch, own[i], "");
    good = good && add_option(launch, "-Djava.class.path=", config->class_path);
    launch->own_count = launch->option_count;
    for (int32_t i = 0; good && i < config->option_count; i++) good = add_option(launch, config->options[i], "");
    if (!good) return error_set(CLK_MEMORY, "out of memory for %d JVM options", config->option_count);
    check_archive(launch);
    return CLK_OK;
}

void launch_free(struct launch *launch) {
    for (int32_t i = 0; i < launch->option_count; i++) free(launch->options[i]);
    free(launch->options);
    free(launch->configuration);
    free(launch->home);
    *launch = (struct launch){0};
}

/* ---- Files ----------------------------------------------------------------------------------------------------------- */

static int32_t check_home_file(const char *home, const char *file) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", home, file);
    switch (prim_file_kind(path)) {
        case PRIM_FILE: return CLK_OK;
        case PRIM_UNREADABLE: return error_set(CLK_JVM_NOT_FOUND, "cannot read %s; " PRIM_READ_ADVICE, path);
        default:
            return error_set(CLK_JVM_NOT_FOUND,
                             "%s is missing; set the JVM's home to the root of a JRE or JDK 17 or newer for " PRIM_PLATFORM, path);
    }
}

static int32_t check_release(const char *home, int version, const char *system, const char *architecture) {
    if (version < OLDEST_JAVA) {
        return error_set(CLK_JVM_NOT_FOUND, "the JVM in %s is Java %d; use a JRE or JDK %d or newer", home, version, OLDEST_JAVA);
    }
    if (strcmp(system, PRIM_SYSTEM) == 0 && strcmp(architecture, PRIM_ARCHITECTURE) == 0) return CLK_OK;
    return error_set(CLK_JVM_NOT_FOUND, "the JVM in %s is for %s on %s; this process needs one for " PRIM_PLATFORM, home, system,
                     architecture);
}

/* Checks version and platform of the JVM in its file `release`. Accepts a JVM without this file, and a file without these properties. */
static int32_t check_version(const char *home) {
    char line[4096], system[32] = PRIM_SYSTEM, architecture[32] = PRIM_ARCHITECTURE;
    snprintf(line, sizeof line, "%s/release", home);
    FILE *file = prim_file_read(line);
    if (file == NULL) return CLK_OK;
    int version = OLDEST_JAVA;
    while (fgets(line, sizeof line, file) != NULL) {
        (void)(sscanf(line, "JAVA_VERSION=\"%d", &version) == 1 || sscanf(line, "OS_NAME=\"%31[^\"]", system) == 1 ||
               sscanf(line, "OS_ARCH=\"%31[^\"]", architecture) == 1);
    }
    fclose(file);
    return check_release(home, version, system, architecture);
}

/* Checks the files without which JNI_CreateJavaVM would end the process before it reads the exit hook. */
static int32_t check_home(const char *home) {
    switch (prim_file_kind(home)) {
        case PRIM_DIRECTORY: break;
        case PRIM_MISSING:
            return error_set(CLK_JVM_NOT_FOUND, "the JVM's home %s does not exist; set it to the root of a JRE or JDK", home);
        case PRIM_UNREADABLE: return error_set(CLK_JVM_NOT_FOUND, "cannot read the JVM's home %s; " PRIM_READ_ADVICE, home);
        default: return error_set(CLK_JVM_NOT_FOUND, "the JVM's home %s is not a folder; set it to the root of a JRE or JDK", home);
    }
    /* The version comes first, because a JVM for another platform has other files. */
    int32_t result = check_version(home);
    if (result == CLK_OK) result = check_home_file(home, PRIM_LIBJVM);
    return result != CLK_OK ? result : check_home_file(home, "lib/modules");
}

static int32_t check_class_path(const char *class_path) {
    char entry[4096];
    for (const char *at = class_path; *at != '\0';) {
        const char *end = strchr(at, PRIM_PATH_SEPARATOR);
        size_t length = end != NULL ? (size_t)(end - at) : strlen(at);
        if (length >= sizeof entry)
            return error_set(CLK_HOST, "an entry of the host's class path is too long; move the package to a shorter path");
        memcpy(entry, at, length);
        entry[length] = '\0';
        enum prim_file kind = length > 0 ? prim_file_kind(entry) : PRIM_DIRECTORY;
        if (kind == PRIM_MISSING) {
            return error_set(CLK_HOST, "%s on the host's class path does not exist; build or reinstall the package", entry);
        }
        if (kind == PRIM_UNREADABLE) return error_set(CLK_HOST, "cannot read %s on the host's class path; " PRIM_READ_ADVICE, entry);
        at = end != NULL ? end + 1 : at + length;
    }
    return CLK_OK;
}

/* Checks that the JVM can decode a path. Otherwise, it would not find its files, and on Windows it would then end the process. */
static int32_t check_characters(int32_t code, const char *path) {
    return prim_jvm_can_decode(path) ? CLK_OK : error_set(code, PRIM_FOREIGN_TEXT, path);
}

/* ---- The whole check ------------------------------------------------------------------------------------------------- */

/* Tries the options in a child process, unless the configuration is equal to the last one that passed. */
static int32_t try_options(const struct launch *launch, int64_t deadline) {
    static char *passed;
    if (passed != NULL && strcmp(passed, launch->configuration) == 0) return CLK_OK;
    int32_t result = options_try(launch->home, launch->options, launch->option_count, deadline);
    if (result == CLK_OK) {
        free(passed);
        passed = concatenate(launch->configuration, "");
    }
    return result;
}

int32_t launch_prepare(struct launch *launch, const clk_jvm_config *config, int64_t deadline) {
    int32_t result = check_home(config->home);
    if (result == CLK_OK) result = check_characters(CLK_JVM_NOT_FOUND, config->home);
    if (result == CLK_OK) result = check_class_path(config->class_path);
    if (result == CLK_OK) result = check_characters(CLK_HOST, config->class_path);
    if (result == CLK_OK) result = options_check(config->options, config->option_count);
    if (result == CLK_OK) result = fill(launch, config);
    if (result == CLK_OK && config->check_options != 0) result = try_options(launch, deadline);
    return result;
}
