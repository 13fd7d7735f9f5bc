package org.collektive.host;

import static java.nio.charset.StandardCharsets.UTF_8;

import java.lang.reflect.Field;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.ArrayList;
import java.util.List;
import org.collektive.host.shim.Shim;

/** Test host that runs the command in each request. A request is a command and an argument (both int32), followed by bytes. */
final class Host {
    private static final int EMPTY = 0;
    private static final int ECHO = 1;
    private static final int GROW = 2;
    private static final int THROW = 3;
    private static final int FAIL = 4;
    private static final int FAIL_SILENTLY = 5;
    private static final int EXIT = 6;
    private static final int HALT = 7;
    private static final int SLEEP = 8;
    private static final int OVERFLOW = 9;
    private static final int EXHAUST = 10;
    private static final int LOG = 11;
    private static final int HANG = 12;
    private static final int CRASH = 13;
    private static final int OUTSIDE = 14;
    private static final int GROW_FOREIGN = 15;
    private static final int STAY = 16;
    private static final int EXIT_ELSEWHERE = 17;
    private static final int IMPLICIT_NULL = 18;
    private static final int GROW_TOO_LARGE = 19;
    private static final int HANG_AT_STOP = 20;
    private static final int WRITE_AT_EXIT = 21;
    private static final int THRASH = 22;
    private static final int DEBUG = 23;
    private static final int CRASH_LATER = 24;
    private static final int OVERFLOW_NATIVELY = 25;
    private static final int DEBUG_LATER = 26;
    private static final int THROW_LATER = 27;

    private static boolean stays;
    private static volatile boolean hangs;

    static long control(long session, ByteBuffer request, int offset, int length, long slot, ByteBuffer answer, int limitMillis)
            throws Exception {
        if (session != 0) throw new AssertionError("the session of a control call must be 0, but is " + session);
        return step(session, request, offset, length, slot, answer, limitMillis);
    }

    private static final class Session {
        int sum;
    }

    private static final List<Object> hoard = new ArrayList<>();

    static String start() {
        return "test host on " + Runtime.version().feature() + " \uD83D\uDE80";
    }

    static long open(long session, ByteBuffer request, int offset, int length, long slot, ByteBuffer answer, int limitMillis)
            throws Exception {
        return step(session, request, offset, length, slot, answer, limitMillis);
    }

    static long step(long session, ByteBuffer request, int offset, int length, long slot, ByteBuffer answer, int limitMillis)
            throws Exception {
        request.order(ByteOrder.LITTLE_ENDIAN);
        answer.order(ByteOrder.LITTLE_ENDIAN);
        int argument = request.getInt(offset + 4);
        switch (request.getInt(offset)) {
            case EMPTY:
                return 0;
            case ECHO:
                return echo(request, offset + 8, length - 8, slot, answer);
            case GROW:
                return grow(argument, slot, answer);
            case THROW_LATER:
                Thread.sleep(argument);
                // falls through
            case THROW:
                throw new IllegalStateException("thrown in the host: \u00E4\u20AC\uD83D\uDE80");
            case FAIL:
                Shim.error("the host says no: \u00E4\u20AC\uD83D\uDE80".getBytes(UTF_8));
                return argument;
            case FAIL_SILENTLY:
                return argument;
            case EXIT:
                return refused(() -> System.exit(3), answer);
            case HALT:
                return refused(() -> Runtime.getRuntime().halt(4), answer);
            case EXIT_ELSEWHERE: {
                long[] result = new long[1];
                Thread thread = new Thread(() -> result[0] = refused(() -> System.exit(5), answer));
                thread.start();
                thread.join();
                return result[0];
            }
            case SLEEP:
                Thread.sleep(argument);
                return 0;
            case OVERFLOW:
                return deeper(1);
            case EXHAUST:
                try {
                    for (;;) hoard.add(new byte[1 << 20]);
                } catch (OutOfMemoryError full) {
                    for (int size = 1 << 20; size > 16; size /= 2) fill(size);
                    throw full;
                }
            case LOG:
                for (int i = 0; i < argument; i++) Shim.log(i % 4, ("line " + i).getBytes(UTF_8));
                return 0;
            case HANG:
                for (;;) Thread.onSpinWait();
            case OVERFLOW_NATIVELY:
                System.load(System.getProperty("test.overflow"));
                return overflow(0);
            case DEBUG_LATER:
                Thread.sleep(argument);
                Shim.debugger(true);
                Thread.sleep(argument);
                return 0;
            case CRASH_LATER:
                Thread.sleep(argument);
                // falls through
            case CRASH: {
                Class<?> unsafe = Class.forName("sun.misc.Unsafe");
                Field field = unsafe.getDeclaredField("theUnsafe");
                field.setAccessible(true);
                unsafe.getMethod("putLong", long.class, long.class).invoke(field.get(null), 64L, 1L);
                return 0;
            }
            case OUTSIDE:
                return (long) answer.capacity() << 32 | 1;
            case GROW_FOREIGN:
                Shim.grow(slot + 1, 100);
                return 0;
            case GROW_TOO_LARGE:
                Shim.grow(slot, Integer.MAX_VALUE);
                return 0;
            case HANG_AT_STOP:
                hangs = true;
                return 0;
            case WRITE_AT_EXIT:
                Runtime.getRuntime().addShutdownHook(new Thread(() -> Shim.log(1, "the exit hook ran".getBytes(UTF_8))));
                return 0;
            case THRASH:
                for (;;) {
                    try {
                        for (int size = 1 << 20; size > 8; size /= 2) fill(size);
                    } catch (OutOfMemoryError elsewhere) {
                        // The error was thrown outside of fill.
                    }
                }
            case STAY:
                stays = true;
                new Thread(() -> {
                    for (;;) Thread.onSpinWait();
                }).start();
                return 0;
            case DEBUG:
                Shim.debugger(argument != 0);
                return 0;
            case IMPLICIT_NULL:
                return implicitNulls(argument, answer);
            default:
                throw new IllegalArgumentException("unknown command");
        }
    }

