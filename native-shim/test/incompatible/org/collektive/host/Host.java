package org.collektive.host;

/** A host of another version: its entries have other types. Its thread does not end. */
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
