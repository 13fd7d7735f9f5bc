package org.collektive.bench.rounds;

import java.util.concurrent.TimeUnit;
import org.openjdk.jmh.annotations.Benchmark;
import org.openjdk.jmh.annotations.BenchmarkMode;
import org.openjdk.jmh.annotations.Level;
import org.openjdk.jmh.annotations.Mode;
import org.openjdk.jmh.annotations.OutputTimeUnit;
import org.openjdk.jmh.annotations.Param;
import org.openjdk.jmh.annotations.Scope;
import org.openjdk.jmh.annotations.Setup;
import org.openjdk.jmh.annotations.State;
import org.openjdk.jmh.annotations.TearDown;

/** Measures one tick of a settled network. Written in Java, because JMH needs a Java annotation processor. */
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.MICROSECONDS)
public class RoundsBenchmark {
    /** The network under test. */
    @State(Scope.Benchmark)
    public static class Network {
        @Param("grid8")
        public String topology;

        @Param("1000")
        public int nodes;

        @Param("a")
        public String program;

        EngineRounds engine;
        HandwrittenRounds handwritten;

        /** Number of ticks after which the values of any network here no longer change. */
        private int ticksToSettle() {
            return 50 + 3 * (int) Math.sqrt(nodes);
        }

        void makeEngine() {
            engine = new EngineRounds(program, Topology.Companion.named(topology, nodes));
            for (int tick = 0; tick < ticksToSettle(); tick++) engine.tick();
        }

        void makeHandwritten() {
            handwritten = new HandwrittenRounds(program, Topology.Companion.named(topology, nodes));
            for (int tick = 0; tick < ticksToSettle(); tick++) handwritten.tick();
        }
    }

    /** Sets up the network on the engine. */
    @State(Scope.Benchmark)
    public static class OnEngine {
        @Setup(Level.Trial)
        public void setUp(Network network) {
            network.makeEngine();
        }

        @TearDown(Level.Trial)
        public void tearDown(Network network) {
            network.engine.close();
        }
    }

    /** Sets up the network for the hand-written loops. */
    @State(Scope.Benchmark)
    public static class ByHand {
        @Setup(Level.Trial)
        public void setUp(Network network) {
            network.makeHandwritten();
        }
    }

    @Benchmark
    public Object engine(Network network, OnEngine engine) {
        return network.engine.tick();
    }

    @Benchmark
    public Object handwritten(Network network, ByHand hand) {
        network.handwritten.tick();
        return network.handwritten;
    }
}
