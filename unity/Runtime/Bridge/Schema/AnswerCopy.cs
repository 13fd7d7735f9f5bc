namespace Collektive.Bridge
{
    /// <summary>A copy of one element of actuator data: see <see cref="ActuatorBuffer.CopyPrevious"/>.</summary>
    internal abstract class AnswerCopy
    {
        private protected AnswerCopy()
        {
        }

        /// <summary>The element, boxed, for tools without the schema's types.</summary>
        public abstract object Get();
    }

    /// <summary>A <see cref="AnswerCopy"/> with a typed element.</summary>
    internal abstract class AnswerCopy<T> : AnswerCopy
    {
        private protected AnswerCopy()
        {
        }

        /// <summary>The element. An element of a table is a view of this object's memory, valid until the next copy.</summary>
        public abstract T Value { get; }

        /// <inheritdoc/>
        public sealed override object Get() => Value;
    }
}
