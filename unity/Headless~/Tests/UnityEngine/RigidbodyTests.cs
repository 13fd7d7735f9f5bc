using System;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;
using Object = UnityEngine.Object;

namespace Collektive.Headless.Tests.Engine
{
    [TestFixture, Category("AnyPlacement")]
    public sealed class RigidbodyTests : PhysicsFixture
    {
        [Test]
        public void Setting_the_velocity_of_a_kinematic_body_logs_an_error_each_time()
        {
            var body = new GameObject("body").AddComponent<Rigidbody>();
            body.isKinematic = true;
            body.linearVelocity = Vector3.one;
            body.angularVelocity = Vector3.one;
            Assert.That(Errors, Is.EqualTo(new[]
            {
                "Setting linear velocity of a kinematic body is not supported.", "Setting angular velocity of a kinematic body is not supported.",
            }));
            Assert.That(body.linearVelocity, Is.EqualTo(Vector3.zero));
        }

        [Test]
        public void An_inactive_body_has_no_velocity()
        {
            var ball = Ball(Vector3.zero);
            ball.gameObject.SetActive(false);
            ball.linearVelocity = Vector3.one;
            ball.angularVelocity = Vector3.one;
            ball.gameObject.SetActive(true);
            Assert.That(ball.linearVelocity, Is.EqualTo(Vector3.zero));
            Assert.That(ball.angularVelocity, Is.EqualTo(Vector3.zero));
        }

        [Test]
        public void Free_fall_is_semi_implicit_Euler()
        {
            var ball = Ball(new Vector3(0f, 100f, 0f));
            Run(1f);
            const int steps = 50;
            Assert.That(ball.transform.position.y, Is.EqualTo(100f - 9.81f * Step * Step * steps * (steps + 1) / 2f).Within(1e-3f));
            Assert.That(ball.linearVelocity.y, Is.EqualTo(-9.81f).Within(1e-3f));
        }

        [Test]
        public void Damping_without_gravity_is_geometric()
        {
            var ball = Ball(Vector3.zero);
            ball.useGravity = false;
            ball.linearDamping = 1f;
            ball.linearVelocity = new Vector3(1f, 0f, 0f);
            Run(0.2f);
            Assert.That(ball.linearVelocity.x, Is.EqualTo(Mathf.Pow(0.98f, 10f)).Within(1e-4f));
        }

        [Test]
        public void Infinite_damping_stops_a_body()
        {
            var ball = Ball(Vector3.zero);
            ball.linearVelocity = Vector3.right;
            ball.linearDamping = float.PositiveInfinity;
            Physics.Simulate(Step);
            Assert.That(ball.linearVelocity == Vector3.zero, Is.True);
            Assert.That(Errors, Is.Empty);
        }

        [TestCase(ForceMode.Force, 0.01f)]
        [TestCase(ForceMode.Acceleration, 0.02f)]
        [TestCase(ForceMode.Impulse, 0.5f)]
        [TestCase(ForceMode.VelocityChange, 1f)]
        public void Force_modes_change_the_velocity_as_documented(ForceMode mode, float speedAfterOneStep)
        {
            var ball = Ball(Vector3.zero);
            ball.mass = 2f;
            ball.useGravity = false;
            ball.AddForce(Vector3.right, mode);
            Assert.That(ball.linearVelocity.x, Is.EqualTo(0f), "the force must have no effect before the step");
            Run(Step);
            Assert.That(ball.linearVelocity.x, Is.EqualTo(speedAfterOneStep).Within(1e-6f));
            Run(Step);
            Assert.That(ball.linearVelocity.x, Is.EqualTo(speedAfterOneStep).Within(1e-6f), "the force must last only one step");
        }

        [Test]
        public void Torque_accelerates_a_ball_by_its_inertia()
        {
            var ball = Ball(Vector3.zero);
            ball.useGravity = false;
            ball.angularDamping = 0f;
            ball.AddTorque(new Vector3(0f, 0.1f, 0f), ForceMode.Impulse);
            Run(Step);
            Assert.That(ball.angularVelocity.y, Is.EqualTo(0.1f / (0.4f * 0.5f * 0.5f)).Within(1e-3f));
        }

        [Test]
        public void A_ball_comes_to_rest_on_a_box()
        {
            Floor();
            var ball = Ball(new Vector3(0f, 2f, 0f));
            Run(4f);
            Assert.That(ball.transform.position.y, Is.EqualTo(0.5f).Within(0.01f));
            Assert.That(ball.linearVelocity.magnitude, Is.LessThan(0.01f));
        }

