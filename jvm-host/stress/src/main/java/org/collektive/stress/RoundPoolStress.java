package org.collektive.stress;

import java.util.concurrent.TimeUnit;
import org.collektive.engine.RoundPool;
import org.collektive.engine.RoundThread;
import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Mode;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.Signal;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.II_Result;

/**
 * One thread repeatedly submits work to the threads of a pool.
 *
 * <p>Each test has one actor. It races with the pool's threads, which park or spin while the next work arrives.
 */
public class RoundPoolStress {
  private static final int COUNT = 5;
  private static final int RANGE = 2;

  /** Counts the runs of each index in a plain array, so lost and repeated work is visible. */
  private static final RoundPool.Task<int[]> COUNT_UP = (counts, thread, worker, begin, end) -> {
    for (int index = begin; index < end; index++) counts[index]++;
  };

  private static long deadline() {
    return System.nanoTime() + TimeUnit.SECONDS.toNanos(20);
  }

  private static int countMissed(RoundPool pool, int[] counts, int times) {
    if (!pool.run(COUNT_UP, counts, COUNT, RANGE, deadline())) return -1;
    int wrong = 0;
    for (int count : counts) if (count != times) wrong++;
    return wrong;
  }

  @JCStressTest
  @Outcome(id = "0, 0", expect = Expect.ACCEPTABLE, desc = "each index ran once per run, visible to the caller and the next run")
  @Outcome(expect = Expect.FORBIDDEN, desc = "an index was skipped or repeated, its result was not visible, or (-1) the work never ended")
  @State
  public static class EveryIndexIsDoneOnce {
    private static final RoundPool POOL = new RoundPool(2);
    private final int[] counts = new int[COUNT];

    @Actor
    public void caller(II_Result result) {
      result.r1 = countMissed(POOL, counts, 1);
      result.r2 = countMissed(POOL, counts, 2);
    }
  }

  /** As in a session, the threads spin while a frame is read. */
  @JCStressTest
  @Outcome(id = "0, 0", expect = Expect.ACCEPTABLE, desc = "each index ran once per run, visible to the caller and the next run")
  @Outcome(expect = Expect.FORBIDDEN, desc = "an index was skipped or repeated, its result was not visible, or (-1) the work never ended")
  @State
  public static class ThreadsThatWakeMissNothing {
    private static final RoundPool POOL = new RoundPool(2);
    private final int[] counts = new int[COUNT];

    @Actor
    public void caller(II_Result result) {
      POOL.wake();
      result.r1 = countMissed(POOL, counts, 1);
      POOL.wake();
      result.r2 = countMissed(POOL, counts, 2);
    }
  }

  @JCStressTest(Mode.Termination)
  @Outcome(id = "TERMINATED", expect = Expect.ACCEPTABLE, desc = "the thread ended")
  @Outcome(id = "STALE", expect = Expect.FORBIDDEN, desc = "an idle thread did not end after its pool was abandoned")
  @State
  public static class AbandonedThreadsEnd {
    private final RoundPool pool = new RoundPool(1);
    private final RoundThread[] thread = new RoundThread[1];

    public AbandonedThreadsEnd() {
      pool.run((RoundPool.Task<RoundThread[]>) (found, self, worker, begin, end) -> found[0] = self, thread, 1, 1, deadline());
    }

    @Actor
    public void joiner() throws InterruptedException {
      thread[0].join();
    }

    @Signal
    public void abandon() {
      pool.abandon();
    }
  }
}
