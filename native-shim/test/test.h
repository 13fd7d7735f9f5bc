/* The test cases of the shim. The name of a case states what it specifies. Each case runs in its own process, which a failed CHECK ends. It runs twice:
 * `shim_test CASE` starts the JVM in that process, and `shim_test CASE own` starts it in a child process. */
#ifndef COLLEKTIVE_TEST_H
#define COLLEKTIVE_TEST_H

#include <stdbool.h>
#include <stdint.h>
#include "collektive_shim.h"

#define CHECK(condition)                                        \
    do {                                                        \
        if (!(condition)) fail(__FILE__, __LINE__, #condition); \
    } while (0)

/* Checks that a call returns the code, and that its error text contains `mention`, unless `mention` is NULL. */
#define CHECK_CODE(code, mention, call) check_code(__FILE__, __LINE__, #call, code, mention, call)
#define CHECK_OK(call) CHECK_CODE(CLK_OK, NULL, call)

/* Skips a case that this platform or JVM does not support. */
_Noreturn void skip(const char *reason);

_Noreturn void fail(const char *file, int line, const char *what);
void check_code(const char *file, int line, const char *call, int32_t expected, const char *mention, int32_t got);

/* The JVM under test, the classes of the test host, and those of an incompatible host. */
const char *java_home(void);
bool java_is_17(void);
extern const char *const host_classes;
extern const char *const host_jar; /* the same classes */
extern const char *const incompatible_classes;

/* Creates a folder in the current folder. The path is static, and valid until the next call. */
const char *scratch_folder(void);
void make_folder(const char *folder, const char *name);

/* Starts the JVM of java_home() with the test host and with these options, which end with NULL. Checks the options in a child process first. */
int32_t start(const char *const *options);
const char *own_or(const char *own, const char *in_process); /* one of the texts, depending on `placement` */
extern int32_t placement;                                    /* placement of the JVM in all starts */
int32_t check(const char *const *options);                   /* runs the checks of start() only */
int32_t check_texts(const char *const *options);             /* runs the same checks except those in the child process */
int32_t start_at(const char *home, const char *class_path, const char *const *options, bool check_options, int32_t limit_ms);
void start_plain(void);

/* Commands of the test host. */
/* clang-format off */
enum command {
    EMPTY, ECHO, GROW, THROW, FAIL, FAIL_SILENTLY, EXIT, HALT, SLEEP, OVERFLOW, EXHAUST, LOG, HANG, CRASH, OUTSIDE, GROW_FOREIGN,
    STAY, EXIT_ELSEWHERE, IMPLICIT_NULL, GROW_TOO_LARGE, HANG_AT_STOP, WRITE_AT_EXIT, THRASH, DEBUG, CRASH_LATER,
    OVERFLOW_NATIVELY, DEBUG_LATER, THROW_LATER
};
/* clang-format on */

/* The request slot of this process, its memory, and the last answer. The functions below make calls with them. */
extern clk_slot request;
extern clk_memory request_memory;
extern clk_answer answer;
int32_t open_session(clk_session *session);
int32_t open_with(clk_session *session, enum command command, int32_t argument);
int32_t step(clk_session session, enum command command, int32_t argument, int32_t limit_ms);

uint64_t random_next(void); /* each thread has its own sequence, which depends on its seed */
void random_seed(uint64_t seed);
int64_t now_ns(void);
void sleep_ms(int ms);                /* the time must be less than a second */
void check_threads_stand_still(void); /* checks that this process uses almost no processor time */
clk_stats stats(void);
bool log_mentions(const char *text); /* reads the log up to the first line that contains the text */

#define OPTIONS(...) ((const char *const[]){__VA_ARGS__, NULL})

/* clang-format off */
#define CASES(X) \
    X(version_and_sizes) X(structs_of_other_sizes) X(errors_have_names) X(last_error_is_cut_at_a_character) \
    X(slot_arguments) X(slot_handles) X(slot_growth_keeps_the_tail) X(slots_are_reused) X(slots_agree_with_a_model) \
    X(home_missing) X(home_of_an_old_version) X(home_of_another_platform) X(home_is_a_file) X(home_without_libjvm) X(home_without_modules) \
    X(home_with_a_broken_libjvm) X(files_that_cannot_be_read) X(home_without_java_command) \
    X(class_path_missing) X(class_path_beyond_ascii) X(class_path_without_host) X(class_path_with_incompatible_host) \
    X(start_arguments) X(options_refused_by_text) X(options_of_debuggers) X(options_too_long) \
    X(options_refused_by_child) X(options_that_make_the_jvm_print) X(jvm_log_in_a_file) \
    X(long_lines_of_the_jvm) X(refusals_are_cut_at_a_character) X(checks_take_turns_after_a_loss) \
    X(option_that_ends_the_jvm) X(refused_start_may_be_repeated) X(check_starts_nothing) X(check_while_a_jvm_runs) \
    X(check_writes_no_archive) X(options_unchecked_heap_order) X(options_unchecked_two_collectors) X(options_unchecked_heap_too_large) \
    X(options_unchecked_unknown) X(failed_start_restores_signal_handlers) X(environment_is_ignored) X(second_start) \
    X(start_from_two_threads) X(start_limit) X(foreign_jvm) X(nothing_runs_without_a_jvm) \
    X(echo_of_random_data) X(answers_grow) X(session_handles) X(many_sessions_one_after_the_other) X(too_many_sessions) \
    X(call_arguments) X(host_errors) X(failed_session_keeps_its_memory) X(exceptions) X(stack_overflow) X(heap_exhausted) \
    X(exit_is_refused) X(control_needs_no_session) X(control_errors) X(answer_outside_of_slot) X(released_request_stays_valid) \
    X(one_wrapper_for_each_memory) X(callers_take_turns) X(own_turn_times_out) \
    X(hang_loses_the_jvm) X(waiting_callers_return_after_a_loss) X(crash_loses_the_jvm) X(fork_loses_the_jvm) \
    X(stop_ends_all) X(stop_waits_while_another_writes_its_classes) X(stop_without_start) X(stop_halts_threads_that_stay) \
    X(stop_times_out) X(stop_while_the_start_hangs) X(stop_after_a_hang) X(stop_while_the_heap_is_full) \
    X(logs_are_bounded) X(signal_handlers_are_repaired) X(implicit_null_checks_and_host_faults) \
    X(calls_in_any_order) \
    X(debugged_steps_are_pending) X(debugged_open_is_pending) X(debugged_open_fails) X(debugged_open_is_closed) \
    X(debugged_session_is_closed) X(debugged_jvm_is_lost) X(debugged_jvm_is_stopped) X(debugging_has_no_limit) \
    X(own_survives_kills) X(own_ends_with_its_parent) X(own_with_a_bad_launcher) X(own_without_resources) X(own_without_processes) X(own_out_of_memory) \
    X(own_needs_no_shared_memory_folder) X(own_continues_after_a_suspension) X(own_with_older_slots) \
    X(own_changes_options) X(own_reports_its_death_at_once)
/* clang-format on */

void bench(void);  /* `shim_test bench` */
void parent(void); /* `shim_test parent`, for own_ends_with_its_parent: starts a JVM, prints its process id and waits */
void fuzz(void);   /* `shim_test fuzz`: runs for CLK_FUZZ_SECONDS, with seeds from CLK_FUZZ_SEED */

#define CASE_DECLARE(name) void name(void);
CASES(CASE_DECLARE)
#undef CASE_DECLARE

#endif
