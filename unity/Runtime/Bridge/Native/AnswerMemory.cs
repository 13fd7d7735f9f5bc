using System;

namespace Collektive.Bridge
{
    /// <summary>The JVM's answer, read in place; valid until the session's next call.</summary>
    internal sealed unsafe class AnswerMemory : NativeMemory
    {
        public override void GrowFront(int newSize) => throw new NotSupportedException("an answer is read-only");

        internal void Point(Shim.Answer answer) => Show(answer.Address, answer.Offset + answer.Length);

        internal void Detach() => Show(null, 0);
    }
}