        [Test]
        public void A_wall_stops_a_pushed_ball()
        {
            Floor();
            Box(new Vector3(5f, 1.5f, 0f), new Vector3(1f, 3f, 5f));
            var ball = Ball(new Vector3(0f, 0.5f, 0f));
            for (var step = 0; step < 200; step++)
            {
                ball.AddForce(20f, 0f, 0f);
                Physics.Simulate(Step);
            }
            Assert.That(ball.transform.position.x, Is.EqualTo(4f).Within(0.05f));
        }

        [Test]
        public void A_ball_without_friction_keeps_its_speed()
        {
            Floor(Frictionless());
            var ball = Ball(new Vector3(-20f, 0.5f, 0f), material: Frictionless());
            Run(1f);
            ball.linearVelocity = new Vector3(4f, 0f, 0f);
            Run(5f);
            Assert.That(ball.linearVelocity.x, Is.EqualTo(4f).Within(1e-4f));
            Assert.That(ball.angularVelocity.magnitude, Is.LessThan(1e-4f));
            Assert.That(ball.transform.position.x, Is.EqualTo(0f).Within(1e-2f));
        }

        [Test]
        public void Friction_stops_a_sliding_box()
        {
            Physics.improvedPatchFriction = true;
            Floor();
            var box = Box(new Vector3(0f, 0.5f, 0f), Vector3.one).gameObject.AddComponent<Rigidbody>();
            Run(0.2f);
            box.linearVelocity = new Vector3(3f, 0f, 0f);
            Run(2f);
            Assert.That(box.linearVelocity.magnitude, Is.LessThan(0.01f));
            // The sliding distance is v^2 / (2 mu g).
            Assert.That(box.transform.position.x, Is.EqualTo(9f / (2f * 0.6f * 9.81f)).Within(0.1f));
        }

        [TestCase(0f, 0f, 0.05f)]
        [TestCase(0.8f, 2.56f, 0.4f)]
        public void Bounciness_determines_the_bounce_height(float bounciness, float heightAfterBounce, float tolerance)
        {
            var material = new PhysicsMaterial { bounciness = bounciness, bounceCombine = PhysicsMaterialCombine.Maximum };
            Floor(material);
            var ball = Ball(new Vector3(0f, 4.5f, 0f), material: material);
            Run(0.95f); // until after the impact
            var highest = 0f;
            for (var step = 0; step < 100; step++)
            {
                Physics.Simulate(Step);
                highest = Mathf.Max(highest, ball.transform.position.y - 0.5f);
            }
            Assert.That(highest, Is.EqualTo(heightAfterBounce).Within(tolerance));
        }

        [Test]
        public void MaxLinearVelocity_limits_the_speed()
        {
            var ball = Ball(Vector3.zero);
            ball.maxLinearVelocity = 5f;
            ball.AddForce(new Vector3(100f, 0f, 0f), ForceMode.VelocityChange);
            Run(1f);
            Assert.That(ball.linearVelocity.magnitude, Is.LessThanOrEqualTo(5.0001f));
        }

        [Test]
        public void A_frozen_rotation_does_not_change()
        {
            Floor();
            var ball = Ball(new Vector3(0f, 0.5f, 0f));
            ball.constraints = RigidbodyConstraints.FreezeRotation;
            Box(new Vector3(3f, 1f, 0.4f), new Vector3(1f, 2f, 1f));
            for (var step = 0; step < 300; step++)
            {
                ball.AddForce(15f, 0f, 0f);
                ball.AddTorque(5f, 5f, 5f);
                Physics.Simulate(Step);
            }
            Assert.That(ball.transform.rotation.Equals(Quaternion.identity), Is.True);
            Assert.That(ball.angularVelocity, Is.EqualTo(Vector3.zero));
        }

        [Test]
        public void Rotations_are_frozen_about_the_axes_of_the_inertia_tensor()
        {
            var ball = Ball(Vector3.zero);
            ball.angularDamping = 0f;
            ball.rotation = Quaternion.Euler(0f, 90f, 0f);
            ball.angularVelocity = new Vector3(0f, 0f, 5f);
            ball.constraints = RigidbodyConstraints.FreezeRotationX;
            ball.AddTorque(1f, 0f, 2f, ForceMode.VelocityChange);
            ball.AddTorque(0f, 0f, 2f, ForceMode.Impulse);
            Physics.Simulate(Step);
            Assert.That((ball.angularVelocity - Vector3.right).magnitude, Is.LessThan(1e-3f));
        }

