using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Measures the node's position. A subclass writes the position to a field of the schema.</summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class PositionSensor<TData> : Sensor<TData>
    {
        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data) => Write(ref data, Node.Position);

        /// <summary>Writes the node's position in metres.</summary>
        protected abstract void Write(ref TData data, Vector3 position);
    }
}
