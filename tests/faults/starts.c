// Calls that start programs and threads.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <spawn.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>

#include "plan.h"

// Until the time is up or a signal was handled.
static void pause_for(double seconds) {
    const struct timespec time = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)};
    nanosleep(&time, NULL);
}

#define DEFINE_SPAWN(name)                                                                          \
    DECLARE_REAL(name)                                                                              \
    int name(pid_t* child, const char* program, const posix_spawn_file_actions_t* actions,          \
             const posix_spawnattr_t* attributes, char* const words[], char* const environment[]) { \
        const int error = fault_of(kind_spawn, program);                                            \
        if (error > 0) return error;                                                                \
        const int result = REAL(name)()(child, program, actions, attributes, words, environment);   \
        if (result == 0 && the_plan()->pause_s > 0) pause_for(the_plan()->pause_s);                 \
        return result;                                                                              \
    }

DEFINE_SPAWN(posix_spawn)
DEFINE_SPAWN(posix_spawnp)

struct start {
    void* (*function)(void*);
    void* argument;
};

static atomic_int alive;

static void* run(void* pointer) {
    struct start start = *(struct start*)pointer;
    free(pointer);
    void* result = start.function(start.argument);
    atomic_fetch_sub(&alive, 1);
    return result;
}

DECLARE_REAL(pthread_create)
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*function)(void*), void* argument) {
    const int fault = fault_of(kind_thread, "");
    if (fault > 0) return fault;
    const int allowed = the_plan()->threads;
    if (allowed >= 0 && atomic_load(&alive) >= allowed) return EAGAIN;
    struct start* start = malloc(sizeof *start);
    if (!start) return EAGAIN;
    *start = (struct start){function, argument};
    atomic_fetch_add(&alive, 1);
    const int error = REAL(pthread_create)()(thread, attributes, run, start);
    if (error) {
        atomic_fetch_sub(&alive, 1);
        free(start);
    }
    return error;
}
