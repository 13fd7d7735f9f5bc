using System;
using System.Collections.Generic;

namespace UnityEngine
{
    /// The components that receive each message, in execution order.
    static class Lifecycle
    {
        static readonly BehaviourList Starting = new BehaviourList();
        static readonly BehaviourList FixedUpdating = new BehaviourList();
        static readonly BehaviourList Updating = new BehaviourList();
        static readonly BehaviourList LateUpdating = new BehaviourList();
        static readonly Comparison<Component> ByOrder = (a, b) => OrderOf(a).CompareTo(OrderOf(b));
        static int enablings;

        /// The objects that are being activated or deactivated with their children, and their component that receives a message now.
        static readonly List<(Transform Root, bool Active, Component Notified)> Changing = new List<(Transform, bool, Component)>();

        public static void Enabled(MonoBehaviour script)
        {
            script.enabling = ++enablings;
            if (!script.HasStarted) Starting.Add(script);
            if (script.messages.FixedUpdate != null) FixedUpdating.Add(script);
            if (script.messages.Update != null) Updating.Add(script);
            if (script.messages.LateUpdate != null) LateUpdating.Add(script);
        }

        /// Notifies components of objects that became active or inactive together. Components of the engine come first, then scripts in execution order.
        /// The parents of their objects cannot change below `root` meanwhile.
        public static void ActivityChanged(List<Component> components, bool active, Transform root)
        {
            Orders.Shuffle(components);
            StableSort(components);
            foreach (var component in components)
            {
                if (component.destroyed || component.owner.activeInHierarchy != active) continue; // changed by a message to an earlier component
                Changing.Add((root, active, component));
                try
                {
                    if (active) component.Activate();
                    else component.Deactivate();
                }
                finally
                {
                    Changing.RemoveAt(Changing.Count - 1);
                }
            }
        }

        /// Whether the object is being activated or deactivated, and it or a child receives a message now.
        public static bool IsChanging(Transform transform) => IsChanging(transform, true) || IsDeactivating(transform);

        public static bool IsDeactivating(Transform transform) => IsChanging(transform, false);

        static bool IsChanging(Transform transform, bool toActive)
        {
            foreach (var (root, active, notified) in Changing)
            {
                if (root is null || active != toActive) continue;
                for (var level = notified.owner.TransformUnchecked; !(level is null); level = ReferenceEquals(level, root) ? null : level.parentOrNull)
                    if (ReferenceEquals(level, transform)) return true;
            }
            return false;
        }

        static int OrderOf(Component component) => component is MonoBehaviour script ? script.messages.Order : int.MinValue;

        static void StableSort(List<Component> components)
        {
            for (var next = 1; next < components.Count; next++)
            {
                var component = components[next];
                var position = next;
                for (; position > 0 && ByOrder(components[position - 1], component) > 0; position--) components[position] = components[position - 1];
                components[position] = component;
            }
        }

        public static void RunFixedUpdates()
        {
            RunStarts();
            for (var cursor = FixedUpdating.Begin(); FixedUpdating.Next(ref cursor, out var script);) Messages.Send(script.messages.FixedUpdate, script);
        }

        public static void RunUpdates()
        {
            RunStarts();
            for (var cursor = Updating.Begin(); Updating.Next(ref cursor, out var script);) Messages.Send(script.messages.Update, script);
        }

        public static void RunLateUpdates()
        {
            RunStarts();
            for (var cursor = LateUpdating.Begin(); LateUpdating.Next(ref cursor, out var script);) Messages.Send(script.messages.LateUpdate, script);
        }

        /// Calls Start of all newly enabled scripts, including scripts that are enabled by another script's Start.
        public static void RunStarts()
        {
            while (Starting.HasNew)
            {
                for (var cursor = Starting.Begin(); Starting.Next(ref cursor, out var script);)
                {
                    if (script.HasStarted) continue;
                    script.HasStarted = true;
                    Messages.Send(script.messages.Start, script);
                }
                Starting.ClearOld();
            }
        }

        public static void ResetState()
        {
            Starting.Clear();
            FixedUpdating.Clear();
            Updating.Clear();
            LateUpdating.Clear();
            Changing.Clear();
            enablings = 0;
        }
    }
}
