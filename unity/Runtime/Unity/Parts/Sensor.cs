using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>Base of all sensors; user sensors derive from <see cref="Sensor{TData}"/>.</summary>
    public abstract class Sensor : NodePart
    {
        internal sealed override ref PartList ListOf(Node node) => ref node.Sensors;
    }

    /// <summary>
    /// Writes sensor data for a node's next round. Several sensors of one node may fill different fields.
    /// </summary>
    /// <typeparam name="TData">
    /// The generated type <c>SensorData</c> of the schema.
    /// </typeparam>
    public abstract class Sensor<TData> : Sensor
    {
        internal sealed override void Run(TickContext tick, int index)
        {
            if (!(tick.SensorData is SensorBuffer<TData> buffer))
            {
                FailWithSchemaMismatch(tick, "sensor", typeof(TData), tick.SensorData.DataType);
                return;
            }
            Prepare(tick);
            Sense(ref buffer.Items[index]);
        }

        /// <summary>
        /// Called once before each round of the node, on the main thread, after physics was synchronised. The data contains the schema's defaults and what
        /// earlier sensors of the node wrote. After an exception, the node misses the round.
        /// </summary>
        protected abstract void Sense(ref TData data);
    }
}
