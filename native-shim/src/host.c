#include "host.h"

#include <stdatomic.h>
#include "engine.h"
#include "error.h"
#include "log.h"
#include "text.h"

#define COUNT(array) ((jint)(sizeof(array) / sizeof(array)[0]))

/* Only the engine thread uses these fields, except `security_exception`, which does not change after the start. */
static struct {
    JNIEnv *env; /* JNI environment of the engine thread */
    jclass host;
    jmethodID start, close, stop, calls[HOST_CALLS];
    jmethodID to_string, get_name;
    jclass security_exception;
    struct host_call *running; /* NULL between calls */
    bool has_error_text;       /* the running call has called Shim.error */
} java;

static struct host_state own;
static struct host_state *state = &own;

bool host_is_debugged(void) { return atomic_load(&state->debugged); }

uint64_t host_wrapped(void) { return atomic_load_explicit(&state->wrapped, memory_order_relaxed); }

void host_share(struct host_state *shared) { state = shared; }

/* ---- Exceptions ------------------------------------------------------------------------------------------------------ */

/* Does not use JNI's "UTF" functions, because they return modified UTF-8. */
void host_text(JNIEnv *env, jstring string, char *buffer, int32_t capacity) {
    jchar units[1024];
    jsize count = (*env)->GetStringLength(env, string);
    if (count > COUNT(units)) count = COUNT(units);
    (*env)->GetStringRegion(env, string, 0, count, units);
    text_from_utf16(units, count, buffer, capacity);
}

/* Copies the string that object.method() returns. False if the method throws an exception or returns null. */
static bool string_of(JNIEnv *env, jobject object, jmethodID method, char *buffer, int32_t capacity) {
    jstring string = (*env)->CallObjectMethod(env, object, method);
    bool good = !(*env)->ExceptionCheck(env) && string != NULL;
    if (good) {
        host_text(env, string, buffer, capacity);
    } else {
        (*env)->ExceptionClear(env);
    }
    (*env)->DeleteLocalRef(env, string);
    return good;
}

/* Clears the pending exception and describes it by toString(). If the heap is too full for that, describes it by its class. */
static void describe_exception(JNIEnv *env, char *buffer, int32_t capacity) {
    jthrowable exception = (*env)->ExceptionOccurred(env);
    (*env)->ExceptionClear(env);
    if (!string_of(env, exception, java.to_string, buffer, capacity)) {
        jclass class = (*env)->GetObjectClass(env, exception);
        if (!string_of(env, class, java.get_name, buffer, capacity)) {
            text_export("an exception without a readable name; the heap is probably exhausted", buffer, capacity);
        }
        (*env)->DeleteLocalRef(env, class);
    }
    (*env)->DeleteLocalRef(env, exception);
}

static int32_t java_error(JNIEnv *env, int32_t code, const char *where) {
    char text[2048];
    describe_exception(env, text, sizeof text);
    return error_set(code, "%s threw %s", where, text);
}

static void throw_new(JNIEnv *env, const char *class_name, const char *message) {
    jclass class = (*env)->FindClass(env, class_name);
    if (class != NULL) (*env)->ThrowNew(env, class, message);
    (*env)->DeleteLocalRef(env, class);
}

/* ---- Memory ---------------------------------------------------------------------------------------------------------- */

/* Creates the block's ByteBuffer unless it exists. On failure, leaves an exception pending and returns false. */
static bool wrap(JNIEnv *env, struct block *block) {
    if (block->wrapper != NULL) return true;
    jobject buffer = (*env)->NewDirectByteBuffer(env, block->address, block->capacity);
    if (buffer == NULL) return false;
    block->wrapper = (*env)->NewGlobalRef(env, buffer);
    (*env)->DeleteLocalRef(env, buffer);
    if (block->wrapper == NULL) {
        if (!(*env)->ExceptionCheck(env)) throw_new(env, "java/lang/OutOfMemoryError", "cannot create a JNI global reference");
        return false;
    }
    atomic_fetch_add_explicit(&state->wrapped, 1, memory_order_relaxed);
    return true;
}

