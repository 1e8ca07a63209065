// Preloaded: pthread_create() fails as under a limit of processes once it was called STRATA_TEST_THREADS times.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

typedef int (*create_function)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);

static atomic_int calls;

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument) {
    const char *allowed = getenv("STRATA_TEST_THREADS");
    if (allowed && atomic_fetch_add(&calls, 1) >= atoi(allowed)) return EAGAIN;
    create_function create = (create_function)dlsym(RTLD_NEXT, "pthread_create");
    return create(thread, attributes, start, argument);
}
