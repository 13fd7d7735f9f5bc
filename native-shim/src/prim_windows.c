#define WIN32_LEAN_AND_MEAN
#include "prim.h"

#include <windows.h>

#include <limits.h>
#include <process.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>

_Static_assert(sizeof(prim_mutex) == sizeof(SRWLOCK), "prim.h does not include windows.h");

#define PATH_UNITS 4096

/* ---- Text ------------------------------------------------------------------------------------------------------------ */

/* Converts UTF-8 to UTF-16. False if the text does not fit or is not UTF-8. */
static bool to_wide(const char *text, wchar_t *wide, int units) {
    return MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, text, -1, wide, units) > 0;
}

/* Converts text in a code page to UTF-16. The caller frees the result. NULL if out of memory, or if the text is not valid in the code page. */
static wchar_t *wide_of(UINT code_page, const char *text) {
    int units = MultiByteToWideChar(code_page, 0, text, -1, NULL, 0);
    wchar_t *wide = units > 0 ? malloc((size_t)units * sizeof *wide) : NULL;
    if (wide != NULL) MultiByteToWideChar(code_page, 0, text, -1, wide, units);
    return wide;
}

/* Converts UTF-16 to text in a code page. The caller frees the result. NULL if out of memory. Sets `lost` if the code page lacks a character. */
static char *narrow_of(UINT code_page, const wchar_t *wide, BOOL *lost) {
    BOOL *flag = code_page == CP_UTF8 ? NULL : lost; /* must be NULL for UTF-8 */
    DWORD exact = code_page == CP_UTF8 ? 0 : WC_NO_BEST_FIT_CHARS;
    int bytes = WideCharToMultiByte(code_page, exact, wide, -1, NULL, 0, NULL, flag);
    char *text = bytes > 0 ? malloc((size_t)bytes) : NULL;
    if (text != NULL) WideCharToMultiByte(code_page, exact, wide, -1, text, bytes, NULL, flag);
    return text;
}

/* Converts text in another code page, such as output of the JVM, to UTF-8 in place, if it fits. */
static void to_utf8_in_place(UINT code_page, char *text, size_t size) {
    wchar_t *wide = wide_of(code_page, text);
    char *utf8 = wide != NULL ? narrow_of(CP_UTF8, wide, NULL) : NULL;
    if (utf8 != NULL && strlen(utf8) < size) memcpy(text, utf8, strlen(utf8) + 1);
    free(utf8);
    free(wide);
}

static char *jvm_text(const char *text, BOOL *lost) {
    wchar_t *wide = wide_of(CP_UTF8, text);
    char *converted = wide != NULL ? narrow_of(GetACP(), wide, lost) : NULL;
    free(wide);
    return converted;
}

char *prim_jvm_text(const char *text) { return jvm_text(text, &(BOOL){FALSE}); }

bool prim_jvm_can_decode(const char *text) {
    BOOL lost = FALSE;
    char *converted = jvm_text(text, &lost);
    free(converted);
    return converted != NULL && !lost;
}

/* ---- Time ------------------------------------------------------------------------------------------------------------ */

#define NANOS_PER_SECOND INT64_C(1000000000)

int64_t prim_now(void) {
    LARGE_INTEGER frequency, count;
    QueryPerformanceFrequency(&frequency);
    QueryPerformanceCounter(&count);
    return count.QuadPart / frequency.QuadPart * NANOS_PER_SECOND +
           count.QuadPart % frequency.QuadPart * NANOS_PER_SECOND / frequency.QuadPart;
}

/* Milliseconds until the deadline, rounded up. */
static DWORD limit_of(int64_t deadline) {
    if (deadline == INT64_MAX) return INFINITE;
    int64_t left = (deadline - prim_now() + PRIM_MILLI - 1) / PRIM_MILLI;
    return left < 0 ? 0 : left >= INT32_MAX ? (DWORD)INT32_MAX : (DWORD)left;
}

/* ---- Locks and semaphores -------------------------------------------------------------------------------------------- */

void prim_lock(prim_mutex *mutex) { AcquireSRWLockExclusive((SRWLOCK *)mutex); }

void prim_unlock(prim_mutex *mutex) { ReleaseSRWLockExclusive((SRWLOCK *)mutex); }

void prim_semaphore_init(prim_semaphore *semaphore, unsigned count) { *semaphore = CreateSemaphoreW(NULL, (LONG)count, LONG_MAX, NULL); }

void prim_semaphore_post(prim_semaphore *semaphore) { ReleaseSemaphore(*semaphore, 1, NULL); }