/* Frees the surplus blocks. They have wrappers, which only the engine thread can delete. */
static void free_surplus(JNIEnv *env) {
    for (struct block *block; (block = slots_take_surplus()) != NULL;) {
        (*env)->DeleteGlobalRef(env, block->wrapper);
        slots_free(block);
    }
}

/* ---- Natives of Shim ------------------------------------------------------------------------------------------------- */

static jobject JNICALL shim_grow(JNIEnv *env, jclass class, jlong slot, jint capacity) {
    (void)class;
    struct host_call *call = engine_is_current() ? java.running : NULL;
    if (call == NULL || call->slot != (clk_slot)slot) {
        throw_new(env, "java/lang/IllegalStateException",
                  "Shim.grow accepts only the answer slot of the running call, on the engine thread");
        return NULL;
    }
    if (capacity > call->answer->capacity && !call->grow(call, capacity)) {
        throw_new(env, "java/lang/OutOfMemoryError", error_last());
        return NULL;
    }
    return wrap(env, call->answer) ? call->answer->wrapper : NULL;
}

/* Copies as many bytes as fit, and a NUL. The caller must not hold a lock, because JNI may wait for a safepoint here. */
static int32_t bytes_text(JNIEnv *env, jbyteArray bytes, char *buffer, int32_t capacity) {
    jsize length = bytes != NULL ? (*env)->GetArrayLength(env, bytes) : 0;
    if (length > capacity - 1) length = capacity - 1;
    (*env)->GetByteArrayRegion(env, bytes, 0, length, (jbyte *)buffer);
    buffer[length] = '\0';
    return length;
}

static void JNICALL shim_error(JNIEnv *env, jclass class, jbyteArray utf8) {
    (void)class;
    char text[ERROR_CAPACITY + 4]; /* longer than an error may be, so that error_set truncates after a whole character */
    bytes_text(env, utf8, text, sizeof text);
    error_set(CLK_OK, "%s", text);
    if (engine_is_current()) java.has_error_text = true;
}

static void JNICALL shim_log(JNIEnv *env, jclass class, jint level, jbyteArray utf8) {
    (void)class;
    char text[LOG_LINE_CAPACITY + 4];
    int32_t length = bytes_text(env, utf8, text, sizeof text);
    log_write(level < CLK_LOG_DEBUG ? CLK_LOG_DEBUG : level > CLK_LOG_ERROR ? CLK_LOG_ERROR : level, text, length);
}

static void JNICALL shim_debugger(JNIEnv *env, jclass class, jboolean attached) {
    (void)env;
    (void)class;
    atomic_store(&state->debugged, attached == JNI_TRUE);
}

/* ---- Natives of java.lang.Shutdown ----------------------------------------------------------------------------------- */

static void refuse_exit(JNIEnv *env) {
    (*env)->ThrowNew(env, java.security_exception,
                     "System.exit and Runtime.halt are not allowed: they would end the whole process; return from the program instead");
}

static void JNICALL shutdown_before_halt(JNIEnv *env, jclass class) {
    (void)class;
    refuse_exit(env);
}

static void JNICALL shutdown_halt(JNIEnv *env, jclass class, jint status) {
    (void)class;
    (void)status;
    refuse_exit(env);
}

/* ---- Binding --------------------------------------------------------------------------------------------------------- */

/* The array literals and casts are needed because JNI declares names as writable strings, and functions as object pointers. */
#define NATIVE(function_name, type, function) \
    {.name = (char[]){function_name}, .signature = (char[]){type}, .fnPtr = (void *)(uintptr_t)(function)}

static jclass find_class(JNIEnv *env, const char *name) {
    jclass local = (*env)->FindClass(env, name);
    jclass global = local != NULL ? (*env)->NewGlobalRef(env, local) : NULL;
    (*env)->DeleteLocalRef(env, local);
    return global;
}

