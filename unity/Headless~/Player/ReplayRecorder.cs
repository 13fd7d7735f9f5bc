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
        private readonly List<KeyValuePair<Transform, ReplayMover>> movers = new List<KeyValuePair<Transform, ReplayMover>>();
        // Components that colour nodes, by node id; null if no node has one.
        private readonly Dictionary<int, IColours> colours;
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
            if (IsColoured(manager)) colours = new Dictionary<int, IColours>();
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
                var place = mover.Key.position;
                var rotation = mover.Key.rotation;
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
            foreach (var root in SceneManager.GetActiveScene().GetRootGameObjects()) colliders.AddRange(root.GetComponentsInChildren<Collider>());
            var floor = FindFloor(colliders);
            var first = manager.Nodes.Count == 0 ? Vector3.zero : manager.Nodes[0].transform.position;
            var arena = floor == null ? new Bounds(first, Vector3.zero) : new Bounds(Top(floor), new Vector3(floor.bounds.size.x, 0, floor.bounds.size.z));
            foreach (var collider in colliders)
            {
                if (collider == floor || collider.isTrigger) continue;
                if (arena.size == Vector3.zero) arena = collider.bounds;
                else arena.Encapsulate(collider.bounds);
                if (collider.GetComponentInParent<Node>() != null)
                {
                    if (collider is SphereCollider body) metadata.NodeRadius = body.radius * body.transform.lossyScale.x;
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
            var kind = colouring.IsCategory ? ReplayFieldKind.Category : ReplayFieldKind.Number;
            fields.Add(new ReplayField(colouring.Name, kind) { Unit = colouring.Unit, Categories = colouring.Categories });
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
            if (!colours.TryGetValue(node.Id, out var part)) colours.Add(node.Id, part = node.GetComponentInChildren<IColours>());
            if (part == null || part.Target == null) return double.NaN;
            part.Target.GetPropertyBlock(block);
            if (block.isEmpty) return double.NaN;
            var colour = block.GetColor("_Color");
            return Byte(colour.r) << 16 | Byte(colour.g) << 8 | Byte(colour.b);
        }

        private static int Byte(float share) => (int)(255 * Mathf.Clamp01(share) + 0.5f);

        /// <summary>Returns the static box with the largest top, if all nodes are above it, or null. The page draws its own floor instead.</summary>
        private Collider FindFloor(List<Collider> colliders)
        {
            Collider floor = null;
            foreach (var collider in colliders)
            {
                if (!(collider is BoxCollider) || collider.attachedRigidbody != null || collider.isTrigger) continue;
                if (floor == null || Footprint(collider) > Footprint(floor)) floor = collider;
            }
            if (floor == null) return null;
            foreach (var node in manager.Nodes)
            {
                if (node.transform.position.y < Top(floor).y) return null;
            }
            return floor;
        }

        private static float Footprint(Collider collider) => collider.bounds.size.x * collider.bounds.size.z;

        private static Vector3 Top(Collider collider)
        {
            var bounds = collider.bounds;
            return new Vector3(bounds.center.x, bounds.max.y, bounds.center.z);
        }

        private void AddMover(ReplayMetadata metadata, Collider collider)
        {
            if (movers.Count == MaxMovers) return;
            var scale = collider.transform.lossyScale;
            ReplayMover mover = null;
            if (collider is BoxCollider box)
            {
                var size = Vector3.Scale(box.size, scale);
                mover = metadata.AddMovingBox(size.x, size.y, size.z);
            }
            if (collider is SphereCollider sphere) mover = metadata.AddMovingSphere(sphere.radius * scale.x);
            if (collider is CapsuleCollider capsule) mover = metadata.AddMovingCapsule(Radius(capsule), Height(capsule), capsule.direction);
            if (mover != null) movers.Add(new KeyValuePair<Transform, ReplayMover>(collider.transform, mover));
        }

        private static void Add(ReplayMetadata metadata, MeshCollider collider)
        {
            var corners = collider.sharedMesh.vertices;
            for (var i = 0; i < corners.Length; i++) corners[i] = Vector3.Scale(corners[i], collider.transform.lossyScale);
            Add(metadata, corners, collider.sharedMesh.triangles, collider.transform.position, collider.transform.rotation);
        }

        /// <summary>Adds a terrain. Uses only a part of its samples, so that the page stays small.</summary>
        private static void Add(ReplayMetadata metadata, TerrainCollider collider)
        {
            var data = collider.terrainData;
            var step = Math.Max(1, (data.heightmapResolution - 1) / MaxTerrainSquares);
            var triangles = TerrainMesh.Triangles((data.heightmapResolution - 1) / step + 1);
            Add(metadata, TerrainMesh.Points(data, step), triangles, collider.transform.position, Quaternion.identity);
        }

        private static void Add(ReplayMetadata metadata, Vector3[] corners, int[] triangles, Vector3 place, Quaternion turn)
        {
            var vertices = new float[3 * corners.Length];
            for (var i = 0; i < corners.Length; i++)
            {
                for (var axis = 0; axis < 3; axis++) vertices[3 * i + axis] = corners[i][axis];
            }
            metadata.AddMesh(vertices, triangles, place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w);
        }

        private static void Add(ReplayMetadata metadata, BoxCollider box)
        {
            var centre = box.transform.TransformPoint(box.center);
            var size = Vector3.Scale(box.size, box.transform.lossyScale);
            var turn = box.transform.rotation;
            metadata.AddBox(centre.x, centre.y, centre.z, size.x, size.y, size.z, turn.x, turn.y, turn.z, turn.w);
        }

        private static void Add(ReplayMetadata metadata, CapsuleCollider capsule)
        {
            var centre = capsule.transform.TransformPoint(capsule.center);
            var turn = capsule.transform.rotation;
            metadata.AddCapsule(centre.x, centre.y, centre.z, Radius(capsule), Height(capsule), capsule.direction, turn.x, turn.y, turn.z, turn.w);
        }

        private static float Radius(CapsuleCollider capsule)
        {
            var scale = capsule.transform.lossyScale;
            return capsule.radius * Mathf.Max(scale[(capsule.direction + 1) % 3], scale[(capsule.direction + 2) % 3]);
        }

        private static float Height(CapsuleCollider capsule) => capsule.height * capsule.transform.lossyScale[capsule.direction];

        private static void Add(ReplayMetadata metadata, SphereCollider sphere)
        {
            var centre = sphere.transform.TransformPoint(sphere.center);
            metadata.AddSphere(centre.x, centre.y, centre.z, sphere.radius * sphere.transform.lossyScale.x);
        }
    }
}
