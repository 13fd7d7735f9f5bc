using System;

namespace UnityEngine
{
    /// The physics messages that a script handles. "Change" stands for Enter and Exit.
    [Flags]
    enum TouchMessages
    {
        None = 0,
        TriggerChange = 1,
        TriggerStay = 2,
        CollisionChange = 4,
        CollisionStay = 8,
        Triggers = TriggerChange | TriggerStay,
        Collisions = CollisionChange | CollisionStay,
    }
}
