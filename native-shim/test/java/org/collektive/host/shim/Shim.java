package org.collektive.host.shim;

import java.nio.ByteBuffer;

public final class Shim {
    public static native ByteBuffer grow(long slot, int capacity);

    public static native void error(byte[] utf8);

    public static native void log(int level, byte[] utf8);

    public static native void debugger(boolean attached);
}
