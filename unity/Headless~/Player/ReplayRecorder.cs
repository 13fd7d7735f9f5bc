using System;
using System.Collections.Generic;
using System.Diagnostics;
using Collektive.Unity;
using Newtonsoft.Json.Linq;
using UnityEngine;
using UnityEngine.Headless;
using UnityEngine.SceneManagement;

namespace Collektive.Headless
{
    /// <summary>Records the nodes, links and shapes of a scene for the replay page and the live page.</summary>
    internal sealed class ReplayRecorder : IDisposable
    {
        /// <summary>Maximum number of frames per simulated second. Other ticks are not recorded.</summary>
        private const double MaxFrames = 10;

        /// <summary>Maximum number of nodes in the frames of a simulated second. Therefore, large swarms have fewer frames.</summary>
        private const double MaxNodes = 50000;

        /// <summary>Maximum number of moving shapes. It is limited, because all their poses are in the header of the page.</summary>
        private const int MaxMovers = 64;

        /// <summary>Maximum number of squares along each side of a terrain.</summary>
        private const int MaxTerrainSquares = 64;

        private readonly ReplayWriter writer;
        private readonly SceneBuilder scene;
        private readonly SimulationManager manager;
        // Functions that return a node's values, one for each field of the replay.
        private readonly List<Func<Node, double>> readers = new List<Func<Node, double>>();
        private readonly ReplayMetrics metrics;
        private readonly List<KeyValuePair<Collider, ReplayMover>> movers = new List<KeyValuePair<Collider, ReplayMover>>();
        // Components that colour nodes, by node id; null if no node has one. Another node may have the id of one that left.
        private readonly Dictionary<int, (Node Node, IColours Part)> colours;
        // Number of neighbours by node id; null unless it is a field of the replay.
        private int[] neighbours;
        private readonly MaterialPropertyBlock block = new MaterialPropertyBlock();
        private readonly Stopwatch clock = new Stopwatch();
        private double last = double.NegativeInfinity;

        /// <param name="open">Opens the writer.</param>
        internal ReplayRecorder(
            Scenario scenario, SceneBuilder scene, RunMetrics runMetrics, SimulationManager manager, Func<ReplayMetadata, ReplayWriter> open)
        {
            this.scene = scene;
            this.manager = manager;
            if (IsColoured(manager)) colours = new Dictionary<int, (Node, IColours)>();
            metrics = new ReplayMetrics(MetricsTable.NamesOf(runMetrics));
            var metadata = new ReplayMetadata
            {
                Title = scenario.Settings.program,
                Seed = scenario.Settings.seed,
                DeltaTime = scenario.Settings.deltaTime,
                Fields = Fields(),
                Metrics = metrics,
            };
            Describe(metadata);
            writer = open(metadata);
        }

        /// <summary>Milliseconds spent on the replay so far.</summary>
        internal double Milliseconds => clock.Elapsed.TotalMilliseconds;

        public void Dispose() => writer.Dispose();

        /// <summary>Adds a row of the metrics.</summary>
        /// <param name="time">Simulated seconds.</param>
        /// <param name="values">Values in the order of <see cref="MetricsTable.NamesOf"/>.</param>
        internal void Measure(double time, IReadOnlyList<double> values) => metrics.Add(time, values);

        /// <summary>Records a frame if one is due. Call this method between ticks.</summary>
        /// <param name="time">Simulated seconds.</param>
        internal void Add(double time)
        {
            if (time >= last + Math.Max(1 / MaxFrames, manager.Nodes.Count / MaxNodes) - 1e-6) Record(time);
        }

        /// <summary>Records a frame of the current time, unless the last frame has the same time.</summary>
        internal void AddNow()
        {
            if (manager.SimulatedTime > last) Record(manager.SimulatedTime);
        }

        /// <summary>Records the last frame, and writes the page.</summary>
        internal void Finish(string template, string path)
        {
            AddNow();
            clock.Start();
            writer.Finish(template, path);
            clock.Stop();
        }

        /// <summary>Returns the poses of each moving shape since the last call.</summary>
        internal JArray TakePoses() => new JArray(movers.ConvertAll(mover => (object)mover.Value.TakePoses()));

