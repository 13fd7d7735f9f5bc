package org.collektive.host;

import java.nio.ByteBuffer;

final class Shim {
    static native ByteBuffer grow(long slot, int capacity);

    static native void error(byte[] utf8);

    static native void log(int level, byte[] utf8);
}
