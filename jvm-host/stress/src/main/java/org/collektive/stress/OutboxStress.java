package org.collektive.stress;

import java.util.concurrent.TimeUnit;
import org.collektive.engine.Outbox;
import org.collektive.engine.RoundPool;
import org.collektive.spi.Export;
import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.I_Result;
import org.openjdk.jcstress.infra.results.L_Result;

/** A neighbour reads a node's outbox while that node's own round sends. */
public class OutboxStress {
  private static final class Box extends Outbox {}

  /** The plain field represents the data that a round writes into its export. */
  private static final class Sent extends Export {
    private int value;

    private Sent(int value) {
      this.value = value;
    }
  }

  @JCStressTest
  @Outcome(id = "1", expect = Expect.ACCEPTABLE, desc = "the export from before the tick")
  @Outcome(expect = Expect.FORBIDDEN, desc = "a round read an export of the same tick, or no export")
  @State
  public static class RoundsReadWhatWasSentBefore {
    private final Box box = new Box();

    public RoundsReadWhatWasSentBefore() {
      box.send(new Sent(1), 7, 0.7);
    }

    @Actor
    public void sender() {
      box.send(new Sent(2), 8, 0.8);
    }

    @Actor
    public void neighbour(L_Result result) {
      Sent read = (Sent) box.readable(8);
      result.r1 = read == null ? "nothing" : read.value;
    }
  }

  @JCStressTest
  @Outcome(id = "nothing", expect = Expect.ACCEPTABLE, desc = "the round found no export from before the tick")
  @Outcome(expect = Expect.FORBIDDEN, desc = "a round read an export of the same tick")
  @State
  public static class FirstExportWaitsForTheNextTick {
    private final Box box = new Box();

    @Actor
    public void sender() {
      box.send(new Sent(1), 1, 0.1);
    }

    @Actor
    public void neighbour(L_Result result) {
      Sent read = (Sent) box.readable(1);
      result.r1 = read == null ? "nothing" : read.value;
    }
  }

  /** Both rounds of a node run on a pool, the second often on a different thread. */
  @JCStressTest
  @Outcome(id = "0", expect = Expect.ACCEPTABLE, desc = "every node reads its neighbour's complete export")
  @Outcome(expect = Expect.FORBIDDEN, desc = "an export was not visible in the next tick, or (-1) the work never ended")
  @State
  public static class NextTickReadsWhole {
    private static final RoundPool POOL = new RoundPool(2);
    private static final int NODES = 4;

    private static final RoundPool.Task<NextTickReadsWhole> SEND = (state, thread, worker, begin, end) -> {
      for (int node = begin; node < end; node++) state.boxes[node].send(new Sent(node + 1), 1, 0.1);
    };

    private static final RoundPool.Task<NextTickReadsWhole> READ = (state, thread, worker, begin, end) -> {
      for (int node = begin; node < end; node++) {
        int neighbour = NODES - 1 - node;
        Sent read = (Sent) state.boxes[neighbour].readable(2);
        state.wrong[node] = read == null || read.value != neighbour + 1 ? 1 : 0;
      }
    };

    private final Box[] boxes = new Box[NODES];
    private final int[] wrong = {1, 1, 1, 1};

    public NextTickReadsWhole() {
      for (int node = 0; node < NODES; node++) boxes[node] = new Box();
    }

    @Actor
    public void caller(I_Result result) {
      long deadline = System.nanoTime() + TimeUnit.SECONDS.toNanos(20);
      if (!POOL.run(SEND, this, NODES, 1, deadline) || !POOL.run(READ, this, NODES, 1, deadline)) {
        result.r1 = -1;
        return;
      }
      for (int one : wrong) result.r1 += one;
    }
  }
}