static void replace_exit(JNIEnv *env) {
    const JNINativeMethod natives[] = {NATIVE("beforeHalt", "()V", shutdown_before_halt), NATIVE("halt0", "(I)V", shutdown_halt)};
    java.security_exception = find_class(env, "java/lang/SecurityException");
    jclass shutdown = (*env)->FindClass(env, "java/lang/Shutdown");
    bool registered =
        java.security_exception != NULL && shutdown != NULL && (*env)->RegisterNatives(env, shutdown, natives, COUNT(natives)) == JNI_OK;
    (*env)->ExceptionClear(env);
    (*env)->DeleteLocalRef(env, shutdown);
    if (!registered)
        log_format(CLK_LOG_WARNING, "this JVM does not allow the shim to block System.exit: a program that calls it ends the JVM");
}

static int32_t incompatible(JNIEnv *env, const char *what) {
    char text[2048];
    text_export("no exception", text, sizeof text);
    if ((*env)->ExceptionCheck(env)) describe_exception(env, text, sizeof text);
    return error_set(CLK_HOST, "%s (%s); check that the class path contains the host jar of the same version as the shim", what, text);
}

static int32_t bind(JNIEnv *env) {
    java.env = env;
    jclass object = (*env)->FindClass(env, "java/lang/Object");
    jclass class = (*env)->FindClass(env, "java/lang/Class");
    jclass full = (*env)->FindClass(env, "java/lang/OutOfMemoryError");
    java.to_string = (*env)->GetMethodID(env, object, "toString", "()Ljava/lang/String;");
    java.get_name = (*env)->GetMethodID(env, class, "getName", "()Ljava/lang/String;");
    (*env)->DeleteLocalRef(env, object);
    /* The first call of Class.getName() allocates, which would fail on a full heap. Later calls return the same string. */
    string_of(env, full, java.get_name, (char[64]){0}, 64);
    (*env)->DeleteLocalRef(env, class);
    (*env)->DeleteLocalRef(env, full);

    const JNINativeMethod natives[] = {NATIVE("grow", "(JI)Ljava/nio/ByteBuffer;", shim_grow), NATIVE("error", "([B)V", shim_error),
                                       NATIVE("log", "(I[B)V", shim_log), NATIVE("debugger", "(Z)V", shim_debugger)};
    jclass shim = find_class(env, "org/collektive/host/shim/Shim");
    if (shim == NULL || (*env)->RegisterNatives(env, shim, natives, COUNT(natives)) != JNI_OK) {
        return incompatible(env, "cannot register the native methods of org.collektive.host.shim.Shim");
    }
    java.host = find_class(env, "org/collektive/host/Host");
    if (java.host == NULL) return incompatible(env, "cannot load org.collektive.host.Host");

#define CALL_TYPE "(JLjava/nio/ByteBuffer;IIJLjava/nio/ByteBuffer;I)J"
    const struct {
        jmethodID *id;
        const char *name;
        const char *type;
    } entries[] = {{&java.start, "start", "()Ljava/lang/String;"},
                   {&java.calls[HOST_OPEN], "open", CALL_TYPE},
                   {&java.calls[HOST_STEP], "step", CALL_TYPE},
                   {&java.calls[HOST_CONTROL], "control", CALL_TYPE},
                   {&java.close, "close", "(J)V"},
                   {&java.stop, "stop", "(I)Z"}};
    for (jint i = 0; i < COUNT(entries); i++) {
        *entries[i].id = (*env)->GetStaticMethodID(env, java.host, entries[i].name, entries[i].type);
        if (*entries[i].id == NULL) return incompatible(env, "org.collektive.host.Host lacks a method that the shim calls");
    }
    return CLK_OK;
}

/* ---- Calls ----------------------------------------------------------------------------------------------------------- */

