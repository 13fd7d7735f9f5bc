using System;
using System.Collections;
using System.Collections.Generic;

namespace UnityEngine
{
    public sealed class Coroutine : YieldInstruction
    {
        internal readonly MonoBehaviour Owner;
        internal readonly IEnumerator Routine;
        readonly Stack<IEnumerator> nested = new Stack<IEnumerator>();
        CoroutinePhase phase;
        int yieldedAtFrame, yieldedInPass;
        double due;
        bool awaitsOther;
        bool done;
        Action ended;

        internal Coroutine(MonoBehaviour owner, IEnumerator routine)
        {
            Owner = owner;
            Routine = routine;
            nested.Push(routine);
        }

        internal bool IsDone => done || Owner.destroyed;

        internal void Stop() => done = true;

        internal void ResumeIfDue(CoroutinePhase now)
        {
            if (IsDone || awaitsOther || now != phase || yieldedInPass == CoroutineScheduler.Pass) return;
            if (now == CoroutinePhase.Update && (Time.frameCount == yieldedAtFrame || Time.timeAsDouble < due)) return;
            Advance();
        }

        /// Runs to the next yield. A nested routine starts immediately. When it ends, the outer routine continues immediately. The same applies to a nested
        /// coroutine. As in Unity, the outer one never continues if the nested one is stopped or throws an exception.
        internal void Advance()
        {
            awaitsOther = false;
            due = 0;
            phase = CoroutinePhase.Update;
            while (!IsDone)
            {
                var current = nested.Peek();
                bool more;
                try
                {
                    more = current.MoveNext();
                }
                catch (Exception exception)
                {
                    Headless.Loop.LogFailedCall(exception, Owner);
                    done = true;
                    return;
                }
                // A coroutine can stop itself before a yield, and then waits for nothing.
                if (more && IsDone) return;
                if (!more)
                {
                    nested.Pop();
                    if (nested.Count > 0) continue;
                    done = true;
                    ended?.Invoke();
                    return;
                }
                if (current.Current is Coroutine other && other.IsDone) continue;
                if (!(current is CustomYieldInstruction) && current.Current is IEnumerator inner)
                {
                    nested.Push(inner);
                    continue;
                }
                Wait(current.Current);
                return;
            }
        }

        void Wait(object instruction)
        {
            yieldedAtFrame = Time.frameCount;
            yieldedInPass = CoroutineScheduler.Pass;
            switch (instruction)
            {
                case WaitForSeconds wait: due = Time.EndOf(wait.seconds); break;
                case WaitForFixedUpdate _: phase = CoroutinePhase.FixedUpdate; break;
                case WaitForEndOfFrame _: phase = CoroutinePhase.EndOfFrame; break;
                case Coroutine other:
                    awaitsOther = true;
                    if (other.ended == null) other.ended = Advance;
                    else Debug.LogError("Another coroutine is already waiting for this coroutine! Only one coroutine can wait for another coroutine.", Owner);
                    break;
            }
        }
    }

    enum CoroutinePhase
    {
        FixedUpdate,
        Update,
        EndOfFrame,
    }

    /// All running coroutines, in the order in which they were started.
    static class CoroutineScheduler
    {
        static readonly List<Coroutine> Running = new List<Coroutine>();

        /// The coroutines that have not reached their first yield, and can already be stopped.
        static readonly List<Coroutine> Starting = new List<Coroutine>();
        static readonly Predicate<Coroutine> Done = coroutine => coroutine.IsDone;

        /// Increases at the beginning and the end of each pass over the coroutines.
        public static int Pass { get; private set; }

        public static Coroutine Start(MonoBehaviour owner, IEnumerator routine)
        {
            if (routine == null) throw new NullReferenceException("routine is null");
            if (!owner.gameObject.activeInHierarchy)
            {
                Debug.LogError($"Coroutine could not be started because the game object '{owner.NameImpl}' is inactive.", owner);
                return null;
            }
            var coroutine = new Coroutine(owner, routine);
            Starting.Add(coroutine);
            coroutine.Advance();
            Starting.Remove(coroutine);
            if (!coroutine.IsDone) Running.Add(coroutine);
            return coroutine;
        }

        public static void Stop(MonoBehaviour owner, IEnumerator routine)
        {
            if (routine == null) return;
            Stop(Starting, owner, routine);
            Stop(Running, owner, routine);
        }

        public static void Stop(MonoBehaviour owner, Coroutine routine)
        {
            if (routine == null) throw new NullReferenceException("routine is null");
            routine.Stop();
        }

        public static void StopAll(MonoBehaviour owner)
        {
            Stop(Starting, owner, null);
            Stop(Running, owner, null);
        }

        /// Stops the coroutines of a script that run `routine`, or all if it is null.
        static void Stop(List<Coroutine> coroutines, MonoBehaviour owner, IEnumerator routine)
        {
            foreach (var coroutine in coroutines)
                if (ReferenceEquals(coroutine.Owner, owner) && (routine == null || coroutine.Routine == routine)) coroutine.Stop();
        }

        public static void Run(CoroutinePhase phase)
        {
            if (Running.Count == 0) return;
            Pass++;
            var count = Running.Count;
            for (var index = 0; index < count; index++) Running[index].ResumeIfDue(phase);
            Running.RemoveAll(Done);
            Pass++;
        }

        public static void ResetState()
        {
            Starting.Clear();
            Running.Clear();
        }
    }
}
