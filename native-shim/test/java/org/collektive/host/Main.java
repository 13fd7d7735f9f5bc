package org.collektive.host;

/** The main class of the JVM's own process. */
final class Main {
    public static void main(String[] arguments) {
        System.load(arguments[0]);
        new Thread(null, () -> serve(arguments[1]), "collektive", 16 << 20).start();
    }

    private static native void serve(String token);
}
