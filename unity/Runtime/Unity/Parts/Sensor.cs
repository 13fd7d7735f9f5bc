using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>Base of all sensors; user sensors derive from <see cref="Sensor{TData}"/>.</summary>
    public abstract class Sensor : NodePart
    {
        internal sealed override ref PartList ListOf(Node node) => ref node.Sensors;
    }

    /// <summary>Writes sensor data for a node's next round. Several sensors of a node may fill different fields.</summary>
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
        /// Called once before each round of the node, on the main thread, with physics synchronised to the transforms. Fields that no earlier sensor of the
        /// node has written contain the schema's defaults. If the method throws an exception, the node misses the round.
        /// </summary>
        protected abstract void Sense(ref TData data);
    }
}
