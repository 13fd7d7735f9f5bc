namespace Collektive.Bridge
{
    /// <summary>A copy of one element of actuator data, which <see cref="ActuatorBuffer.CopyPrevious"/> creates.</summary>
    internal abstract class AnswerCopy
    {
        private protected AnswerCopy()
        {
        }

        /// <summary>Returns the element, boxed, for tools that do not know the schema's types.</summary>
        public abstract object Get();
    }

    /// <summary>A <see cref="AnswerCopy"/> with a typed element.</summary>
    internal abstract class AnswerCopy<T> : AnswerCopy
    {
        private protected AnswerCopy()
        {
        }

        /// <summary>The element. If it is a table, it is a view of this object's memory, which is valid until the next copy.</summary>
        public abstract T Value { get; }

        /// <inheritdoc/>
        public sealed override object Get() => Value;
    }
}
