using System;
using System.Collections;

namespace UnityEngine
{
    public class YieldInstruction { }

    public sealed class WaitForFixedUpdate : YieldInstruction { }

    public sealed class WaitForEndOfFrame : YieldInstruction { }

    public sealed class WaitForSeconds : YieldInstruction
    {
        internal readonly float seconds;
        public WaitForSeconds(float seconds) => this.seconds = seconds;
    }

    public abstract class CustomYieldInstruction : IEnumerator
    {
        public abstract bool keepWaiting { get; }
        public object Current => null;
        public bool MoveNext() => keepWaiting;
        public virtual void Reset() { }
    }

    public sealed class WaitUntil : CustomYieldInstruction
    {
        readonly Func<bool> predicate;
        public WaitUntil(Func<bool> predicate) => this.predicate = predicate;
        public override bool keepWaiting => !predicate();
    }
}
