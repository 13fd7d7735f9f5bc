using System;
using System.Collections.Generic;
using System.Reflection;
using Collektive.Unity;
using NUnit.Framework;
using probe;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests the values of each built-in sensor in scenes with known results.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class SensorTests : SimulationFixture
    {
        [Test]
        public void A_position_sensor_on_a_child_reads_the_position_of_the_node()
        {
            var node = MakeNode(0, new Vector3(1, 2, 3)).Node;
            var child = new GameObject("Child");
            child.transform.SetParent(node.transform, false);
            child.transform.localPosition = Vector3.up;
            var sensor = child.AddComponent<Position>();
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(new Vector3(1, 2, 3)));
        }

        [Test]
        public void Velocity_without_a_body_is_displacement_over_the_time_between_rounds()
        {
            var node = MakeNode(0).Node;
            var sensor = node.gameObject.AddComponent<Velocity>();
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(Vector3.zero));
            node.transform.position = new Vector3(0.1f, 0, 0);
            Play(1);
            Assert.That(sensor.Value.x, Is.EqualTo(2).Within(1e-4f));
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(Vector3.zero));
        }

        [Test]
        public void Velocity_with_a_body_is_the_velocity_of_the_body()
        {
            var node = MakeNode(0).Node;
            var body = AddWeightlessBody(node);
            body.linearVelocity = new Vector3(0, 0, 3);
            var sensor = node.gameObject.AddComponent<Velocity>();
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(new Vector3(0, 0, 3)));
        }

        [Test]
        public void A_rigidbody_sensor_adds_a_body_and_reads_it()
        {
            var sensor = MakeNode(0).Node.gameObject.AddComponent<Body>();
            sensor.GetComponent<Rigidbody>().mass = 7;
            Play(1);
            Assert.That(sensor.Mass, Is.EqualTo(7));
        }

        [Test]
        public void Obstacles_are_other_colliders_within_reach_sorted_by_distance()
        {
            var node = MakeNode(0).Node;
            node.gameObject.AddComponent<SphereCollider>();
            var sensor = node.gameObject.AddComponent<Obstacles>();
            sensor.Reach = 3;
            var wall = MakeBox(new Vector3(2.5f, 0, 0));
            var near = MakeBox(new Vector3(0, 0, -2));
            AddWeightlessBody(near);
            MakeBox(new Vector3(0, 4, 0));
            MakeBox(Vector3.forward).GetComponent<Collider>().isTrigger = true;
            MakeBox(Vector3.back).layer = 2;
            Play(1);
            Assert.That(sensor.Values.Count, Is.EqualTo(2));
            Assert.That(sensor.Values[0].Vector, Is.EqualTo(new Vector3(0, 0, -1.5f)));
            Assert.That(sensor.Values[0].Body, Is.SameAs(near.GetComponent<Rigidbody>()));
            Assert.That(sensor.Values[1].Vector, Is.EqualTo(new Vector3(2, 0, 0)));
            Assert.That(sensor.Values[1].Collider, Is.SameAs(wall.GetComponent<Collider>()));
            Assert.That(sensor.Values[1].Body == null, Is.True);
            Assert.That(sensor.Values[1].Distance, Is.EqualTo(2));
        }

        [Test]
        public void Non_convex_meshes_use_their_bounds_and_log_one_message()
        {
            var sensor = MakeNode(0).Node.gameObject.AddComponent<Obstacles>();
            sensor.Reach = 3;
            // The mesh consists of the near side and the top of a cube.
            var mesh = new Mesh();
            mesh.vertices = new[]
            {
                new Vector3(-0.5f, -0.5f, -0.5f), new Vector3(-0.5f, 0.5f, -0.5f), new Vector3(-0.5f, -0.5f, 0.5f), new Vector3(-0.5f, 0.5f, 0.5f),
                new Vector3(0.5f, 0.5f, -0.5f), new Vector3(0.5f, 0.5f, 0.5f),
            };
            mesh.triangles = new[] { 0, 2, 1, 1, 2, 3, 1, 3, 4, 3, 5, 4 };
            for (var i = 0; i < 2; i++)
            {
                var rock = new GameObject("Rock");
                rock.transform.position = new Vector3(2 + i, 0, 0);
                rock.AddComponent<MeshCollider>().sharedMesh = mesh;
            }
            Play(3);
            Assert.That(sensor.Values.ConvertAll(obstacle => obstacle.Distance), Is.EqualTo(new[] { 1.5f, 2.5f }));
            Assert.That(Errors, Is.Empty);
            Assert.That(Log.FindAll(line => line.Contains("'Rock' is not a box, sphere, capsule or convex mesh")).Count, Is.EqualTo(1));
        }

        [Test]
        public void Obstacles_beyond_the_initial_capacity_are_found()
        {
            var sensor = MakeNode(0).Node.gameObject.AddComponent<Obstacles>();
            sensor.Reach = 100;
            for (var i = 0; i < 100; i++) MakeBox(new Vector3(i % 10, 5, i / 10));
            Play(1);
            Assert.That(sensor.Values.Count, Is.EqualTo(100));
            for (var i = 1; i < 100; i++) Assert.That(sensor.Values[i].Distance, Is.GreaterThanOrEqualTo(sensor.Values[i - 1].Distance));
        }

        [Test]
        public void A_full_ray_fan_starts_ahead_and_rotates_with_the_node()
        {
            var node = MakeNode(0).Node;
            node.gameObject.AddComponent<SphereCollider>();
            var sensor = node.gameObject.AddComponent<Rays>();
            sensor.Rays = 4;
            sensor.Range = 10;
            var wall = MakeBox(new Vector3(3, 0, 0));
            Play(1);
            Assert.That(Distances(sensor), Is.EqualTo("10 2.5 10 10"));
            Assert.That(sensor.Values[1].Collider, Is.SameAs(wall.GetComponent<Collider>()));
            Assert.That(sensor.Values[1].Direction.x, Is.EqualTo(1).Within(1e-6f));
            Assert.That(sensor.Values[0].Collider == null, Is.True);
            node.transform.rotation = Quaternion.Euler(0, 90, 0);
            Play(1);
            Assert.That(Distances(sensor), Is.EqualTo("2.5 10 10 10"));
        }

        [Test]
        public void A_partial_ray_fan_goes_left_to_right_and_ignores_own_colliders()
        {
            var node = MakeNode(0).Node;
            var sensor = node.gameObject.AddComponent<Rays>();
            sensor.Rays = 3;
            sensor.Angle = 180;
            sensor.Range = 4;
            MakeBox(new Vector3(-3, 0, 0));
            MakeBox(new Vector3(0, 0, 3));
            var arm = MakeBox(new Vector3(0, 0, 1.5f));
            arm.transform.localScale = 0.5f * Vector3.one;
            arm.transform.SetParent(node.transform, true);
            Play(1);
            Assert.That(Distances(sensor), Is.EqualTo("2.5 2.5 4"));
            sensor.Rays = 1;
            Play(1);
            Assert.That(Distances(sensor), Is.EqualTo("2.5"));
        }

        [Test]
        public void A_contact_reports_point_normal_and_impulse()
        {
            MakeBox(new Vector3(0, -0.5f, 0));
            var ball = MakeBall(new Vector3(0, 0.49f, 0));
            ball.sleepThreshold = 0; // prevents sleeping, because contacts of a sleeping body have no impulse
            var sensor = ball.gameObject.AddComponent<Contacts>();
            Play(1);
            Assert.That(sensor.Values, Is.Empty, "the sensor must have no contacts before the first physics step");
            Play(40);
            Assert.That(sensor.Values.Count, Is.EqualTo(1));
            Assert.That(sensor.Values[0].Body == null, Is.True);
            Assert.That(sensor.Values[0].Point.y, Is.EqualTo(0).Within(0.05f));
            Assert.That(sensor.Values[0].Normal.y, Is.EqualTo(1).Within(1e-3f));
            // A body of 2 kg rests on the box during the 0.05 s between two rounds.
            Assert.That(sensor.Values[0].Impulse.y, Is.EqualTo(2 * 9.81f * 0.05f).Within(0.2f));
            ball.linearVelocity = 10 * Vector3.up;
            Play(3);
            Assert.That(sensor.Values, Is.Empty);
        }

        [Test]
        public void An_obstacle_that_moves_to_another_body_no_longer_touches_the_node()
        {
            var box = MakeBox(new Vector3(0, -0.5f, 0));
            var sensor = MakeBall(new Vector3(0, 0.49f, 0)).gameObject.AddComponent<Contacts>();
            Play(3);
            Assert.That(sensor.Values.Count, Is.EqualTo(1));
            box.transform.SetParent(MakeCarrier(), false);
            Play(2);
            Assert.That(sensor.Values, Is.Empty);
        }

        [TestCase(1)]
        [TestCase(-1)]
        public void The_impulse_of_a_mesh_with_two_opposite_walls_points_away_from_the_pressed_wall(int side)
        {
            Physics.gravity = new Vector3(10 * side, 0, 0);
            var channel = new Mesh();
            // The walls are 2 mm from the ball. Physics reports both as contacts.
            const float x = 0.502f;
            channel.vertices = new[]
            {
                new Vector3(-x, -2, -2), new Vector3(-x, 2, -2), new Vector3(-x, -2, 2), new Vector3(-x, 2, 2),
                new Vector3(x, -2, -2), new Vector3(x, 2, -2), new Vector3(x, -2, 2), new Vector3(x, 2, 2),
            };
            channel.triangles = new[] { 0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7 };
            new GameObject("Channel").AddComponent<MeshCollider>().sharedMesh = channel;
            var ball = MakeBall(Vector3.zero);
            ball.sleepThreshold = 0;
            var sensor = ball.gameObject.AddComponent<Contacts>();
            Play(20);
            Assert.That(sensor.Values.Count, Is.EqualTo(1));
            Assert.That(sensor.Values[0].Impulse.x, Is.EqualTo(-side * 2 * 10 * 0.05f).Within(0.02f));
            Assert.That(sensor.Values[0].Normal.x, Is.EqualTo(-side).Within(1e-3f));
        }

        [Test]
        public void The_impulses_of_a_body_in_a_corner_are_those_of_each_collider()
        {
            foreach (var place in new[] { new Vector3(10.5f, 0, 0), new Vector3(0, -10.5f, 0), new Vector3(0, 0, 10.5f) })
                MakeBox(place).transform.localScale = 20 * Vector3.one;
            var node = MakeNode(0).Node;
            node.gameObject.AddComponent<BoxCollider>();
            node.gameObject.AddComponent<Rigidbody>().sleepThreshold = 0;
            var sensor = node.gameObject.AddComponent<Contacts>();
            Play(60);
            Assert.That(sensor.Values.Count, Is.EqualTo(3));
            foreach (var contact in sensor.Values)
                Assert.That(contact.Impulse.magnitude, Is.EqualTo(contact.Collider.transform.position.y < 0 ? 9.81f * 0.05f : 0).Within(0.02f));
        }

        [Test]
        public void A_short_collision_between_two_rounds_is_reported_once()
        {
            Configure("double", settings => settings.deltaTime = 0.3f);
            Physics.gravity = Vector3.zero;
            var box = MakeBox(Vector3.zero).GetComponent<Collider>();
            box.sharedMaterial = new PhysicsMaterial { bounciness = 1, bounceCombine = PhysicsMaterialCombine.Maximum };
            var ball = MakeBall(new Vector3(0, 3, 0));
            var sensor = ball.gameObject.AddComponent<Contacts>();
            ball.linearVelocity = 8 * Vector3.down;
            Play(1);
            Assert.That(ball.linearVelocity.y, Is.GreaterThan(0), "the ball must have bounced");
            Play(1);
            Assert.That(sensor.Values.Count, Is.EqualTo(1));
            Assert.That(sensor.Values[0].Impulse.y, Is.EqualTo(2 * (8 + ball.linearVelocity.y)).Within(1));
            Play(1);
            Assert.That(sensor.Values, Is.Empty);
        }

        [Test]
        public void A_destroyed_body_is_no_longer_a_contact()
        {
            var box = MakeBox(new Vector3(0, -0.5f, 0));
            var sensor = MakeBall(new Vector3(0, 0.49f, 0)).gameObject.AddComponent<Contacts>();
            Play(20);
            Assert.That(sensor.Values.Count, Is.EqualTo(1));
            Object.Destroy(box);
            Play(2);
            Assert.That(sensor.Values, Is.Empty);
            Assert.That(Errors, Is.Empty);
        }

        [TestCase(0)]
        [TestCase(1)]
        public void A_contact_of_several_colliders_continues_without_one_of_them(int disabled)
        {
            MakeBox(new Vector3(0, -0.5f, 0)).transform.localScale = new Vector3(20, 1, 20);
            var body = MakeBall(new Vector3(0, 0.5f, 0));
            body.GetComponent<SphereCollider>().center = Vector3.left;
            body.gameObject.AddComponent<SphereCollider>().center = Vector3.right;
            var sensor = body.gameObject.AddComponent<Contacts>();
            Play(5);
            Assert.That(sensor.Values.Count, Is.EqualTo(1));
            Assert.That(sensor.Values[0].Impulse.y, Is.EqualTo(2 * 9.81f * 0.05f).Within(0.05f), "the impulses of both colliders");
            body.GetComponents<SphereCollider>()[disabled].enabled = false;
            Play(1);
            Assert.That(sensor.Values.Count, Is.EqualTo(1));
        }

        [Test]
        public void A_contact_of_a_child_node_is_not_a_contact_of_its_parent()
        {
            MakeBox(new Vector3(0, -0.5f, 0)).transform.localScale = new Vector3(20, 1, 20);
            var body = MakeBall(new Vector3(0, 3, 0));
            var child = MakeBox(new Vector3(0, 0.5f, 0)).AddComponent<Node>();
            child.transform.SetParent(body.transform, true);
            var sensor = body.gameObject.AddComponent<Contacts>();
            Play(5);
            Assert.That(sensor.Values, Is.Empty);
            Object.DestroyImmediate(child);
            body.linearVelocity = Vector3.up;
            Play(10);
            Assert.That(sensor.Values.Count, Is.EqualTo(1), "the collider now belongs to the parent");
        }

        [Test]
        public void A_body_whose_collider_was_disabled_and_that_moved_has_no_contacts()
        {
            MakeBox(new Vector3(0, -0.5f, 0));
            var ball = MakeBall(new Vector3(0, 0.49f, 0));
            var sensor = ball.gameObject.AddComponent<Contacts>();
            Play(10);
            Assert.That(sensor.Values.Count, Is.EqualTo(1));
            ball.GetComponent<Collider>().enabled = false;
            ball.isKinematic = true;
            ball.position = new Vector3(0, 20, 0);
            Play(2);
            Assert.That(sensor.Values, Is.Empty);
            ball.GetComponent<Collider>().enabled = true;
            Play(2);
            Assert.That(sensor.Values, Is.Empty);
        }

        [Test]
        public void A_node_whose_collider_is_disabled_has_left_all_zones()
        {
            var (_, ball, sensor) = MakeBallInZone();
            Play(3);
            ball.GetComponent<Collider>().enabled = false;
            Play(2);
            ball.transform.position = new Vector3(5, 0, 0);
            ball.GetComponent<Collider>().enabled = true;
            Play(3);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "in", "left" }));
        }

        [Test]
        public void A_zone_that_was_disabled_and_enabled_between_two_rounds_can_be_left()
        {
            var (zone, ball, sensor) = MakeBallInZone();
            Play(2);
            zone.enabled = false;
            Physics.Simulate(0.01f);
            zone.enabled = true;
            Play(2);
            ball.transform.position = new Vector3(5, 0, 0);
            Play(3);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "in", "in", "in", "left" }));
        }

        [Test]
        public void A_zone_that_was_disabled_enabled_and_left_between_two_rounds_is_left()
        {
            var (zone, ball, sensor) = MakeBallInZone();
            Play(2);
            ball.GetComponent<Node>().Sleep(0.15);
            zone.enabled = false;
            Play(1);
            zone.enabled = true;
            Play(1);
            ball.transform.position = new Vector3(5, 0, 0);
            Play(3);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "left" }));
        }

        [TestCase(false, "")]
        [TestCase(true, "entered")]
        public void A_node_that_was_disabled_enters_the_zones_that_it_is_in_when_it_joins_again(bool isInside, string expected)
        {
            var (zone, ball, sensor) = MakeBallInZone();
            Play(3);
            sensor.Events.Clear();
            ball.GetComponent<Node>().enabled = false;
            if (!isInside) ball.transform.position = new Vector3(5, 0, 0);
            Play(2);
            ball.GetComponent<Node>().enabled = true;
            Play(1);
            Assert.That(string.Join(",", sensor.Events), Is.EqualTo(expected));
        }

        [Test]
        public void Zones_report_entering_staying_and_leaving()
        {
            var zone = MakeBox(new Vector3(5, 0, 0)).GetComponent<Collider>();
            zone.isTrigger = true;
            var ball = MakeBall(Vector3.zero);
            ball.isKinematic = true;
            var sensor = ball.gameObject.AddComponent<Zones>();
            Play(2);
            Assert.That(sensor.Events, Is.Empty);
            ball.transform.position = new Vector3(5, 0, 0);
            Play(4);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "in", "in" }));
            Assert.That(sensor.Last, Is.SameAs(zone));
            ball.transform.position = Vector3.zero;
            Play(3);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "in", "in", "in", "left" }));
        }

        [TestCase(true)]
        [TestCase(false)]
        public void A_zone_or_collider_that_moves_to_another_body_is_left(bool movesZone)
        {
            var zone = MakeBox(Vector3.zero).GetComponent<Collider>();
            zone.isTrigger = true;
            MakeNode(0, Vector3.zero).Node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            var arm = new GameObject("Arm");
            arm.transform.SetParent(Manager.Nodes[0].transform, false);
            arm.AddComponent<SphereCollider>();
            arm.AddComponent<SphereCollider>();
            var sensor = arm.AddComponent<Zones>();
            var carrier = MakeCarrier();
            if (!movesZone) carrier.gameObject.AddComponent<Node>();
            var moved = movesZone ? zone.transform : arm.transform;
            var before = moved.parent;
            Play(2);
            moved.SetParent(carrier, false);
            Play(2);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "left" }));
            moved.SetParent(before, false);
            Play(3);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "left", "entered", "in" }));
        }

        [Test]
        public void A_zone_that_was_left_and_entered_between_two_rounds_is_entered()
        {
            var (_, ball, sensor) = MakeBallInZone();
            Play(2);
            ball.GetComponent<Node>().Sleep(0.1);
            ball.transform.position = new Vector3(5, 0, 0);
            Play(1);
            ball.transform.position = Vector3.zero;
            Play(3);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "entered", "in" }));
        }

        [TestCase(-1)]
        [TestCase(1)]
        public void A_node_whose_colliders_leave_and_enter_a_zone_in_the_same_step_is_still_in_the_zone(int side)
        {
            MakeBox(Vector3.zero).GetComponent<Collider>().isTrigger = true;
            var body = MakeBall(2 * side * Vector3.right);
            body.isKinematic = true;
            body.GetComponent<SphereCollider>().center = 2 * Vector3.left;
            body.gameObject.AddComponent<SphereCollider>().center = 2 * Vector3.right;
            var sensor = body.gameObject.AddComponent<Zones>();
            Play(3);
            body.transform.position = -body.transform.position;
            Play(3);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "in", "in", "in", "in" }));
            body.transform.position = 10 * Vector3.right;
            Play(2);
            Assert.That(sensor.Events[sensor.Events.Count - 1], Is.EqualTo("left"));
        }

        [Test]
        public void The_velocity_of_a_node_begins_at_zero_when_the_node_is_enabled_again()
        {
            var node = MakeNode(0).Node;
            var sensor = node.gameObject.AddComponent<MeanVelocity>();
            Play(1);
            node.transform.position = new Vector3(1, 0, 0);
            Play(1);
            Assert.That(sensor.Value.x, Is.EqualTo(20).Within(1e-3));
            node.enabled = false;
            Play(1);
            node.transform.position = new Vector3(9, 0, 0);
            node.enabled = true;
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(Vector3.zero));
        }

        [Test]
        public void The_velocity_of_a_node_begins_at_zero_in_the_next_simulation()
        {
            var node = MakeNode(0).Node;
            var sensor = node.gameObject.AddComponent<MeanVelocity>();
            Play(1);
            Manager.enabled = false;
            node.transform.position = new Vector3(9, 0, 0);
            Manager.enabled = true;
            node.Sleep(0.05);
            Play(2);
            Assert.That(sensor.Value, Is.EqualTo(Vector3.zero));
        }

        [Test]
        public void Impulses_before_a_node_was_enabled_again_are_not_reported()
        {
            MakeBox(new Vector3(0, -0.5f, 0));
            var ball = MakeBall(new Vector3(0, 0.49f, 0));
            ball.sleepThreshold = 0;
            var sensor = ball.gameObject.AddComponent<Contacts>();
            Play(20);
            var node = ball.GetComponent<Node>();
            node.enabled = false;
            Play(20);
            node.enabled = true;
            node.Sleep(0.05);
            Play(2);
            Assert.That(sensor.Values.Count, Is.EqualTo(1));
            Assert.That(sensor.Values[0].Impulse.y, Is.EqualTo(2 * 9.81f * 0.05f).Within(0.05f));
        }

        [Test]
        public void A_sensor_that_moves_to_another_node_in_a_tick_measures_around_that_node()
        {
            MakeBox(new Vector3(100, 0, 0));
            var first = MakeNode(0).Node;
            var second = MakeNode(0, new Vector3(100, 0, 1)).Node;
            var sensor = new GameObject("Sensor");
            sensor.transform.SetParent(first.transform);
            var obstacles = sensor.AddComponent<Obstacles>();
            var setter = first.gameObject.AddComponent<Setter>();
            Play(2);
            Assert.That(obstacles.Values, Is.Empty);
            setter.Sensing = () => sensor.transform.SetParent(second.transform);
            Play(1);
            Assert.That(obstacles.Values.Count, Is.EqualTo(1));
        }

        [Test]
        public void A_range_that_another_sensor_sets_applies_to_the_same_round()
        {
            MakeBox(new Vector3(0, 0, 4)).transform.localScale = new Vector3(1, 1, 2);
            var node = MakeNode(0).Node;
            var setter = node.gameObject.AddComponent<Setter>();
            var sensor = node.gameObject.AddComponent<Rays>();
            sensor.Rays = 1;
            sensor.Range = 1;
            Play(2);
            Assert.That(Distances(sensor), Is.EqualTo("1"));
            setter.Sensing = () => sensor.Range = 10;
            Play(1);
            Assert.That(Distances(sensor), Is.EqualTo("3"));
        }

        [Test]
        public void A_reach_or_layers_that_another_sensor_sets_apply_to_the_same_round()
        {
            MakeBox(new Vector3(0, 0, 4));
            var node = MakeNode(0).Node;
            var setter = node.gameObject.AddComponent<Setter>();
            var obstacles = node.gameObject.AddComponent<Obstacles>();
            var rays = node.gameObject.AddComponent<Rays>();
            (rays.Rays, rays.Range) = (1, 10);
            Play(2);
            Assert.That(obstacles.Values, Is.Empty);
            setter.Sensing = () => obstacles.Reach = 10;
            Play(1);
            Assert.That(obstacles.Values.Count, Is.EqualTo(1));
            setter.Sensing = () => obstacles.Layers = rays.Layers = 1 << 8;
            Play(1);
            Assert.That(obstacles.Values, Is.Empty);
            Assert.That(Distances(rays), Is.EqualTo("10"));
        }

        [Test]
        public void A_disabled_zone_is_left_and_triggers_of_nodes_are_not_zones()
        {
            var zone = MakeBox(Vector3.zero).GetComponent<Collider>();
            zone.isTrigger = true;
            var other = MakeNode(0).Node.gameObject.AddComponent<SphereCollider>();
            other.isTrigger = true;
            var ball = MakeBall(Vector3.zero);
            ball.isKinematic = true;
            var sensor = ball.gameObject.AddComponent<Zones>();
            Play(3);
            zone.enabled = false;
            Play(2);
            Assert.That(sensor.Events, Is.EqualTo(new[] { "entered", "in", "left" }));
        }

        [Test]
        public void Intensity_decreases_with_distance_and_is_summed_over_sources()
        {
            var sensor = MakeNode(0).Node.gameObject.AddComponent<Intensity>();
            var first = MakeSource(new Vector3(10, 0, 0));
            var second = MakeSource(new Vector3(0, 30, 0));
            second.Falloff = 2;
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(90 + 40));
            sensor.Source = first;
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(90));
            first.enabled = false;
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(0));
            sensor.Source = second;
            second.Falloff = 10;
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(0), "the value must never be negative");
        }

        [Test]
        public void A_destroyed_source_has_no_intensity()
        {
            var sensor = MakeSensorOfDestroyedSource();
            Assert.That(sensor.Value, Is.EqualTo(0));
            sensor.Source = null;
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(100));
            sensor.Source = MakeSource(Vector3.zero);
            Object.DestroyImmediate(sensor.Source.gameObject);
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(0), "the source was destroyed before the first round with it");
        }

        [Test]
        public void A_selected_source_that_is_destroyed_before_the_first_round_has_no_intensity()
        {
            MakeSource(Vector3.zero);
            var source = MakeSource(Vector3.zero);
            var node = MakeNode(0).Node.gameObject;
            node.SetActive(false);
            var sensor = node.AddComponent<Intensity>();
            // A scene or prefab sets the field, not the property.
            typeof(IntensitySensor<SensorData>).GetField("source", BindingFlags.NonPublic | BindingFlags.Instance).SetValue(sensor, source);
            node.SetActive(true);
            Object.DestroyImmediate(source);
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(0));
        }

        [Test]
        public void Editing_a_sensor_keeps_its_destroyed_source_but_not_its_cleared_source()
        {
            var sensor = MakeSensorOfDestroyedSource();
            Edit(sensor);
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(0));
            sensor.Source = MakeSource(new Vector3(20, 0, 0));
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(80));
            Field(sensor).SetValue(sensor, null);
            Edit(sensor);
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(180));

            static FieldInfo Field(Intensity of) => of.GetType().BaseType.GetField("source", BindingFlags.NonPublic | BindingFlags.Instance);
            static void Edit(Intensity edited) =>
                edited.GetType().BaseType.GetMethod("OnValidate", BindingFlags.NonPublic | BindingFlags.Instance).Invoke(edited, null);
        }

        [Test]
        public void The_sum_of_intensities_does_not_depend_on_the_order_of_sources()
        {
            var sensor = MakeNode(0).Node.gameObject.AddComponent<Intensity>();
            var sources = new List<IntensitySource>();
            foreach (var peak in new[] { 1, 1, 1, 1 << 24 })
            {
                sources.Add(MakeSource(Vector3.zero));
                sources[sources.Count - 1].Peak = peak;
            }
            var sums = new HashSet<float>();
            for (var i = 0; i < sources.Count; i++)
            {
                sources[i].enabled = false;
                sources[i].enabled = true;
                Play(1);
                sums.Add(sensor.Value);
            }
            Assert.That(sums, Is.EqualTo(new[] { 16777220f }));
            sources[0].Peak = float.PositiveInfinity;
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(float.PositiveInfinity));
        }

        [Test]
        public void A_node_on_a_child_is_an_obstacle_of_its_parent()
        {
            var child = MakeNode(0, new Vector3(5, 0, 0)).Node;
            child.gameObject.AddComponent<SphereCollider>();
            var node = MakeNode(0).Node;
            child.transform.SetParent(node.transform, true);
            var rays = node.gameObject.AddComponent<Rays>();
            rays.Rays = 4;
            rays.Range = 10;
            var obstacles = node.gameObject.AddComponent<Obstacles>();
            obstacles.Reach = 8;
            // The first round does not use the batch.
            for (var round = 0; round < 2; round++)
            {
                Play(1);
                Assert.That(Distances(rays), Is.EqualTo("10 4.5 10 10"));
                Assert.That(obstacles.Values.Count, Is.EqualTo(1));
            }
        }

        [Test]
        public void A_ray_finds_an_obstacle_within_a_millimetre_behind_the_surface_of_an_own_collider()
        {
            var node = MakeNode(0).Node;
            var rays = node.gameObject.AddComponent<Rays>();
            rays.Rays = 1;
            rays.Range = 10;
            MakeBox(new Vector3(0, 0, 2)).transform.SetParent(node.transform, true);
            MakeBox(new Vector3(0, 0, 2.0005f));
            // The first round does not use the batch.
            for (var round = 0; round < 2; round++)
            {
                Play(1);
                Assert.That(rays.Values[0].Distance, Is.EqualTo(1.5005f).Within(1e-5f));
            }
        }

        [TestCase(1)]
        [TestCase(-1)]
        public void Hits_at_equal_offsets_do_not_depend_on_the_order_of_creation(int first)
        {
            var node = MakeNode(0).Node;
            node.gameObject.AddComponent<SphereCollider>();
            node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            var obstacles = node.gameObject.AddComponent<Obstacles>();
            var zones = node.gameObject.AddComponent<Zones>();
            foreach (var side in new[] { first, -first })
            {
                // The node is inside of both obstacles, so their closest points are the same.
                MakeBox(Vector3.zero).GetComponent<BoxCollider>().center = new Vector3(0.3f * side, 0, 0);
                var zone = MakeBox(Vector3.zero);
                zone.transform.localScale = (2 + side) * Vector3.one;
                zone.GetComponent<Collider>().isTrigger = true;
            }
            Play(2);
            Assert.That(obstacles.Values.ConvertAll(obstacle => obstacle.Collider.bounds.center.x), Is.EqualTo(new[] { -0.3f, 0.3f }));
            Assert.That((zones.Events.Count, zones.Last.transform.localScale.x), Is.EqualTo((2, 3f)));
        }

        [TestCase(0)]
        [TestCase(-3)]
        public void A_fan_without_rays_is_an_error(int rays)
        {
            MakeNode(0).Node.gameObject.AddComponent<Rays>().Rays = rays;
            Play(2);
            Assert.That(Errors[0], Is.StringContaining("Rays of node 0").And.StringContaining("its number of rays is " + rays + ": set it to 1 or greater"));
        }

        [TestCase(float.NaN)]
        [TestCase(-90)]
        [TestCase(float.NegativeInfinity)]
        public void A_fan_whose_angle_is_negative_or_not_a_number_is_an_error(float angle)
        {
            var rays = MakeNode(0).Node.gameObject.AddComponent<Rays>();
            Play(2);
            rays.Angle = angle;
            Play(1);
            Assert.That(Errors.Count, Is.EqualTo(1), string.Join("; ", Errors));
            Assert.That(Errors[0], Is.StringContaining("Rays of node 0").And.StringContaining("angle"));
        }

        [TestCase(-1)]
        [TestCase(float.NaN)]
        public void Negative_settings_and_NaN_are_errors(float value)
        {
            MakeNode(0).Node.gameObject.AddComponent<Obstacles>().Reach = value;
            MakeNode(0).Node.gameObject.AddComponent<Rays>().Range = value;
            MakeNode(0).Node.gameObject.AddComponent<ActuatorTests.Move>().MaxSpeed = value;
            MakeNode(0).Node.gameObject.AddComponent<ActuatorTests.Move>().ReachTime = value;
            Play(1);
            var names = new[] { "reach", "range", "maximum speed", "reach time" };
            Assert.That(Errors.Count, Is.EqualTo(names.Length), string.Join("; ", Errors));
            for (var i = 0; i < names.Length; i++)
            {
                var problem = "its " + names[i] + " is " + value + ": set it to 0 or greater";
                Assert.That(Errors[i], Is.StringContaining("of node " + i).And.StringContaining(problem));
            }
        }

        [TestCase(false)]
        [TestCase(true)]
        public void A_collider_that_leaves_in_a_tick_is_no_longer_an_obstacle(bool isDestroyed)
        {
            var setter = MakeNode(0).Node.gameObject.AddComponent<Setter>();
            var obstacles = MakeNode(0).Node.gameObject.AddComponent<Obstacles>();
            obstacles.Reach = 10;
            var boxes = new List<Collider>();
            for (var x = 2; x < 5; x++) boxes.Add(MakeBox(new Vector3(x, 0, 0)).GetComponent<Collider>());
            Play(2);
            Assert.That(obstacles.Values.Count, Is.EqualTo(3));
            setter.Sensing = () =>
            {
                if (isDestroyed) Object.DestroyImmediate(boxes[0]);
                else boxes[0].enabled = false;
            };
            Play(1);
            Assert.That(Errors, Is.Empty);
            Assert.That(obstacles.Values.ConvertAll(obstacle => obstacle.Vector.x), Is.EqualTo(new[] { 2.5f, 3.5f }));
        }

        [TestCase(false)]
        [TestCase(true)]
        public void A_ray_passes_a_collider_that_leaves_in_the_tick(bool isDestroyed)
        {
            var setter = MakeNode(0).Node.gameObject.AddComponent<Setter>();
            var rays = MakeNode(0).Node.gameObject.AddComponent<Rays>();
            (rays.Rays, rays.Range) = (1, 10);
            var near = MakeBox(new Vector3(0, 0, 2)).GetComponent<Collider>();
            MakeBox(new Vector3(0, 0, 4));
            Play(2);
            Assert.That(Distances(rays), Is.EqualTo("1.5"));
            setter.Sensing = () =>
            {
                if (isDestroyed) Object.DestroyImmediate(near);
                else near.enabled = false;
            };
            Play(1);
            Assert.That(Distances(rays), Is.EqualTo("3.5"));
        }

        [Test]
        public void An_infinite_reach_finds_all_obstacles()
        {
            var obstacles = MakeNode(0).Node.gameObject.AddComponent<Obstacles>();
            obstacles.Reach = float.PositiveInfinity;
            MakeBox(new Vector3(0, 0, 1e5f));
            for (var round = 0; round < 2; round++)
            {
                Play(1);
                Assert.That(obstacles.Values.Count, Is.EqualTo(1));
            }
        }

        private static string Distances(Rays sensor) =>
            string.Join(" ", sensor.Values.ConvertAll(hit => Math.Round(hit.Distance, 3).ToString(System.Globalization.CultureInfo.InvariantCulture)));

        private static GameObject MakeBox(Vector3 place)
        {
            var box = GameObject.CreatePrimitive(PrimitiveType.Cube);
            box.transform.position = place;
            return box;
        }

        private static Rigidbody AddWeightlessBody(Component part) => AddWeightlessBody(part.gameObject);

        private static Rigidbody AddWeightlessBody(GameObject holder)
        {
            var body = holder.AddComponent<Rigidbody>();
            body.useGravity = false;
            return body;
        }

        private static Transform MakeCarrier()
        {
            var body = new GameObject("Carrier").AddComponent<Rigidbody>();
            body.isKinematic = true;
            body.transform.position = 90 * Vector3.right;
            return body.transform;
        }

        /// <summary>Creates a node of 2 kg with a radius of half a metre.</summary>
        private static (Collider Zone, Rigidbody Ball, Zones Sensor) MakeBallInZone()
        {
            var zone = MakeBox(Vector3.zero).GetComponent<Collider>();
            zone.isTrigger = true;
            var ball = MakeBall(Vector3.zero);
            ball.isKinematic = true;
            return (zone, ball, ball.gameObject.AddComponent<Zones>());
        }

        private static Rigidbody MakeBall(Vector3 place)
        {
            var node = MakeNode(0, place).Node;
            node.gameObject.AddComponent<SphereCollider>();
            var body = node.gameObject.AddComponent<Rigidbody>();
            body.mass = 2;
            return body;
        }

        /// <summary>Returns a sensor whose source was destroyed after a round. Another source is at the origin.</summary>
        private Intensity MakeSensorOfDestroyedSource()
        {
            var sensor = MakeNode(0).Node.gameObject.AddComponent<Intensity>();
            MakeSource(Vector3.zero);
            var source = MakeSource(new Vector3(10, 0, 0));
            sensor.Source = source;
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(90));
            Object.Destroy(source.gameObject);
            Play(2);
            return sensor;
        }

        private static IntensitySource MakeSource(Vector3 place)
        {
            var source = new GameObject("Source").AddComponent<IntensitySource>();
            source.transform.position = place;
            return source;
        }

        public sealed class Position : PositionSensor<SensorData>
        {
            public Vector3 Value { get; private set; }

            protected override void Write(ref SensorData data, Vector3 position) => Value = position;
        }

        public sealed class Velocity : VelocitySensor<SensorData>
        {
            public Vector3 Value { get; private set; }

            protected override void Write(ref SensorData data, Vector3 velocity) => Value = velocity;
        }

        public sealed class Body : RigidbodySensor<SensorData>
        {
            public float Mass { get; private set; }

            protected override void Write(ref SensorData data, Rigidbody body) => Mass = body.mass;
        }

        public sealed class Obstacles : ObstacleSensor<SensorData>
        {
            public List<Obstacle> Values { get; } = new List<Obstacle>();

            protected override void Write(ref SensorData data, Span<Obstacle> obstacles)
            {
                Values.Clear();
                foreach (var obstacle in obstacles) Values.Add(obstacle);
            }
        }

        public sealed class Rays : RayFanSensor<SensorData>
        {
            public List<RayHit> Values { get; } = new List<RayHit>();

            protected override void Write(ref SensorData data, Span<RayHit> hits)
            {
                Values.Clear();
                foreach (var hit in hits) Values.Add(hit);
            }
        }

        public sealed class Contacts : ContactSensor<SensorData>
        {
            public List<Contact> Values { get; } = new List<Contact>();

            protected override void Write(ref SensorData data, Span<Contact> contacts)
            {
                Values.Clear();
                foreach (var contact in contacts) Values.Add(contact);
            }
        }

        public sealed class Zones : ZoneSensor<SensorData>
        {
            public List<string> Events { get; } = new List<string>();

            public Collider Last { get; private set; }

            protected override void Write(ref SensorData data, Span<Zone> zones)
            {
                foreach (var zone in zones)
                {
                    Last = zone.Collider;
                    Events.Add(zone.Left ? "left" : zone.Entered ? "entered" : "in");
                }
            }
        }

        public sealed class MeanVelocity : VelocitySensor<SensorData>
        {
            public Vector3 Value { get; private set; }

            protected override void Write(ref SensorData data, Vector3 velocity) => Value = velocity;
        }

        public sealed class Setter : Sensor<SensorData>
        {
            public Action Sensing { get; set; } = () => { };

            protected override void Sense(ref SensorData data) => Sensing();
        }

        public sealed class Intensity : IntensitySensor<SensorData>
        {
            public float Value { get; private set; }

            protected override void Write(ref SensorData data, float intensity) => Value = intensity;
        }
    }
}
