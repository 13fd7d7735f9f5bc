package org.collektive.host;

/** Host of another version, whose methods have other types. It starts a thread that does not end. */
final class Host {
    static {
        new Thread(() -> {
            for (;;) Thread.onSpinWait();
        }).start();
    }

    static String start() {
        return "incompatible";
    }

    static long open(byte[] request) {
        return 0;
    }
}