static SECURITY_ATTRIBUTES inheritable = {.nLength = sizeof inheritable, .bInheritHandle = TRUE};
/* The handles of the shared memory and of two semaphores. Only the child that shares them inherits them, and their values are the same in the child. */
enum { SHARED_HANDLES = 3 };
static HANDLE shared_handles[SHARED_HANDLES];
static DWORD shared_count;

void prim_semaphore_share(prim_semaphore *semaphore) {
    if (*semaphore == NULL && shared_count < SHARED_HANDLES) {
        *semaphore = CreateSemaphoreW(NULL, 0, LONG_MAX, NULL);
        shared_handles[shared_count++] = *semaphore;
    }
    while (prim_semaphore_try(semaphore)) {
    }
}

bool prim_semaphore_try(prim_semaphore *semaphore) { return WaitForSingleObject(*semaphore, 0) == WAIT_OBJECT_0; }

bool prim_semaphore_sleep_until(prim_semaphore *semaphore, int64_t deadline) {
    while (WaitForSingleObject(*semaphore, limit_of(deadline)) != WAIT_OBJECT_0) {
        if (prim_now() >= deadline) return false;
    }
    return true;
}

/* ---- Threads --------------------------------------------------------------------------------------------------------- */

struct thread_start {
    void (*body)(void);
    const char *name;
};

static unsigned __stdcall thread_main(void *argument) {
    struct thread_start start = *(struct thread_start *)argument;
    wchar_t name[16];
    free(argument);
    if (to_wide(start.name, name, 16)) SetThreadDescription(GetCurrentThread(), name);
    start.body();
    return 0;
}

/* Prevents Windows from unloading this library, because threads, native methods and hooks of the JVM use it until the process ends. */
static void pin_library(void) {
    HMODULE self;
    GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_PIN | GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS, (LPCWSTR)(uintptr_t)&pin_library, &self);
}

bool prim_thread_start(void (*body)(void), const char *name, size_t stack_bytes) {
    struct thread_start *start = malloc(sizeof *start);
    if (start == NULL) return false;
    *start = (struct thread_start){body, name};
    pin_library();
    uintptr_t thread = _beginthreadex(NULL, (unsigned)stack_bytes, thread_main, start, STACK_SIZE_PARAM_IS_A_RESERVATION, NULL);
    if (thread == 0) {
        free(start);
        return false;
    }
    CloseHandle((HANDLE)thread);
    return true;
}

void prim_yield(void) { SwitchToThread(); }

_Noreturn void prim_park(void) {
    for (;;) Sleep(INFINITE);
}

/* Windows has no fork. */
void prim_at_fork(void (*child)(void)) { (void)child; }

/* ---- Signal handlers ------------------------------------------------------------------------------------------------- */

static LPTOP_LEVEL_EXCEPTION_FILTER before;

void prim_signals_save(void) {
    before = SetUnhandledExceptionFilter(NULL);
    SetUnhandledExceptionFilter(before);
}

void prim_signals_restore(void) { SetUnhandledExceptionFilter(before); }

/* Does nothing. HotSpot handles its exceptions with tables that other libraries cannot replace, and passes unhandled exceptions to the previous
 * filter. */
void prim_signals_adopt(void) {}

int32_t prim_signals_repair(void) { return 0; }

/* ---- Memory ---------------------------------------------------------------------------------------------------------- */

void *prim_allocate(size_t bytes) { return _aligned_malloc(bytes, 64); }

void prim_free(void *memory) { _aligned_free(memory); }

static void describe(DWORD error, char *why, size_t why_size) {
    wchar_t text[256];
    DWORD length = FormatMessageW(FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS | FORMAT_MESSAGE_MAX_WIDTH_MASK, NULL, error,
                                  0, text, sizeof text / sizeof *text, NULL);
    while (length > 0 && (text[length - 1] == L' ' || text[length - 1] == L'.')) length--;
    text[length] = L'\0';
    char *utf8 = narrow_of(CP_UTF8, text, NULL);
    snprintf(why, why_size, "%s (error %lu)", utf8 != NULL && utf8[0] != '\0' ? utf8 : "no reason given", error);
    free(utf8);
}

static uint8_t *section_view;

