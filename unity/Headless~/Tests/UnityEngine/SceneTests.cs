using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;
using UnityEngine.SceneManagement;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class SceneTests : PlayerFixture
    {
        [Test]
        public void Objects_belong_to_their_scene_and_leave_with_it()
        {
            var own = new GameObject("Own");
            GameObject other = null, child = null;
            var events = new List<string>();
            SceneManager.sceneLoaded += (scene, mode) => events.Add("loaded " + scene.name + " " + mode);
            SceneManager.sceneUnloaded += scene => events.Add("unloaded " + scene.name);
            var second = AdditiveScene.Load("Second", () =>
            {
                other = new GameObject("Other");
                child = new GameObject("Child");
                child.transform.SetParent(other.transform);
            });
            Assert.That(SceneManager.sceneCount, Is.EqualTo(2));
            Assert.That(SceneManager.GetSceneAt(1) == second, Is.True);
            Assert.That((own.scene == second, other.scene == second, child.scene == second), Is.EqualTo((false, true, true)));
            Assert.That(new GameObject("New").scene == second, Is.False);
            Assert.That(GameObject.Find("Other"), Is.SameAs(other));
            child.transform.SetParent(null);
            Assert.That(child.scene == second, Is.True);
            child.transform.SetParent(own.transform);
            Assert.That(child.scene == second, Is.False);
            AdditiveScene.Unload(second);
            Assert.That((other == null, own == null, child == null), Is.EqualTo((true, false, false)));
            Assert.That(SceneManager.sceneCount, Is.EqualTo(1));
            Assert.That(events, Is.EqualTo(new[] { "loaded Second Additive", "unloaded Second" }));
        }

        [Test]
        public void Objects_of_a_scene_become_active_together()
        {
            Watcher first = null;
            AdditiveScene.Load("Second", () =>
            {
                first = new GameObject("First").AddComponent<Watcher>();
                new GameObject("Last");
            });
            Assert.That(first.FoundLast, Is.True);
        }

        [Test]
        public void FindObjectsByType_finds_game_objects()
        {
            GameObject parent = new GameObject("Parent"), child = new GameObject("Child"), hidden = new GameObject("Hidden");
            child.transform.SetParent(parent.transform);
            hidden.SetActive(false);
            Assert.That(Object.FindObjectsByType<GameObject>(FindObjectsSortMode.None), Is.EquivalentTo(new[] { parent, child }));
            Assert.That(Object.FindObjectsByType<GameObject>(FindObjectsInactive.Include, FindObjectsSortMode.None),
                Is.EquivalentTo(new[] { parent, child, hidden }));
        }

        [Test]
        public void Objects_that_are_not_saved_are_not_found()
        {
            GameObject saved = new GameObject("Saved"), unsaved = new GameObject("Unsaved") { hideFlags = HideFlags.HideAndDontSave };
            unsaved.transform.SetAsFirstSibling();
            Assert.That(Object.FindObjectsByType<GameObject>(FindObjectsSortMode.None), Is.EqualTo(new[] { saved }));
            Assert.That(Object.FindAnyObjectByType<GameObject>(), Is.SameAs(saved));
            Assert.That(Object.FindAnyObjectByType<Transform>(), Is.SameAs(saved.transform));
        }

        [Test]
        public void An_invalid_scene_has_no_root_objects()
        {
            Assert.Throws<System.ArgumentException>(() => default(Scene).GetRootGameObjects());
            Assert.Throws<System.ArgumentException>(() => default(Scene).GetRootGameObjects(new List<GameObject>()));
        }

        [Test]
        public void FindObjectsByType_can_sort_by_creation()
        {
            Transform first = new GameObject().transform, second = new GameObject().transform;
            first.SetParent(second);
            Assert.That(Object.FindObjectsByType<Transform>(FindObjectsSortMode.InstanceID), Is.EqualTo(new[] { first, second }));
        }

        [Test]
        public void Find_follows_the_path_in_a_name()
        {
            GameObject robot = new GameObject("Robot"), arm = new GameObject("Arm"), hand = new GameObject("Hand");
            arm.transform.SetParent(robot.transform);
            hand.transform.SetParent(arm.transform);
            foreach (var path in new[] { "Hand", "Arm/Hand", "Robot/Arm/Hand", "/Robot/Arm/Hand" })
                Assert.That(GameObject.Find(path), Is.SameAs(hand), path);
            foreach (var path in new[] { "/Hand", "/Arm/Hand", "Robot/Hand", "/", "", null }) Assert.That(GameObject.Find(path), Is.Null, path);
            hand.SetActive(false);
            Assert.That(GameObject.Find("/Robot/Arm/Hand"), Is.Null);
        }

        private sealed class Watcher : MonoBehaviour
        {
            internal bool FoundLast { get; private set; }

            private void Awake() => FoundLast = GameObject.Find("Last") != null;
        }

        [Test]
        public void Layers_of_the_project_settings_are_logged_as_unknown_once()
        {
            Assert.That(LayerMask.GetMask("Water", "UI"), Is.EqualTo(1 << 4 | 1 << 5));
            Assert.That(Errors, Is.Empty);
            for (var frame = 0; frame < 2; frame++) Assert.That(LayerMask.GetMask("Robots"), Is.EqualTo(0));
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(Errors[0], Is.StringContaining("The layer 'Robots' is unknown."));
        }
    }
}