        [Test]
        public void Setting_the_angular_velocity_skips_frozen_axes_at_once()
        {
            var ball = Ball(Vector3.zero);
            ball.rotation = Quaternion.Euler(0f, 90f, 0f);
            ball.constraints = RigidbodyConstraints.FreezeRotationX;
            ball.angularVelocity = new Vector3(0f, 1f, 5f);
            Assert.That((ball.angularVelocity - Vector3.up).magnitude, Is.LessThan(1e-5f));
            ball.constraints = RigidbodyConstraints.FreezeRotation;
            ball.angularVelocity = Vector3.one;
            Assert.That(ball.angularVelocity, Is.EqualTo(Vector3.zero));
        }

        [Test]
        public void A_body_with_a_frozen_rotation_does_not_keep_the_spin_of_its_kinematic_motion()
        {
            var ball = Ball(Vector3.zero);
            ball.constraints = RigidbodyConstraints.FreezeRotation;
            ball.isKinematic = true;
            ball.MoveRotation(Quaternion.Euler(0f, 5f, 0f));
            Physics.Simulate(Step);
            ball.isKinematic = false;
            Physics.Simulate(Step);
            Assert.That(ball.angularVelocity, Is.EqualTo(Vector3.zero));
        }

        [Test]
        public void Friction_holds_a_ball_whose_rotation_is_frozen()
        {
            Floor();
            var ball = Ball(new Vector3(0f, 0.5f, 0f));
            ball.constraints = RigidbodyConstraints.FreezeRotation;
            for (var step = 0; step < 100; step++)
            {
                ball.AddForce(5f, 0f, 0f);
                Physics.Simulate(Step);
            }
            Assert.That(ball.position.x, Is.EqualTo(0f).Within(1e-3f));
        }

        [Test]
        public void A_frozen_axis_does_not_change_and_the_others_move()
        {
            var ball = Ball(new Vector3(0f, 1f, 0f));
            ball.constraints = RigidbodyConstraints.FreezePositionY | RigidbodyConstraints.FreezeRotation;
            ball.linearVelocity = new Vector3(1f, 0f, 0f);
            Run(1f);
            Assert.That(ball.transform.position.y, Is.EqualTo(1f));
            Assert.That(ball.transform.position.x, Is.EqualTo(1f).Within(1e-4f));
        }

        [Test]
        public void A_kinematic_body_pushes_and_is_not_pushed()
        {
            Floor(Frictionless());
            var ball = Ball(new Vector3(1.2f, 0.5f, 0f), material: Frictionless());
            var pusher = Box(new Vector3(0f, 0.5f, 0f), Vector3.one).gameObject.AddComponent<Rigidbody>();
            pusher.isKinematic = true;
            for (var step = 1; step <= 100; step++)
            {
                pusher.MovePosition(new Vector3(step * 0.02f, 0.5f, 0f));
                Physics.Simulate(Step);
            }
            Assert.That(pusher.transform.position.x, Is.EqualTo(2f).Within(1e-4f));
            Assert.That(pusher.transform.position.y, Is.EqualTo(0.5f));
            Assert.That(ball.transform.position.x, Is.GreaterThan(2.95f));
        }

        [Test]
        public void A_kinematic_body_wakes_and_pushes_bodies_when_its_transform_moves()
        {
            Floor(Frictionless());
            var box = Box(new Vector3(0f, 0.5f, 0f), Vector3.one).gameObject.AddComponent<Rigidbody>();
            var pusher = Box(new Vector3(-2f, 0.5f, 0f), Vector3.one).gameObject.AddComponent<Rigidbody>();
            pusher.isKinematic = true;
            Run(1f);
            Assert.That(box.IsSleeping(), Is.True);
            for (var step = 0; step < 100; step++)
            {
                pusher.transform.position += new Vector3(0.02f, 0f, 0f);
                var place = pusher.transform.position;
                Physics.Simulate(Step);
                Assert.That(pusher.transform.position, Is.EqualTo(place));
                Assert.That(pusher.linearVelocity, Is.EqualTo(Vector3.zero));
            }
            Assert.That(box.position.x, Is.GreaterThan(0.9f));
        }

