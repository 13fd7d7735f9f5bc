using System;
using System.Collections.Generic;
using System.Globalization;
using Collektive.Headless;
using Collektive.Unity;
using standard;
using UnityEngine;

namespace Collektive.Standard
{
    /// <summary>A scene for studies without C#. Its fields, which a scenario sets, describe the nodes, obstacles, links and movement.</summary>
    public sealed class StandardScene : SceneBuilder
    {
        private const int IgnoreRaycastLayer = 2;
        private const int MaxNodes = 1_000_000;
        private const int MaxSets = 32;
        internal const float WallWidth = 0.1f;

        /// <summary>The part of an obstacle below the ground, as a share of its height. Otherwise, lines of sight along the ground could miss it.</summary>
        private const float Foundation = 0.01f;

        /// <summary>Time limit for the evaluation of an expression when the scene is checked before the run.</summary>
        private const int CheckMs = 1000;

        private static readonly double[] AtStart = { 0 };

        public Deployment deployment = new Deployment();
        public Neighbourhood neighbourhood = new Neighbourhood();
        public List<NodeSet> sets = new List<NodeSet>();
        public List<Obstacle> obstacles = new List<Obstacle>();
        public Movement movement = new Movement();
        public Churn churn = new Churn();
        public Reading reading = new Reading();

        private readonly Dictionary<int, uint> members = new Dictionary<int, uint>();
        private readonly List<Node> failing = new List<Node>();
        private readonly List<Node> found = new List<Node>();
        private readonly Dictionary<int, Track> tracks = new Dictionary<int, Track>();
        private readonly List<Vector3> places = new List<Vector3>();
        private ValueSeries series;
        private PlaceExpression expression;
        private SimulationManager manager;
        private Area area;
        private uint active;
        private uint source;
        private double nextArrival;

        /// <inheritdoc/>
        public override IReadOnlyList<NodeColouring> Colourings => new[]
        {
            new NodeColouring("value", node => node.TryGetAnswer(out ActuatorData answer) ? answer.Value : double.NaN),
            new NodeColouring("category", node => node.TryGetAnswer(out ActuatorData answer) ? answer.Category : double.NaN) { IsCategory = true },
            new NodeColouring("flag", node => node.TryGetAnswer(out ActuatorData answer) ? answer.Flag ? 1 : 0 : double.NaN)
            {
                IsCategory = true, Categories = new[] { "false", "true" },
            },
        };

        /// <inheritdoc/>
        public override string FindProblem() =>
            ProblemOf(deployment) ?? ProblemOfFiles() ?? ProblemOf(neighbourhood) ?? ProblemOf(movement) ?? ProblemOfSets() ?? ProblemOfObstacles()
                ?? ProblemIfBelow("churn.failures", churn.failures, 0) ?? ProblemIfBelow("churn.arrivals", churn.arrivals, 0);

        internal uint SetsOf(int id) => members.TryGetValue(id, out var bits) ? bits & active : 0;

        internal bool IsSource(uint bits) => (bits & source) != 0;

        /// <summary>Returns the value of the expression or file for a node at the current time; 0 without a value.</summary>
        internal double ReadingOf(Node node)
        {
            var place = node.Position;
            var value = series?.ValueAt(node.Id, Now)
                ?? expression?.Evaluate(node.Id, manager.SimulatedTime, place.x, place.y, place.z) ?? double.NaN;
            return double.IsNaN(value) ? 0 : value;
        }

        /// <inheritdoc/>
        protected override void Build(SimulationManager manager)
        {
            this.manager = manager;
            area = new Area(deployment, obstacles, places);
            if (reading.expression.Length > 0) expression = new PlaceExpression(reading.expression, manager.Settings.stepLimitMs);
            foreach (var obstacle in obstacles) MakeObstacle(obstacle);
            Deploy();
            if (manager.Failure.Length > 0) return;
            FillSets();
            UpdateSets();
            if (churn.arrivals > 0) nextArrival = Pause(churn.arrivals);
            manager.Ticked += Advance;
        }

        private void OnDestroy() => expression?.Dispose();

        private static string ProblemIfBelow(string field, float value, float least) =>
            value >= least && Area.IsFinite(value) ? null : "'" + field + "' is " + Text(value) + "; it must be at least " + Text(least);

        private static string ProblemIfNotPositive(string field, float value) =>
            value > 0 && Area.IsFinite(value) ? null : "'" + field + "' is " + Text(value) + "; it must be a number greater than 0";

        private static string Text(float value) => value.ToString(CultureInfo.InvariantCulture);

        private static string Text(double value) => value.ToString(CultureInfo.InvariantCulture);

