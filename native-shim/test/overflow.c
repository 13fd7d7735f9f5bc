/* A native library that a program loads, with a function that overflows the stack. */
#include <jni.h>
#include "collektive_shim.h"

CLK_API jint JNICALL Java_org_collektive_host_Host_overflow(JNIEnv *env, jclass class, jint depth);

CLK_API jint JNICALL Java_org_collektive_host_Host_overflow(JNIEnv *env, jclass class, jint depth) {
    volatile char frame[1024];
    frame[0] = (char)depth;
    return depth < 0 ? 0 : Java_org_collektive_host_Host_overflow(env, class, (depth + 1) & 0xFFFFFF) + frame[0];
}
