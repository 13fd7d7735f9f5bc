using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class TouchTests : PhysicsFixture
    {
        public class Listener : MonoBehaviour
        {
            public Collision Last;
            public ContactPoint Contact;
            public float Impulse;
            void OnTriggerEnter(Collider other) => Notes.Add(name + " enter " + other.name);
            void OnTriggerStay(Collider other) => Notes.Add(name + " stay " + other.name);
            void OnTriggerExit(Collider other) => Notes.Add(name + " exit " + other.name);

            void OnCollisionEnter(Collision collision)
            {
                Notes.Add(name + " hits " + collision.gameObject.name);
                Contact = collision.GetContact(0);
                Impulse = collision.impulse.y;
                Last = collision;
            }

            void OnCollisionExit() => Notes.Add(name + " leaves");
        }

        static Rigidbody Mover(Vector3 place)
        {
            var mover = Ball(place);
            mover.name = "mover";
            mover.isKinematic = true;
            return mover;
        }

        static BoxCollider Zone()
        {
            var zone = Box(Vector3.zero, Vector3.one);
            zone.name = "zone";
            zone.isTrigger = true;
            zone.gameObject.AddComponent<Listener>();
            return zone;
        }

        static void StepAt(Rigidbody body, float x)
        {
            body.transform.position = new Vector3(x, 0f, 0f);
            Physics.Simulate(Step);
        }

        [Test]
        public void Triggers_send_messages_before_collisions()
        {
            Box(Vector3.zero, Vector3.one).name = "wall";
            Ball(Vector3.zero).gameObject.AddComponent<Listener>();
            Zone();
            Physics.Simulate(Step);
            Assert.That(Notes[Notes.Count - 1], Is.EqualTo("ball hits wall"));
        }

        [Test]
        public void A_trigger_finds_a_body_that_was_inside_only_before_a_step()
        {
            Zone();
            var ball = Ball(Vector3.left, 0.05f);
            ball.useGravity = false;
            ball.linearVelocity = Vector3.right / Step;
            for (var step = 0; step < 3; step++) Physics.Simulate(Step);
            Assert.That(string.Join(", ", Notes), Is.EqualTo("zone enter ball, zone stay ball, zone exit ball"));
        }

        [TestCase(0.4f, "zone exit mover, zone enter mover, zone stay mover")]
        [TestCase(5f, "zone exit mover")]
        public void A_body_that_becomes_dynamic_leaves_its_triggers_and_enters_them_again(float place, string notes)
        {
            Zone();
            var mover = Mover(Vector3.zero);
            StepAt(mover, 0f);
            Notes.Clear();
            mover.isKinematic = false;
            StepAt(mover, place);
            Assert.That(string.Join(", ", Notes), Is.EqualTo(notes));
        }

        [TestCase(true)]
        [TestCase(false)]
        public void A_body_leaves_the_triggers_with_which_it_no_longer_collides(bool changesLayer)
        {
            var zone = Zone();
            var mover = Mover(Vector3.zero);
            Physics.IgnoreLayerCollision(0, 9);
            StepAt(mover, 0f);
            Notes.Clear();
            if (changesLayer) mover.gameObject.layer = 9;
            else Physics.IgnoreCollision(zone, mover.GetComponent<Collider>());
            StepAt(mover, 0f);
            Assert.That(Events(), Is.EqualTo("zone exit mover"));
        }

        [Test]
        public void Ignoring_another_pair_sends_exit_before_another_enter()
        {
            var zone = Zone();
            var mover = Mover(Vector3.zero);
            StepAt(mover, 0f);
            Notes.Clear();
            Physics.IgnoreCollision(zone, Ball(new Vector3(9f, 0f, 0f)).GetComponent<Collider>());
            StepAt(mover, 0f);
            Assert.That(string.Join(", ", Notes), Is.EqualTo("zone exit mover, zone enter mover, zone stay mover"));
        }

        [Test]
        public void Each_of_many_triggers_sends_exit_before_another_enter()
        {
            for (var index = 0; index < 60; index++) Zone().name = "zone" + index;
            var mover = Mover(Vector3.zero);
            StepAt(mover, 0f);
            Notes.Clear();
            mover.isKinematic = false;
            StepAt(mover, 0f);
            for (var index = 0; index < 60; index++)
            {
                var zone = "zone" + index + " ";
                Assert.That(string.Join(", ", Notes.FindAll(note => note.StartsWith(zone, System.StringComparison.Ordinal))),
                    Is.EqualTo(zone + "exit mover, " + zone + "enter mover, " + zone + "stay mover"));
            }
        }

        [Test]
        public void A_body_keeps_its_triggers_when_an_ignored_collider_is_deactivated()
        {
            Zone();
            var mover = Mover(Vector3.zero);
            var other = Ball(new Vector3(9f, 0f, 0f)).GetComponent<Collider>();
            Physics.IgnoreCollision(other, mover.GetComponent<Collider>());
            StepAt(mover, 0f);
            Notes.Clear();
            other.gameObject.SetActive(false);
            StepAt(mover, 0f);
            Assert.That(Events(), Is.EqualTo("zone stay mover"));
        }

        [TestCase(0)]
        [TestCase(8)]
        public void Ignoring_two_layers_keeps_the_triggers_of_other_layers(int layerOfAnotherCollider)
        {
            Zone();
            var mover = Mover(Vector3.zero);
            var other = new GameObject("other") { layer = layerOfAnotherCollider };
            other.transform.SetParent(mover.transform, false);
            other.transform.localPosition = new Vector3(9f, 0f, 0f);
            other.AddComponent<SphereCollider>();
            StepAt(mover, 0f);
            Notes.Clear();
            Physics.IgnoreLayerCollision(8, 9);
            StepAt(mover, 0f);
            Assert.That(Events(), Is.EqualTo("zone stay mover"));
        }

        [Test]
        public void Another_scale_of_a_mesh_collider_keeps_its_touches()
        {
            var cube = GameObject.CreatePrimitive(PrimitiveType.Cube);
            Object.DestroyImmediate(cube.GetComponent<Collider>());
            var collider = cube.AddComponent<MeshCollider>();
            collider.convex = true;
            collider.isTrigger = true;
            var mover = Mover(new Vector3(0.9f, 0f, 0f));
            mover.gameObject.AddComponent<Listener>();
            foreach (var scale in new[] { 1f, 1.5f, 2f, 0.5f, 0.5f })
            {
                cube.transform.localScale = scale * Vector3.one;
                Physics.Simulate(Step);
            }
            Assert.That(Events(), Is.EqualTo("mover enter Cube mover stay Cube mover stay Cube mover stay Cube mover exit Cube"));
        }

        [Test]
        public void Another_height_of_a_capsule_keeps_a_body_in_its_triggers()
        {
            Zone();
            var mover = Mover(Vector3.zero);
            mover.GetComponent<Collider>().enabled = false;
            var capsule = mover.gameObject.AddComponent<CapsuleCollider>();
            capsule.height = 2f;
            StepAt(mover, 0f);
            Notes.Clear();
            capsule.height = 1f;
            StepAt(mover, 0f);
            capsule.height = 2f;
            StepAt(mover, 0f);
            Assert.That(Events(), Is.EqualTo("zone stay mover zone stay mover"));
        }

        [Test]
        public void Another_detection_mode_keeps_a_body_in_its_triggers()
        {
            Zone();
            var mover = Mover(Vector3.zero);
            StepAt(mover, 0f);
            Notes.Clear();
            mover.collisionDetectionMode = CollisionDetectionMode.ContinuousSpeculative;
            mover.collisionDetectionMode = CollisionDetectionMode.Continuous;
            StepAt(mover, 0f);
            Assert.That(Events(), Is.EqualTo("zone stay mover"));
        }

        public class HitListener : MonoBehaviour
        {
            void OnCollisionEnter() => Notes.Add("hit");
            void OnCollisionExit() => Notes.Add("leave");
        }

        [TestCase(false)]
        [TestCase(true)]
        public void Another_script_or_detection_mode_does_not_repeat_a_collision(bool changesDetection)
        {
            Floor();
            var ball = Ball(new Vector3(0f, 0.5f, 0f));
            ball.gameObject.AddComponent<HitListener>();
            Run(0.1f);
            Assert.That(Events(), Is.EqualTo("hit"));
            if (changesDetection) ball.collisionDetectionMode = CollisionDetectionMode.Continuous;
            else ball.gameObject.AddComponent<Listener>();
            Notes.Clear();
            Run(0.1f);
            Assert.That(Events(), Is.EqualTo(""));
            var collider = ball.GetComponent<Collider>();
            ball.collisionDetectionMode = CollisionDetectionMode.Discrete;
            collider.enabled = false;
            collider.enabled = true;
            Run(0.1f);
            Assert.That(Events().StartsWith("hit"), Is.True, Events());
        }

        [TestCase(false)]
        [TestCase(true)]
        public void A_body_that_becomes_kinematic_collides_again_whatever_else_changes(bool changesOther)
        {
            Ball(new Vector3(0f, 0f, 0f)).useGravity = false;
            var ball = Ball(new Vector3(0.99f, 0f, 0f));
            var other = Ball(new Vector3(9f, 9f, 0f));
            ball.gameObject.AddComponent<HitListener>();
            Run(0.02f);
            if (changesOther) other.collisionDetectionMode = CollisionDetectionMode.Continuous;
            ball.isKinematic = true;
            Notes.Clear();
            Run(0.02f);
            Assert.That(Events(), Is.EqualTo("hit"));
        }

        [TestCase(true, true)]
        [TestCase(true, false)]
        [TestCase(false, true)]
        [TestCase(false, false)]
        public void A_kinematic_body_touches_dynamic_bodies_only(bool isFirst, bool isOtherKinematic)
        {
            var mover = isFirst ? Mover(new Vector3(5f, 0f, 0f)) : null;
            var other = Box(Vector3.zero, Vector3.one);
            if (isOtherKinematic) other.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            if (!isFirst) mover = Mover(new Vector3(5f, 0f, 0f));
            mover.gameObject.AddComponent<Listener>();
            for (var i = 0; i < 5; i++)
            {
                mover.MovePosition(new Vector3(0.8f - 0.1f * i, 0f, 0f));
                Physics.Simulate(Step);
            }
            Assert.That(Notes, Is.Empty);
            var ball = Ball(new Vector3(0f, 0.9f, 0f));
            ball.name = "ball";
            Physics.Simulate(Step);
            Assert.That(Notes, Is.EqualTo(new[] { "mover hits ball" }));
        }

        [Test]
        public void A_trigger_sends_enter_once_and_stay_in_every_step_then_exit()
        {
            Zone();
            var mover = Mover(new Vector3(5f, 0f, 0f));
            StepAt(mover, 5f);
            StepAt(mover, 0.8f);
            StepAt(mover, 0.4f);
            StepAt(mover, 0f);
            StepAt(mover, 5f);
            StepAt(mover, 5f);
            Assert.That(Events(), Is.EqualTo("zone enter mover zone stay mover zone stay mover zone stay mover zone exit mover"));
        }

        [TestCase(typeof(MeshCollider))]
        [TestCase(typeof(CapsuleCollider))]
        public void A_collider_that_turns_below_a_parent_keeps_its_touches(System.Type type)
        {
            var zone = GameObject.CreatePrimitive(PrimitiveType.Quad);
            Object.DestroyImmediate(zone.GetComponent<Collider>());
            zone.GetComponent<MeshFilter>().sharedMesh = GameObject.CreatePrimitive(PrimitiveType.Cube).GetComponent<MeshFilter>().sharedMesh;
            zone.transform.SetParent(new GameObject("parent").transform);
            var collider = (Collider)zone.AddComponent(type);
            if (collider is MeshCollider mesh) mesh.convex = true;
            collider.isTrigger = true;
            Mover(Vector3.zero).gameObject.AddComponent<Listener>();
            for (var step = 0; step < 100; step++)
            {
                zone.transform.Rotate(1f, 2f, 3f);
                Physics.Simulate(Step);
            }
            Assert.That(Notes.FindAll(note => note == "mover enter Quad").Count, Is.EqualTo(1));
        }

        [Test]
        public void Both_sides_receive_trigger_messages_even_disabled_ones()
        {
            Zone().GetComponent<Listener>().enabled = false;
            var mover = Mover(Vector3.zero);
            mover.gameObject.AddComponent<Listener>();
            Physics.Simulate(Step);
            Assert.That(Notes, Is.EquivalentTo(new[] { "zone enter mover", "mover enter zone", "zone stay mover", "mover stay zone" }));
        }

        [Test]
        public void Two_static_colliders_send_no_messages()
        {
            Zone();
            Box(Vector3.zero, Vector3.one);
            Physics.Simulate(Step);
            Assert.That(Notes, Is.Empty);
        }

        [Test]
        public void A_trigger_does_not_block_a_body()
        {
            Zone();
            var ball = Ball(new Vector3(0f, 3f, 0f));
            Run(2f);
            Assert.That(ball.transform.position.y, Is.LessThan(-5f));
            Assert.That(Notes[0], Is.EqualTo("zone enter ball"));
            Assert.That(Notes[Notes.Count - 1], Is.EqualTo("zone exit ball"));
        }

        [Test]
        public void Disabled_and_destroyed_colliders_send_no_exit()
        {
            Zone();
            var mover = Mover(Vector3.zero);
            Physics.Simulate(Step);
            mover.gameObject.SetActive(false);
            Physics.Simulate(Step);
            mover.gameObject.SetActive(true);
            Physics.Simulate(Step);
            Object.DestroyImmediate(mover.gameObject);
            Physics.Simulate(Step);
            Assert.That(Events(), Is.EqualTo("zone enter mover zone stay mover zone enter mover zone stay mover"));
        }

        [Test]
        public void A_trigger_of_a_child_sends_messages_to_the_body_too()
        {
            var parent = Mover(new Vector3(9f, 0f, 0f));
            parent.gameObject.AddComponent<Listener>();
            var child = new GameObject("child");
            child.transform.SetParent(parent.transform, false);
            var range = child.AddComponent<SphereCollider>();
            range.radius = 3f;
            range.isTrigger = true;
            child.AddComponent<Listener>();
            Box(new Vector3(11.5f, 0f, 0f), Vector3.one);
            Physics.Simulate(Step);
            Assert.That(Notes, Is.EquivalentTo(new[] { "child enter box", "mover enter box", "child stay box", "mover stay box" }));
        }

        [Test]
        public void A_collision_reports_its_point_speed_and_impulse()
        {
            Floor().name = "floor";
            var ball = Ball(new Vector3(2f, 3f, 1f));
            var listener = ball.gameObject.AddComponent<Listener>();
            var before = 0f;
            while (Notes.Count == 0)
            {
                before = ball.linearVelocity.y;
                Physics.Simulate(Step);
            }
            Assert.That(Events(), Is.EqualTo("ball hits floor"));
            Assert.That(listener.Last.relativeVelocity.y, Is.EqualTo(-before).Within(1e-3f));
            Assert.That(listener.Contact.normal == Vector3.up, Is.True);
            Assert.That(listener.Contact.thisCollider.name, Is.EqualTo("ball"));
            Assert.That((listener.Contact.point - new Vector3(2f, 0f, 1f)).magnitude, Is.LessThan(0.2f));
            Assert.That(listener.Impulse, Is.EqualTo(ball.linearVelocity.y - (before - 9.81f * Step)).Within(0.02f));
            ball.transform.position = new Vector3(2f, 3f, 1f);
            Physics.Simulate(Step);
            Assert.That(Events(), Is.EqualTo("ball hits floor ball leaves"));
        }

        [Test]
        public void A_moved_transform_affects_physics_only_after_a_sync()
        {
            var target = Box(Vector3.zero, Vector3.one);
            Physics.SyncTransforms();
            target.transform.position = new Vector3(10f, 0f, 0f);
            Assert.That(Physics.CheckSphere(Vector3.zero, 0.1f), Is.True);
            Assert.That(target.bounds.center, Is.EqualTo(Vector3.zero));
            Physics.SyncTransforms();
            Assert.That(Physics.CheckSphere(Vector3.zero, 0.1f), Is.False);
            Assert.That(Physics.CheckSphere(new Vector3(10f, 0f, 0f), 0.1f), Is.True);
        }

        [Test]
        public void A_moved_parent_moves_the_colliders_of_its_children()
        {
            var parent = new GameObject("parent").transform;
            Box(Vector3.zero, Vector3.one).transform.SetParent(parent);
            parent.position = new Vector3(0f, 7f, 0f);
            parent.localScale = new Vector3(2f, 2f, 2f);
            Physics.SyncTransforms();
            Assert.That(Physics.CheckSphere(new Vector3(0f, 7.95f, 0f), 0.01f), Is.True);
            Assert.That(Physics.CheckSphere(Vector3.zero, 0.1f), Is.False);
        }
    }
}
