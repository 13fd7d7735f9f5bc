package probe;

import it.unibo.collektive.aggregate.Field;
import it.unibo.collektive.aggregate.FieldEntry;
import it.unibo.collektive.aggregate.api.Aggregate;
import it.unibo.collektive.aggregate.api.InMemory;
import java.util.ArrayList;
import java.util.List;
import java.util.logging.Logger;
import org.collektive.api.Device;
import org.collektive.api.Program;
import org.slf4j.LoggerFactory;

/** Programs that succeed, or fail in the way that the sensor data selects. */
public final class Programs {
  private Programs() {}

  /** Returns a hash of the values of this node and its neighbours, the number of successful rounds, a random number and the wind. */
  @Program(name = "sum")
  public static ActuatorData sum(Aggregate<Integer> aggregate, SensorData sensors, Device device) {
    long sum = sensors.value();
    int rounds = aggregate.alignedOn("rounds", () -> aggregate.<Integer>evolve(0, n -> n + 1));
    Field<Integer, Integer> near = aggregate.neighboring(sensors.value(), InMemory.INSTANCE);
    for (FieldEntry<Integer, Integer> entry : near.getNeighbors().getList()) sum = sum * 31 + entry.getValue();
    GlobalData globals = (GlobalData) device.getGlobals();
    return new ActuatorData(sum, rounds + "/" + device.getRandom().nextInt() + "/" + (globals == null ? "calm" : globals.wind()));
  }

  @Program(name = "probe")
  public static ActuatorData probe(Aggregate<Integer> aggregate, SensorData sensors) {
    String text = null;
    int round = aggregate.alignedOn("rounds", () -> aggregate.<Integer>evolve(0, n -> n + 1));
    String label = sensors.label() == null ? "" : sensors.label();
    if (label.startsWith("text:")) text = "x".repeat(Integer.parseInt(label.substring(5)));
    switch (label) {
      case "throw": throw new IllegalStateException("broken\nin two lines");
      case "throw-surrogate": throw new IllegalStateException("half \ud83d");
      case "recurse": return recurse(aggregate, sensors);
      case "memory": return exhaust();
      case "null": return null;
      case "surrogate": text = "\ud800"; break;
      case "share-view": aggregate.neighboring(sensors, InMemory.INSTANCE); break;
      case "keep-view": aggregate.evolve(sensors, old -> sensors); break;
      case "print": System.out.println("hello"); System.err.print("care"); System.err.println("ful"); break;
      case "slf4j": LoggerFactory.getLogger("probe").error("it {}", "broke"); break;
      case "thread": runThread(() -> System.out.println("from afar")); break;
      case "log": Logger.getLogger("probe").warning("watch out"); break;
      case "exit": throw new SecurityException("System.exit is refused");
      case "loop": while (true) { Thread.onSpinWait(); }
      default: break;
    }
    return new ActuatorData(round, text);
  }

  private static ActuatorData recurse(Aggregate<Integer> aggregate, SensorData sensors) {
    return aggregate.alignedOn("deeper", () -> recurse(aggregate, sensors));
  }

  private static void runThread(Runnable work) {
    Thread thread = new Thread(work, "of-probe");
    thread.start();
    try {
      thread.join();
    } catch (InterruptedException interrupted) {
      throw new IllegalStateException(interrupted);
    }
  }

  private static ActuatorData exhaust() {
    List<long[]> all = new ArrayList<>();
    while (true) all.add(new long[1 << 20]);
  }
}
