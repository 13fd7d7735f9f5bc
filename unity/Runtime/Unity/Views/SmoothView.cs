using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Makes an object appear to move smoothly between ticks. Add it to a child that only has renderers. It moves the child from the parent's pose before
    /// the last tick to the parent's present pose, like the interpolation of a Rigidbody. The parent, whose pose rules, sensors and physics use, is not
    /// affected. Disable the component to draw the poses of the ticks.
    /// </summary>
    [AddComponentMenu("Collektive/Smooth View")]
    [DisallowMultipleComponent]
    [HelpPage("sensors-and-actuators.md#views")]
    public sealed class SmoothView : MonoBehaviour
    {
        private SimulationManager shown;
        private ulong tick;
        private Vector3 restPosition;
        private Quaternion restRotation;
        private Vector3 fromPosition;
        private Vector3 toPosition;
        private Quaternion fromRotation;
        private Quaternion toRotation;

        private void OnEnable()
        {
            if (transform.parent == null || GetComponentInChildren<Collider>() != null)
            {
                Debug.LogError("Smooth View on '" + name + "' would move a node or its colliders: move it to a child that only has renderers", this);
                enabled = false;
                return;
            }
            restPosition = transform.localPosition;
            restRotation = transform.localRotation;
            shown = null;
        }

        private void OnDisable()
        {
            // The pose must also be restored if the manager has been destroyed.
            if (!ReferenceEquals(shown, null)) transform.SetLocalPositionAndRotation(restPosition, restRotation);
            shown = null;
        }

        private void LateUpdate()
        {
            var manager = SimulationManager.Current;
            var parent = transform.parent;
            if (manager == null || parent == null) return;
            parent.GetPositionAndRotation(out var position, out var rotation);
            if (shown != manager)
            {
                (toPosition, toRotation) = (position, rotation);
                tick = ulong.MaxValue;
                shown = manager;
            }
            if (tick != manager.Tick)
            {
                (fromPosition, fromRotation) = (toPosition, toRotation);
                tick = manager.Tick;
            }
            (toPosition, toRotation) = (position, rotation);
            var fraction = manager.TickFraction;
            var turn = Quaternion.Slerp(fromRotation, toRotation, fraction);
            // The offset in the parent's axes, with the scales of all parents.
            var offset = Quaternion.Inverse(rotation) * parent.TransformVector(restPosition);
            transform.SetPositionAndRotation(Vector3.Lerp(fromPosition, toPosition, fraction) + turn * offset, turn * restRotation);
        }
    }
}