uint8_t *prim_shared_reserve(char *why, size_t why_size) {
    if (section_view != NULL) return section_view;
    HANDLE section = CreateFileMappingW(INVALID_HANDLE_VALUE, NULL, PAGE_READWRITE | SEC_RESERVE, (DWORD)(PRIM_SHARED_BYTES >> 32),
                                        (DWORD)PRIM_SHARED_BYTES, NULL);
    if (section != NULL) section_view = MapViewOfFile(section, FILE_MAP_ALL_ACCESS, 0, 0, 0);
    if (section_view == NULL) {
        describe(GetLastError(), why, why_size);
        if (section != NULL) CloseHandle(section);
    } else {
        shared_handles[shared_count++] = section;
    }
    return section_view;
}

/* Windows cannot return the memory of parts of a section. */
bool prim_shared_commit(uint64_t offset, uint64_t bytes, bool committed) {
    return committed && VirtualAlloc(section_view + offset, bytes, MEM_COMMIT, PAGE_READWRITE) != NULL;
}

/* ---- Files and libraries --------------------------------------------------------------------------------------------- */

enum prim_file prim_file_kind(const char *path) {
    wchar_t wide[PATH_UNITS];
    if (!to_wide(path, wide, PATH_UNITS)) return PRIM_MISSING;
    DWORD attributes = GetFileAttributesW(wide);
    if (attributes == INVALID_FILE_ATTRIBUTES) return GetLastError() == ERROR_ACCESS_DENIED ? PRIM_UNREADABLE : PRIM_MISSING;
    bool folder = (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    HANDLE file = CreateFileW(wide, folder ? FILE_LIST_DIRECTORY : GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                              NULL, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL);
    if (file == INVALID_HANDLE_VALUE) return PRIM_UNREADABLE;
    CloseHandle(file);
    return folder ? PRIM_DIRECTORY : PRIM_FILE;
}

bool prim_executable(const char *path) { return prim_file_kind(path) == PRIM_FILE; }

/* Writes the path of `name`, in the folder that contains `file`, to `folder`. False if the path of the file has no folder or is too long. */
static bool path_in_folder(const char *file, const wchar_t *name, wchar_t *folder) {
    if (!to_wide(file, folder, PATH_UNITS)) return false;
    wchar_t *end = folder + wcslen(folder);
    while (end > folder && end[-1] != L'/' && end[-1] != L'\\') end--;
    if (end == folder || (size_t)(end - folder) + wcslen(name) >= PATH_UNITS) return false;
    wcscpy(end, name);
    return true;
}

int64_t prim_disk_free(const char *file) {
    wchar_t folder[PATH_UNITS];
    ULARGE_INTEGER bytes;
    if (!path_in_folder(file, L"", folder) || !GetDiskFreeSpaceExW(folder, &bytes, NULL, NULL)) return INT64_MAX;
    return bytes.QuadPart > INT64_MAX ? INT64_MAX : (int64_t)bytes.QuadPart;
}

#define LOCK_POLL_MS 5

/* Windows cannot lock a folder. The lock is a file in the folder, which only one process at a time can open, and which is deleted when it is closed. */
int prim_folder_lock(const char *file, int64_t deadline) {
    wchar_t path[PATH_UNITS];
    if (!path_in_folder(file, L".collektive-lock", path)) return -1;
    for (;;) {
        HANDLE lock = CreateFileW(path, GENERIC_WRITE, 0, NULL, CREATE_ALWAYS, FILE_ATTRIBUTE_HIDDEN | FILE_FLAG_DELETE_ON_CLOSE, NULL);
        if (lock != INVALID_HANDLE_VALUE) return (int)(intptr_t)lock; /* handles have 32 significant bits */
        DWORD error = GetLastError();
        bool taken = error == ERROR_SHARING_VIOLATION || error == ERROR_ACCESS_DENIED || error == ERROR_DELETE_PENDING;
        if (!taken || prim_now() >= deadline) return -1;
        Sleep(LOCK_POLL_MS);
    }
}

void prim_folder_unlock(int lock) { CloseHandle((HANDLE)(intptr_t)lock); }

FILE *prim_file_read(const char *path) {
    wchar_t wide[PATH_UNITS];
    return to_wide(path, wide, PATH_UNITS) ? _wfopen(wide, L"r") : NULL;
}

/* jvm.dll is in bin/server and depends on libraries in bin. Windows searches bin only if AddDllDirectory adds it, as a path with backslashes. */
void *prim_library_open(const char *path, char *why, size_t why_size) {
    wchar_t wide[PATH_UNITS], full[PATH_UNITS], bin[PATH_UNITS];
    DWORD units = to_wide(path, wide, PATH_UNITS) ? GetFullPathNameW(wide, PATH_UNITS, full, NULL) : 0;
    if (units == 0 || units >= PATH_UNITS) {
        snprintf(why, why_size, "its path is too long");
        return NULL;
    }
    wcscpy(bin, full);
    for (int i = 0; i < 2; i++) {
        wchar_t *end = wcsrchr(bin, L'\\');
        if (end != NULL) *end = L'\0';
    }
    DLL_DIRECTORY_COOKIE cookie = AddDllDirectory(bin);
    HMODULE library = LoadLibraryExW(full, NULL, LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR | LOAD_LIBRARY_SEARCH_DEFAULT_DIRS);
    if (library == NULL) describe(GetLastError(), why, why_size);
    if (cookie != NULL) RemoveDllDirectory(cookie);
    return (void *)library;
}

void *prim_library_symbol(void *library, const char *name) { return (void *)(uintptr_t)GetProcAddress((HMODULE)library, name); }

bool prim_library_path(char *path, size_t size) {
    wchar_t wide[PATH_UNITS];
    HMODULE self;
    if (!GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT | GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS,
                            (LPCWSTR)(uintptr_t)&pin_library, &self)) {
        return false;
    }
    DWORD units = GetModuleFileNameW(self, wide, PATH_UNITS);
    return units > 0 && units < PATH_UNITS && WideCharToMultiByte(CP_UTF8, 0, wide, -1, path, (int)size, NULL, NULL) > 0;
}

