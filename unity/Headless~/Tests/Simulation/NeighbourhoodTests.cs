using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests the links of each built-in rule.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class NeighbourhoodTests : SimulationFixture
    {
        [Test]
        public void The_nearest_nodes_are_neighbours_and_exchange_messages()
        {
            // The nodes are at 0 m, 1 m, 3 m and 7 m. Except for the first node, the nearest node is always the one to the left.
            var line = MakeLine(0, 1, 3, 7);
            foreach (var node in line) node.Node.gameObject.AddComponent<KNearestNeighbourhood>().Count = 1;
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 1>0 1>2 2>1 2>3 3>2"));
            line[3].Node.transform.position = new Vector3(-1, 0, 0);
            Play(1);
            // Nodes 1 and 3 are now both 1 m from node 0, so the smaller id wins.
            Assert.That(Links(), Is.EqualTo("0>1 0>3 1>0 1>2 2>1 3>0"));
        }

        [TestCase(1)]
        [TestCase(2)]
        [TestCase(3)]
        public void Radius_rules_match_brute_force(int seed)
        {
            var random = new RandomStream((ulong)seed, 0, RandomPurpose.Scene);
            var nodes = new List<Node>();
            var nextId = 0;
            while (nextId < 40) nodes.Add(MakeNodeWithRadius(random, nextId++));
            for (var tick = 0; tick < 150; tick++)
            {
                foreach (var node in nodes) node.transform.position += 0.1f * Place(random);
                var one = nodes[random.Range(0, nodes.Count)];
                switch (random.Range(0, 7))
                {
                    case 0:
                        one.transform.position = 10 * Place(random);
                        break;
                    case 1:
                        one.enabled = !one.enabled;
                        // Some nodes rejoin with the same id before the next tick.
                        if (random.Range(0, 2) == 0) one.enabled = !one.enabled;
                        break;
                    case 2:
                        one.gameObject.SetActive(false);
                        Object.Destroy(one.gameObject);
                        nodes.Remove(one);
                        break;
                    case 3:
                        nodes.Add(MakeNodeWithRadius(random, nextId++));
                        break;
                    case 4:
                        one.GetComponent<RadiusNeighbourhood>().Radius = random.Range(0f, 5f);
                        break;
                    case 5:
                        one.transform.localScale = random.Range(0, 2) == 0 ? new Vector3(-3, 0.1f, 3) : Vector3.one;
                        break;
                    default:
                        one.GetComponent<RadiusNeighbourhood>().enabled ^= true;
                        break;
                }
                Play(1);
                Assert.That(Links(), Is.EqualTo(BruteForceLinks(nodes)), "tick " + tick);
                AssertLengths();
            }
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_directed_rule_creates_links_in_one_direction()
        {
            var line = MakeLine(0, 1, 3, 7);
            foreach (var node in line)
            {
                var rule = node.Node.gameObject.AddComponent<KNearestNeighbourhood>();
                rule.Count = 1;
                rule.Directed = true;
            }
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 1>0 2>1 3>2"));
        }

        [Test]
        public void K_nearest_links_all_nodes_if_K_exceeds_their_number()
        {
            foreach (var node in MakeLine(0, 1000, 2000000)) node.Node.gameObject.AddComponent<KNearestNeighbourhood>().Count = 5;
            Play(1);
            Assert.That(Manager.LinkCount, Is.EqualTo(6));
        }

        [Test]
        public void A_wall_blocks_a_line_of_sight_link_until_it_moves_away()
        {
            foreach (var node in MakeLine(0, 2, 4)) AddLineOfSight(node, 3);
            var wall = MakeWall(3);
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            wall.transform.position = new Vector3(0, 100, 0);
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 1>0 1>2 2>1"));
        }

        [Test]
        public void Walls_add_attenuation_to_links_of_a_non_blocking_rule()
        {
            foreach (var node in MakeLine(0, 10))
            {
                var rule = AddLineOfSight(node, 20);
                rule.Blocking = false;
                rule.Attenuation = 2.5f;
            }
            MakeWall(3);
            var second = MakeWall(6);
            Play(1);
            Assert.That(Attenuation(), Is.EqualTo(5));
            second.GetComponent<Collider>().enabled = false;
            Play(1);
            Assert.That(Attenuation(), Is.EqualTo(2.5f));
        }

        [TestCase(true)]
        [TestCase(false)]
        public void An_infinite_attenuation_does_not_affect_clear_lines(bool blocking)
        {
            var nodes = MakeLine(0, 2);
            var rule = AddLineOfSight(nodes[0], 3);
            rule.Attenuation = float.PositiveInfinity;
            rule.Blocking = blocking;
            Play(2);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            Assert.That(Attenuation(), Is.EqualTo(0));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void The_trigger_of_a_child_node_does_not_replace_a_disabled_trigger()
        {
            var zone = MakeNode(1, id: 0);
            var trigger = AddZone(zone.Node);
            var child = MakeNode(3, new Vector3(0, 50, 0), id: 2).Node;
            child.gameObject.AddComponent<SphereCollider>().isTrigger = true;
            child.transform.SetParent(zone.Node.transform, true);
            var visitor = MakeNode(2, new Vector3(1, 0, 0), id: 1);
            visitor.Node.gameObject.AddComponent<SphereCollider>().radius = 0.1f;
            visitor.Node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            Play(2);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            trigger.enabled = false;
            Play(1);
            Assert.That(Links(), Is.Empty);
        }

        [Test]
        public void Own_colliders_triggers_and_other_layers_do_not_block_the_line_of_sight()
        {
            var line = MakeLine(0, 10);
            foreach (var node in line)
            {
                AddLineOfSight(node, 20).Layers = 1;
                node.Node.gameObject.AddComponent<SphereCollider>().radius = 1;
                var antenna = new GameObject("Antenna");
                antenna.transform.SetParent(node.Node.transform, false);
                antenna.transform.localPosition = new Vector3(node.Node.transform.position.x > 0 ? -2 : 2, 0, 0);
                antenna.AddComponent<SphereCollider>().radius = 0.1f;
            }
            MakeWall(4).GetComponent<Collider>().isTrigger = true;
            MakeWall(6).layer = 4;
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            // The body of another node now blocks the line of sight.
            MakeNode(0, new Vector3(5, 0, 0)).Node.gameObject.AddComponent<SphereCollider>();
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>2 1>2 2>0 2>1"));
        }

        [Test]
        public void A_node_on_a_child_blocks_the_line_of_sight_of_its_parent()
        {
            var line = MakeLine(0, 10, 5);
            AddLineOfSight(line[0], 20);
            line[2].Node.gameObject.AddComponent<SphereCollider>();
            line[2].Node.transform.SetParent(line[0].Node.transform, true);
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>2 2>0"));
        }

        [Test]
        public void Listed_nodes_are_neighbours_while_they_are_active()
        {
            var line = MakeLine(0, 100, 200);
            var rule = line[0].Node.gameObject.AddComponent<ExplicitNeighbourhood>();
            rule.Neighbours.AddRange(new[] { line[1].Node, null, line[2].Node, line[0].Node });
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 0>2 1>0 2>0"));
            line[1].Node.enabled = false;
            Object.Destroy(line[2].Node.gameObject);
            Play(2);
            Assert.That(Links(), Is.Empty);
            line[1].Node.RequestedId = 7;
            line[1].Node.enabled = true;
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>7 7>0"));
            rule.Neighbours.Clear();
            Play(1);
            Assert.That(Links(), Is.Empty);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_listed_node_that_was_never_active_is_ignored()
        {
            var line = MakeLine(0, 100);
            var prefab = new GameObject("Prefab");
            prefab.SetActive(false);
            var rule = line[0].Node.gameObject.AddComponent<ExplicitNeighbourhood>();
            rule.Neighbours.AddRange(new[] { prefab.AddComponent<Node>(), line[1].Node });
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            Assert.That(Errors, Is.Empty);
        }

        [TestCase(float.NaN, 0, "length")]
        [TestCase(-1, 0, "length")]
        [TestCase(float.PositiveInfinity, 0, "length")]
        [TestCase(1, float.NaN, "attenuation")]
        [TestCase(1, -1, "attenuation")]
        public void A_rule_with_invalid_link_values_fails_and_keeps_its_links(float length, float attenuation, string what)
        {
            var line = MakeLine(0, 1, 2);
            var rule = line[0].Node.gameObject.AddComponent<ListRule>();
            rule.Others.Add(line[1].Node);
            Play(1);
            rule.Others.Add(line[2].Node);
            rule.Length = length;
            rule.Attenuation = attenuation;
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(Errors[0], Is.StringContaining("ListRule of node 0").And.StringContaining("a link's " + what + " must be finite and 0 or greater"));
            rule.Length = 1;
            rule.Attenuation = 0;
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 0>2 1>0 2>0"));
        }

        [TestCase(-1)]
        [TestCase(float.NaN)]
        public void A_ready_made_rule_with_a_negative_setting_fails_and_keeps_its_links(float value)
        {
            var line = MakeLine(0, 1, 2, 3, 4);
            var radius = line[0].Node.gameObject.AddComponent<RadiusNeighbourhood>();
            var tolerance = line[1].Node.gameObject.AddComponent<RadiusNeighbourhood>();
            var sight = AddLineOfSight(line[2], 1);
            var nearest = line[3].Node.gameObject.AddComponent<KNearestNeighbourhood>();
            radius.Radius = tolerance.Radius = nearest.Count = 1;
            Play(1);
            var links = Links();
            radius.Radius = sight.Radius = tolerance.LengthTolerance = value;
            nearest.Count = -1;
            Play(1);
            Assert.That(Links(), Is.EqualTo(links));
            var names = new[] { "radius", "length tolerance", "radius", "count" };
            Assert.That(Errors.Count, Is.EqualTo(names.Length), string.Join("; ", Errors));
            for (var i = 0; i < names.Length; i++)
                Assert.That(Errors[i], Is.StringContaining("of node " + i).And.StringContaining("its " + names[i] + " is "));
            Assert.That(Manager.Failure, Is.Empty);
        }

        [Test]
        public void Neighbours_can_be_added_only_within_FindNeighbours()
        {
            var line = MakeLine(0, 1);
            var rule = line[0].Node.gameObject.AddComponent<ListRule>();
            Play(1);
            Assert.That(Assert.Throws<System.InvalidOperationException>(() => rule.Name(line[1].Node)).Message, Is.StringContaining("FindNeighbours"));
            Play(1);
            Assert.That(Links(), Is.Empty);
        }

        [Test]
        public void A_rule_can_create_the_node_that_it_adds()
        {
            var line = MakeLine(0);
            line[0].Node.gameObject.AddComponent<ListRule>().MakeAt = 100;
            Play(2);
            Assert.That(Errors, Is.Empty);
            Assert.That(Links(), Is.EqualTo("0>100 100>0"));
        }

        [Test]
        public void A_rule_does_not_link_a_node_that_an_earlier_rule_removed()
        {
            var line = MakeLine(0, 1, 2, 3);
            line[0].Node.gameObject.AddComponent<Removing>().Victim = line[1].Node;
            line[2].Node.gameObject.AddComponent<Attenuating>();
            line[3].Node.gameObject.AddComponent<Within>();
            Play(1);
            Assert.That((Links(), Manager.LinkCount), Is.EqualTo(("0>2 0>3 2>0 2>3 3>0 3>2", 6)));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_custom_rule_can_query_the_nearest_nodes()
        {
            foreach (var node in MakeLine(0, 1, 2, 3)) node.Node.gameObject.AddComponent<SecondNearest>();
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>2 1>2 2>3 3>1"));
        }

        [Test]
        public void A_re_enabled_trigger_rule_links_nodes_that_are_inside()
        {
            var zone = MakeNode(1);
            var trigger = zone.Node.gameObject.AddComponent<SphereCollider>();
            trigger.isTrigger = true;
            trigger.radius = 2;
            var rule = zone.Node.gameObject.AddComponent<TriggerNeighbourhood>();
            var visitor = MakeNode(2, new Vector3(1, 0, 0));
            visitor.Node.gameObject.AddComponent<SphereCollider>().radius = 0.1f;
            visitor.Node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            Play(2);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            rule.enabled = false;
            Play(1);
            Assert.That(Links(), Is.Empty);
            rule.enabled = true;
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
        }

        [Test]
        public void A_disabled_trigger_has_no_neighbours()
        {
            var zone = MakeNode(1);
            var trigger = AddZone(zone.Node);
            var visitor = MakeNode(2, new Vector3(1, 0, 0));
            visitor.Node.gameObject.AddComponent<SphereCollider>().radius = 0.1f;
            visitor.Node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            Play(2);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            trigger.enabled = false;
            Play(1);
            Assert.That(Links(), Is.Empty);
            trigger.enabled = true;
            Play(2);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
        }

        [TestCase(1, "0>1 1>0")]
        [TestCase(9, "")]
        public void A_node_that_was_reactivated_elsewhere_has_left_the_trigger(float place, string links)
        {
            var zone = MakeNode(1, id: 0);
            AddZone(zone.Node);
            var visitor = MakeNode(2, new Vector3(1, 0, 0), id: 1).Node.gameObject;
            visitor.AddComponent<SphereCollider>().radius = 0.1f;
            visitor.AddComponent<Rigidbody>().isKinematic = true;
            Play(2);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            visitor.SetActive(false);
            visitor.transform.position = new Vector3(place, 0, 0);
            visitor.SetActive(true);
            Play(2);
            Assert.That(Links(), Is.EqualTo(links));
        }

        [Test]
        public void A_body_in_a_trigger_is_linked_when_it_becomes_a_node()
        {
            var trigger = MakeNode(1).Node.gameObject.AddComponent<SphereCollider>();
            trigger.isTrigger = true;
            trigger.radius = 2;
            trigger.gameObject.AddComponent<TriggerNeighbourhood>();
            var visitor = new GameObject("Visitor");
            visitor.transform.position = Vector3.right;
            visitor.AddComponent<SphereCollider>().radius = 0.1f;
            visitor.AddComponent<Rigidbody>().isKinematic = true;
            Play(2);
            var node = visitor.AddComponent<Node>();
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            Object.DestroyImmediate(node);
            Play(1);
            Assert.That(Links(), Is.Empty);
            visitor.AddComponent<Node>();
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>2 2>0"));
        }

        [Test]
        public void A_rule_that_is_called_determines_the_values_of_links_that_other_rules_also_keep()
        {
            Configure("double");
            var nodes = MakeLine(0, 2);
            nodes[0].Node.gameObject.AddComponent<RadiusNeighbourhood>().LengthTolerance = 0;
            var rule = nodes[0].Node.gameObject.AddComponent<Attenuating>();
            rule.LengthTolerance = 1;
            Play(2);
            Assert.That(Value(), Is.EqualTo((2f, 5f)));
            nodes[1].Node.transform.position = new Vector3(2.5f, 0, 0);
            Play(1);
            Assert.That(Value(), Is.EqualTo((2f, 5f)));
            rule.enabled = false;
            Play(1);
            Assert.That(Value(), Is.EqualTo((2.5f, 0f)));

            (float, float) Value()
            {
                var links = new List<LinkRecord>();
                Manager.CopyLinks(links);
                return (links[0].Length, links[0].Attenuation);
            }
        }

        [Test]
        public void A_rule_that_moves_to_another_node_in_its_own_call_sets_no_links_for_that_node()
        {
            var nodes = MakeLine(0, 1, 2);
            nodes[2].Node.transform.position = new Vector3(9, 0, 0);
            var arm = new GameObject("Arm");
            arm.transform.SetParent(nodes[0].Node.transform, false);
            var rule = arm.AddComponent<Moving>();
            rule.Target = nodes[2].Node.transform;
            Play(1);
            Assert.That(Links(), Is.Empty);
            Play(1);
            Assert.That((Links(), rule.Node), Is.EqualTo(("1>2 2>1", nodes[2].Node)));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_link_that_only_a_script_keeps_has_the_values_of_the_script()
        {
            var nodes = MakeLine(0, 2);
            nodes[0].Node.gameObject.AddComponent<Attenuating>();
            Manager.AddLink(0, 1, true);
            nodes[1].Node.transform.position = new Vector3(3, 0, 0);
            Play(1);
            Assert.That(Values(), Is.EqualTo("0>1 3 5, 1>0 3 5"));
            nodes[0].Node.GetComponent<Attenuating>().enabled = false;
            Play(1);
            Assert.That(Values(), Is.EqualTo("0>1 2 0"));

            string Values()
            {
                var links = new List<LinkRecord>();
                Manager.CopyLinks(links);
                return string.Join(", ", links.ConvertAll(link => link.From + ">" + link.To + " " + link.Length + " " + link.Attenuation));
            }
        }

        [Test]
        public void A_collider_with_a_new_parent_belongs_to_its_new_node()
        {
            var zone = MakeNode(1, id: 0);
            AddZone(zone.Node);
            var arm = new GameObject("Arm");
            arm.transform.SetParent(MakeNode(2, Vector3.right, id: 1).Node.transform, false);
            arm.AddComponent<SphereCollider>().radius = 0.1f;
            arm.AddComponent<Rigidbody>().isKinematic = true;
            Play(2);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            var other = MakeNode(2, Vector3.right, id: 2).Node;
            arm.transform.SetParent(other.transform, true);
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>2 2>0"));
            Object.DestroyImmediate(other);
            arm.transform.parent.gameObject.AddComponent<Node>();
            Play(1);
            Assert.That(Links(), Is.EqualTo("0>3 3>0"));
        }

        [Test]
        public void Triggers_and_colliders_that_move_to_another_body_leave_each_other()
        {
            var bodies = new[] { MakeNode(2, id: 0), MakeNode(2, Vector3.right, id: 1), MakeNode(2, 9 * Vector3.forward, id: 2) };
            foreach (var body in bodies) body.Node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            var zone = new GameObject("Zone").transform;
            zone.SetParent(bodies[0].Node.transform, false);
            AddZone(zone);
            var arm = new GameObject("Arm").transform;
            arm.SetParent(bodies[1].Node.transform, false);
            arm.gameObject.AddComponent<SphereCollider>().radius = 0.1f;
            Play(2);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            zone.SetParent(bodies[2].Node.transform, false);
            Play(2);
            Assert.That(Links(), Is.Empty);
            zone.SetParent(bodies[0].Node.transform, false);
            Play(2);
            Assert.That(Links(), Is.EqualTo("0>1 1>0"));
            arm.SetParent(bodies[2].Node.transform, false);
            Play(2);
            Assert.That(Links(), Is.Empty);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Searches_between_ticks_skip_nodes_that_left()
        {
            var line = MakeLine(0, 1, 2);
            Play(1);
            line[1].Node.enabled = false;
            Object.DestroyImmediate(line[2].Node.gameObject);
            var found = new List<Node>();
            Manager.FindNodes(Vector3.zero, 5, found, new List<float>());
            Assert.That(found, Is.EqualTo(new[] { line[0].Node }));
            Manager.FindNearestNodes(Vector3.zero, 3, found, new List<float>());
            Assert.That(found, Is.EqualTo(new[] { line[0].Node }));
        }

        private static SphereCollider AddZone(Component owner)
        {
            var trigger = owner.gameObject.AddComponent<SphereCollider>();
            trigger.isTrigger = true;
            trigger.radius = 2;
            owner.gameObject.AddComponent<TriggerNeighbourhood>();
            return trigger;
        }

        private static ProbeNode[] MakeLine(params float[] places)
        {
            var line = new ProbeNode[places.Length];
            for (var i = 0; i < places.Length; i++) line[i] = MakeNode(i, new Vector3(places[i], 0, 0));
            return line;
        }

        private static LineOfSightNeighbourhood AddLineOfSight(ProbeNode node, float radius)
        {
            var rule = node.Node.gameObject.AddComponent<LineOfSightNeighbourhood>();
            rule.Radius = radius;
            return rule;
        }

        private static Vector3 Place(RandomStream random) => new Vector3(random.Range(-5f, 5f), random.Range(-1f, 1f), random.Range(-5f, 5f));

        private static Node MakeNodeWithRadius(RandomStream random, int id)
        {
            var node = MakeNode(1, Place(random), id).Node;
            node.gameObject.AddComponent<RadiusNeighbourhood>().Radius = random.Range(1f, 3f);
            return node;
        }

        private static string BruteForceLinks(List<Node> nodes)
        {
            var sorted = nodes.FindAll(node => node.enabled);
            sorted.Sort((a, b) => a.Id.CompareTo(b.Id));
            var links = new List<string>();
            foreach (var from in sorted)
            {
                foreach (var to in sorted)
                {
                    if (from != to && (IsWithinRadius(from, to) || IsWithinRadius(to, from))) links.Add(from.Id + ">" + to.Id);
                }
            }
            return string.Join(" ", links);
        }

        private static bool IsWithinRadius(Node node, Node other)
        {
            var rule = node.GetComponent<RadiusNeighbourhood>();
            return rule.enabled && (other.transform.position - node.transform.position).sqrMagnitude <= rule.Radius * rule.Radius;
        }

        /// <summary>
        /// Checks the lengths of the links. They may differ from the distances by the tolerance of the rules, or by twice as much after a link has passed from
        /// one rule to another.
        /// </summary>
        private void AssertLengths()
        {
            var links = new List<LinkRecord>();
            Manager.CopyLinks(links);
            foreach (var link in links)
            {
                var distance = Vector3.Distance(Manager.Find(link.From).transform.position, Manager.Find(link.To).transform.position);
                Assert.That(link.Length, Is.EqualTo(distance).Within(0.5001f), link.From + ">" + link.To);
            }
        }

        private static GameObject MakeWall(float place)
        {
            var wall = GameObject.CreatePrimitive(PrimitiveType.Cube);
            wall.transform.position = new Vector3(place, 0, 0);
            wall.transform.localScale = new Vector3(0.2f, 4, 4);
            return wall;
        }

        private float Attenuation()
        {
            var links = new List<LinkRecord>();
            Manager.CopyLinks(links);
            Assert.That(links.Count, Is.EqualTo(2));
            Assert.That(links[0].Attenuation, Is.EqualTo(links[1].Attenuation));
            return links[0].Attenuation;
        }

        /// <summary>Returns all directed links as sorted text.</summary>
        private string Links()
        {
            var links = new List<LinkRecord>();
            Manager.CopyLinks(links);
            links.Sort((a, b) => a.From != b.From ? a.From.CompareTo(b.From) : a.To.CompareTo(b.To));
            return string.Join(" ", links.ConvertAll(link => link.From + ">" + link.To));
        }

        /// <summary>A rule that links the node to a configured list of neighbours.</summary>
        public sealed class ListRule : NeighbourhoodRule
        {
            public float Length { get; set; } = 1;

            public float Attenuation { get; set; }

            /// <summary>The id of a node that the next call of the rule creates, or -1.</summary>
            public int MakeAt { get; set; } = -1;

            public List<Node> Others { get; } = new List<Node>();

            public void Name(Node other) => kept.Add(other);

            private NeighbourCollector kept;

            protected override void FindNeighbours(NeighbourCollector neighbours)
            {
                kept = neighbours;
                if (MakeAt >= 0) Others.Add(MakeNode(1, new Vector3(1, 0, 0), MakeAt).Node);
                MakeAt = -1;
                foreach (var other in Others) neighbours.Add(other, Length, Attenuation);
            }
        }

        public sealed class Attenuating : NeighbourhoodRule
        {
            protected override void FindNeighbours(NeighbourCollector neighbours)
            {
                foreach (ref readonly var near in neighbours.FindWithin(9)) neighbours.Add(near, 5);
            }
        }

        public sealed class Within : NeighbourhoodRule
        {
            protected override void FindNeighbours(NeighbourCollector neighbours) => neighbours.AddWithin(9);
        }

        /// <summary>A rule that removes a node, and counts the remaining links.</summary>
        public sealed class Removing : NeighbourhoodRule
        {
            public Node Victim { get; set; }

            protected override void FindNeighbours(NeighbourCollector neighbours)
            {
                Victim.enabled = false;
                Assert.That(SimulationManager.Current.LinkCount, Is.EqualTo(0));
            }
        }

        public sealed class Moving : NeighbourhoodRule
        {
            public Transform Target { get; set; }

            protected override void FindNeighbours(NeighbourCollector neighbours)
            {
                neighbours.Add(neighbours.Nodes[1]);
                if (transform.parent != Target) transform.SetParent(Target, false);
            }
        }

        public sealed class SecondNearest : NeighbourhoodRule
        {
            public SecondNearest() => Directed = true;

            protected override void FindNeighbours(NeighbourCollector neighbours) => neighbours.Add(neighbours.FindNearest(3)[2]);
        }
    }
}