        /// <summary>Records a frame. Only a live page accepts the time of the last frame again, and replaces that frame.</summary>
        internal void Record(double time)
        {
            clock.Start();
            last = time;
            if (neighbours != null) CountNeighbours();
            writer.BeginFrame(time, manager.Simulation.PresentLinks.Count);
            var nodes = manager.Nodes;
            // If many nodes have left, releases the memory of their entries.
            if (colours?.Count > 2 * nodes.Count) colours.Clear();
            for (var i = 0; i < nodes.Count; i++)
            {
                var node = nodes[i];
                var position = node.transform.position;
                writer.Node(node.Id, position.x, position.y, position.z, readers[0](node));
                for (var field = 1; field < readers.Count; field++) writer.Value(field, readers[field](node));
            }
            foreach (var mover in movers)
            {
                var collider = mover.Key;
                if (!collider || !collider.enabled || !collider.gameObject.activeInHierarchy)
                {
                    mover.Value.AddMissing();
                    continue;
                }
                var place = Centre(collider);
                var rotation = collider.transform.rotation;
                mover.Value.Add(place.x, place.y, place.z, rotation.x, rotation.y, rotation.z, rotation.w);
            }
            foreach (ref var pair in manager.Simulation.PresentLinks.Pairs)
            {
                if (pair.Up.References > 0) writer.Link(pair.Low, pair.High, pair.Down.References > 0);
                else if (pair.Down.References > 0) writer.Link(pair.High, pair.Low);
            }
            writer.EndFrame();
            clock.Stop();
        }

        private void CountNeighbours()
        {
            neighbours = new int[manager.Simulation.IdCapacity];
            foreach (ref var pair in manager.Simulation.PresentLinks.Pairs)
            {
                if (!pair.IsReferenced) continue;
                neighbours[pair.Low]++;
                neighbours[pair.High]++;
            }
        }

        private void Describe(ReplayMetadata metadata)
        {
            Physics.SyncTransforms();
            var colliders = new List<Collider>();
            foreach (var root in SceneManager.GetActiveScene().GetRootGameObjects())
                if (root.activeInHierarchy) colliders.AddRange(root.GetComponentsInChildren<Collider>());
            var floor = FindFloor(colliders);
            var first = manager.Nodes.Count == 0 ? Vector3.zero : manager.Nodes[0].transform.position;
            var arena = floor == null ? new Bounds(first, Vector3.zero) : new Bounds(Top(floor), new Vector3(floor.bounds.size.x, 0, floor.bounds.size.z));
            foreach (var collider in colliders)
            {
                if (collider == floor || collider.isTrigger || !collider.enabled) continue;
                if (arena.size == Vector3.zero) arena = collider.bounds;
                else arena.Encapsulate(collider.bounds);
                if (collider.GetComponentInParent<Node>() != null)
                {
                    if (collider is SphereCollider body) metadata.NodeRadius = Radius(body);
                    if (collider is CapsuleCollider upright)
                    {
                        metadata.NodeRadius = Radius(upright);
                        // The page does not store rotations of nodes.
                        metadata.NodeHeight = upright.direction == 1 ? Height(upright) : 0;
                    }
                    continue;
                }
                if (collider.attachedRigidbody != null) AddMover(metadata, collider);
                else if (collider is BoxCollider box) Add(metadata, box);
                else if (collider is SphereCollider sphere) Add(metadata, sphere);
                else if (collider is CapsuleCollider capsule) Add(metadata, capsule);
                else if (collider is MeshCollider mesh && mesh.sharedMesh != null) Add(metadata, mesh);
                else if (collider is TerrainCollider terrain && terrain.terrainData != null) Add(metadata, terrain);
            }
            if (floor == null) foreach (var node in manager.Nodes) arena.Encapsulate(node.transform.position);
            // The page needs an arena of nonzero width and depth, even if coordinates far from the origin are rounded.
            var rounding = 1e-6f * Mathf.Max(Mathf.Abs(arena.center.x), Mathf.Abs(arena.center.z));
            var room = Mathf.Max(1, rounding);
            arena.Expand(new Vector3(arena.size.x > rounding ? 0 : room, 0, arena.size.z > rounding ? 0 : room));
            metadata.SetArena(arena.min.x, arena.min.y, arena.min.z, arena.max.x, arena.max.y, arena.max.z, grows: floor == null);
            foreach (var landmark in scene.Landmarks)
            {
                metadata.AddMarker(landmark.Key, landmark.Value.x, landmark.Value.y, landmark.Value.z);
            }
        }

