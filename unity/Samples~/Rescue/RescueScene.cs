using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using rescue;
using UnityEngine;

namespace CollektiveSamples.Rescue
{
    /// <summary>
    /// Robots leave their base and explore two ruined buildings. They find three casualties, and maintain a channel of robots from each casualty to the base.
    /// Walls weaken their radio. After a while, some robots fail, and others close the gaps in the channels.
    /// </summary>
    [AddComponentMenu("Collektive/Samples/Rescue Scene")]
    public sealed class RescueScene : SceneBuilder
    {
        private const float BodyRadius = 0.35f;
        private const float Spacing = 1.5f;
        private const int PerRow = 16;

        private static readonly string[] Names = { "found", "connected", "channel_robots", "robots", "explored" };

        private static readonly Vector3 BasePlace = new Vector3(-37, 0.5f, 0);

        private static readonly Vector3[] Casualties =
        {
            new Vector3(-15, 0.5f, 17.5f), new Vector3(30, 0.5f, -7), new Vector3(13, 0.5f, -15),
        };

        /// <summary>Number of robots. The base is an additional node.</summary>
        [Min(1)]
        public int robots = 120;

        /// <summary>Radio range of the robots in metres.</summary>
        [Min(0)]
        public float range = 10;

        /// <summary>Simulated seconds after which some robots fail.</summary>
        [Min(0)]
        public float failAfter = 60;

        /// <summary>Share of the robots that fail.</summary>
        [Range(0, 1)]
        public float failing = 0.1f;

        private readonly List<Node> chosen = new List<Node>();
        private readonly List<LinkRecord> links = new List<LinkRecord>();
        private readonly HashSet<int> reached = new HashSet<int>();
        private readonly HashSet<(int, int)> visited = new HashSet<(int, int)>();
        private SimulationManager manager;
        private PhysicsMaterial slippery;
        private Node station;

        /// <inheritdoc/>
        public override IReadOnlyList<string> MetricNames => Names;

        /// <inheritdoc/>
        public override IReadOnlyList<NodeColouring> Colourings => new[]
        {
            new NodeColouring("role", node => node.TryGetAnswer(out ActuatorData answer) ? answer.Role : double.NaN)
            {
                IsCategory = true, Categories = RoleColour.Names,
            },
            new NodeColouring("distance to the base", node => node.TryGetAnswer(out ActuatorData answer) && answer.Distance >= 0 ? answer.Distance : double.NaN)
            {
                Unit = "m",
            },
        };

        /// <inheritdoc/>
        public override IReadOnlyList<KeyValuePair<string, Vector3>> Landmarks
        {
            get
            {
                var marks = new List<KeyValuePair<string, Vector3>> { new KeyValuePair<string, Vector3>("base", BasePlace) };
                for (var i = 0; i < Casualties.Length; i++) marks.Add(new KeyValuePair<string, Vector3>("casualty " + (i + 1), Casualties[i]));
                return marks;
            }
        }

        /// <summary>
        /// Writes five values: the number of casualties that have a robot with them, the number of casualties that are connected to the base, the number of
        /// robots in channels, the number of robots, and the share of the ground that has been explored.
        /// </summary>
        public override void Measure(double[] values)
        {
            values[0] = values[1] = values[2] = 0;
            FindReached();
            Explore(manager);
            var found = new bool[Casualties.Length];
            var connected = new bool[Casualties.Length];
            foreach (var node in manager.Nodes)
            {
                var place = node.transform.position;
                var role = RoleOf(node);
                if (role == 1) values[2]++;
                if (role != 2) continue;
                var casualty = NearestCasualty(place);
                found[casualty] = true;
                connected[casualty] |= reached.Contains(node.Id);
            }
            for (var i = 0; i < Casualties.Length; i++)
            {
                if (found[i]) values[0]++;
                if (connected[i]) values[1]++;
            }
            values[3] = manager.Nodes.Count - 1;
            values[4] = visited.Count / 1000.0; // 80 x 50 m in cells of 2 x 2 m
        }