int32_t host_start(JNIEnv *env, char *version, int32_t capacity) {
    replace_exit(env);
    int32_t result = bind(env);
    if (result != CLK_OK) return result;
    jstring string = (*env)->CallStaticObjectMethod(env, java.host, java.start);
    if ((*env)->ExceptionCheck(env)) {
        char text[2048];
        describe_exception(env, text, sizeof text);
        return error_set(CLK_HOST, "Host.start threw %s; if a class is missing or corrupt, reinstall the JVM and the package", text);
    }
    if (string == NULL) return error_set(CLK_HOST, "Host.start returned null instead of a version; reinstall the package");
    host_text(env, string, version, capacity);
    (*env)->DeleteLocalRef(env, string);
    return CLK_OK;
}

/* Returns whether the host may return the code (docs/boundary.md). The other codes report the state of the shim. */
static bool is_host_code(jlong code) {
    static const int32_t codes[] = {CLK_ARGUMENT, CLK_HANDLE, CLK_HOST, CLK_FRAME, CLK_SCHEMA, CLK_PROGRAM, CLK_SESSION_FAILED, CLK_JAVA};
    bool found = false;
    for (int i = 0; i < COUNT(codes); i++) found |= codes[i] == code;
    return found;
}

static int32_t close_session(JNIEnv *env, clk_session session) {
    (*env)->CallStaticVoidMethod(env, java.host, java.close, (jlong)session);
    return (*env)->ExceptionCheck(env) ? java_error(env, CLK_JAVA, "Host.close") : CLK_OK;
}

int32_t host_run(struct host_call *call) {
    JNIEnv *env = java.env;
    free_surplus(env);
    if (call->entry == HOST_CLOSE) return close_session(env, call->session);
    static const char *const names[HOST_CALLS] = {"Host.open", "Host.step", "Host.control"};
    const char *where = names[call->entry];
    if (!wrap(env, call->request) || !wrap(env, call->answer)) return java_error(env, CLK_JAVA, "wrapping a slot");
    const jvalue arguments[] = {{.j = (jlong)call->session}, {.l = call->request->wrapper}, {.i = call->offset},  {.i = call->length},
                                {.j = (jlong)call->slot},    {.l = call->answer->wrapper},  {.i = call->limit_ms}};
    java.has_error_text = false;
    java.running = call;
    jlong result = (*env)->CallStaticLongMethodA(env, java.host, java.calls[call->entry], arguments);
    java.running = NULL;
    if ((*env)->ExceptionCheck(env)) return java_error(env, CLK_JAVA, where);
    if (result < 0) {
        if (!is_host_code(result))
            return error_set(CLK_HOST, "%s returned %lld, which is not an error code of the host", where, (long long)result);
        if (!java.has_error_text) error_set(CLK_OK, "%s: %s", where, clk_error_text((int32_t)result));
        return (int32_t)result;
    }
    int64_t offset = result >> 32;
    int64_t length = result & INT64_C(0xFFFFFFFF);
    if (offset + length > call->answer->capacity) {
        return error_set(CLK_HOST, "%s returned an answer at %lld + %lld, but its slot has %d bytes", where, (long long)offset,
                         (long long)length, call->answer->capacity);
    }
    call->answer_offset = (int32_t)offset;
    call->answer_length = (int32_t)length;
    return CLK_OK;
}

bool host_stop(int32_t limit_ms) {
    JNIEnv *env = java.env;
    jboolean idle = (*env)->CallStaticBooleanMethod(env, java.host, java.stop, (jint)limit_ms);
    if (!(*env)->ExceptionCheck(env)) return idle == JNI_TRUE;
    java_error(env, CLK_JAVA, "Host.stop");
    log_format(CLK_LOG_WARNING, "the host did not stop, but the JVM is shut down anyway: %s", error_last());
    return true;
}

bool host_run_exit_hooks(void) {
    JNIEnv *env = java.env;
    jclass shutdown = (*env)->FindClass(env, "java/lang/Shutdown");
    jmethodID run = shutdown != NULL ? (*env)->GetStaticMethodID(env, shutdown, "shutdown", "()V") : NULL;
    if (run != NULL) (*env)->CallStaticVoidMethod(env, shutdown, run);
    (*env)->ExceptionClear(env);
    (*env)->DeleteLocalRef(env, shutdown);
    return run != NULL;
}
