using System;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Base of all actuators; user actuators derive from <see cref="Actuator{TData}"/>.</summary>
    public abstract class Actuator : NodePart
    {
        /// <summary>Returns a vector of the program's answer, or throws if it is not finite, because physics cannot recover from it.</summary>
        internal static Vector3 Finite(Vector3 answer)
        {
            if (float.IsFinite(answer.x) && float.IsFinite(answer.y) && float.IsFinite(answer.z)) return answer;
            throw new InvalidOperationException(
                "the program answered (" + answer.x + ", " + answer.y + ", " + answer.z + "), which is not finite: correct the program");
        }

        internal sealed override ref PartList ListOf(Node node) => ref node.Actuators;
    }

    /// <summary>Applies the answer of a node's program to the scene.</summary>
    /// <typeparam name="TData">
    /// The generated type <c>ActuatorData</c> of the schema: a copy of a struct, a view of a table that is valid during the call.
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
        /// Called once after each round of the node that gave an answer, on the main thread, before physics advances. Data of a table is a view of the bridge's
        /// memory: valid during the call only.
        /// </summary>
        protected abstract void Act(TData data);
    }
}