        /// <summary>Returns the scene's colourings, then its colours. Without colourings, returns its colours, then fields of the answers.</summary>
        private List<ReplayField> Fields()
        {
            var fields = new List<ReplayField>();
            foreach (var colouring in scene.Colourings) Add(fields, colouring);
            var hasColourings = fields.Count > 0;
            if (colours != null) AddColours(fields);
            if (!hasColourings) foreach (var colouring in AnswerColourings.Of(manager)) Add(fields, colouring);
            if (fields.Count == 0)
            {
                neighbours = Array.Empty<int>();
                Add(fields, new NodeColouring("neighbours", node => neighbours[node.Id]));
            }
            return fields;
        }

        private void Add(List<ReplayField> fields, NodeColouring colouring)
        {
            // The page would show the first one for both.
            if (fields.Exists(field => field.Name == colouring.Name))
                throw new ScenarioException("two colourings are named '" + colouring.Name + "': rename one of the scene's Colourings");
            var kind = colouring.IsCategory ? ReplayFieldKind.Category : ReplayFieldKind.Number;
            fields.Add(new ReplayField(colouring.Name, kind) { Unit = colouring.Unit, Categories = colouring.Categories ?? Array.Empty<string>() });
            // Values that the page cannot store count as missing, such as an infinite distance, or Int.MAX_VALUE without a leader.
            double limit = colouring.IsCategory ? ReplayField.MaxInteger - 1 : float.MaxValue;
            readers.Add(node => colouring.Read(node) is var value && Math.Abs(value) <= limit ? value : double.NaN);
        }

        private void AddColours(List<ReplayField> fields)
        {
            fields.Add(new ReplayField("colour in the scene", ReplayFieldKind.Colour));
            readers.Add(ColourOf);
        }

        private static bool IsColoured(SimulationManager manager)
        {
            foreach (var node in manager.Nodes)
                if (node.GetComponentInChildren<IColours>() != null) return true;
            return false;
        }

        private double ColourOf(Node node)
        {
            if (!colours.TryGetValue(node.Id, out var known) || !ReferenceEquals(known.Node, node))
                colours[node.Id] = known = (node, Node.FindFirst<IColours>(node.gameObject, node));
            var part = known.Part;
            if (part == null || part.Target == null) return double.NaN;
            part.Target.GetPropertyBlock(block);
            if (block.isEmpty) return double.NaN;
            var colour = block.GetColor("_Color");
            if (float.IsNaN(colour.r + colour.g + colour.b)) return double.NaN;
            return Byte(colour.r) << 16 | Byte(colour.g) << 8 | Byte(colour.b);
        }

        private static int Byte(float share) => (int)(255 * Mathf.Clamp01(share) + 0.5f);

        /// <summary>
        /// Returns the static box or plane with the largest top if it is level and all nodes are above it, or null. The page draws its own floor instead.
        /// </summary>
        private Collider FindFloor(List<Collider> colliders)
        {
            Collider floor = null;
            foreach (var collider in colliders)
            {
                if (!(collider is BoxCollider || IsPlane(collider)) || collider.attachedRigidbody != null || collider.isTrigger || !collider.enabled) continue;
                if (floor == null || Footprint(collider) > Footprint(floor)) floor = collider;
            }
            if (floor == null || floor is BoxCollider && floor.transform.up.y < 0.9999f) return null;
            var bounds = floor.bounds;
            foreach (var node in manager.Nodes)
            {
                var place = node.transform.position;
                if (place.y < bounds.max.y) return null;
                // For example, the largest of several houses below drones is not the floor.
                if (!bounds.Contains(new Vector3(place.x, bounds.center.y, place.z))) return null;
            }
            return floor;
        }

        private static bool IsPlane(Collider collider) => collider is MeshCollider && collider.bounds.size is var size && size.x > 0 && size.y < 0.001f;

        private static float Footprint(Collider collider) => collider.bounds.size.x * collider.bounds.size.z;

        private static Vector3 Top(Collider collider)
        {
            var bounds = collider.bounds;
            return new Vector3(bounds.center.x, bounds.max.y, bounds.center.z);
        }