        [Test]
        public void A_kinematic_body_moves_to_its_target_from_where_its_transform_is()
        {
            var body = new GameObject("body").AddComponent<Rigidbody>();
            body.isKinematic = true;
            body.MovePosition(new Vector3(1f, 0f, 0f));
            body.transform.position = new Vector3(0.5f, 0f, 0f);
            Run(Step);
            Assert.That(body.position.x, Is.EqualTo(1f).Within(1e-4f));
            Assert.That(body.linearVelocity.x, Is.EqualTo(0.5f / Step).Within(1e-2f));
        }

        [Test]
        public void MoveRotation_does_not_move_a_dynamic_body()
        {
            var ball = Ball(Vector3.zero);
            ball.MovePosition(Vector3.right);
            ball.position = Vector3.left;
            ball.MoveRotation(Quaternion.Euler(0f, 5f, 0f));
            Assert.That(ball.position, Is.EqualTo(Vector3.left));
        }

        [Test]
        public void A_moving_kinematic_body_keeps_its_velocity_when_it_becomes_dynamic()
        {
            var ball = Ball(Vector3.zero);
            ball.useGravity = false;
            ball.isKinematic = true;
            ball.MovePosition(new Vector3(0.1f, 0f, 0f));
            Physics.Simulate(Step);
            ball.isKinematic = false;
            Assert.That(ball.linearVelocity.x, Is.EqualTo(5f).Within(1e-3f));
            Physics.Simulate(Step);
            Assert.That(ball.linearVelocity.x, Is.EqualTo(5f).Within(1e-3f));
        }

        [Test]
        public void Child_colliders_belong_to_the_body_and_determine_its_centre_of_mass()
        {
            var body = new GameObject("body");
            foreach (var x in new[] { 1f, 3f })
            {
                var part = new GameObject("part");
                part.transform.SetParent(body.transform);
                part.transform.localPosition = new Vector3(x, 0f, 0f);
                part.AddComponent<SphereCollider>();
            }
            var rigidbody = body.AddComponent<Rigidbody>();
            Assert.That(body.transform.GetChild(0).GetComponent<Collider>().attachedRigidbody, Is.SameAs(rigidbody));
            Assert.That((rigidbody.worldCenterOfMass - new Vector3(2f, 0f, 0f)).magnitude, Is.LessThan(1e-5f));
            rigidbody.useGravity = false;
            rigidbody.angularDamping = 0f;
            rigidbody.angularVelocity = new Vector3(0f, Mathf.PI, 0f); // half a turn a second about the centre
            Run(1f);
            Assert.That((body.transform.position - new Vector3(4f, 0f, 0f)).magnitude, Is.LessThan(0.05f));
            Assert.That((body.transform.GetChild(1).GetComponent<Collider>().bounds.center - new Vector3(1f, 0f, 0f)).magnitude, Is.LessThan(0.05f));
        }

        [TestCase(true)]
        [TestCase(false)]
        public void A_kinematic_child_follows_its_parents_body(bool isThrown)
        {
            var parent = Add<Rigidbody>("parent");
            parent.useGravity = false;
            var middle = new GameObject("middle");
            middle.transform.SetParent(parent.transform);
            var zone = new GameObject("zone").AddComponent<SphereCollider>();
            zone.isTrigger = true;
            zone.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            zone.transform.SetParent(middle.transform);
            zone.transform.localPosition = new Vector3(0f, 2f, 0f);
            if (isThrown) parent.linearVelocity = new Vector3(5f, 0f, 0f);
            else parent.position = new Vector3(5f, 0f, 0f);
            Run(1f);
            Physics.SyncTransforms();
            Assert.That((zone.transform.position - new Vector3(5f, 2f, 0f)).magnitude, Is.LessThan(1e-3f));
            Assert.That((zone.bounds.center - zone.transform.position).magnitude, Is.LessThan(1e-3f));
        }

        [Test]
        public void Changes_of_gravity_constraints_mass_and_colliders_wake_a_sleeping_body()
        {
            Wakes(body => body.useGravity = true);
            Wakes(body => body.constraints = RigidbodyConstraints.FreezePositionY);
            Wakes(body => body.mass = 2f);
            Wakes(body => body.centerOfMass = Vector3.up);
            Wakes(body => body.inertiaTensor = Vector3.one);
            Wakes(body => body.GetComponent<Collider>().enabled = false);
            Wakes(body => body.gameObject.AddComponent<BoxCollider>());
            Wakes(body => (body.useGravity, body.constraints, body.mass) = (false, RigidbodyConstraints.None, 1f), false);

            static void Wakes(Action<Rigidbody> change, bool wakes = true)
            {
                var ball = Ball(Vector3.zero);
                ball.useGravity = false;
                ball.Sleep();
                Physics.Simulate(Step);
                change(ball);
                Assert.That(ball.IsSleeping(), Is.EqualTo(!wakes));
                Physics.Simulate(Step);
                Assert.That(ball.IsSleeping(), Is.EqualTo(!wakes));
                Object.DestroyImmediate(ball.gameObject);
            }
        }

