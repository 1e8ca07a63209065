// Preloaded: pthread_create() fails as under a limit of processes while STRATA_TEST_THREADS threads are alive.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

typedef int (*create_function)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);

struct start {
    void *(*function)(void *);
    void *argument;
};

static atomic_int alive;

static void *run(void *pointer) {
    struct start start = *(struct start *)pointer;
    free(pointer);
    void *result = start.function(start.argument);
    atomic_fetch_sub(&alive, 1);
    return result;
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*function)(void *), void *argument) {
    const char *allowed = getenv("STRATA_TEST_THREADS");
    if (allowed && atomic_load(&alive) >= atoi(allowed)) return EAGAIN;
    create_function create = (create_function)dlsym(RTLD_NEXT, "pthread_create");
    struct start *start = malloc(sizeof *start);
    if (!start) return EAGAIN;
    *start = (struct start){function, argument};
    atomic_fetch_add(&alive, 1);
    int error = create(thread, attributes, run, start);
    if (error) {
        atomic_fetch_sub(&alive, 1);
        free(start);
    }
    return error;
}
