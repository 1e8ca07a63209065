// What is to go wrong, and what was called: shared by the wrappers of the preload library.
//
//   STRATA_TEST_FAULT=KIND:N:ERROR   the N-th call of a kind fails; N+ means that one and all after it, as on a full
//                                    disk. KIND is a name in plan.c, ERROR an errno's name in plan.c, or SHORT: a write
//                                    of half the bytes, or KILL: the process ends there, as by a crash. Several, with
//                                    commas between, at once
//   STRATA_TEST_FAULT_LOG=FILE       gets a line for every call that counts: kind, number, "failed" or "called", what;
//                                    and one for what is on the disk from then on: "synced", bytes, path
//   STRATA_TEST_SPAWN_PAUSE=S        posix_spawn() returns S seconds after the program was started, or when a signal
//                                    comes
//   STRATA_TEST_THREADS=K            pthread_create() fails, as under a limit of processes, while K threads are alive
//
// All are taken out of the environment, LD_PRELOAD with them, so that programs that this one runs are left alone.
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum kind {
    kind_open,  // for writing or creating
    kind_write,
    kind_read,  // of hidden and temporary files, opening them included
    kind_fsync,
    kind_rename,
    kind_link,
    kind_unlink,
    kind_truncate,
    kind_mkdir,
    kind_close,  // of a regular file that was open for writing
    kind_spawn,
    kind_thread,
    kind_count
};

// The calls [first,last] of a kind, and errno, kShort or kKill.
struct fault {
    int kind;
    long first, last;
    int error;
};

struct plan {
    struct fault faults[4];
    int fault_count;
    int log;         // descriptor, or -1
    double pause_s;  // after posix_spawn()
    int threads;     // -1: no limit
};

enum { kShort = -1, kKill = -2 };

const struct plan* the_plan(void);

// Counts a call. 0: go on; otherwise errno, or kShort, of which only writes know.
int fault_of(enum kind kind, const char* what);

// The path that a descriptor stands for.
void path_of(int descriptor, char* path, size_t size);

// As fault_of(), for what is done to a descriptor.
int fault_of_descriptor(enum kind kind, int descriptor);

// The next function of this name: the system's.
#define REAL(name) real_##name
#define DECLARE_REAL(name)                                              \
    static __typeof__(&name) REAL(name)(void) {                         \
        static __typeof__(&name) found;                                 \
        if (!found) found = (__typeof__(&name))dlsym(RTLD_NEXT, #name); \
        return found;                                                   \
    }

// The wrapper's answer when its call is to fail.
#define FAIL_IF(fault, failed)      \
    do {                            \
        const int error_ = (fault); \
        if (error_ > 0) {           \
            errno = error_;         \
            return failed;          \
        }                           \
    } while (0)

// Writes to the log how much of a file outlives a power cut.
void note_synced(int descriptor);