        private static string ProblemOf(Deployment deployment)
        {
            if (deployment.nodes < 1 || deployment.nodes > MaxNodes)
                return "'deployment.nodes' is " + deployment.nodes + "; it must be from 1 to " + MaxNodes;
            if (deployment.columns < 0) return "'deployment.columns' is " + deployment.columns + "; it must be at least 0";
            if (!Area.IsSize(deployment.size)) return "'deployment.size' must be two numbers greater than 0: the lengths along x and z in metres";
            return ProblemIfNotPositive("deployment.spacing", deployment.spacing) ?? ProblemIfBelow("deployment.disorder", deployment.disorder, 0)
                ?? ProblemIfNotPositive("deployment.radius", deployment.radius) ?? ProblemOf("deployment.polygon", deployment.polygon);
        }

        private static string ProblemOf(string field, List<float[]> polygon)
        {
            if (polygon.Count == 1 || polygon.Count == 2) return "'" + field + "' has " + polygon.Count + " corners; it needs at least 3";
            return polygon.TrueForAll(Area.IsPoint) ? null : "'" + field + "' must be a list of [x, z]";
        }

        private static string ProblemOf(Neighbourhood neighbourhood) =>
            neighbourhood.count < 1 ? "'neighbourhood.count' is " + neighbourhood.count + "; it must be at least 1"
                : ProblemIfBelow("neighbourhood.radius", neighbourhood.radius, 0)
                    ?? ProblemIfBelow("neighbourhood.lengthTolerance", neighbourhood.lengthTolerance, 0);

        private static string ProblemOf(Movement movement) =>
            !(movement.exponent > 1) ? "'movement.exponent' is " + Text(movement.exponent) + "; it must be greater than 1"
                : ProblemIfNotPositive("movement.speed", movement.speed) ?? ProblemIfBelow("movement.pause", movement.pause, 0)
                    ?? ProblemIfNotPositive("movement.shortest", movement.shortest) ?? ProblemIfNotPositive("movement.bodyRadius", movement.bodyRadius);

        private string ProblemOfFiles()
        {
            var field = "deployment.file";
            try
            {
                if (deployment.kind == DeploymentKind.File) ReadTracks();
                else if (movement.kind == MovementKind.Trace) return "'movement.kind' is Trace, which needs a 'deployment' of kind File";
                field = "reading.expression";
                if (reading.expression.Length > 0)
                {
                    if (reading.file.Length > 0) return "'reading' needs either 'expression' or 'file'";
                    new PlaceExpression(reading.expression, CheckMs).Dispose();
                }
                field = "reading.file";
                if (reading.file.Length > 0) series = new ValueSeries(DataFile.Find(reading.file));
                return null;
            }
            catch (ScenarioException error)
            {
                return "'" + field + "': " + error.Message;
            }
        }

        private void ReadTracks()
        {
            foreach (var track in Track.Read(DataFile.Find(deployment.file), movement.kind == MovementKind.Trace))
            {
                tracks.Add(track.Id, track);
                // The nodes visit all points of a trace, and stand still at its place at second 0 otherwise.
                foreach (var time in movement.kind == MovementKind.Trace ? track.Times : AtStart)
                {
                    track.PlaceAt(time, out var x, out var z);
                    places.Add(new Vector3(x, 0, z));
                }
            }
        }

        private string ProblemOfSets()
        {
            if (sets.Count > MaxSets) return "'sets' has " + sets.Count + " sets; the maximum is " + MaxSets;
            for (var i = 0; i < sets.Count; i++)
            {
                var set = sets[i];
                var field = "sets[" + i + "]";
                if (set.name.Length == 0) return "'" + field + ".name' is missing";
                if (sets.FindIndex(other => other.name == set.name) < i)
                    return "'" + field + ".name' is '" + set.name + "', which is also the name of another set";
                if (set.near.Length > 0 && !Area.IsPoint(set.near)) return "'" + field + ".near' must be [x, z]";
                if (set.near.Length == 0 && set.ids.Length == 0) return "'" + field + "' needs 'ids' or 'near'";
                if (set.count < 1 || set.count > Count)
                    return "'" + field + ".count' is " + set.count + "; it must be from 1 to the number of nodes, " + Count;
                foreach (var id in set.ids)
                {
                    if (tracks.Count > 0 && !tracks.ContainsKey(id)) return "'" + field + ".ids' contains node " + id + ", which is not in " + deployment.file;
                    if (tracks.Count == 0 && (id < 0 || id >= deployment.nodes))
                        return "'" + field + ".ids' contains node " + id + ", but the ids of the deployment are 0 to " + (deployment.nodes - 1);
                }
                if (!(set.from <= set.until)) return "'" + field + ".from' is " + Text(set.from) + "; it must be at most 'until', " + Text(set.until);
            }
            return null;
        }

        /// <summary>Simulated time plus a thousandth of a tick, because three ticks of 0.3333333 are a second.</summary>
        private double Now => manager.SimulatedTime + 1e-3 * manager.Settings.deltaTime;

