#include <stddef.h>
#include <string.h>
#include "test.h"

/* C# contains copies of these structs, so a change of their layout is a change of the ABI. */
_Static_assert(sizeof(clk_jvm_config) == 48 && offsetof(clk_jvm_config, home) == 8, "clk_jvm_config");
_Static_assert(sizeof(clk_memory) == 16 && offsetof(clk_memory, address) == 8, "clk_memory");
_Static_assert(sizeof(clk_answer) == 24 && offsetof(clk_answer, address) == 16, "clk_answer");
_Static_assert(sizeof(clk_stats) == 56 && offsetof(clk_stats, steps) == 16, "clk_stats");

void version_and_sizes(void) {
    CHECK(clk_version() == CLK_VERSION);
    CHECK(clk_jvm_state() == CLK_STATE_NONE);
}

void errors_have_names(void) {
    for (int32_t code = -16; code <= 0; code++) {
        CHECK(strncmp(clk_error_name(code), "CLK_", 4) == 0 && strcmp(clk_error_name(code), "CLK_UNKNOWN") != 0);
        CHECK(strlen(clk_error_text(code)) > 5);
    }
    CHECK(strcmp(clk_error_name(CLK_FRAME), "CLK_FRAME") == 0);
    CHECK(strcmp(clk_error_name(-17), "CLK_UNKNOWN") == 0 && strcmp(clk_error_name(1), "CLK_UNKNOWN") == 0);
    CHECK(strlen(clk_error_text(-17)) > 5);
}

void last_error_is_cut_at_a_character(void) {
    char buffer[64];
    CHECK(clk_last_error(NULL, 0) == 0);
    CHECK_CODE(CLK_JVM_NOT_FOUND, "\xC3\xA4\xE2\x82\xAC", start_at("/\xC3\xA4\xE2\x82\xAC", "x", NULL, true, 1000));
    int32_t whole = clk_last_error(NULL, 0);
    CHECK(whole > 20);
    for (int32_t capacity = 1; capacity < (int32_t)sizeof buffer; capacity++) {
        memset(buffer, 'x', sizeof buffer);
        CHECK(clk_last_error(buffer, capacity) == whole);
        int32_t length = (int32_t)strlen(buffer);
        CHECK(length < capacity && length >= capacity - 3);
        CHECK(length == 0 || (unsigned char)buffer[length - 1] < 0xC0);
        if (capacity < (int32_t)sizeof buffer) CHECK(buffer[capacity] == 'x');
    }
}

void structs_of_other_sizes(void) {
    struct {
        clk_stats known;
        uint64_t newer;
    } large = {.known.size = sizeof large, .newer = 77};
    CHECK_OK(clk_get_stats(&large.known));
    CHECK(large.newer == 77 && large.known.size == sizeof large);
    clk_stats small = {.size = offsetof(clk_stats, steps), .steps = 77};
    CHECK_OK(clk_get_stats(&small));
    CHECK(small.steps == 77);
    CHECK_CODE(CLK_ARGUMENT, "stats->size", clk_get_stats(&(clk_stats){.size = 0}));
    CHECK_CODE(CLK_ARGUMENT, "stats is NULL", clk_get_stats(NULL));

    clk_slot slot;
    CHECK_CODE(CLK_ARGUMENT, "memory->size", clk_slot_acquire(1, &slot, &(clk_memory){.size = 8}));

    struct {
        clk_jvm_config known;
        uint64_t newer;
    } config = {.known = {.size = sizeof config, .home = "/nowhere", .class_path = "x", .start_limit_ms = 1000}};
    CHECK_CODE(CLK_JVM_NOT_FOUND, "/nowhere", clk_jvm_start(&config.known));
    config.newer = 1;
    CHECK_CODE(CLK_ARGUMENT, "update the shim", clk_jvm_start(&config.known));
    config.known.size = 8;
    CHECK_CODE(CLK_ARGUMENT, "config->size", clk_jvm_start(&config.known));
}
