using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class TransformTests : PlayerFixture
    {
        const int Trials = 200;

        static System.Random random;

        [SetUp]
        public void Seed() => random = new System.Random(42);

        static float Number(float least, float most) => least + (float)random.NextDouble() * (most - least);
        static Vector3 Vector(float size) => new Vector3(Number(-size, size), Number(-size, size), Number(-size, size));
        static Quaternion RandomRotation() => Quaternion.Euler(Number(-180f, 180f), Number(-180f, 180f), Number(-180f, 180f));

        static Transform Chain(int depth)
        {
            Transform last = null;
            for (var level = 0; level < depth; level++)
            {
                var next = new GameObject().transform;
                next.SetParent(last, false);
                next.localPosition = Vector(10f);
                next.localRotation = RandomRotation();
                next.localScale = new Vector3(Number(0.5f, 2f), Number(0.5f, 2f), Number(0.5f, 2f));
                last = next;
            }
            return last;
        }

        static void Near(Vector3 actual, Vector3 expected, float tolerance = 1e-2f) =>
            Assert.That((actual - expected).magnitude, Is.LessThan(tolerance), $"{actual} is not {expected}");

        [Test]
        public void Points_vectors_and_directions_round_trip_through_world_space()
        {
            for (var trial = 0; trial < Trials; trial++)
            {
                var transform = Chain(1 + trial % 4);
                var value = Vector(5f);
                Near(transform.InverseTransformPoint(transform.TransformPoint(value)), value);
                Near(transform.InverseTransformVector(transform.TransformVector(value)), value);
                Near(transform.InverseTransformDirection(transform.TransformDirection(value)), value);
                Near(transform.localToWorldMatrix.MultiplyPoint3x4(value), transform.TransformPoint(value));
                Near(transform.worldToLocalMatrix.MultiplyPoint3x4(transform.TransformPoint(value)), value);
            }
        }

        [Test]
        public void A_mirrored_parent_mirrors_rotations_of_children()
        {
            for (var trial = 0; trial < Trials; trial++)
            {
                var transform = Chain(1 + trial % 5);
                for (var level = transform; level != null; level = level.parent)
                {
                    var size = level == transform ? level.localScale : Vector3.one;
                    level.localScale = Vector3.Scale(size, new Vector3(random.Next(2) * 2 - 1, random.Next(2) * 2 - 1, random.Next(2) * 2 - 1));
                }
                var value = Vector(5f);
                Near(transform.position + transform.rotation * Vector3.Scale(transform.lossyScale, value), transform.TransformPoint(value));
                var rotation = RandomRotation();
                transform.rotation = rotation;
                Assert.That(Quaternion.Angle(transform.rotation, rotation), Is.LessThan(0.1f));
                var position = Vector(5f);
                transform.SetPositionAndRotation(position, rotation);
                Near(transform.position + rotation * Vector3.Scale(transform.lossyScale, value), transform.TransformPoint(value));
            }
        }

        [Test]
        public void SetPositionAndRotation_sets_the_world_pose()
        {
            for (var trial = 0; trial < Trials; trial++)
            {
                var transform = Chain(1 + trial % 4);
                var position = Vector(20f);
                var rotation = RandomRotation();
                transform.SetPositionAndRotation(position, rotation);
                Near(transform.position, position);
                Assert.That(Quaternion.Angle(transform.rotation, rotation), Is.LessThan(0.1f));
            }
        }

        [Test]
        public void SetParent_keeps_the_world_pose()
        {
            for (var trial = 0; trial < Trials; trial++)
            {
                Transform child = Chain(2), parent = Chain(1);
                var position = child.position;
                var rotation = child.rotation;
                child.SetParent(parent);
                Near(child.position, position);
                Assert.That(Quaternion.Angle(child.rotation, rotation), Is.LessThan(0.1f));
                Assert.That(child.parent, Is.SameAs(parent));
            }
        }

        [Test]
        public void SetParent_keeps_the_world_scale_of_a_turned_child_of_a_stretched_parent()
        {
            var parent = new GameObject("parent").transform;
            parent.localScale = new Vector3(2f, 1f, 1f);
            var child = new GameObject("child").transform;
            child.rotation = Quaternion.Euler(0f, 90f, 0f);
            child.SetParent(parent);
            Near(child.localScale, new Vector3(1f, 1f, 0.5f), 1e-5f);
            Near(child.lossyScale, Vector3.one, 1e-5f);
            child.SetParent(null);
            Near(child.localScale, Vector3.one, 1e-5f);
        }

        [Test]
        public void Local_coordinates_are_0_along_axes_with_a_scale_of_0()
        {
            var flat = new GameObject("flat").transform;
            flat.localScale = new Vector3(2f, 0f, 1f);
            Near(flat.InverseTransformPoint(Vector3.one), new Vector3(0.5f, 0f, 1f), 1e-5f);
            Near(flat.worldToLocalMatrix.MultiplyPoint3x4(Vector3.one), new Vector3(0.5f, 0f, 1f), 1e-5f);
            var child = new GameObject("child").transform;
            child.SetParent(flat);
            child.position = Vector3.one;
            Near(child.position, new Vector3(1f, 0f, 1f), 1e-5f);
            Near(child.localScale, new Vector3(0.5f, 0f, 1f), 1e-5f);
        }

        [Test]
        public void World_values_match_known_values()
        {
            var parent = new GameObject("parent").transform;
            parent.position = new Vector3(1f, 2f, 3f);
            parent.rotation = Quaternion.Euler(0f, 90f, 0f);
            parent.localScale = new Vector3(2f, 2f, 2f);
            var child = new GameObject("child").transform;
            child.SetParent(parent, false);
            child.localPosition = new Vector3(0f, 0f, 1f);
            Near(child.position, new Vector3(3f, 2f, 3f), 1e-5f);
            Near(child.forward, Vector3.right, 1e-5f);
            Near(child.lossyScale, new Vector3(2f, 2f, 2f), 1e-5f);
            child.Translate(0f, 0f, 1f);
            Near(child.position, new Vector3(4f, 2f, 3f), 1e-5f);
            child.LookAt(child.position + Vector3.back);
            Near(child.forward, Vector3.back, 1e-5f);
            child.LookAt(child);
            Near(child.forward, Vector3.back, 1e-5f);
        }

        [Test]
        public void Siblings_keep_their_order_and_cycles_are_rejected()
        {
            var root = new GameObject("root").transform;
            foreach (var name in new[] { "a", "b", "c" }) new GameObject(name).transform.SetParent(root);
            root.GetChild(2).SetAsFirstSibling();
            Assert.That(root.childCount, Is.EqualTo(3));
            Assert.That(root.GetChild(0).name, Is.EqualTo("c"));
            Assert.That(root.Find("b").GetSiblingIndex(), Is.EqualTo(2));
            Assert.That(root.GetChild(1).IsChildOf(root), Is.True);
            Assert.Throws<System.ArgumentNullException>(() => root.IsChildOf(null));
            new GameObject("a").transform.SetParent(root);
            new GameObject("leaf").transform.SetParent(root.GetChild(3));
            Assert.That(root.Find("a/leaf").parent.GetSiblingIndex(), Is.EqualTo(3), "of two children with the name a, the second has the leaf");
            Object.DestroyImmediate(root.GetChild(3).gameObject);
            root.SetParent(root.GetChild(1));
            Assert.That(root.parent, Is.Null);
            Assert.That(Errors.Count, Is.EqualTo(1));
            root.DetachChildren();
            Assert.That(root.childCount, Is.EqualTo(0));
        }

        [TestCase("", "arm")]
        [TestCase("hand/", "hand")]
        [TestCase("..", "robot")]
        [TestCase("../", "robot")]
        [TestCase("../leg", "leg")]
        [TestCase("hand/../../leg", "leg")]
        [TestCase("../..", null)]
        [TestCase("/robot", "robot")]
        [TestCase("/robot/leg", "leg")]
        [TestCase("/leg", null)]
        public void Find_follows_paths_upwards_and_from_the_roots(string path, string expected)
        {
            Transform robot = new GameObject("robot").transform, arm = new GameObject("arm").transform;
            arm.SetParent(robot);
            new GameObject("hand").transform.SetParent(arm);
            new GameObject("leg").transform.SetParent(robot);
            robot.gameObject.SetActive(false);
            Assert.That(arm.Find(path)?.name, Is.EqualTo(expected));
        }

        public class Parent : MonoBehaviour
        {
            void OnTransformChildrenChanged() => Notes.Add(name + " " + transform.childCount);
        }

        [Test]
        public void A_parent_receives_a_message_when_its_children_change()
        {
            Transform a = Add<Parent>("a").transform, b = Add<Parent>("b").transform;
            Transform first = new GameObject("first").transform, second = new GameObject("second").transform;
            first.SetParent(a);
            second.parent = a;
            second.SetSiblingIndex(0);
            second.SetSiblingIndex(0);
            first.SetParent(b);
            Object.DestroyImmediate(first.gameObject);
            Object.Instantiate(second.gameObject, b);
            b.gameObject.SetActive(false);
            second.SetParent(b);
            Assert.That(Events(), Is.EqualTo("a 1 a 2 a 2 a 1 b 1 b 0 b 1 a 0"));
        }

        public class Destroyer : MonoBehaviour
        {
            void OnTransformParentChanged() => Object.DestroyImmediate(transform.parent.gameObject);
        }

        [Test]
        public void A_script_can_destroy_its_new_parent()
        {
            var child = Add<Destroyer>().transform;
            var parent = Add<Parent>().gameObject;
            child.SetParent(parent.transform);
            Assert.That(!parent && !child, Is.True);
            Assert.That(Errors, Is.Empty);
        }

        public class Leaver : MonoBehaviour
        {
            public Transform Child, Other;

            void OnDisable()
            {
                Child.SetParent(null);
                Other.SetParent(transform);
                if (!gameObject.activeInHierarchy) transform.SetParent(Other);
            }
        }

        [Test]
        public void Children_cannot_leave_or_join_a_parent_that_is_being_activated_or_deactivated()
        {
            var script = Add<Leaver>("Parent");
            script.Child = new GameObject("Child").transform;
            script.Other = new GameObject("Other").transform;
            script.Child.SetParent(script.transform);
            script.gameObject.SetActive(false);
            Assert.That((script.Child.parent, script.Other.parent, script.transform.parent), Is.EqualTo((script.transform, (Transform)null, script.Other)));
            Assert.That(Errors, Is.EqualTo(new[]
            {
                "Cannot set the parent of the GameObject 'Child' while activating or deactivating the parent GameObject 'Parent'.",
                "Cannot set the parent of the GameObject 'Other' while activating or deactivating the parent GameObject 'Parent'.",
            }));
            script.transform.SetParent(null);
            script.gameObject.SetActive(true);
            script.enabled = false;
            Assert.That((script.Child.parent, script.Other.parent), Is.EqualTo(((Transform)null, script.transform)));
        }

        [Test]
        public void A_rotation_towards_a_zero_vector_is_logged()
        {
            var thing = new GameObject().transform;
            thing.forward = Vector3.zero;
            Assert.That(thing.rotation, Is.EqualTo(Quaternion.identity));
            Assert.That(Errors, Is.EqualTo(new[] { "Look rotation viewing vector is zero" }));
        }

        [Test]
        public void A_negative_sibling_index_changes_nothing()
        {
            var parent = new GameObject().transform;
            var child = new GameObject().transform;
            child.SetParent(parent);
            Assert.Throws<System.ArgumentOutOfRangeException>(() => child.SetSiblingIndex(-1));
            Assert.That(parent.childCount, Is.EqualTo(1));
        }

        [Test]
        public void Children_can_be_moved_while_they_are_enumerated()
        {
            var parent = new GameObject().transform;
            for (var count = 0; count < 4; count++) new GameObject().transform.SetParent(parent);
            foreach (Transform child in parent) child.SetParent(null);
            Assert.That(parent.childCount, Is.EqualTo(2));
        }

        [Test]
        public void A_child_has_changed_if_its_parent_moved()
        {
            var parent = new GameObject().transform;
            var child = new GameObject().transform;
            child.SetParent(parent);
            Assert.That(child.hasChanged, Is.True);
            child.hasChanged = false;
            Assert.That(child.hasChanged, Is.False);
            parent.position = Vector3.up;
            Assert.That(child.hasChanged, Is.True);
        }

        [Test]
        public void LookAt_without_a_target_does_nothing() => new GameObject().transform.LookAt((Transform)null);

        [Test]
        public void A_name_is_never_null()
        {
            var holder = new GameObject((string)null);
            Assert.That(holder.name, Is.EqualTo(""));
            Assert.That(GameObject.Find("other") == null, Is.True);
        }
    }
}