        private int Count => tracks.Count > 0 ? tracks.Count : deployment.nodes;

        private string ProblemOfObstacles()
        {
            for (var i = 0; i < obstacles.Count; i++)
            {
                var obstacle = obstacles[i];
                var field = "obstacles[" + i + "]";
                if (obstacle.box.Length > 0 == obstacle.polygon.Count > 0) return "'" + field + "' needs either 'box' or 'polygon'";
                if (obstacle.box.Length > 0 && !Area.IsPoint(obstacle.box)) return "'" + field + ".box' must be the centre, [x, z]";
                if (!Area.IsSize(obstacle.size)) return "'" + field + ".size' must be two numbers greater than 0, the lengths along x and z in metres";
                var problem = ProblemOf(field + ".polygon", obstacle.polygon) ?? ProblemIfNotPositive(field + ".height", obstacle.height);
                if (problem != null) return problem;
            }
            return null;
        }

        private void MakeObstacle(Obstacle obstacle)
        {
            var middle = obstacle.height * (1 - Foundation) / 2;
            var height = obstacle.height * (1 + Foundation);
            if (obstacle.polygon.Count == 0)
            {
                MakeBox("Obstacle", new Vector3(obstacle.box[0], middle, obstacle.box[1]), new Vector3(obstacle.size[0], height, obstacle.size[1]));
                return;
            }
            for (var i = 0; i < obstacle.polygon.Count; i++)
            {
                var a = obstacle.polygon[i];
                var b = obstacle.polygon[(i + 1) % obstacle.polygon.Count];
                var way = new Vector3(b[0] - a[0], 0, b[1] - a[1]);
                if (way.magnitude == 0) continue;
                var wall = MakeBox("Wall", new Vector3((a[0] + b[0]) / 2, middle, (a[1] + b[1]) / 2), new Vector3(WallWidth, height, way.magnitude));
                wall.transform.rotation = Quaternion.LookRotation(way);
            }
        }

        private void Deploy()
        {
            foreach (var track in tracks.Values)
            {
                track.PlaceAt(0, out var x, out var z);
                if (!area.IsFree(new Vector3(x, 0, z)))
                    manager.Fail("an obstacle covers node " + track.Id + " of " + deployment.file + ":" + track.Line + ": move the obstacle or the node");
                if (manager.Failure.Length > 0) return;
                MakeNode(track.Id, new Vector3(x, 0, z));
            }
            if (tracks.Count > 0) return;
            var placed = new PlaceGrid(deployment.kind == DeploymentKind.Poisson ? deployment.spacing : 0);
            for (var i = 0; i < deployment.nodes && manager.Failure.Length == 0; i++)
            {
                var place = deployment.kind == DeploymentKind.Grid ? PlaceInGrid(i) : FindFreePlace(placed);
                if (place is Vector3 free) MakeNode(i, free);
            }
            if (manager.Nodes.Count == 0 && manager.Failure.Length == 0)
                manager.Fail("obstacles cover all positions of the grid: move 'obstacles', or change 'deployment'");
        }

        /// <summary>Returns the position of a node, or null if an obstacle covers it.</summary>
        private Vector3? PlaceInGrid(int index)
        {
            var place = deployment.spacing * new Vector3(index % area.Columns, 0, index / area.Columns);
            if (deployment.disorder > 0)
            {
                place += new Vector3(
                    manager.Random.Range(-deployment.disorder, deployment.disorder), 0, manager.Random.Range(-deployment.disorder, deployment.disorder));
            }
            return area.IsFree(place) ? place : (Vector3?)null;
        }

        private Vector3? FindFreePlace(PlaceGrid placed)
        {
            const int Attempts = 1000;
            for (var attempt = 0; attempt < Attempts; attempt++)
            {
                if (!(area.Uniform(manager.Random) is Vector3 place)) break;
                if (placed.TryAdd(place)) return place;
            }
            manager.Fail("the area has no room for " + deployment.nodes + " nodes: " + placed.Count + " were placed; enlarge it, or use fewer nodes"
                + (deployment.kind == DeploymentKind.Poisson ? " or a smaller 'deployment.spacing'" : ""));
            return null;
        }

        private void MakeNode(int id, Vector3 place)
        {
            var hasBody = movement.kind == MovementKind.Velocity || movement.kind == MovementKind.Target;
            var holder = hasBody ? GameObject.CreatePrimitive(PrimitiveType.Sphere) : new GameObject();
            holder.SetActive(false);
            holder.name = "Node";
            // On this layer, bodies do not block radio links.
            holder.layer = IgnoreRaycastLayer;
            holder.transform.position = hasBody ? place + movement.bodyRadius * Vector3.up : place;
            if (hasBody) AddBody(holder);
            holder.AddComponent<Node>().RequestedId = id;
            AddRule(holder);
            holder.AddComponent<StandardSensor>().Scene = this;
            holder.AddComponent<StandardVelocity>();
            if (movement.kind == MovementKind.RandomWaypoint || movement.kind == MovementKind.LevyWalk) holder.AddComponent<Walker>();
            holder.SetActive(true);
        }

