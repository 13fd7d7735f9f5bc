using System.Collections.Generic;
using Collektive.Unity;
using UnityEngine;

namespace CollektiveSamples.GradientAscent
{
    /// <summary>
    /// A swarm moves towards the source of a signal in a flat arena of 100 x 60 m with a rim. Four obstacles block the direct path. Each node senses the
    /// intensity of the signal at its position and the obstacles around it, and exchanges messages with the nodes within its range.
    /// </summary>
    [AddComponentMenu("Collektive/Samples/Gradient Ascent Scene")]
    public sealed class GradientAscentScene : SceneBuilder
    {
        private const int IgnoreRaycastLayer = 2;
        private const int SpawnAttempts = 10000;

        private static readonly string[] Names = { "mean_distance", "p90_distance", "contacts" };
        private static readonly float[] ObstaclePlaces = { -9, -3, 3, 9 };

        /// <summary>Number of nodes.</summary>
        [Min(1)]
        public int nodes = 500;

        /// <summary>Radio range of the nodes in metres.</summary>
        [Min(0)]
        public float range = 3;

        /// <summary>Radius of a node's body in metres.</summary>
        [Min(0.01f)]
        public float bodyRadius = 0.25f;

        /// <summary>Position of the source.</summary>
        public Vector3 source = new Vector3(25, 0, 0);

        /// <summary>Whether the scene contains the four obstacles.</summary>
        public bool obstacles = true;

        /// <summary>Factor for the length and width of the field, and for the reach of the source. It does not move the source.</summary>
        [Min(0.1f)]
        public float fieldScale = 1;

        [SerializeField]
        [Tooltip("Prefab of the nodes. If empty, the scene builds an equivalent object. Runs without Unity do this too.")]
        private Node nodePrefab = null;

        [SerializeField]
        [Tooltip("The source in the scene. If empty, the scene builds one.")]
        private IntensitySource sourceObject = null;

        private readonly List<float> distances = new List<float>();
        private SimulationManager manager;
        private IntensitySource intensity;
        private PhysicsMaterial slippery;

        /// <inheritdoc/>
        public override IReadOnlyList<string> MetricNames => Names;

        /// <inheritdoc/>
        public override string ColouringName => "intensity";

        /// <inheritdoc/>
        public override IReadOnlyList<KeyValuePair<string, Vector3>> Landmarks => new[] { new KeyValuePair<string, Vector3>("source", source) };

        /// <inheritdoc/>
        public override float GetColouringValue(Node node) => intensity.IntensityAt(node.transform.position);

        /// <summary>Writes the mean and the 90th percentile of the nodes' distances to the source in metres, and the number of contacts.</summary>
        public override void Measure(double[] values)
        {
            distances.Clear();
            var sum = 0.0;
            var contacts = 0;
            foreach (var node in manager.Nodes)
            {
                var way = node.transform.position - source;
                way.y = 0;
                distances.Add(way.magnitude);
                sum += way.magnitude;
                contacts += node.GetComponent<ObstacleSensor>().Contacts;
            }
            distances.Sort();
            values[0] = sum / distances.Count;
            values[1] = distances.Count == 0 ? double.NaN : distances[(int)(0.9 * (distances.Count - 1))];
            values[2] = contacts;
        }

        /// <inheritdoc/>
        protected override void Build(SimulationManager manager)
        {
            if (nodes < 1 || !(range >= 0) || !(bodyRadius > 0) || !(fieldScale > 0))
            {
                manager.Fail("the scene has " + nodes + " nodes of radius " + bodyRadius + " m with a range of " + range + " m on a field of scale "
                    + fieldScale + ": use at least one node, a radius and a scale above 0, and a range of 0 or greater");
                return;
            }
            this.manager = manager;
            slippery = new PhysicsMaterial { dynamicFriction = 0, staticFriction = 0, bounciness = 0, frictionCombine = PhysicsMaterialCombine.Minimum };
            intensity = sourceObject != null ? sourceObject : new GameObject("Source").AddComponent<IntensitySource>();
            intensity.transform.position = source;
            intensity.Falloff /= fieldScale;
            var length = 100 * fieldScale;
            var width = 60 * fieldScale;
            MakeObstacle("Floor", new Vector3(0, -0.5f, 0), new Vector3(length, 1, width)).layer = IgnoreRaycastLayer;
            MakeObstacle("Rim", new Vector3(0, 0.5f, width / 2 + 0.25f), new Vector3(length + 1, 1, 0.5f));
            MakeObstacle("Rim", new Vector3(0, 0.5f, -width / 2 - 0.25f), new Vector3(length + 1, 1, 0.5f));
            MakeObstacle("Rim", new Vector3(length / 2 + 0.25f, 0.5f, 0), new Vector3(0.5f, 1, width));
            MakeObstacle("Rim", new Vector3(-length / 2 - 0.25f, 0.5f, 0), new Vector3(0.5f, 1, width));
            if (obstacles)
            {
                foreach (var place in ObstaclePlaces)
                    MakeObstacle("Obstacle", new Vector3(10 * fieldScale, 1.5f, place * fieldScale), new Vector3(1, 3, 5 * fieldScale));
            }
            var places = new FreePlaces(2 * bodyRadius);
            var original = nodePrefab != null ? nodePrefab.gameObject : MakeOriginal();
            for (var i = 0; i < nodes && manager.Failure.Length == 0; i++) MakeNode(original, i, FreePlace(manager, places));
            if (nodePrefab == null) Destroy(original);
        }

        /// <summary>Returns a position where a body does not overlap another. It has x from -35 to 5 and z from -25 to 25, times the field's scale.</summary>
        private Vector3 FreePlace(SimulationManager manager, FreePlaces places)
        {
            for (var attempt = 0; attempt < SpawnAttempts; attempt++)
            {
                var place = new Vector3(
                    manager.Random.Range(-35f * fieldScale, 5f * fieldScale), bodyRadius, manager.Random.Range(-25f * fieldScale, 25f * fieldScale));
                if (places.TryTake(place)) return place;
            }
            manager.Fail("the field is too small for " + nodes + " bodies of radius " + bodyRadius + " m: use fewer or smaller bodies, or a larger scale");
            return Vector3.zero;
        }

        private GameObject MakeObstacle(string title, Vector3 centre, Vector3 size)
        {
            var box = MakeBox(title, centre, size);
            box.GetComponent<BoxCollider>().sharedMaterial = slippery;
            return box;
        }

        private void MakeNode(GameObject original, int index, Vector3 place)
        {
            var node = Instantiate(original, place, Quaternion.identity);
            node.name = "Node " + index;
            node.transform.localScale = 2 * bodyRadius * Vector3.one;
            node.GetComponent<SphereCollider>().sharedMaterial = slippery;
            node.GetComponent<RadiusNeighbourhood>().Radius = range;
            node.GetComponent<IntensitySensor>().Source = intensity;
            node.GetComponent<ObstacleSensor>().BodyRadius = bodyRadius;
            node.SetActive(true);
        }

        /// <summary>Builds an inactive object with the same components as the prefab.</summary>
        private static GameObject MakeOriginal()
        {
            var original = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            original.SetActive(false);
            original.AddComponent<Rigidbody>().constraints = RigidbodyConstraints.FreezeRotation;
            original.AddComponent<Node>();
            original.AddComponent<RadiusNeighbourhood>();
            original.AddComponent<PositionSensor>();
            original.AddComponent<IntensitySensor>();
            original.AddComponent<ObstacleSensor>();
            original.AddComponent<MoveActuator>();
            return original;
        }
    }
}
