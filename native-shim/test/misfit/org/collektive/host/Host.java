package org.collektive.host;

/** A host of another version: its entries have other types. */
final class Host {
    static String start() {
        return "misfit";
    }

    static long open(byte[] request) {
        return 0;
    }
}
