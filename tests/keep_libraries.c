// Libraries stay loaded until a program with sanitizers ends, so that reports and their suppressions name
// whose code it was. Mesa unloads its driver with the last context.
#include <dlfcn.h>

int dlclose(void* library) {
    (void)library;
    return 0;
}
