using System;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class LifecycleTests : PlayerFixture
    {
        public class Witness : MonoBehaviour
        {
            protected void Note(string what) => Notes.Add(name + "." + what);
            void Awake() => Note("Awake");
            void OnEnable() => Note("OnEnable");
            void Start() => Note("Start");
            void FixedUpdate() => Note("FixedUpdate");
            void Update() => Note("Update");
            void LateUpdate() => Note("LateUpdate");
            void OnDisable() => Note("OnDisable");
            void OnDestroy() => Note("OnDestroy");
            void OnApplicationQuit() => Note("OnApplicationQuit");
        }

        public class DerivedWitness : Witness { }

        public class Quiet : MonoBehaviour
        {
            void Awake() => Notes.Add(name);
        }

        [DefaultExecutionOrder(-5)] public class Early : Quiet { void Update() => Notes.Add("early"); }
        public class Middle : Quiet { void Update() => Notes.Add("middle"); }
        [DefaultExecutionOrder(7)] public class Late : Quiet { void Update() => Notes.Add("late"); }

        public class Thrower : MonoBehaviour
        {
            void Start() => throw new InvalidOperationException("start failed");
            void Update() => throw new InvalidOperationException("update failed");
        }

        public class EagerRandom : MonoBehaviour
        {
            public Vector3 Place = UnityEngine.Random.insideUnitSphere;
            void Awake() => Place = UnityEngine.Random.insideUnitSphere;
        }

        public class EagerTime : MonoBehaviour { public float Since = Time.time; }
        public class EagerSearch : MonoBehaviour { public GameObject Leader = GameObject.Find("leader"); }
        public class EagerLayer : MonoBehaviour { public int Layer = LayerMask.NameToLayer("Water"); }

        public class ThrowsInAwake : MonoBehaviour
        {
            void Awake() => throw new InvalidOperationException("awake failed");
            void OnEnable() => Notes.Add("enabled");
        }

        public class Spawner : MonoBehaviour
        {
            void Update()
            {
                if (Time.frameCount == 1) new GameObject("child").AddComponent<Witness>();
            }
        }

        [RequireComponent(typeof(Rigidbody), typeof(SphereCollider))] public class RequiresComponents : MonoBehaviour { }
        [RequireComponent(typeof(RequiresBack))] public class RequiresOther : MonoBehaviour { }
        [RequireComponent(typeof(RequiresOther))] public class RequiresBack : MonoBehaviour { }
        [DisallowMultipleComponent] public class Single : MonoBehaviour { }
        public class DerivedSingle : Single { }

        [Test]
        public void Messages_are_sent_in_the_documented_order()
        {
            var witness = Add<Witness>("a");
            Assert.That(Events(), Is.EqualTo("a.Awake a.OnEnable"));
            Loop.Frame(0.02f);
            UnityEngine.Object.Destroy(witness.gameObject);
            Loop.Frame(0.001f);
            Assert.That(Events(), Is.EqualTo(
                "a.Awake a.OnEnable a.Start a.FixedUpdate a.Update a.LateUpdate a.Update a.LateUpdate a.OnDisable a.OnDestroy"));
        }

        [Test]
        public void Private_messages_of_base_classes_are_found()
        {
            Add<DerivedWitness>("h");
            Loop.Frame(0.001f);
            Assert.That(Events(), Is.EqualTo("h.Awake h.OnEnable h.Start h.Update h.LateUpdate"));
        }

        [Test]
        public void Every_Start_comes_before_any_Update()
        {
            Add<Witness>("a");
            Add<Witness>("b");
            Notes.Clear();
            Loop.Frame(0.001f);
            Assert.That(Events(), Is.EqualTo("a.Start b.Start a.Update b.Update a.LateUpdate b.LateUpdate"));
        }

        [Test]
        public void Execution_order_determines_the_order_of_Update()
        {
            Add<Late>();
            Add<Middle>();
            Add<Early>();
            Notes.Clear();
            Loop.Frame(0.001f);
            Assert.That(Events(), Is.EqualTo("early middle late"));
        }

        [Test]
        public void Execution_order_determines_the_order_of_Awake()
        {
            var root = new GameObject("root");
            root.SetActive(false);
            Child<Late>("late");
            Child<Middle>("middle");
            Child<Early>("early");
            root.SetActive(true);
            Assert.That(Events(), Is.EqualTo("early middle late"));

            void Child<T>(string name) where T : Component
            {
                var child = new GameObject(name);
                child.transform.SetParent(root.transform);
                child.AddComponent<T>();
            }
        }

        [Test]
        public void An_inactive_object_receives_Awake_when_activated()
        {
            var holder = new GameObject("a");
            holder.SetActive(false);
            var witness = holder.AddComponent<Witness>();
            Loop.Frame(0.02f);
            Assert.That(Events(), Is.Empty);
            Assert.That(witness.isActiveAndEnabled, Is.False);
            holder.SetActive(true);
            Assert.That(Events(), Is.EqualTo("a.Awake a.OnEnable"));
            holder.SetActive(false);
            holder.SetActive(true);
            Assert.That(Events(), Is.EqualTo("a.Awake a.OnEnable a.OnDisable a.OnEnable"));
        }

        [Test]
        public void An_object_without_Awake_receives_no_OnDestroy()
        {
            var holder = new GameObject("a");
            holder.SetActive(false);
            holder.AddComponent<Witness>();
            UnityEngine.Object.DestroyImmediate(holder);
            Assert.That(Events(), Is.Empty);
        }

        [Test]
        public void A_disabled_component_receives_Awake_but_not_Start()
        {
            var holder = new GameObject("a");
            holder.SetActive(false);
            var witness = holder.AddComponent<Witness>();
            witness.enabled = false;
            holder.SetActive(true);
            Loop.Frame(0.02f);
            Assert.That(Events(), Is.EqualTo("a.Awake"));
            witness.enabled = true;
            Loop.Frame(0.001f);
            Assert.That(Events(), Is.EqualTo("a.Awake a.OnEnable a.Start a.Update a.LateUpdate"));
        }

        [Test]
        public void A_child_is_active_only_with_its_parent()
        {
            var parent = new GameObject("parent");
            var child = Add<Witness>("c");
            child.transform.SetParent(parent.transform);
            Notes.Clear();
            parent.SetActive(false);
            Assert.That(child.gameObject.activeSelf, Is.True);
            Assert.That(child.gameObject.activeInHierarchy, Is.False);
            child.transform.SetParent(null);
            Assert.That(Events(), Is.EqualTo("c.OnDisable c.OnEnable"));
        }

        public class Reviver : MonoBehaviour
        {
            public GameObject Revived;

            void OnEnable() => Notes.Add("OnEnable");

            void OnDisable()
            {
                Notes.Add("OnDisable");
                Revived.SetActive(!Revived.activeSelf);
            }
        }

        [TestCase("object")]
        [TestCase("parent")]
        public void SetActive_activates_nothing_that_is_being_deactivated(string revived)
        {
            var script = Add<Reviver>();
            var parent = new GameObject("parent");
            script.transform.SetParent(parent.transform);
            script.Revived = revived == "parent" ? parent : script.gameObject;
            script.Revived.SetActive(false);
            Assert.That(Errors, Is.EqualTo(new[] { $"The GameObject '{revived}' is already being activated or deactivated." }));
            Assert.That((script.Revived.activeSelf, script.isActiveAndEnabled), Is.EqualTo((true, false)));
            Assert.That(Events(), Is.EqualTo("OnEnable OnDisable"));
        }

        [Test]
        public void OnDisable_can_activate_other_objects_and_deactivate_its_own_for_later()
        {
            var script = Add<Reviver>();
            script.Revived = new GameObject();
            script.Revived.SetActive(false);
            script.enabled = false;
            Assert.That(script.Revived.activeInHierarchy, Is.True);
            script.enabled = true;
            var parent = new GameObject("parent");
            script.transform.SetParent(parent.transform);
            script.Revived = script.gameObject;
            parent.SetActive(false);
            parent.SetActive(true);
            Assert.That((script.gameObject.activeSelf, script.isActiveAndEnabled), Is.EqualTo((false, false)));
        }

        [Test]
        public void A_search_among_children_or_parents_includes_an_inactive_object_itself()
        {
            GameObject parent = Add<Single>().gameObject, middle = Add<Single>().gameObject, child = Add<Single>().gameObject;
            middle.transform.SetParent(parent.transform);
            child.transform.SetParent(middle.transform);
            parent.SetActive(false);
            Assert.That(middle.GetComponentInChildren<Single>(), Is.SameAs(middle.GetComponent<Single>()));
            Assert.That(middle.GetComponentInChildren(typeof(Single)), Is.SameAs(middle.GetComponent<Single>()));
            Assert.That(middle.GetComponentInParent<Single>(), Is.SameAs(middle.GetComponent<Single>()));
            Assert.That(middle.GetComponentInParent(typeof(Single)), Is.SameAs(middle.GetComponent<Single>()));
            Assert.That(middle.GetComponentsInChildren<Single>(), Is.EqualTo(middle.GetComponents<Single>()));
            Assert.That(middle.GetComponentsInParent<Single>(), Is.EqualTo(middle.GetComponents<Single>()));
        }

        [Test]
        public void An_exception_is_logged_and_other_components_go_on()
        {
            Add<Thrower>();
            Add<Witness>("w");
            Notes.Clear();
            Loop.Frame(0.001f);
            Loop.Frame(0.001f);
            Assert.That(Events(), Is.EqualTo("w.Start w.Update w.LateUpdate w.Update w.LateUpdate"));
            Assert.That(Errors, Is.EqualTo(new[] { "start failed", "update failed", "update failed" }));
            Assert.That(Loop.FailedCalls, Is.EqualTo(3));
        }

        [TestCase(typeof(EagerRandom), "Random")]
        [TestCase(typeof(EagerTime), "Time")]
        [TestCase(typeof(EagerSearch), "Find")]
        [TestCase(typeof(EagerLayer), "NameToLayer")]
        public void A_field_initialiser_that_uses_the_engine_is_logged_once_per_object(Type script, string member)
        {
            new GameObject().AddComponent(script);
            Assert.That(Errors, Is.EqualTo(new[]
            {
                $"{member} is not allowed to be called from the constructor or a field initialiser of {script.Name}: call it in Awake or Start instead.",
            }));
        }

        [Test]
        public void A_script_whose_Awake_throws_is_disabled()
        {
            var script = Add<ThrowsInAwake>();
            Assert.That(script.enabled, Is.False);
            Assert.That(Events(), Is.Empty);
        }

        [Test]
        public void An_object_created_in_Update_starts_before_LateUpdate_and_updates_in_the_next_frame()
        {
            Add<Spawner>();
            Loop.Frame(0.001f);
            Assert.That(Events(), Is.EqualTo("child.Awake child.OnEnable child.Start child.LateUpdate"));
            Notes.Clear();
            Loop.Frame(0.001f);
            Assert.That(Events(), Is.EqualTo("child.Update child.LateUpdate"));
        }

        class FixedClock : MonoBehaviour
        {
            void FixedUpdate() => Notes.Add($"{Time.unscaledDeltaTime:0.00} {Time.unscaledTime:0.00}");
            void Update() => Notes.Add($"{Time.unscaledDeltaTime:0.00} {Time.unscaledTime:0.00}");
        }

        [Test]
        public void Unscaled_times_are_those_of_the_fixed_clock_in_FixedUpdate()
        {
            Time.timeScale = 0.5f;
            Add<FixedClock>();
            Loop.Frame(0.08f);
            Assert.That(string.Join(", ", Notes), Is.EqualTo("0.04 0.04, 0.04 0.08, 0.08 0.08"));
        }

        class Stopper : MonoBehaviour
        {
            void FixedUpdate()
            {
                Time.timeScale = 0f;
                Notes.Add($"{Time.unscaledDeltaTime:0.00} {Time.unscaledTime:0.00}");
            }
        }

        [Test]
        public void A_time_scale_that_FixedUpdate_sets_affects_the_next_frame()
        {
            Add<Stopper>();
            Loop.Frame(0.04f);
            Loop.Frame(0.04f);
            Assert.That(string.Join(", ", Notes), Is.EqualTo("0.02 0.02, 0.02 0.04"));
        }

        [Test]
        public void FixedUpdate_is_not_called_at_a_time_scale_of_0()
        {
            Add<FixedClock>();
            Loop.Frame(0.019f);
            Time.timeScale = 0f;
            Time.fixedDeltaTime = 0.01f;
            Loop.Frame(0.01f);
            Assert.That(string.Join(", ", Notes), Is.EqualTo("0.02 0.02, 0.01 0.03"));
        }

        [TestCase(0.02f, 1)]
        [TestCase(0.1f, 5)]
        [TestCase(0.05f, 2)]
        public void FixedUpdate_runs_once_per_fixed_step_within_the_frame(float deltaTime, int expected)
        {
            Add<Witness>("a");
            Loop.Frame(deltaTime);
            Assert.That(Notes.FindAll(note => note == "a.FixedUpdate").Count, Is.EqualTo(expected));
        }

        [Test]
        public void Quit_calls_OnApplicationQuit_and_destroys_all_objects()
        {
            var quitting = 0;
            Application.quitting += () => quitting++;
            Add<Witness>("a");
            Notes.Clear();
            Loop.Quit();
            Assert.That(Events(), Is.EqualTo("a.OnApplicationQuit a.OnDisable a.OnDestroy"));
            Assert.That(quitting, Is.EqualTo(1));
        }

        public class Respawner : MonoBehaviour
        {
            void OnDestroy()
            {
                if (Notes.Count > 100) return;
                Notes.Add("OnDestroy");
                Add<Respawner>("copy");
            }
        }

        [Test]
        public void Objects_that_OnDestroy_creates_while_quitting_are_destroyed_without_messages()
        {
            Add<Respawner>();
            Loop.Quit();
            Assert.That(Events(), Is.EqualTo("OnDestroy"));
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(Errors[0], Is.StringContaining("'copy'"));
        }

        [Test]
        public void OnApplicationQuit_is_also_sent_to_disabled_scripts_of_active_objects()
        {
            Add<Witness>("disabled").enabled = false;
            Add<Witness>("inactive").gameObject.SetActive(false);
            Notes.Clear();
            Loop.Quit();
            Assert.That(Events(), Is.EqualTo("disabled.OnApplicationQuit disabled.OnDestroy inactive.OnDestroy"));
        }

        [Test]
        public void Required_components_are_added()
        {
            var holder = Add<RequiresComponents>().gameObject;
            Assert.That(holder.GetComponents<Component>().Length, Is.EqualTo(4));
            Assert.That(holder.GetComponent<Rigidbody>(), Is.Not.Null);
            Assert.That(holder.GetComponent<Collider>(), Is.InstanceOf<SphereCollider>());
        }

        [Test]
        public void Components_can_require_each_other() =>
            Assert.That(Add<RequiresOther>().GetComponents<MonoBehaviour>().Length, Is.EqualTo(2));

        [Test]
        public void DisallowMultipleComponent_applies_to_the_type_and_its_subclasses()
        {
            var holder = Add<Single>().gameObject;
            Assert.That(holder.AddComponent<Single>() == null, Is.True);
            Assert.That(holder.AddComponent<DerivedSingle>() == null, Is.True);
            Assert.That(Errors.Count, Is.EqualTo(2));
        }

        [Test]
        public void An_object_has_at_most_one_MeshFilter_and_one_MeshRenderer()
        {
            var cube = GameObject.CreatePrimitive(PrimitiveType.Cube);
            Assert.That(cube.AddComponent<MeshFilter>() == null && cube.AddComponent<MeshRenderer>() == null, Is.True);
            Assert.That(Errors.Count, Is.EqualTo(2));
        }

        [DisallowMultipleComponent]
        class SingleAmongSingles : Single { }

        [Test]
        public void DisallowMultipleComponent_of_a_base_class_applies_despite_that_of_a_subclass()
        {
            var holder = Add<Single>().gameObject;
            Assert.That(holder.AddComponent<SingleAmongSingles>() == null, Is.True);
            Assert.That(Errors.Count, Is.EqualTo(1));
        }

        public class StateLogger : MonoBehaviour
        {
            void Awake() => Notes.Add("Awake " + isActiveAndEnabled);
            void OnEnable() => Notes.Add("OnEnable " + isActiveAndEnabled);
        }

        [Test]
        public void A_script_is_active_and_enabled_from_OnEnable_on()
        {
            Add<StateLogger>();
            Assert.That(Events(), Is.EqualTo("Awake False OnEnable True"));
        }

        public class UnsentMessages : MonoBehaviour
        {
            void OnApplicationPause(bool isPaused) => Notes.Add("paused");
            void OnApplicationFocus() => Notes.Add("focused");
            void Update(int times) => Notes.Add("updated");
            void OnTriggerExit(Collider other, Collision collision) => Notes.Add("left");
        }

        public class StartableAsset : ScriptableObject
        {
            void Start(int seed) => Notes.Add("started");
        }

        [Test]
        public void A_scriptable_object_can_have_methods_with_names_of_messages()
        {
            ScriptableObject.CreateInstance<StartableAsset>();
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Messages_that_are_never_sent_are_logged_once_per_type()
        {
            Add<UnsentMessages>();
            Add<UnsentMessages>();
            Loop.Frame(0.02f);
            Assert.That(Events(), Is.Empty);
            Assert.That(Errors, Is.EqualTo(new[]
            {
                "Script error (UnsentMessages): Update(Int32) is never called: the message has no parameter.",
                "Script error (UnsentMessages): OnTriggerExit(Collider, Collision) is never called: the message has one parameter, of type Collider.",
                "UnsentMessages.OnApplicationFocus is never called without Unity.", "UnsentMessages.OnApplicationPause is never called without Unity.",
            }));
        }
    }
}