        private void AddBody(GameObject holder)
        {
            holder.transform.localScale = 2 * movement.bodyRadius * Vector3.one;
            var body = holder.AddComponent<Rigidbody>();
            body.useGravity = false;
            body.constraints = RigidbodyConstraints.FreezeRotation | RigidbodyConstraints.FreezePositionY;
            if (movement.kind == MovementKind.Velocity) holder.AddComponent<VelocityActuator>();
            else holder.AddComponent<TargetActuator>().MaxSpeed = movement.speed;
        }

        private void AddRule(GameObject holder)
        {
            if (neighbourhood.kind == NeighbourhoodKind.Radius) holder.AddComponent<RadiusNeighbourhood>().Radius = area.Rounded(neighbourhood.radius);
            else if (neighbourhood.kind == NeighbourhoodKind.Nearest) holder.AddComponent<KNearestNeighbourhood>().Count = neighbourhood.count;
            else holder.AddComponent<LineOfSightNeighbourhood>().Radius = area.Rounded(neighbourhood.radius);
            holder.GetComponent<NeighbourhoodRule>().LengthTolerance = neighbourhood.lengthTolerance;
        }

        private void FillSets()
        {
            for (var i = 0; i < sets.Count; i++)
            {
                var bit = 1u << i;
                if (sets[i].name == "source") source = bit;
                foreach (var id in sets[i].ids)
                {
                    if (manager.Find(id) == null) manager.Fail("'sets[" + i + "].ids' contains node " + id + ", whose position an obstacle covers");
                    Add(id, bit);
                }
                if (sets[i].near.Length == 0) continue;
                if (sets[i].count > manager.Nodes.Count)
                    manager.Fail("'sets[" + i + "].count' is " + sets[i].count + ", but obstacles leave " + manager.Nodes.Count + " nodes");
                var point = new Vector3(sets[i].near[0], 0, sets[i].near[1]);
                found.Clear();
                found.AddRange(manager.Nodes);
                // At equal distances, the node with the smaller id comes first.
                found.Sort((a, b) =>
                {
                    var difference = SquaredDistance(a, point).CompareTo(SquaredDistance(b, point));
                    return difference != 0 ? difference : a.Id.CompareTo(b.Id);
                });
                for (var k = 0; k < sets[i].count && k < found.Count; k++) Add(found[k].Id, bit);
            }
        }

        private static float SquaredDistance(Node node, Vector3 point)
        {
            var way = node.transform.position - point;
            return way.x * way.x + way.z * way.z;
        }

        private void Add(int id, uint bit) => members[id] = (members.TryGetValue(id, out var bits) ? bits : 0) | bit;

        private void UpdateSets()
        {
            active = 0;
            for (var i = 0; i < sets.Count; i++)
            {
                if (Now >= sets[i].from && Now < sets[i].until) active |= 1u << i;
            }
        }

        private void Advance(SimulationManager manager)
        {
            UpdateSets();
            var seconds = manager.Settings.deltaTime;
            if (movement.kind == MovementKind.RandomWaypoint || movement.kind == MovementKind.LevyWalk)
            {
                foreach (var node in manager.Nodes) node.GetComponent<Walker>().Walk(node, movement, area, seconds);
            }
            if (movement.kind == MovementKind.Trace) FollowTracks();
            if (churn.failures > 0) Fail(1 - Math.Exp(-churn.failures * seconds));
            for (; churn.arrivals > 0 && nextArrival <= manager.SimulatedTime; nextArrival += Pause(churn.arrivals))
            {
                if (area.Uniform(manager.Random) is Vector3 place) MakeNode(-1, place);
            }
        }

        private void FollowTracks()
        {
            foreach (var node in manager.Nodes)
            {
                if (!tracks.TryGetValue(node.Id, out var track)) continue;
                track.PlaceAt(manager.SimulatedTime, out var x, out var z);
                node.transform.position = new Vector3(x, 0, z);
            }
        }

        private void Fail(double probability)
        {
            // The nodes are collected first, because each destroyed node changes the manager's list.
            failing.Clear();
            foreach (var node in manager.Nodes)
            {
                if (manager.Random.NextDouble() < probability) failing.Add(node);
            }
            foreach (var node in failing) Destroy(node.gameObject);
        }

        /// <summary>Draws the time in seconds until the next event. It has an exponential distribution with the rate.</summary>
        private double Pause(double rate) => -Math.Log(1 - manager.Random.NextDouble()) / rate;
    }
}
