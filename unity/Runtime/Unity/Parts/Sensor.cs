using System;
using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>Base of all sensors; user sensors derive from <see cref="Sensor{TData}"/>.</summary>
    public abstract class Sensor : NodePart
    {
        internal abstract Type DataType { get; }

        internal abstract void Sense(SensorBuffer buffer, int index);

        internal sealed override void Attach(Node node) => node.Sensors.Add(this);

        internal sealed override void Detach(Node node) => node.Sensors.Remove(this);
    }

    /// <summary>
    /// Writes what a node perceives into the data of its next round. Several sensors of one node fill different fields of the same data.
    /// </summary>
    /// <typeparam name="TData">
    /// The generated type of the schema's sensor data: <c>SensorDataValue</c> for a struct, <c>SensorDataDraft</c> for a table.
    /// </typeparam>
    public abstract class Sensor<TData> : Sensor
    {
        internal sealed override Type DataType => typeof(TData);

        internal sealed override void Sense(SensorBuffer buffer, int index)
        {
            Sense(ref ((SensorBuffer<TData>)buffer).Items[index]);
        }

        /// <summary>
        /// Called once before each round of the node, on the main thread, after physics were synchronised. The data holds the
        /// schema's defaults and what earlier sensors of the node wrote. An exception costs the node this round.
        /// </summary>
        protected abstract void Sense(ref TData data);
    }
}
