/* A disk as on a network that loses answers: what is renamed, linked, removed or made below the folder LOSE_BELOW is
 * done, and is said to have failed as it does when it is asked for again. Tests preload it. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* What is told of a call that did its work. */
static int answer(int done, const char *path, int error) {
    const char *folder = getenv("LOSE_BELOW");
    if (done != 0 || !folder || strncmp(path, folder, strlen(folder)) != 0) return done;
    errno = error;
    return -1;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

int rename(const char *from, const char *to) {
    return answer(REAL(rename)(from, to), to, ENOENT);
}

int link(const char *from, const char *to) {
    return answer(REAL(link)(from, to), to, EEXIST);
}

int unlink(const char *path) {
    return answer(REAL(unlink)(path), path, ENOENT);
}

int remove(const char *path) {
    return answer(REAL(remove)(path), path, ENOENT);
}

int mkdir(const char *path, mode_t mode) {
    return answer(REAL(mkdir)(path, mode), path, EEXIST);
}
