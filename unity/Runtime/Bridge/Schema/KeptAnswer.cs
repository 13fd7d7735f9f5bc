namespace Collektive.Bridge
{
    /// <summary>One element of actuator data in memory of its own: see <see cref="ActuatorBuffer.KeepFormer"/>.</summary>
    internal abstract class KeptAnswer
    {
        private protected KeptAnswer()
        {
        }

        /// <summary>The element, boxed: for tools that know no schema.</summary>
        public abstract object Get();
    }

    /// <summary>A <see cref="KeptAnswer"/> with a typed element.</summary>
    internal abstract class KeptAnswer<T> : KeptAnswer
    {
        private protected KeptAnswer()
        {
        }

        /// <summary>The element. Of a table it is a view of this object's memory: valid until the next copy is kept there.</summary>
        public abstract T Value { get; }

        /// <inheritdoc/>
        public sealed override object Get() => Value;
    }
}