/* ---- Environment and processes --------------------------------------------------------------------------------------- */

bool prim_environment_hide(const char *name, char **hidden) {
    const char *value = getenv(name);
    if (value == NULL) return false;
    size_t size = strlen(name) + strlen(value) + 2;
    char *entry = malloc(size);
    if (entry == NULL) return false;
    snprintf(entry, size, "%s=%s", name, value);
    _putenv_s(name, "");
    *hidden = entry;
    return true;
}

void prim_environment_show(char *hidden) {
    _putenv(hidden);
    free(hidden);
}

/* Appends a word to a command line, quoted by the rules of CommandLineToArgvW. False if it does not fit. */
static bool add_word(const char *word, wchar_t *line, size_t units) {
    wchar_t *wide = wide_of(CP_UTF8, word);
    size_t used = wcslen(line), backslashes = 0;
    if (wide == NULL || used + 2 * wcslen(wide) + 4 > units) {
        free(wide);
        return false;
    }
    if (used > 0) line[used++] = L' ';
    line[used++] = L'"';
    for (const wchar_t *at = wide;; at++) {
        if (*at == L'\\') {
            backslashes++;
        } else {
            /* Backslashes must be doubled before a quote, and only there. */
            if (*at == L'"' || *at == L'\0') {
                for (size_t i = 0; i < backslashes; i++) line[used++] = L'\\';
            }
            if (*at == L'"') line[used++] = L'\\';
            backslashes = 0;
        }
        if (*at == L'\0') break;
        line[used++] = *at;
    }
    line[used++] = L'"';
    line[used] = L'\0';
    free(wide);
    return true;
}

enum { LINE_UNITS = 32767 };

/* Returns the command line, which the caller frees. NULL if out of memory, or if the command line is longer than Windows allows. */
static wchar_t *command_line(char *const argv[]) {
    wchar_t *line = malloc(LINE_UNITS * sizeof *line);
    if (line != NULL) line[0] = L'\0';
    for (; line != NULL && *argv != NULL; argv++) {
        if (!add_word(*argv, line, LINE_UNITS)) {
            free(line);
            line = NULL;
        }
    }
    return line;
}

/* Starts a program in a job, which also includes its children. The program inherits only the handles in the array, of which the first is its input and
 * the second its output. NULL if the program does not start. */
static HANDLE spawn(wchar_t *line, HANDLE handles[], DWORD count, HANDLE job) {
    STARTUPINFOEXW startup = {.StartupInfo = {.cb = sizeof startup,
                                              .dwFlags = STARTF_USESTDHANDLES,
                                              .hStdInput = handles[0],
                                              .hStdOutput = handles[1],
                                              .hStdError = handles[1]}};
    PROCESS_INFORMATION child = {0};
    SIZE_T size = 0;
    InitializeProcThreadAttributeList(NULL, 1, 0, &size);
    startup.lpAttributeList = malloc(size);
    if (startup.lpAttributeList == NULL || !InitializeProcThreadAttributeList(startup.lpAttributeList, 1, 0, &size)) {
        free(startup.lpAttributeList);
        return NULL;
    }
    BOOL started = UpdateProcThreadAttribute(startup.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, handles,
                                             count * sizeof *handles, NULL, NULL) &&
                   CreateProcessW(NULL, line, NULL, NULL, TRUE, CREATE_NO_WINDOW | CREATE_SUSPENDED | EXTENDED_STARTUPINFO_PRESENT, NULL,
                                  NULL, &startup.StartupInfo, &child);
    DeleteProcThreadAttributeList(startup.lpAttributeList);
    free(startup.lpAttributeList);
    if (!started) return NULL;
    AssignProcessToJobObject(job, child.hProcess);
    ResumeThread(child.hThread);
    CloseHandle(child.hThread);
    return child.hProcess;
}

