#include "sqlite3.h"

int collektive_insert(sqlite3_stmt *statement, const double *values, int count);

/*
 * Binds `count` values, NaN as NULL, and executes a statement without results: one call in place of one per value. Keeps neither argument. Returns
 * SQLite's code. Not thread-safe, like the statement's database.
 */
__attribute__((visibility("default"))) int collektive_insert(sqlite3_stmt *statement, const double *values, int count) {
    for (int i = 0; i < count; i++) {
        int code = sqlite3_bind_double(statement, i + 1, values[i]);
        if (code != SQLITE_OK) {
            return code;
        }
    }
    int code = sqlite3_step(statement);
    sqlite3_reset(statement);
    return code;
}
