using Collektive.Unity;
using UnityEngine;

namespace CollektiveSamples.Rescue
{
    /// <summary>Drives a vehicle back and forth between two points. Its position depends only on the simulated time.</summary>
    [RequireComponent(typeof(Rigidbody))]
    [AddComponentMenu("Collektive/Samples/Rescue/Shuttle")]
    public sealed class Shuttle : MonoBehaviour
    {
        [SerializeField]
        [Tooltip("First turning point in metres.")]
        private Vector3 from;

        [SerializeField]
        [Tooltip("Second turning point in metres.")]
        private Vector3 to;

        [SerializeField]
        [Min(0)]
        [Tooltip("Speed in metres per second.")]
        private float speed = 1;

        private SimulationManager manager;
        private Rigidbody body;

        /// <summary>Sets the two turning points in metres and the speed in metres per second. Call it before the component is enabled.</summary>
        public void Set(Vector3 from, Vector3 to, float speed)
        {
            this.from = from;
            this.to = to;
            this.speed = speed;
        }

        private void OnEnable()
        {
            body = GetComponent<Rigidbody>();
            manager = SimulationManager.Current;
            if (manager != null) manager.Ticked += Drive;
        }

        private void OnDisable()
        {
            if (manager != null) manager.Ticked -= Drive;
        }

        private void Drive(SimulationManager manager)
        {
            var length = Vector3.Distance(from, to);
            var done = Mathf.PingPong((float)manager.SimulatedTime * speed, length);
            body.MovePosition(Vector3.Lerp(from, to, done / length));
        }
    }
}