        [Test]
        public void A_force_wakes_a_sleeping_body_unless_it_is_zero()
        {
            var ball = Ball(new Vector3(0f, 5f, 0f));
            ball.Sleep();
            ball.AddForceAtPosition(Vector3.zero, Vector3.right);
            Run(0.2f);
            Assert.That(ball.IsSleeping(), Is.True);
            Assert.That(ball.transform.position.y, Is.EqualTo(5f));
            ball.AddForce(Vector3.right);
            Run(0.2f);
            Assert.That(ball.IsSleeping(), Is.False);
            Assert.That(ball.transform.position.y, Is.LessThan(5f));
        }

        [TestCase(float.NaN)]
        [TestCase(float.PositiveInfinity)]
        public void Non_finite_values_are_rejected_and_change_nothing(float bad)
        {
            var ball = Ball(new Vector3(1f, 2f, 3f));
            ball.useGravity = false;
            ball.transform.position = new Vector3(bad, 0f, 0f);
            ball.transform.rotation = new Quaternion(bad, 0f, 0f, 1f);
            ball.linearVelocity = new Vector3(0f, bad, 0f);
            ball.AddForce(0f, 0f, bad);
            ball.position = new Vector3(bad, 0f, 0f);
            Run(0.1f);
            Assert.That(ball.transform.position, Is.EqualTo(new Vector3(1f, 2f, 3f)));
            Assert.That(Errors.Count, Is.EqualTo(5));
            Assert.That(Errors[0], Is.StringContaining("'ball'"));
        }

        [Test]
        public void Rotations_that_are_not_of_unit_length_are_rejected_and_change_nothing()
        {
            var ball = Ball(Vector3.zero);
            var turn = Quaternion.Euler(0f, 90f, 0f);
            ball.rotation = turn;
            ball.rotation = default;
            ball.MoveRotation(new Quaternion(0f, 1f, 0f, 1f));
            Assert.That(ball.rotation == turn, Is.True);
            Assert.That(Errors.Count, Is.EqualTo(2));
            Assert.That(Errors[0], Is.StringContaining("'ball'"));
        }

        [Test]
        public void A_pose_that_is_set_before_the_first_step_is_kept()
        {
            var prefab = Ball(Vector3.zero);
            prefab.useGravity = false;
            var copy = Object.Instantiate(prefab, new Vector3(1f, 2f, 3f), Quaternion.identity);
            copy.position = new Vector3(4f, 5f, 6f);
            copy.rotation = Quaternion.Euler(0f, 90f, 0f);
            Run(Step);
            Assert.That(copy.position, Is.EqualTo(new Vector3(4f, 5f, 6f)));
            Assert.That(copy.transform.position, Is.EqualTo(copy.position));
            Assert.That(copy.transform.eulerAngles.y, Is.EqualTo(90f).Within(0.01f));
            copy.transform.position = new Vector3(9f, 0f, 0f);
            Run(Step);
            Assert.That(copy.position, Is.EqualTo(new Vector3(9f, 0f, 0f)), "later changes of the transform must move the body");
        }

        [Test]
        public void Setting_the_body_position_moves_the_transform_at_the_next_step()
        {
            var ball = Ball(Vector3.zero);
            ball.useGravity = false;
            ball.linearVelocity = new Vector3(1f, 0f, 0f);
            Run(0.2f);
            ball.position = new Vector3(5f, 0f, 0f);
            Assert.That(ball.position.x, Is.EqualTo(5f));
            Assert.That(ball.transform.position.x, Is.EqualTo(0.2f).Within(1e-4f));
            Run(0.1f);
            Assert.That(ball.transform.position.x, Is.EqualTo(5.1f).Within(1e-4f));
        }

        [Test]
        public void Another_scale_keeps_the_position_that_a_script_set_for_the_body()
        {
            var ball = Ball(Vector3.zero);
            ball.useGravity = false;
            Run(Step);
            ball.position = new Vector3(5f, 0f, 0f);
            ball.transform.localScale = new Vector3(2f, 2f, 2f);
            Run(Step);
            Assert.That(ball.transform.position, Is.EqualTo(new Vector3(5f, 0f, 0f)));
            Assert.That(ball.GetComponent<Collider>().bounds.size.x, Is.EqualTo(2f).Within(1e-4f));
        }

