using System;
using System.Collections.Generic;
using System.Linq;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using probe;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests the data that the views pass to Unity's Graphics and renderers.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class ViewTests : SimulationFixture
    {
        [Test]
        public void Each_directed_link_is_drawn_as_a_bar_from_its_sender()
        {
            var view = AddLinkView();
            view.Width = 0.1f;
            MakeNode(0, new Vector3(1, 2, 3));
            MakeNode(0, new Vector3(1, 2, 7));
            Manager.AddLink(0, 1, directed: true);
            Play(1);
            var bars = Bars();
            Assert.That(bars.Count, Is.EqualTo(1));
            Assert.That(bars[0].From, Is.EqualTo(new Vector3(1, 2, 3)));
            Assert.That(bars[0].To, Is.EqualTo(new Vector3(1, 2, 7)));
            var draw = DrawLog.Draws[0];
            Assert.That(draw.Properties.GetFloat("_LinkWidth"), Is.EqualTo(0.1f));
            Assert.That((draw.Bounds.min - new Vector3(0.95f, 1.95f, 2.95f)).magnitude, Is.LessThan(1e-5f), "the bounds must contain the bars");
            Assert.That((draw.Bounds.max - new Vector3(1.05f, 2.05f, 7.05f)).magnitude, Is.LessThan(1e-5f));
            Manager.AddLink(1, 0, directed: true);
            Play(1);
            Assert.That(Bars().Count, Is.EqualTo(2));
        }

        [Test]
        public void One_way_links_have_a_different_colour()
        {
            var view = AddLinkView();
            view.Scale.low = Color.red;
            view.Scale.high = Color.green;
            for (var i = 0; i < 3; i++) MakeNode(0, i * Vector3.right);
            Manager.AddLink(0, 1);
            Manager.AddLink(1, 2, directed: true);
            Play(1);
            Assert.That(Bars().FindAll(bar => bar.Color == Color.green).Count, Is.EqualTo(2));
            Assert.That(Bars().FindAll(bar => bar.Color == Color.red).Count, Is.EqualTo(1));
            Manager.AddLink(2, 1, directed: true);
            Play(1);
            Assert.That(Bars().FindAll(bar => bar.Color == Color.green).Count, Is.EqualTo(4));
        }

        [Test]
        public void A_scale_can_have_the_range_of_all_floats()
        {
            var scale = new ColourScale();
            scale.Begin();
            scale.Include(float.MinValue);
            scale.Include(float.MaxValue);
            Assert.That(new[] { float.MinValue, 0, float.MaxValue }.Select(scale.StepOf), Is.EqualTo(new[] { 0, 8, 15 }));
        }

        [TestCase(LinkColouring.Length)]
        [TestCase(LinkColouring.Value)]
        public void Links_are_coloured_by_length_or_value(LinkColouring colouring)
        {
            var view = AddLinkView();
            view.Colouring = colouring;
            view.Value = link => link.To * link.To;
            view.Scale.low = Color.black;
            view.Scale.high = Color.white;
            MakeNode(0, Vector3.zero);
            for (var i = 1; i <= 3; i++) Manager.AddLink(0, MakeNode(0, i * i * Vector3.right).Node.Id, true);
            Play(1);
            // The values are 1, 4 and 9. The middle value is at 3/8 of the range, which is in the seventh of sixteen steps.
            var shades = Bars().ConvertAll(bar => (float)Math.Round(bar.Color.r, 3));
            shades.Sort();
            Assert.That(shades, Is.EqualTo(new[] { 0, 0.4f, 1 }));
        }

        [Test]
        public void All_links_are_drawn_at_once_with_48_vertices_per_pair()
        {
            AddLinkView();
            for (var i = 0; i < 60; i++) MakeNode(0, new Vector3(i, i * i % 7, 0));
            for (var i = 0; i < 60; i++)
            {
                for (var j = 0; j < i; j++) Manager.AddLink(i, j);
            }
            Play(1);
            Assert.That(Bars().Count, Is.EqualTo(60 * 59));
            Assert.That(DrawLog.Draws.Count, Is.EqualTo(1));
            Assert.That((DrawLog.Draws[0].Vertices, DrawLog.Draws[0].Instances), Is.EqualTo((48, 30 * 59)));
        }

        [Test]
        public void Above_its_limit_the_view_draws_nothing_and_logs_one_message()
        {
            var view = AddLinkView();
            view.Limit = 3;
            for (var i = 0; i < 3; i++) MakeNode(0, i * Vector3.right);
            Manager.AddLink(0, 1);
            Manager.AddLink(1, 2);
            Play(2);
            Assert.That(DrawLog.Draws, Is.Empty);
            Assert.That(Log.FindAll(line => line.Contains("the scene has 4 links, but the Link View draws at most 3")).Count, Is.EqualTo(1));
            Manager.RemoveLink(1, 2, directed: true);
            Play(1);
            Assert.That(Bars().Count, Is.EqualTo(3));
        }

        [Test]
        public void Link_ends_stay_correct_when_another_node_leaves()
        {
            AddLinkView();
            var nodes = new List<ProbeNode>();
            foreach (var id in new[] { 900, 7, 30 }) nodes.Add(MakeNode(0, id * Vector3.right, id));
            Manager.AddLink(900, 30, directed: true);
            Play(1);
            nodes[1].Node.enabled = false;
            Play(1);
            Assert.That(Bars().ConvertAll(bar => (bar.From.x, bar.To.x)), Is.EqualTo(new[] { (900f, 30f) }));
        }

        [Test]
        public void A_disabled_view_or_one_without_a_manager_draws_nothing()
        {
            var view = AddLinkView();
            MakeNode(0);
            MakeNode(0, Vector3.right);
            Manager.AddLink(0, 1);
            Play(1);
            Assert.That(DrawLog.Draws, Is.Not.Empty);
            view.enabled = false;
            Play(1);
            Assert.That(DrawLog.Draws, Is.Empty);
            view.enabled = true;
            Play(1);
            Assert.That(DrawLog.Draws, Is.Not.Empty);
            Manager.enabled = false;
            Loop.Frame(0.05f);
            Assert.That(DrawLog.Draws, Is.Empty);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_view_draws_with_its_material_and_releases_its_resources()
        {
            var before = DrawLog.Buffers;
            var view = AddLinkView();
            MakeNode(0);
            MakeNode(0, Vector3.right);
            Manager.AddLink(0, 1);
            Play(1);
            var own = DrawLog.Draws[0].Material;
            Assert.That(own.shader.name, Is.EqualTo("Collektive/Link"));
            Assert.That(view.Material == null, Is.True, "the setting must stay empty when the view uses the package's material");
            Assert.That(DrawLog.Buffers, Is.EqualTo(before + 2));
            view.enabled = false;
            Play(1);
            Assert.That(own == null, Is.True);
            Assert.That(DrawLog.Buffers, Is.EqualTo(before));
            var shared = new Material(Shader.Find("Collektive/Link"));
            view.Material = shared;
            view.enabled = true;
            Play(1);
            Assert.That(DrawLog.Draws[0].Material, Is.SameAs(shared));
            view.enabled = false;
            Play(1);
            Assert.That(shared == null, Is.False);
        }

        [Test]
        public void A_replaced_material_of_the_user_is_not_destroyed()
        {
            var view = AddLinkView();
            view.enabled = false;
            var first = view.Material = new Material(Shader.Find("Collektive/Link"));
            view.enabled = true;
            view.Material = null;
            view.enabled = false;
            Play(1);
            Assert.That(first == null, Is.False);
        }

        [Test]
        public void A_smooth_view_moves_what_is_drawn_between_ticks_and_nothing_else()
        {
            Configure("double", settings => settings.deltaTime = 0.1f);
            var node = MakeNode(0).Node;
            var visual = new GameObject("Visual").transform;
            visual.SetParent(node.transform, false);
            visual.localPosition = Vector3.up;
            var view = visual.gameObject.AddComponent<SmoothView>();
            var seen = new List<float>();
            Manager.Ticked += manager =>
            {
                seen.Add(node.Position.x);
                node.transform.position += 4 * Vector3.right;
            };
            Play(1);
            var drawn = new List<Vector3>();
            for (var frame = 0; frame < 8; frame++)
            {
                Loop.Frame(0.025f);
                drawn.Add(visual.position);
                Assert.That(node.transform.position.x, Is.EqualTo(4 * (float)Manager.Tick), "the node must stay at its pose of the last tick");
            }
            Assert.That(drawn.ConvertAll(place => Mathf.Round(place.x)), Is.EqualTo(new float[] { 4, 4, 4, 4, 5, 6, 7, 8 }));
            Assert.That(drawn.TrueForAll(place => Mathf.Abs(place.y - 1) < 1e-5f), Is.True);
            Assert.That(seen, Is.EqualTo(new float[] { 0, 4, 8 }), "rules and sensors must see the same positions");
            Manager.Paused = true;
            Loop.Frame(0.025f);
            Assert.That(visual.localPosition, Is.EqualTo(Vector3.up), "while paused, the view must show the last tick");
            view.enabled = false;
            Manager.Paused = false;
            Loop.Frame(0.025f);
            Assert.That(visual.localPosition, Is.EqualTo(Vector3.up));
        }

        [Test]
        public void A_smooth_view_of_a_node_at_rest_keeps_its_place_below_scaled_parents()
        {
            var node = MakeNode(0).Node;
            var map = new GameObject("Map").transform;
            map.localScale = new Vector3(1, 3, -1);
            node.transform.SetParent(map);
            node.transform.localRotation = Quaternion.Euler(20, 30, 45);
            var visual = new GameObject("Visual").transform;
            visual.SetParent(node.transform, false);
            visual.localPosition = new Vector3(1, 2, 3);
            visual.gameObject.AddComponent<SmoothView>();
            Play(3);
            Assert.That((visual.localPosition - new Vector3(1, 2, 3)).magnitude, Is.LessThan(1e-5f));
        }

        [Test]
        public void A_smooth_view_that_would_move_a_collider_is_an_error()
        {
            var node = MakeNode(0).Node;
            Assert.That(node.gameObject.AddComponent<SmoothView>().enabled, Is.False);
            var child = new GameObject("Arm");
            child.transform.SetParent(node.transform);
            child.AddComponent<SphereCollider>();
            Assert.That(child.AddComponent<SmoothView>().enabled, Is.False);
            Assert.That(Errors.Count, Is.EqualTo(2));
            Assert.That(Errors[1], Is.StringContaining("Arm").And.StringContaining("a child that only has renderers"));
        }

        [Test]
        public void Legends_of_two_views_do_not_overlap()
        {
            var views = new[] { new GameObject("A").AddComponent<DoubleView>(), new GameObject("B").AddComponent<DoubleView>() };
            views[0].Title = "first";
            views[1].Title = "second";
            Gui.Placed.Clear();
            foreach (var view in views) UnityEditor.Headless.Menus.Send(view, "OnGUI");
            var titles = Gui.Placed.ConvertAll(label => label.Text.Substring(0, label.Text.IndexOf(' ')));
            Assert.That(titles, Is.EqualTo(new[] { "first", "first", "second", "second" }));
            Assert.That(Gui.Placed[3].Place.y, Is.GreaterThanOrEqualTo(Gui.Placed[0].Place.y + Gui.Placed[0].Place.height));
            views[0].enabled = false;
            Gui.Placed.Clear();
            UnityEditor.Headless.Menus.Send(views[1], "OnGUI");
            Assert.That(Gui.Placed[0].Place.y, Is.EqualTo(10), "the legend must move up to the first place");
        }

        [Test]
        public void Views_of_nodes_with_large_ids_need_little_memory()
        {
            AddLinkView();
            new GameObject("View").AddComponent<DoubleView>();
            var before = GC.GetTotalMemory(true);
            MakeNode(1, Vector3.zero, 5).Node.gameObject.AddComponent<RadiusNeighbourhood>();
            MakeNode(2, Vector3.right, (1 << 24) - 1).Node.gameObject.AddComponent<RadiusNeighbourhood>();
            Play(2);
            Assert.That(Bars().Count, Is.EqualTo(2));
            Assert.That(GC.GetTotalMemory(true) - before, Is.LessThan(16 << 20));
        }

        [Test]
        public void Without_compute_shaders_a_view_is_disabled_with_one_message()
        {
            Loop.HasComputeShaders = false;
            var view = AddLinkView();
            MakeNode(0);
            MakeNode(0, Vector3.right);
            Manager.AddLink(0, 1);
            Play(3);
            Assert.That(view.enabled, Is.False);
            Assert.That(Errors, Is.Empty);
            Assert.That(Log.FindAll(line => line.Contains("Link View on 'Links' is disabled")).Count, Is.EqualTo(1));
            Assert.That(Manager.Tick, Is.EqualTo(3));
        }

        [Test]
        public void A_material_that_cannot_draw_links_is_an_error()
        {
            var view = AddLinkView();
            view.enabled = false;
            view.Material = new Material(Shader.Find("Standard"));
            view.enabled = true;
            Play(1);
            Assert.That(view.enabled, Is.False);
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(Errors[0], Is.StringContaining("whose shader does not draw links"));
            Assert.That(DrawLog.Draws, Is.Empty);
        }

        [Test]
        public void Nodes_are_coloured_by_a_value_of_their_answers()
        {
            var view = new GameObject("View").AddComponent<DoubleView>();
            view.Title = "double";
            view.Scale.low = Color.black;
            view.Scale.high = Color.white;
            var nodes = new[] { MakeBall(1), MakeBall(2), MakeBall(3) };
            Play(1);
            Assert.That(ColorOf(nodes[0]), Is.EqualTo(Color.black));
            Assert.That(ColorOf(nodes[1]).r, Is.EqualTo(8 / 15f).Within(1e-3f));
            Assert.That(ColorOf(nodes[2]), Is.EqualTo(Color.white));
            Assert.That(view.useGUILayout, Is.False, "GUI layout would allocate in each event");
            Assert.That(view.Legend, Is.StringContaining("double  2 ").And.StringContaining("<color=#000000>").And.StringEnding(" 6"));
            nodes[2].Sensor.Value = 101;
            Play(1);
            Assert.That(ColorOf(nodes[1]), Is.EqualTo(Color.black));
            Assert.That(view.Legend, Is.StringEnding(" 202"));
        }

        [Test]
        public void A_node_without_a_renderer_does_not_colour_its_child_node()
        {
            var view = new GameObject("View").AddComponent<DoubleView>();
            view.Scale.low = Color.black;
            view.Scale.high = Color.white;
            var child = MakeBall(1);
            child.Node.transform.SetParent(MakeNode(9).Node.transform, false);
            MakeBall(9);
            Play(1);
            Assert.That(ColorOf(child), Is.EqualTo(Color.black));
        }

        [Test]
        public void Title_and_colours_can_change_during_play()
        {
            var view = new GameObject("View").AddComponent<DoubleView>();
            var nodes = new[] { MakeBall(1), MakeBall(2) };
            Play(1);
            Assert.That(view.Legend, Is.StringStarting("value "));
            view.Title = "twice";
            view.Scale.low = Color.black;
            view.Scale.high = Color.white;
            Play(1);
            Assert.That(view.Legend, Is.StringStarting("twice ").And.StringContaining("<color=#FFFFFF>"));
            Assert.That(ColorOf(nodes[0]), Is.EqualTo(Color.black));
            Assert.That(ColorOf(nodes[1]), Is.EqualTo(Color.white));
        }

        [Test]
        public void A_fixed_scale_does_not_adapt_and_a_failed_round_keeps_the_colour()
        {
            Configure("trouble");
            var view = new GameObject("View").AddComponent<DoubleView>();
            view.Scale.automatic = false;
            view.Scale.highest = 15;
            view.Scale.low = Color.black;
            view.Scale.high = Color.white;
            var node = MakeBall(0);
            Play(3);
            Assert.That(ColorOf(node).r, Is.EqualTo(3 / 15f).Within(1e-3f));
            node.Sensor.Value = 13;
            Play(1);
            Assert.That(node.Node.TryGetAnswer(out ActuatorData last), Is.True, "the last answer must still be readable");
            Assert.That(last.Value, Is.EqualTo(3));
            Assert.That(ColorOf(node).r, Is.EqualTo(3 / 15f).Within(1e-3f));
            node.Sensor.Value = 0;
            Play(20);
            Assert.That(ColorOf(node), Is.EqualTo(Color.white));
        }

        [Test]
        public void TryGetAnswer_returns_the_last_answer_only_as_the_schema_type()
        {
            var node = MakeNode(4).Node;
            Assert.That(node.TryGetAnswer(out ActuatorData _), Is.False, "before the first tick");
            Play(1);
            Assert.That(node.TryGetAnswer(out ActuatorData data), Is.True);
            Assert.That(data.Value, Is.EqualTo(8));
            Assert.That(node.AnswerTime, Is.EqualTo(0.05).Within(1e-6));
            Assert.That(node.AnswerTick, Is.EqualTo(1));
            Assert.That(node.TryGetAnswer(out int _), Is.False);
            node.enabled = false;
            Assert.That(node.TryGetAnswer(out data), Is.False);
            Assert.That((node.AnswerTick, node.AnswerTime), Is.EqualTo((0UL, -1.0)));
        }

        [TestCase(Schedule.Lockstep)]
        [TestCase(Schedule.Sequential)]
        [TestCase(Schedule.Asynchronous)]
        public void A_field_view_includes_all_nodes_in_colours_and_scale(Schedule schedule)
        {
            Configure("double", settings =>
            {
                settings.schedule = schedule;
                settings.timing = new RoundTiming { period = 0.25f };
            });
            var view = new GameObject("View").AddComponent<DoubleView>();
            view.Scale.low = Color.black;
            view.Scale.high = Color.white;
            var nodes = new List<ProbeNode>();
            for (var i = 0; i < 6; i++) nodes.Add(MakeBall(i));
            Play(6);
            for (var tick = 0; tick < 10; tick++)
            {
                Play(1);
                Assert.That((view.Scale.lowest, view.Scale.highest), Is.EqualTo((0f, 10f)));
                for (var i = 0; i < 6; i++) Assert.That(ColorOf(nodes[i]).r, Is.EqualTo(i / 5f).Within(0.05f), "node " + i);
            }
        }

        private static LinkView AddLinkView() => new GameObject("Links").AddComponent<LinkView>();

        private static ProbeNode MakeBall(float value)
        {
            var node = MakeNode(value);
            GameObject.CreatePrimitive(PrimitiveType.Sphere).transform.SetParent(node.Node.transform, false);
            return node;
        }

        private static Color ColorOf(ProbeNode node)
        {
            var block = new MaterialPropertyBlock();
            node.Node.GetComponentInChildren<Renderer>().GetPropertyBlock(block);
            return block.GetColor("_BaseColor");
        }

        /// <summary>
        /// Returns the bars that are drawn in this frame, as the shader computes them. The shader draws each bar from its start to the middle.
        /// </summary>
        private static List<(Vector3 From, Vector3 To, Color Color)> Bars()
        {
            var bars = new List<(Vector3, Vector3, Color)>();
            foreach (var draw in DrawLog.Draws)
            {
                var places = draw.Read<Vector4>("_LinkPlaces");
                var ends = draw.Read<uint>("_LinkPairs");
                Color low = draw.Properties.GetColor("_LinkLow"), high = draw.Properties.GetColor("_LinkHigh");
                for (var i = 0; i < 2 * draw.Instances; i++)
                {
                    var shade = ends[i] >> 24;
                    if (shade == 255) continue;
                    Vector3 from = places[(int)(ends[i] & 0xFFFFFF)], to = places[(int)(ends[i ^ 1] & 0xFFFFFF)];
                    bars.Add((from, to, Color.Lerp(low, high, shade / 15f)));
                }
            }
            return bars;
        }

        public sealed class DoubleView : FieldView<ActuatorData>
        {
            protected override float Read(ActuatorData data) => data.Value;
        }
    }
}