    private static void fill(int size) {
        try {
            for (;;) hoard.add(new byte[size]);
        } catch (OutOfMemoryError full) {
            // The heap is full, as intended.
        }
    }

    private static long echo(ByteBuffer request, int offset, int length, long slot, ByteBuffer answer) {
        ByteBuffer target = length > answer.capacity() ? Shim.grow(slot, length) : answer;
        int at = target.capacity() - length;
        target.put(at, request, offset, length);
        return (long) at << 32 | length;
    }

    /** Doubles the answer buffer until it has the size. Checks that all earlier buffers stay valid. */
    private static long grow(int size, long slot, ByteBuffer answer) {
        List<ByteBuffer> all = new ArrayList<>();
        all.add(answer);
        while (answer.capacity() < size) {
            answer = Shim.grow(slot, answer.capacity() + 1);
            if (answer != Shim.grow(slot, answer.capacity())) throw new AssertionError("Shim.grow must return the same buffer if it is large enough");
            all.add(answer);
        }
        for (int i = 0; i < all.size(); i++) {
            for (int at = 0; at < all.get(i).capacity(); at += 64) all.get(i).put(at, (byte) i);
        }
        for (int i = 0; i < all.size(); i++) {
            for (int at = 0; at < all.get(i).capacity(); at += 64) {
                if (all.get(i).get(at) != i) throw new AssertionError("two buffers of the same call overlap");
            }
        }
        for (int at = 0; at < size; at++) answer.put(at, (byte) at);
        return size;
    }

    private static long refused(Runnable exit, ByteBuffer answer) {
        try {
            exit.run();
            return 0;
        } catch (SecurityException refused) {
            answer.put(0, (byte) 1);
            return 1;
        }
    }

    /** Overflows the stack by recursion in C. */
    private static native int overflow(int depth);

    private static int deeper(int depth) {
        return deeper(depth + 1) + 1;
    }

    /** Runs null checks, which compiled code implements by SIGSEGV. */
    private static long implicitNulls(int rounds, ByteBuffer answer) {
        Session[] sessions = {new Session(), null};
        int caught = 0;
        for (int i = 0; i < rounds; i++) {
            try {
                sessions[i % 50000 == 49999 ? 1 : 0].sum++;
            } catch (NullPointerException expected) {
                caught++;
            }
        }
        answer.putInt(0, caught);
        return 4;
    }

    static void close(long session) {}

    static boolean stop(int limitMillis) {
        while (hangs) Thread.onSpinWait();
        return !stays;
    }
}
