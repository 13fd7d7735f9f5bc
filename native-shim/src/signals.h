/*
 * Signal handlers, shared by the host process (Mono), HotSpot and the shim. HotSpot installs its own at the start and
 * passes on to the handlers that were there before what is not its own.
 */
#ifndef COLLEKTIVE_SIGNALS_H
#define COLLEKTIVE_SIGNALS_H

#include <stdint.h>

/* Remembers the host's handlers. Before JNI_CreateJavaVM. */
void signals_save_host(void);

/* Puts the host's handlers back: the JVM did not come up. Any thread. */
void signals_restore_host(void);

/* Makes HotSpot's handlers fit for this process, and remembers them. After JNI_CreateJavaVM. */
void signals_adopt_jvm(void);

/* Puts HotSpot's handlers back where another library has replaced them. Returns how many were. Any thread. */
int32_t signals_repair(void);

#endif
