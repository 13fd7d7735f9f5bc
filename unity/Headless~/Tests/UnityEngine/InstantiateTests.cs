using System;
using System.Collections.Generic;
using NUnit.Framework;
using Unity.Collections;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class InstantiateTests : PlayerFixture
    {
        [Serializable]
        public class Settings
        {
            public int count;
        }

        public class Template : MonoBehaviour
        {
            public int number;
            public List<string> names = new List<string>();
            public Settings settings = new Settings();
            public Transform child;
            public GameObject stranger;
            [SerializeField] float hidden;
            [NonSerialized] public int transient;
            public Ray ray;
            public float Hidden { get => hidden; set => hidden = value; }
            void Awake() => Notes.Add($"Awake({number} at {transform.position.x:0})");
        }

        [Test]
        public void A_copy_has_its_own_serialised_values_before_Awake()
        {
            var holder = new GameObject("template");
            holder.SetActive(false);
            var original = holder.AddComponent<Template>();
            holder.AddComponent<SphereCollider>().radius = 0.25f;
            var child = new GameObject("child").transform;
            child.SetParent(holder.transform);
            var stranger = new GameObject("stranger");
            original.number = 7;
            original.names.Add("one");
            original.settings.count = 3;
            original.child = child;
            original.stranger = stranger;
            original.Hidden = 0.5f;
            original.transient = 9;
            original.ray = new Ray(Vector3.one, Vector3.up);

            var copy = UnityEngine.Object.Instantiate(original, new Vector3(4f, 0f, 0f), Quaternion.identity);
            copy.gameObject.SetActive(true);

            Assert.That(Events(), Is.EqualTo("Awake(7 at 4)"));
            Assert.That(copy.name, Is.EqualTo("template(Clone)"));
            Assert.That(copy.names, Is.EqualTo(new[] { "one" }).And.Not.SameAs(original.names));
            Assert.That(copy.settings, Is.Not.SameAs(original.settings));
            Assert.That(copy.settings.count, Is.EqualTo(3));
            Assert.That(copy.child, Is.SameAs(copy.transform.GetChild(0)));
            Assert.That(copy.stranger, Is.SameAs(stranger));
            Assert.That(copy.Hidden, Is.EqualTo(0.5f));
            Assert.That(copy.transient, Is.EqualTo(0));
            Assert.That(copy.ray, Is.EqualTo(default(Ray)), "Unity does not serialise rays");
            Assert.That(copy.GetComponent<SphereCollider>().radius, Is.EqualTo(0.25f));
        }

        [Test]
        public void A_copy_with_a_pose_and_a_parent_keeps_its_local_scale()
        {
            var parent = new GameObject("parent").transform;
            parent.position = Vector3.up;
            parent.localScale = new Vector3(2f, 2f, 2f);
            var copy = UnityEngine.Object.Instantiate(new GameObject("original"), Vector3.one, Quaternion.Euler(0f, 90f, 0f), parent).transform;
            Assert.That(copy.position, Is.EqualTo(Vector3.one));
            Assert.That(Quaternion.Angle(copy.rotation, Quaternion.Euler(0f, 90f, 0f)), Is.LessThan(0.1f));
            Assert.That(copy.localScale, Is.EqualTo(Vector3.one));
        }

        [Test]
        public void Settings_of_a_body_that_Unity_does_not_serialise_have_their_defaults_in_a_copy()
        {
            var original = Add<Rigidbody>();
            (original.mass, original.maxAngularVelocity, original.maxLinearVelocity, original.maxDepenetrationVelocity) = (2f, 50f, 5f, 1f);
            (original.sleepThreshold, original.solverIterations, original.solverVelocityIterations) = (0f, 20, 20);
            var copy = UnityEngine.Object.Instantiate(original);
            Assert.That(copy.mass, Is.EqualTo(2f));
            Assert.That((copy.maxAngularVelocity, copy.maxLinearVelocity, copy.maxDepenetrationVelocity), Is.EqualTo((7f, 1e16f, 10f)));
            Assert.That((copy.sleepThreshold, copy.solverIterations, copy.solverVelocityIterations), Is.EqualTo((0.005f, 6, 1)));
        }

        public class State
        {
            public int count;
        }

        public class Memory : MonoBehaviour
        {
            public State state = new State();
            public List<State> states = new List<State>();
            public HashSet<int> channels = new HashSet<int> { 1, 2 };
            public Vector3[] places = { };
            public LayerMask layers;
        }

        [Test]
        public void Fields_that_Unity_does_not_serialise_have_their_initial_values_in_a_copy()
        {
            var original = Add<Memory>();
            original.state.count = 3;
            original.states.Add(original.state);
            original.channels.Add(3);
            original.places = new[] { Vector3.up };
            original.layers = 5;
            var copy = UnityEngine.Object.Instantiate(original);
            Assert.That(copy.state.count, Is.EqualTo(0));
            Assert.That(copy.states, Is.Empty);
            Assert.That(copy.channels, Is.EquivalentTo(new[] { 1, 2 }));
            Assert.That(copy.places, Is.EqualTo(original.places));
            Assert.That(copy.layers.value, Is.EqualTo(5));
        }

        [Serializable]
        public struct Timer
        {
            public float period;
            [NonSerialized] public int ticks;
            readonly float rate;

            public Timer(float rate) : this() => this.rate = rate;

            public float Rate => rate;
        }

        public class TimerOwner : MonoBehaviour
        {
            public Timer timer = new Timer(2f);
            public Timer[] timers = { };
        }

        [Test]
        public void Fields_of_structs_that_Unity_does_not_serialise_have_their_initial_values_in_a_copy()
        {
            var original = Add<TimerOwner>();
            original.timer = new Timer(3f) { period = 0.5f, ticks = 4 };
            original.timers = new[] { original.timer };
            var copy = UnityEngine.Object.Instantiate(original);
            Assert.That((copy.timer.period, copy.timer.ticks, copy.timer.Rate), Is.EqualTo((0.5f, 0, 2f)));
            Assert.That((copy.timers[0].period, copy.timers[0].ticks, copy.timers[0].Rate), Is.EqualTo((0.5f, 0, 0f)));
            Assert.That(original.timer.ticks, Is.EqualTo(4));
        }

        [Serializable]
        public class Table : ISerializationCallbackReceiver
        {
            public List<int> keys = new List<int>();
            public readonly Dictionary<int, string> names = new Dictionary<int, string>();

            public void OnBeforeSerialize() => keys = new List<int>(names.Keys);

            public void OnAfterDeserialize() => keys.ForEach(key => names.Add(key, "name " + key));
        }

        [Serializable]
        public struct Values : ISerializationCallbackReceiver
        {
            public List<int> stored;
            public HashSet<int> all;

            public void OnBeforeSerialize() => stored = new List<int>(all ?? new HashSet<int>());

            public void OnAfterDeserialize() => (all ??= new HashSet<int>()).UnionWith(stored);
        }

        public class TableOwner : MonoBehaviour, ISerializationCallbackReceiver
        {
            public Table table = new Table();
            public Values values;
            public int count;
            public int Names { get; private set; }

            public void OnBeforeSerialize() => count = table.names.Count;

            public void OnAfterDeserialize() => Names = 10 * count + table.names.Count;
        }

        [Test]
        public void A_copy_receives_the_callbacks_of_serialisation()
        {
            var original = Add<TableOwner>();
            original.table.names.Add(4, "four");
            original.table.names.Add(7, "seven");
            original.values.all = new HashSet<int> { 3 };
            var copy = UnityEngine.Object.Instantiate(original);
            Assert.That(copy.table.names, Is.EquivalentTo(new Dictionary<int, string> { [4] = "name 4", [7] = "name 7" }));
            Assert.That(copy.Names, Is.EqualTo(22));
            Assert.That(original.table.names[4], Is.EqualTo("four"));
            Assert.That(copy.values.all, Is.EqualTo(new[] { 3 }).And.Not.SameAs(original.values.all));
        }

        [Serializable]
        public class Linked
        {
            [SerializeReference] public Linked next;

            public override bool Equals(object other) => other is Linked;

            public override int GetHashCode() => 0;
        }

        public class LinkedOwner : MonoBehaviour
        {
            [SerializeReference] public Linked first;
            [SerializeReference] public List<Linked> all = new List<Linked>();
        }

        [Test]
        public void A_copy_shares_references_as_the_original_does()
        {
            var original = Add<LinkedOwner>();
            original.first = new Linked { next = new Linked() };
            original.first.next.next = original.first;
            original.all.Add(original.first.next);
            var copy = UnityEngine.Object.Instantiate(original);
            Assert.That(copy.first, Is.Not.SameAs(original.first).And.Not.SameAs(copy.first.next));
            Assert.That(copy.first.next.next, Is.SameAs(copy.first));
            Assert.That(copy.all[0], Is.SameAs(copy.first.next));
        }

        [Test]
        public void A_copy_under_a_parent_keeps_its_local_position()
        {
            var parent = new GameObject().transform;
            parent.position = new Vector3(10f, 0f, 0f);
            var original = new GameObject().transform;
            original.position = new Vector3(1f, 0f, 0f);
            Assert.That(UnityEngine.Object.Instantiate(original, parent).position, Is.EqualTo(new Vector3(11f, 0f, 0f)));
            Assert.That(UnityEngine.Object.Instantiate(original, Vector3.up, Quaternion.identity, parent).position, Is.EqualTo(Vector3.up));
        }

        [Serializable]
        public class Animal
        {
            public int legs;
            public Animal mother;

            public Animal(int legs) => this.legs = legs;
        }

        [Serializable]
        public class Dog : Animal
        {
            public Dog() : base(4) { }
        }

        public class Zoo : MonoBehaviour
        {
            public string label;
            public List<int> numbers;
            public Vector3[] places;
            public Animal animal;
            public NativeArray<int> native;
        }

        [Test]
        public void Null_is_copied_as_an_empty_value()
        {
            var copy = UnityEngine.Object.Instantiate(Add<Zoo>());
            Assert.That(copy.label, Is.EqualTo(""));
            Assert.That(copy.numbers, Is.Not.Null.And.Empty);
            Assert.That(copy.places, Is.Not.Null.And.Empty);
            Assert.That(copy.animal, Is.Not.Null);
        }

        [Test]
        public void Objects_are_copied_with_the_type_of_their_field()
        {
            var original = Add<Zoo>();
            original.animal = new Dog();
            var copy = UnityEngine.Object.Instantiate(original);
            Assert.That(copy.animal.GetType(), Is.EqualTo(typeof(Animal)));
            Assert.That(copy.animal.legs, Is.EqualTo(4));
        }

        [Test]
        public void Copies_of_objects_that_contain_themselves_end_at_a_depth_limit()
        {
            var original = Add<Zoo>();
            original.animal = new Dog();
            original.animal.mother = original.animal;
            var depth = 0;
            for (var animal = UnityEngine.Object.Instantiate(original).animal; animal != null; animal = animal.mother) depth++;
            Assert.That(depth, Is.EqualTo(10));
            Assert.That(Errors.Count, Is.EqualTo(1));
        }

        [Test]
        public void Native_arrays_are_not_copied()
        {
            var original = Add<Zoo>();
            original.native = new NativeArray<int>(3, Allocator.Persistent);
            Assert.That(UnityEngine.Object.Instantiate(original).native.IsCreated, Is.False);
            original.native.Dispose();
        }

        [Test]
        public void A_copy_has_a_normalised_rotation_and_a_finite_position()
        {
            var copy = UnityEngine.Object.Instantiate(new GameObject(), new Vector3(float.NaN, 0f, 0f), Quaternion.identity).transform;
            Assert.That(copy.position, Is.EqualTo(Vector3.zero));
            Assert.That(Errors.Count, Is.EqualTo(1));
            copy = UnityEngine.Object.Instantiate(new GameObject(), Vector3.zero, new Quaternion(0f, 0f, 0f, 2f)).transform;
            Assert.That(copy.rotation.w, Is.EqualTo(1f));
        }

        public class Asset : ScriptableObject
        {
            public int number;
            void Awake() => Notes.Add($"Awake({number})");
            void OnEnable() => Notes.Add("OnEnable");
        }

        [Test]
        public void Copies_of_scriptable_objects_receive_messages()
        {
            var asset = ScriptableObject.CreateInstance<Asset>();
            asset.number = 7;
            Notes.Clear();
            UnityEngine.Object.Instantiate(asset);
            Assert.That(Events(), Is.EqualTo("Awake(7) OnEnable"));
        }
    }
}
