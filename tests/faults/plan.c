#define _GNU_SOURCE
#include "plan.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

static const char *const kind_names[kind_count] = {"open",     "write", "fsync", "rename", "link",  "unlink",
                                                   "truncate", "mkdir", "close", "spawn",  "thread"};

static const struct {
    const char *name;
    int error;
} errors[] = {{"ENOSPC", ENOSPC}, {"EIO", EIO},       {"EACCES", EACCES}, {"EBUSY", EBUSY}, {"EMFILE", EMFILE},
              {"EAGAIN", EAGAIN}, {"EDQUOT", EDQUOT}, {"EINTR", EINTR},   {"SHORT", kShort}};

static struct plan plan = {kind_count, 0, 0, 0, -1, 0, -1};
static pthread_once_t plan_once = PTHREAD_ONCE_INIT;
static atomic_long calls[kind_count];

// A test with a misspelt plan must not pass.
static void refuse(const char *text) {
    fprintf(stderr, "faults: '%s' is no plan; allowed: KIND:N:ERROR\n", text);
    _exit(99);
}

static void read_fault(const char *text) {
    char kind[16], error[16];
    char *end;
    const char *colon = strchr(text, ':');
    if (!colon || sscanf(text, "%15[a-z]:%*[0-9+]:%15s", kind, error) != 2) refuse(text);
    for (plan.fails = 0; plan.fails < kind_count && strcmp(kind, kind_names[plan.fails]) != 0;) ++plan.fails;
    plan.first = plan.last = strtol(colon + 1, &end, 10);
    if (*end == '+') plan.last = __LONG_MAX__;
    for (size_t i = 0; i < sizeof errors / sizeof *errors; ++i) {
        if (strcmp(error, errors[i].name) == 0) plan.error = errors[i].error;
    }
    if (plan.fails == kind_count || plan.error == 0 || plan.first < 1) refuse(text);
}

static void read_plan(void) {
    const char *fault = getenv("STRATA_TEST_FAULT"), *log = getenv("STRATA_TEST_FAULT_LOG");
    const char *pause = getenv("STRATA_TEST_SPAWN_PAUSE"), *threads = getenv("STRATA_TEST_THREADS");
    if (fault && *fault) read_fault(fault);
    if (log) plan.log = (int)syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (pause) plan.pause_s = atof(pause);
    if (threads) plan.threads = atoi(threads);
    unsetenv("STRATA_TEST_FAULT");
    unsetenv("STRATA_TEST_FAULT_LOG");
    unsetenv("STRATA_TEST_SPAWN_PAUSE");
    unsetenv("STRATA_TEST_THREADS");
    unsetenv("LD_PRELOAD");
}

const struct plan *the_plan(void) {
    pthread_once(&plan_once, read_plan);
    return &plan;
}

int fault_of(enum kind kind, const char *what) {
    const int interrupted_errno = errno;
    the_plan();
    const long number = atomic_fetch_add(&calls[kind], 1) + 1;
    const bool fails = (int)kind == plan.fails && plan.first <= number && number <= plan.last;
    if (plan.log >= 0) {
        char line[1024];
        int length = snprintf(line, sizeof line, "%s %ld %s %s\n", kind_names[kind], number,
                              fails ? "failed" : "called", what);
        if (length >= (int)sizeof line) length = sizeof line - 1;
        syscall(SYS_write, plan.log, line, (size_t)length);
    }
    errno = interrupted_errno;
    return fails ? plan.error : 0;
}

int fault_of_descriptor(enum kind kind, int descriptor) {
    const int interrupted_errno = errno;
    char link[64], path[512];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    path[length > 0 ? length : 0] = '\0';
    errno = interrupted_errno;
    return fault_of(kind, path);
}
