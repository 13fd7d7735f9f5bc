using System;

namespace UnityEngine
{
    /// Which messages of physics a script answers to; Change stands for Enter and Exit.
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