        private void AddMover(ReplayMetadata metadata, Collider collider)
        {
            if (movers.Count == MaxMovers) return;
            ReplayMover mover = null;
            if (collider is BoxCollider box)
            {
                var size = Size(box);
                mover = metadata.AddMovingBox(size.x, size.y, size.z);
            }
            if (collider is SphereCollider sphere) mover = metadata.AddMovingSphere(Radius(sphere));
            if (collider is CapsuleCollider capsule) mover = metadata.AddMovingCapsule(Radius(capsule), Height(capsule), capsule.direction);
            if (collider is MeshCollider mesh && mesh.sharedMesh != null) mover = metadata.AddMovingMesh(Vertices(mesh), mesh.sharedMesh.triangles);
            if (mover != null) movers.Add(new KeyValuePair<Collider, ReplayMover>(collider, mover));
        }

        private static void Add(ReplayMetadata metadata, MeshCollider collider)
        {
            var place = collider.transform.position;
            var turn = collider.transform.rotation;
            metadata.AddMesh(Vertices(collider), collider.sharedMesh.triangles, place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w);
        }

        /// <summary>Adds a terrain. Uses only a part of its samples, so that the page stays small.</summary>
        private static void Add(ReplayMetadata metadata, TerrainCollider collider)
        {
            var data = collider.terrainData;
            var step = Math.Max(1, (data.heightmapResolution - 1) / MaxTerrainSquares);
            var triangles = TerrainMesh.Triangles((data.heightmapResolution - 1) / step + 1);
            var place = collider.transform.position;
            metadata.AddMesh(Coordinates(TerrainMesh.Points(data, step)), triangles, place.x, place.y, place.z, 0, 0, 0, 1);
        }

        private static float[] Vertices(MeshCollider collider)
        {
            var corners = collider.sharedMesh.vertices;
            for (var i = 0; i < corners.Length; i++) corners[i] = Vector3.Scale(corners[i], collider.transform.lossyScale);
            return Coordinates(corners);
        }

        private static float[] Coordinates(Vector3[] points)
        {
            var coordinates = new float[3 * points.Length];
            for (var i = 0; i < points.Length; i++)
            {
                for (var axis = 0; axis < 3; axis++) coordinates[3 * i + axis] = points[i][axis];
            }
            return coordinates;
        }

        private static void Add(ReplayMetadata metadata, BoxCollider box)
        {
            var centre = Centre(box);
            var size = Size(box);
            var turn = box.transform.rotation;
            metadata.AddBox(centre.x, centre.y, centre.z, size.x, size.y, size.z, turn.x, turn.y, turn.z, turn.w);
        }

        private static void Add(ReplayMetadata metadata, CapsuleCollider capsule)
        {
            var centre = Centre(capsule);
            var turn = capsule.transform.rotation;
            metadata.AddCapsule(centre.x, centre.y, centre.z, Radius(capsule), Height(capsule), capsule.direction, turn.x, turn.y, turn.z, turn.w);
        }

        private static void Add(ReplayMetadata metadata, SphereCollider sphere)
        {
            var centre = Centre(sphere);
            metadata.AddSphere(centre.x, centre.y, centre.z, Radius(sphere));
        }

        // Sizes follow Unity's rules for scaled colliders.
        private static Vector3 Scale(Collider collider)
        {
            var scale = collider.transform.lossyScale;
            return new Vector3(Mathf.Abs(scale.x), Mathf.Abs(scale.y), Mathf.Abs(scale.z));
        }

        private static Vector3 Size(BoxCollider box) => Vector3.Scale(box.size, Scale(box));

        private static float Radius(SphereCollider sphere)
        {
            var scale = Scale(sphere);
            return sphere.radius * Mathf.Max(scale.x, Mathf.Max(scale.y, scale.z));
        }

        private static float Radius(CapsuleCollider capsule)
        {
            var scale = Scale(capsule);
            return capsule.radius * Mathf.Max(scale[(capsule.direction + 1) % 3], scale[(capsule.direction + 2) % 3]);
        }

        private static float Height(CapsuleCollider capsule) => capsule.height * Scale(capsule)[capsule.direction];

        /// <summary>Returns the centre of a shape, which need not be the position of its object.</summary>
        private static Vector3 Centre(Collider collider)
        {
            var offset = collider is BoxCollider box ? box.center
                : collider is SphereCollider sphere ? sphere.center
                : collider is CapsuleCollider capsule ? capsule.center : Vector3.zero;
            return collider.transform.TransformPoint(offset);
        }
    }
}