        [Test]
        public void SetParent_can_keep_the_local_pose_of_a_moved_body()
        {
            var parent = new GameObject("parent").transform;
            parent.position = new Vector3(0f, 0f, 10f);
            var ball = Ball(Vector3.zero);
            ball.useGravity = false;
            ball.linearVelocity = new Vector3(1f, 0f, 0f);
            Run(0.2f);
            ball.transform.SetParent(parent, false);
            Assert.That(ball.transform.localPosition.x, Is.EqualTo(0.2f).Within(1e-4f));
            Assert.That(ball.transform.position.z, Is.EqualTo(10f).Within(1e-4f));
            Run(0.2f);
            Assert.That(ball.transform.localPosition.x, Is.EqualTo(0.4f).Within(1e-4f));
            Assert.That(ball.transform.position.z, Is.EqualTo(10f).Within(1e-4f));
        }

        [Test]
        public void Layers_and_pairs_can_be_ignored()
        {
            Floor().gameObject.layer = 8;
            Ball(new Vector3(0f, 1f, 0f)).gameObject.layer = 9;
            Physics.IgnoreLayerCollision(8, 9);
            var through = Ball(new Vector3(5f, 1f, 0f));
            Physics.IgnoreCollision(through.GetComponent<Collider>(), Object.FindAnyObjectByType<BoxCollider>());
            var stays = Ball(new Vector3(-5f, 1f, 0f));
            Run(2f);
            Assert.That(through.transform.position.y, Is.LessThan(-2f));
            Assert.That(stays.transform.position.y, Is.EqualTo(0.5f).Within(0.01f));
        }

        [TestCase(true)]
        [TestCase(false)]
        public void A_collider_that_is_disabled_or_deactivated_collides_again_with_ignored_ones(bool deactivates)
        {
            var floor = Floor();
            var ball = Ball(new Vector3(0f, 1f, 0f)).GetComponent<Collider>();
            Physics.IgnoreCollision(ball, floor);
            if (deactivates) ball.gameObject.SetActive(false);
            else floor.enabled = false;
            Assert.That(Physics.GetIgnoreCollision(floor, ball), Is.False);
            ball.gameObject.SetActive(true);
            floor.enabled = true;
            Run(2f);
            Assert.That(ball.transform.position.y, Is.EqualTo(0.5f).Within(0.01f));
        }

        [Test]
        public void Collisions_of_an_inactive_collider_cannot_be_ignored()
        {
            var floor = Floor();
            var ball = Ball(new Vector3(0f, 1f, 0f)).GetComponent<Collider>();
            ball.gameObject.SetActive(false);
            Physics.IgnoreCollision(floor, ball);
            ball.gameObject.SetActive(true);
            Run(2f);
            Assert.That(ball.transform.position.y, Is.EqualTo(0.5f).Within(0.01f));
            Assert.That(Errors, Is.EqualTo(new[] { "Physics.IgnoreCollision has no effect: the collider of 'ball' is disabled or inactive." }));
        }

        [Test]
        public void Removing_the_body_leaves_a_static_collider()
        {
            var ball = Ball(new Vector3(0f, 5f, 0f));
            Object.DestroyImmediate(ball);
            Run(0.2f);
            var collider = Object.FindAnyObjectByType<SphereCollider>();
            Assert.That(collider.attachedRigidbody == null, Is.True);
            var other = Ball(new Vector3(0f, 7f, 0f));
            other.constraints = RigidbodyConstraints.FreezePositionX | RigidbodyConstraints.FreezePositionZ;
            Run(3f);
            Assert.That(other.transform.position.y, Is.EqualTo(6f).Within(0.01f));
        }

        [Test]
        public void FixedUpdate_steps_physics_except_in_script_mode()
        {
            Physics.simulationMode = SimulationMode.FixedUpdate;
            var ball = Ball(new Vector3(0f, 5f, 0f));
            Loop.Frame(0.1f);
            Assert.That(ball.transform.position.y, Is.LessThan(5f));
            Physics.Simulate(Step);
            Assert.That(Errors.Count, Is.EqualTo(1));
            Physics.simulationMode = SimulationMode.Script;
            var height = ball.transform.position.y;
            Loop.Frame(0.1f);
            Assert.That(ball.transform.position.y, Is.EqualTo(height));
        }
    }
}
