using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Perceives where the node is. A subclass of one line says into which field of the schema's data it goes.</summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class PositionSensor<TData> : Sensor<TData>
    {
        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data) => Write(ref data, Node.Position);

        /// <summary>Writes the node's position in metres.</summary>
        protected abstract void Write(ref TData data, Vector3 position);
    }
}
