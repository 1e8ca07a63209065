#define _GNU_SOURCE
#include "plan.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static const char* const kind_names[kind_count] = {"open",   "write",    "read",  "fsync", "rename", "link",
                                                   "unlink", "truncate", "mkdir", "close", "spawn",  "thread"};

static const struct {
    const char* name;
    int error;
} errors[] = {{"ENOSPC", ENOSPC}, {"EIO", EIO},       {"EACCES", EACCES}, {"EBUSY", EBUSY}, {"EMFILE", EMFILE},
              {"EAGAIN", EAGAIN}, {"EDQUOT", EDQUOT}, {"EINTR", EINTR},   {"SHORT", kShort}, {"KILL", kKill}};

static struct plan plan = {.log = -1, .threads = -1};
static pthread_once_t plan_once = PTHREAD_ONCE_INIT;
static atomic_long calls[kind_count];

// A test with a misspelt plan must not pass.
static void refuse(const char* text) {
    fprintf(stderr, "faults: '%s' is no plan; allowed: KIND:N:ERROR\n", text);
    _exit(99);
}

static void read_fault(const char* text) {
    struct fault fault = {0, 0, 0, 0};
    char kind[16], error[16];
    char* end;
    const char* colon = strchr(text, ':');
    if (!colon || sscanf(text, "%15[a-z]:%*[0-9+]:%15[A-Z]", kind, error) != 2) refuse(text);
    while (fault.kind < kind_count && strcmp(kind, kind_names[fault.kind]) != 0) ++fault.kind;
    fault.first = fault.last = strtol(colon + 1, &end, 10);
    if (*end == '+') fault.last = __LONG_MAX__;
    for (size_t i = 0; i < sizeof errors / sizeof *errors; ++i) {
        if (strcmp(error, errors[i].name) == 0) fault.error = errors[i].error;
    }
    const int most = sizeof plan.faults / sizeof *plan.faults;
    if (fault.kind == kind_count || fault.error == 0 || fault.first < 1 || plan.fault_count == most) refuse(text);
    plan.faults[plan.fault_count++] = fault;
}

static void read_plan(void) {
    const char *fault = getenv("STRATA_TEST_FAULT"), *log = getenv("STRATA_TEST_FAULT_LOG");
    const char *pause = getenv("STRATA_TEST_SPAWN_PAUSE"), *threads = getenv("STRATA_TEST_THREADS");
    for (; fault && *fault; fault = strchr(fault, ',') ? strchr(fault, ',') + 1 : NULL) read_fault(fault);
    if (log) plan.log = (int)syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (pause) plan.pause_s = atof(pause);
    if (threads) plan.threads = atoi(threads);
    unsetenv("STRATA_TEST_FAULT");
    unsetenv("STRATA_TEST_FAULT_LOG");
    unsetenv("STRATA_TEST_SPAWN_PAUSE");
    unsetenv("STRATA_TEST_THREADS");
    unsetenv("LD_PRELOAD");
}

const struct plan* the_plan(void) {
    pthread_once(&plan_once, read_plan);
    return &plan;
}

static int error_of_call(enum kind kind, long number) {
    for (const struct fault* fault = plan.faults; fault < plan.faults + plan.fault_count; ++fault) {
        if (fault->kind == (int)kind && fault->first <= number && number <= fault->last) return fault->error;
    }
    return 0;
}

static void __attribute__((format(printf, 1, 2))) write_log(const char* format, ...) {
    if (plan.log < 0) return;
    char line[1024];
    va_list values;
    va_start(values, format);
    int length = vsnprintf(line, sizeof line, format, values);
    va_end(values);
    if (length >= (int)sizeof line) length = sizeof line - 1;
    syscall(SYS_write, plan.log, line, (size_t)length);
}

int fault_of(enum kind kind, const char* what) {
    const int interrupted_errno = errno;
    the_plan();
    const long number = atomic_fetch_add(&calls[kind], 1) + 1;
    const int error = error_of_call(kind, number);
    write_log("%s %ld %s %s\n", kind_names[kind], number, error ? "failed" : "called", what);
    if (error == kKill) kill(getpid(), SIGKILL);
    errno = interrupted_errno;
    return error;
}

void path_of(int descriptor, char* path, size_t size) {
    const int interrupted_errno = errno;
    char link[64];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, size - 1);
    path[length > 0 ? length : 0] = '\0';
    errno = interrupted_errno;
}

int fault_of_descriptor(enum kind kind, int descriptor) {
    char path[512];
    path_of(descriptor, path, sizeof path);
    return fault_of(kind, path);
}

void note_synced(int descriptor) {
    const int interrupted_errno = errno;
    char path[512];
    struct stat status;
    path_of(descriptor, path, sizeof path);
    if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) {
        write_log("synced %ld %s\n", (long)status.st_size, path);
    }
    errno = interrupted_errno;
}
