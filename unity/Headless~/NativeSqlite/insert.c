#include "sqlite3.h"

int collektive_bind(sqlite3_stmt *statement, const double *values, int count);
int collektive_insert(sqlite3_stmt *statement, const double *values, int count);

/*
 * Binds `count` values, NaN as NULL, in one call. Keeps neither argument. Returns SQLite's code. Not thread-safe, like the statement's database.
 */
__attribute__((visibility("default"))) int collektive_bind(sqlite3_stmt *statement, const double *values, int count) {
    int code = SQLITE_OK;
    for (int i = 0; i < count && code == SQLITE_OK; i++) {
        code = sqlite3_bind_double(statement, i + 1, values[i]);
    }
    return code;
}

/* Binds values and executes a statement without results. The rest is as in `collektive_bind`. */
__attribute__((visibility("default"))) int collektive_insert(sqlite3_stmt *statement, const double *values, int count) {
    int code = collektive_bind(statement, values, count);
    if (code != SQLITE_OK) {
        return code;
    }
    code = sqlite3_step(statement);
    sqlite3_reset(statement);
    return code;
}