        /// <inheritdoc/>
        protected override void Build(SimulationManager manager)
        {
            if (robots < 1 || robots > 300 || !(range >= 0) || !(failing >= 0 && failing <= 1))
            {
                manager.Fail("the scene has " + robots + " robots with a range of " + range + " m, of which a share of " + failing
                    + " fails: use 1 to 300 robots, a range of 0 or greater, and a share from 0 to 1");
                return;
            }
            this.manager = manager;
            slippery = new PhysicsMaterial { dynamicFriction = 0, staticFriction = 0, bounciness = 0, frictionCombine = PhysicsMaterialCombine.Minimum };
            Ruins.Build(manager.Random);
            station = MakeRobot(BasePlace, true);
            for (var i = 0; i < robots; i++)
            {
                // The robots start in rows beside the base, with small random offsets.
                var place = new Vector3(-35 + Spacing * (i / PerRow) * 0.8f, 0.5f, Spacing * (i % PerRow - (PerRow - 1) / 2f));
                MakeRobot(place + new Vector3(manager.Random.Range(-0.2f, 0.2f), 0, manager.Random.Range(-0.2f, 0.2f)), false);
            }
        }

        // Build does not add the handler, because Unity removes handlers when it compiles scripts during Play, and then calls only OnEnable.
        private void OnEnable()
        {
            manager = SimulationManager.Current;
            if (manager == null) return;
            manager.Ticked += Explore;
            manager.Ticked += FailWhenDue;
        }

        private void OnDisable()
        {
            if (manager == null) return;
            manager.Ticked -= Explore;
            manager.Ticked -= FailWhenDue;
        }

        /// <summary>Marks the cells of the ground that contain robots. Called after each tick, because rows of the metrics may be many ticks apart.</summary>
        private void Explore(SimulationManager manager)
        {
            foreach (var node in manager.Nodes)
            {
                var place = node.transform.position;
                visited.Add((Mathf.FloorToInt(place.x / 2), Mathf.FloorToInt((place.z + 25) / 2)));
            }
        }

        private void FailWhenDue(SimulationManager manager)
        {
            if (manager.SimulatedTime < failAfter) return;
            manager.Ticked -= FailWhenDue;
            chosen.Clear();
            foreach (var node in manager.Nodes)
                if (node != station) chosen.Add(node);
            for (var remaining = Mathf.RoundToInt(failing * chosen.Count); remaining > 0; remaining--)
            {
                var index = manager.Random.Range(0, chosen.Count);
                chosen[index].gameObject.SetActive(false);
                chosen.RemoveAt(index);
            }
        }

        /// <summary>Finds the robots that a chain of channel robots connects to the base.</summary>
        private void FindReached()
        {
            reached.Clear();
            reached.Add(station.Id);
            manager.CopyLinks(links);
            for (var before = 0; before < reached.Count;)
            {
                before = reached.Count;
                foreach (var link in links)
                    if (reached.Contains(link.From) && RoleOf(manager.Find(link.To)) > 0) reached.Add(link.To);
            }
        }

        private static int RoleOf(Node node) => node.TryGetAnswer(out ActuatorData answer) ? answer.Role : 0;

        private static int NearestCasualty(Vector3 place)
        {
            var nearest = 0;
            for (var i = 1; i < Casualties.Length; i++)
                if (Vector3.Distance(place, Casualties[i]) < Vector3.Distance(place, Casualties[nearest])) nearest = i;
            return nearest;
        }

        private Node MakeRobot(Vector3 place, bool isBase)
        {
            var robot = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            robot.SetActive(false);
            robot.name = isBase ? "Base" : "Robot";
            // On this layer, the bodies of other robots do not block radio.
            robot.layer = Ruins.GroundLayer;
            robot.transform.position = place;
            robot.transform.localScale = 2 * BodyRadius * Vector3.one;
            robot.GetComponent<Collider>().sharedMaterial = slippery;
            robot.AddComponent<Rigidbody>().constraints = RigidbodyConstraints.FreezeRotation;
            var node = robot.AddComponent<Node>();
            var radio = robot.AddComponent<LineOfSightNeighbourhood>();
            radio.Radius = range;
            radio.Blocking = false;
            robot.AddComponent<PositionSensor>();
            robot.AddComponent<BarrierSensor>().Reach = 1.5f;
            var sensor = robot.AddComponent<CasualtySensor>();
            sensor.Casualties = Casualties;
            sensor.IsBase = isBase;
            robot.AddComponent<DriveActuator>().KeepVertical = true;
            robot.AddComponent<RoleColour>();
            robot.SetActive(true);
            return node;
        }
    }
}
