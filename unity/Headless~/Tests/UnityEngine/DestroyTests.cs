using System.Collections;
using System.Collections.Generic;
using System.Reflection;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class DestroyTests : PlayerFixture
    {
        public class Part : MonoBehaviour
        {
            void OnDisable() => Notes.Add(name + ".OnDisable");
            void OnDestroy() => Notes.Add(name + ".OnDestroy");
        }

        [Test]
        public void Destroy_waits_for_the_end_of_the_frame()
        {
            var part = Add<Part>("a");
            Object.Destroy(part);
            Assert.That(part != null, Is.True);
            Loop.Frame(0.01f);
            Assert.That(part == null, Is.True);
            Assert.That(Events(), Is.EqualTo("a.OnDisable a.OnDestroy"));
        }

        [Test]
        public void A_destroyed_object_equals_null_but_is_not_null()
        {
            var holder = new GameObject("a");
            var part = holder.AddComponent<Part>();
            Object.DestroyImmediate(holder);
            Assert.That(part == null, Is.True);
            Assert.That(part.Equals(null), Is.True);
            Assert.That((bool)part, Is.False);
            Assert.That(part is null, Is.False);
            Assert.That(part.ToString(), Is.EqualTo("null"));
            Assert.Throws<MissingReferenceException>(() => _ = part?.enabled);
            Assert.Throws<MissingReferenceException>(() => _ = part.transform);
            Assert.Throws<MissingReferenceException>(() => _ = holder.name);
        }

        [Test]
        public void Two_destroyed_objects_differ()
        {
            GameObject first = new GameObject("first"), second = new GameObject("second");
            Object.DestroyImmediate(first);
            Object.DestroyImmediate(second);
            Assert.That(first == second, Is.False);
            Assert.That(new List<GameObject> { first, second }.IndexOf(second), Is.EqualTo(1));
        }

        [Test]
        public void Children_are_destroyed_with_their_parent_after_all_are_disabled()
        {
            var parent = Add<Part>("p");
            var child = Add<Part>("c");
            child.transform.SetParent(parent.transform);
            Object.Destroy(parent.gameObject);
            Loop.Frame(0.01f);
            Assert.That(child == null, Is.True);
            Assert.That(Events(), Is.EqualTo("p.OnDisable c.OnDisable p.OnDestroy c.OnDestroy"));
        }

        public class DestroyHandler : MonoBehaviour
        {
            public System.Action OnDestroyed;
            void Update() => Notes.Add("Update");
            void OnDestroy()
            {
                Notes.Add("OnDestroy");
                OnDestroyed();
            }
        }

        [Test]
        public void An_object_is_destroyed_once_although_its_script_destroys_it_again()
        {
            DestroyHandler script = Add<DestroyHandler>(), component = Add<DestroyHandler>();
            var holder = script.gameObject;
            script.OnDestroyed = () => Object.DestroyImmediate(holder);
            Object.DestroyImmediate(holder);
            component.OnDestroyed = () => Object.DestroyImmediate(component);
            Object.DestroyImmediate(component);
            Assert.That(Events(), Is.EqualTo("OnDestroy OnDestroy"));
        }

        [Test]
        public void A_destroyed_object_cannot_be_activated()
        {
            var script = Add<DestroyHandler>();
            var holder = script.gameObject;
            script.OnDestroyed = () => holder.SetActive(true);
            Object.DestroyImmediate(holder);
            Loop.Frame(0.02f);
            Assert.That(Events(), Is.EqualTo("OnDestroy"));
        }

        [Test]
        public void Objects_cannot_leave_or_join_parents_that_are_destroyed()
        {
            var script = Add<DestroyHandler>();
            Transform parent = script.transform, child = new GameObject("Child").transform, other = new GameObject("Other").transform;
            child.SetParent(parent);
            script.OnDestroyed = () =>
            {
                child.SetParent(null);
                other.SetParent(parent);
            };
            Object.DestroyImmediate(parent.gameObject);
            Assert.That(Errors.Count, Is.EqualTo(2));
            Assert.That(Object.FindObjectsByType<Transform>(FindObjectsSortMode.None), Is.EqualTo(new[] { other }));
        }

        [Test]
        public void Destroy_with_a_delay_waits_for_that_time()
        {
            var holder = new GameObject();
            Object.Destroy(holder, 0.05f);
            Loop.Frame(0.02f);
            Loop.Frame(0.02f);
            Assert.That(holder != null, Is.True);
            Loop.Frame(0.02f);
            Assert.That(holder == null, Is.True);
        }

        [RequireComponent(typeof(Rigidbody), typeof(Collider))]
        public class Mover : MonoBehaviour { }

        [Test]
        public void A_required_component_is_destroyed_only_after_its_dependents()
        {
            var mover = new GameObject("a", typeof(BoxCollider), typeof(SphereCollider), typeof(Mover)).GetComponent<Mover>();
            Rigidbody body = mover.GetComponent<Rigidbody>();
            Object.DestroyImmediate(mover.GetComponent<BoxCollider>());
            Assert.That(Errors, Is.Empty);
            Object.DestroyImmediate(mover.GetComponent<SphereCollider>());
            Object.Destroy(body);
            Loop.Frame(0.02f);
            Assert.That(mover.GetComponent<SphereCollider>() != null && body != null, Is.True);
            Assert.That(Errors.Count, Is.EqualTo(2));
            Object.Destroy(mover);
            Object.Destroy(body);
            Loop.Frame(0.02f);
            Assert.That(body == null, Is.True);
        }

        [Test]
        public void A_destroyed_component_is_no_longer_found()
        {
            var part = Add<Part>();
            var holder = part.gameObject;
            Object.DestroyImmediate(part);
            Assert.That(holder.GetComponent<Part>() == null, Is.True);
            Assert.That(holder.TryGetComponent<Part>(out _), Is.False);
            Assert.That(Object.FindAnyObjectByType<Part>() == null, Is.True);
        }

        [Test]
        public void Using_a_destroyed_object_throws_an_exception()
        {
            var holder = new GameObject("a");
            var transform = holder.transform;
            Object.DestroyImmediate(holder);
            Assert.Throws<MissingReferenceException>(() => _ = transform.position);
            Assert.Throws<MissingReferenceException>(() => _ = transform.forward);
            Assert.Throws<MissingReferenceException>(() => _ = transform.lossyScale);
            Assert.Throws<MissingReferenceException>(() => _ = transform.parent);
            Assert.Throws<MissingReferenceException>(() => _ = transform.childCount);
            Assert.Throws<MissingReferenceException>(() => transform.TransformPoint(Vector3.one));
            Assert.Throws<MissingReferenceException>(() => transform.SetAsFirstSibling());
            Assert.Throws<MissingReferenceException>(() => _ = holder.activeInHierarchy);
            Assert.Throws<MissingReferenceException>(() => holder.CompareTag("Untagged"));
            Assert.Throws<MissingReferenceException>(() => holder.layer = 3);
        }

        /// Calls every member that the engine declares, except generic ones.
        [TestCase(typeof(Rigidbody))]
        [TestCase(typeof(BoxCollider))]
        [TestCase(typeof(SphereCollider))]
        [TestCase(typeof(CapsuleCollider))]
        [TestCase(typeof(MeshCollider))]
        [TestCase(typeof(TerrainCollider))]
        [TestCase(typeof(FixedJoint))]
        [TestCase(typeof(HingeJoint))]
        [TestCase(typeof(SpringJoint))]
        [TestCase(typeof(MeshRenderer))]
        [TestCase(typeof(MeshFilter))]
        [TestCase(typeof(Part))]
        [TestCase(typeof(GameObject))]
        [TestCase(typeof(Transform))]
        [TestCase(typeof(Mesh))]
        [TestCase(typeof(Material))]
        [TestCase(typeof(PhysicsMaterial))]
        [TestCase(typeof(TerrainData))]
        public void No_member_of_a_destroyed_object_can_be_used(System.Type type)
        {
            var holder = new GameObject();
            var destroyed = type == typeof(GameObject) ? holder
                : type == typeof(Transform) ? holder.transform
                : type == typeof(Material) ? new Material(Shader.Find("Standard"))
                : typeof(Component).IsAssignableFrom(type) ? holder.AddComponent(type)
                : (Object)System.Activator.CreateInstance(type);
            Object.DestroyImmediate(type == typeof(Transform) ? holder : destroyed);
            var usable = new List<string>();
            foreach (var method in type.GetMethods())
            {
                if (method.DeclaringType.Assembly != typeof(Object).Assembly || method.IsStatic || method.IsGenericMethod) continue;
                if (method.GetBaseDefinition().DeclaringType == typeof(object)) continue;
                if (method.Name == "get_gameObject" || method.Name == "GetEnumerator") continue; // C# answers without the engine
                try
                {
                    method.Invoke(destroyed, System.Array.ConvertAll(method.GetParameters(), parameter => Value(parameter.ParameterType)));
                    usable.Add(method.Name);
                }
                catch (TargetInvocationException error) when (error.InnerException is MissingReferenceException)
                {
                }
                catch (TargetInvocationException error)
                {
                    usable.Add(method.Name + ": " + error.InnerException.GetType().Name);
                }
            }
            Assert.That(string.Join(" ", usable), Is.Empty);
        }

        /// Returns a harmless argument.
        static object Value(System.Type type)
        {
            if (type == typeof(string)) return "a";
            if (type == typeof(System.Type)) return typeof(Transform);
            if (type == typeof(Vector3)) return Vector3.one;
            if (type == typeof(Transform)) return new GameObject().transform;
            if (type == typeof(IEnumerator)) return new int[0].GetEnumerator();
            if (type.IsArray) return System.Array.CreateInstance(type.GetElementType(), new int[type.GetArrayRank()]);
            return type.IsValueType || type.IsGenericType ? System.Activator.CreateInstance(type.IsByRef ? type.GetElementType() : type) : null;
        }
    }
}
