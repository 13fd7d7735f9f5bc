package probe;

import org.collektive.api.Metric;
import org.collektive.api.NetworkSnapshot;
import org.collektive.api.NodeSnapshot;

/** The metrics of the tests. */
public final class Metrics {
  private Metrics() {}

  /** Returns the sum of all sensor data of this tick. */
  @Metric(name = "sensed")
  public static double sensed(NetworkSnapshot<SensorData, ActuatorData> network) {
    double sum = 0;
    for (NodeSnapshot<SensorData, ActuatorData> node : network.getNodes()) {
      if (node.getSensors() != null) sum += node.getSensors().value();
    }
    return sum;
  }

  /** Returns the sum of the last answers, or NaN if a node has not answered yet. */
  @Metric(name = "answered")
  public static double answered(NetworkSnapshot<SensorData, ActuatorData> network) {
    double sum = 0;
    for (NodeSnapshot<SensorData, ActuatorData> node : network.getNodes()) {
      sum += node.getAnswer() == null ? Double.NaN : node.getAnswer().getValue();
    }
    return sum;
  }

  /** Returns the sum over all links of the sender's id plus ten times the link's length. */
  @Metric(name = "links")
  public static double links(NetworkSnapshot<SensorData, ActuatorData> network) {
    return network.getNodes().stream()
        .flatMap(node -> node.getLinks().stream())
        .mapToDouble(link -> network.get(link.getFrom()).getId() + 10 * link.getLength())
        .sum();
  }

  @Metric(name = "throwing")
  public static double throwing(NetworkSnapshot<SensorData, ActuatorData> network) {
    throw new IllegalStateException("no metric at " + network.getTime());
  }

  @Metric(name = "looping")
  public static double looping(NetworkSnapshot<SensorData, ActuatorData> network) {
    while (true) Thread.onSpinWait();
  }
}
