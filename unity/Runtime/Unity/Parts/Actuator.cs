using System;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Base of all actuators; user actuators derive from <see cref="Actuator{TData}"/>.</summary>
    public abstract class Actuator : NodePart
    {
        private bool hasReportedKinematic;

        /// <summary>
        /// Returns a vector of the program's answer. Throws an exception if it is not finite, because physics cannot recover from such values.
        /// </summary>
        internal static Vector3 Finite(Vector3 answer)
        {
            if (float.IsFinite(answer.x) && float.IsFinite(answer.y) && float.IsFinite(answer.z)) return answer;
            throw new InvalidOperationException(
                "the program answered (" + answer.x + ", " + answer.y + ", " + answer.z + "), which is not finite: correct the program");
        }

        /// <summary>Returns whether a body is kinematic, and warns once that this actuator has no effect on such a body.</summary>
        internal bool WarnIfKinematic(Rigidbody body)
        {
            if (!body.isKinematic) return false;
            if (hasReportedKinematic) return true;
            hasReportedKinematic = true;
            Debug.LogWarning(GetType().Name + " on '" + name
                + "' has no effect while its Rigidbody is kinematic: disable Is Kinematic, or move the node with a Move actuator", this);
            return true;
        }

        internal sealed override ref PartList ListOf(Node node) => ref node.Actuators;
    }

    /// <summary>Applies the answer of a node's program to the scene.</summary>
    /// <typeparam name="TData">
    /// The generated type <c>ActuatorData</c> of the schema.
    /// </typeparam>
    public abstract class Actuator<TData> : Actuator
    {
        internal sealed override void Run(TickContext tick, int index)
        {
            if (!(tick.Answered is ActuatorBuffer<TData> buffer))
            {
                FailWithSchemaMismatch(tick, "actuator", typeof(TData), tick.Answered.DataType);
                return;
            }
            Prepare(tick);
            Act(buffer[index]);
        }

        /// <summary>
        /// Called once after each round that returned an answer, on the main thread, before physics advances. A struct is passed as a copy. A table is passed
        /// as a view of the bridge's memory, which is valid during the call only.
        /// </summary>
        protected abstract void Act(TData data);
    }
}