/* Creates an unnamed job, which ends its processes when its last handle is closed. NULL on failure. */
static HANDLE make_job(void) {
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = {.BasicLimitInformation = {.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE}};
    HANDLE job = CreateJobObjectW(NULL, NULL);
    if (job != NULL) SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
    return job;
}

#define OUTPUT_POLL_MS 5

static void close_all(const HANDLE handles[], int count) {
    for (int i = 0; i < count; i++) {
        if (handles[i] != NULL && handles[i] != INVALID_HANDLE_VALUE) CloseHandle(handles[i]);
    }
}

static void inherit_shared(DWORD flag) {
    for (DWORD i = 0; i < shared_count; i++) SetHandleInformation(shared_handles[i], HANDLE_FLAG_INHERIT, flag);
}

/* When this process ends, Windows closes the only handle of the job, and the job ends the child. */
int32_t prim_child_start(char *const argv[], bool shares, prim_child *child, char *why, size_t why_size) {
    HANDLE to = NULL;
    HANDLE input = CreateFileW(L"NUL", GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE, &inheritable, OPEN_EXISTING, 0, NULL);
    HANDLE job = make_job();
    wchar_t *line = command_line(argv);
    *child = (prim_child){.job = job};
    if (line != NULL && job != NULL && CreatePipe(&child->output, &to, &inheritable, 0)) {
        HANDLE handles[2 + SHARED_HANDLES] = {input, to};
        memcpy(handles + 2, shared_handles, shared_count * sizeof *shared_handles);
        if (shares) inherit_shared(HANDLE_FLAG_INHERIT);
        child->process = spawn(line, handles, 2 + (shares ? shared_count : 0), job);
        inherit_shared(0);
    }
    if (child->process == NULL) describe(GetLastError(), why, why_size);
    free(line);
    close_all((const HANDLE[]){input, to}, 2);
    if (child->process != NULL) return (int32_t)GetProcessId(child->process);
    close_all((const HANDLE[]){job, child->output}, 2);
    *child = (prim_child){0};
    return 0;
}

bool prim_child_read(prim_child *child, int64_t deadline, char *buffer, size_t size) {
    for (bool ended = false;; ended = WaitForSingleObject(child->process, OUTPUT_POLL_MS) == WAIT_OBJECT_0) {
        DWORD ready = 0, count = 0;
        if (PeekNamedPipe(child->output, NULL, 0, NULL, &ready, NULL) && ready > 0 &&
            ReadFile(child->output, buffer, (DWORD)size / 4, &count, NULL) && count > 0) { /* the text may be longer in UTF-8 */
            buffer[count] = '\0';
            to_utf8_in_place(GetACP(), buffer, size);
            return true;
        }
        if (ended || prim_now() >= deadline) return false;
    }
}

/* Removes the highest bit of the exit code, because the codes of crashes exceed INT_MAX. */
bool prim_child_reap(prim_child *child, int64_t deadline, int *status) {
    DWORD code;
    if (WaitForSingleObject(child->process, limit_of(deadline)) != WAIT_OBJECT_0 || !GetExitCodeProcess(child->process, &code))
        return false;
    *status = (int)(code & INT_MAX);
    close_all((const HANDLE[]){child->process, child->job, child->output}, 3);
    *child = (prim_child){0};
    return true;
}

void prim_child_kill(prim_child *child) { TerminateJobObject(child->job, 1); }

void prim_child_token(char *text, size_t size) { snprintf(text, size, "%llx", (unsigned long long)(uintptr_t)shared_handles[0]); }

uint8_t *prim_child_attach(const char *token) {
    char *end;
    uintptr_t handle = (uintptr_t)strtoull(token, &end, 16);
    if (end == token || *end != '\0') return NULL;
    return MapViewOfFile((HANDLE)handle, FILE_MAP_ALL_ACCESS, 0, 0, 0);
}
