using System.Collections;
using System.Threading;
using System.Threading.Tasks;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class CoroutineTests : PlayerFixture
    {
        public class Runner : MonoBehaviour
        {
            public bool Open;

            void Update() => Notes.Add("Update");
            void LateUpdate() => Notes.Add("LateUpdate");

            public IEnumerator Frames()
            {
                Notes.Add("a");
                yield return null;
                Notes.Add("b");
                yield return null;
                Notes.Add("c");
            }

            public IEnumerator AwaitThenFixed(Coroutine inner)
            {
                yield return inner;
                yield return new WaitForFixedUpdate();
                Notes.Add("continued");
            }

            public IEnumerator Seconds(float seconds)
            {
                yield return new WaitForSeconds(seconds);
                Notes.Add("waited");
            }

            public IEnumerator Nested()
            {
                yield return Frames();
                Notes.Add("outer");
                yield return StartCoroutine(Seconds(0f));
                Notes.Add("end");
            }

            public IEnumerator DestroyAndWait(GameObject victim)
            {
                Destroy(victim);
                yield return new WaitForEndOfFrame();
                Notes.Add("gone " + (victim == null));
            }

            public IEnumerator Nothing()
            {
                Notes.Add("nothing");
                yield break;
            }

            public IEnumerator Fixed()
            {
                yield return new WaitForFixedUpdate();
                Notes.Add("fixed");
            }

            public IEnumerator Await(System.Func<Coroutine> inner)
            {
                yield return inner();
                Notes.Add("continued");
            }

            public IEnumerator AwaitLater(System.Func<Coroutine> other)
            {
                yield return null;
                yield return other();
                Notes.Add("continued");
            }

            public IEnumerator Phases()
            {
                yield return new WaitForFixedUpdate();
                Notes.Add("fixed");
                yield return new WaitForEndOfFrame();
                Notes.Add("frame end");
                yield return new WaitUntil(() => Open);
                Notes.Add("open");
            }
        }

        public class StartsAsync : MonoBehaviour
        {
            async void Start()
            {
                var main = Thread.CurrentThread;
                for (var frame = 0; frame < 2; frame++)
                {
                    await Task.Yield();
                    Notes.Add("frame " + frame + " " + (Thread.CurrentThread == main));
                }
                throw new System.InvalidOperationException("failed");
            }
        }

        public class StartsAsCoroutine : MonoBehaviour
        {
            IEnumerator Start()
            {
                Notes.Add("first");
                yield return null;
                Notes.Add("second");
            }
        }

        static void Frames(int count)
        {
            for (var frame = 0; frame < count; frame++) Loop.Frame(0.02f);
        }

        class Endless : MonoBehaviour
        {
            IEnumerator Awake() => Note();
            IEnumerator OnEnable() => Note();
            IEnumerator Update() => Note();
            IEnumerator OnDisable() => Note();

            static IEnumerator Note()
            {
                Notes.Add("called");
                yield return null;
            }
        }

        [Test]
        public void Messages_such_as_Update_cannot_be_coroutines()
        {
            var script = Add<Endless>();
            Loop.Frame(0.02f);
            script.enabled = false;
            Assert.That(Notes, Is.Empty);
            Assert.That(Errors, Is.EqualTo(new[]
            {
                "Script error (Endless): Awake() can not be a coroutine.", "Script error (Endless): OnEnable() can not be a coroutine.",
                "Script error (Endless): Update() can not be a coroutine.", "Script error (Endless): OnDisable() can not be a coroutine.",
            }));
        }

        [Test]
        public void Yield_null_resumes_in_the_next_frame_between_Update_and_LateUpdate()
        {
            var runner = Add<Runner>();
            runner.StartCoroutine(runner.Frames());
            Frames(2);
            Assert.That(Events(), Is.EqualTo("a Update b LateUpdate Update c LateUpdate"));
        }

        [Test]
        public void WaitForSeconds_uses_game_time()
        {
            var runner = Add<Runner>();
            runner.StartCoroutine(runner.Seconds(0.1f));
            Frames(4);
            Assert.That(Notes, Has.No.Member("waited"));
            Frames(2);
            Assert.That(Notes, Has.Member("waited"));
        }

        [TestCase(0.02f, 1)]
        [TestCase(0.02f, 50)]
        [TestCase(0.02f, 6000)]
        [TestCase(0.1f, 3)]
        [TestCase(1f / 60f, 999)]
        public void WaitForSeconds_and_delayed_destruction_take_the_exact_number_of_frames(float deltaTime, int frames)
        {
            var runner = Add<Runner>();
            for (var frame = 0; frame < 13; frame++) Loop.Frame(deltaTime);
            var seconds = (float)System.Math.Round(frames * (double)deltaTime, 2);
            runner.StartCoroutine(runner.Seconds(seconds));
            var other = new GameObject("other");
            Object.Destroy(other, seconds);
            var waited = 0;
            var lived = 0;
            for (var frame = 1; frame <= frames + 2; frame++)
            {
                Loop.Frame(deltaTime);
                if (!Notes.Contains("waited")) waited = frame;
                if (other != null) lived = frame;
                Notes.RemoveAll(note => note.EndsWith("Update"));
            }
            Assert.That((waited + 1, lived + 1), Is.EqualTo((frames, frames)));
        }

        [Test]
        public void Nested_coroutines_are_awaited()
        {
            var runner = Add<Runner>();
            runner.StartCoroutine(runner.Nested());
            Frames(5);
            Notes.RemoveAll(note => note.EndsWith("Update"));
            Assert.That(Events(), Is.EqualTo("a b c outer waited end"));
        }

        [Test]
        public void Other_yield_instructions_resume_in_their_phases()
        {
            var runner = Add<Runner>();
            runner.StartCoroutine(runner.Phases());
            Frames(1);
            Assert.That(Events(), Is.EqualTo("fixed Update LateUpdate frame end"));
            Frames(2);
            runner.Open = true;
            Frames(1);
            Assert.That(Notes, Has.Member("open"));
        }

        [Test]
        public void Objects_are_destroyed_before_the_end_of_the_frame_is_awaited()
        {
            var runner = Add<Runner>();
            runner.StartCoroutine(runner.DestroyAndWait(new GameObject()));
            Frames(1);
            Assert.That(Notes[Notes.Count - 1], Is.EqualTo("gone True"));
        }

        [Test]
        public void A_coroutine_continues_as_soon_as_the_awaited_one_ends()
        {
            var runner = Add<Runner>();
            runner.StartCoroutine(runner.Await(() => runner.StartCoroutine(runner.Nothing())));
            Assert.That(Events(), Is.EqualTo("nothing continued"));
            Notes.Clear();
            runner.StartCoroutine(runner.Await(() => runner.StartCoroutine(runner.Fixed())));
            Frames(1);
            Assert.That(Events(), Is.EqualTo("fixed continued Update LateUpdate"));
            Notes.Clear();
            Coroutine later = null;
            runner.StartCoroutine(runner.AwaitLater(() => later));
            later = runner.StartCoroutine(runner.Frames());
            Frames(2);
            Assert.That(Events(), Is.EqualTo("a Update b LateUpdate Update c continued LateUpdate"));
        }

        [Test]
        public void A_coroutine_continues_at_most_once_in_a_fixed_step()
        {
            var runner = Add<Runner>();
            var inner = runner.StartCoroutine(runner.Fixed());
            runner.StartCoroutine(runner.AwaitThenFixed(inner));
            Frames(1);
            Assert.That(Events(), Is.EqualTo("fixed Update LateUpdate"));
            Frames(1);
            Assert.That(Events(), Is.EqualTo("fixed Update LateUpdate continued Update LateUpdate"));
        }

        [Test]
        public void A_coroutine_does_not_continue_if_the_awaited_one_is_stopped()
        {
            var runner = Add<Runner>();
            var inner = runner.StartCoroutine(runner.Frames());
            runner.StartCoroutine(runner.Await(() => inner));
            Frames(1);
            runner.StopCoroutine(inner);
            Frames(3);
            Assert.That(Notes, Has.No.Member("continued"));
        }

        [Test]
        public void Only_one_coroutine_can_await_another()
        {
            var runner = Add<Runner>();
            var inner = runner.StartCoroutine(runner.Frames());
            runner.StartCoroutine(runner.Await(() => inner));
            runner.StartCoroutine(runner.Await(() => inner));
            Assert.That(Errors[0], Is.StringContaining("Another coroutine is already waiting"));
            Frames(3);
            Assert.That(Notes.FindAll(note => note == "continued").Count, Is.EqualTo(1));
        }

        [Test]
        public void A_coroutine_ends_when_stopped_or_when_its_object_is_deactivated()
        {
            var runner = Add<Runner>();
            runner.StopCoroutine(runner.StartCoroutine(runner.Frames()));
            runner.StartCoroutine(runner.Frames());
            runner.gameObject.SetActive(false);
            runner.gameObject.SetActive(true);
            Frames(2);
            Assert.That(Notes, Has.No.Member("b"));
        }

        public class SelfStopping : MonoBehaviour
        {
            public IEnumerator WaitFor(Coroutine other, bool stops)
            {
                if (stops) StopAllCoroutines();
                yield return other;
                Notes.Add("waited");
            }

            public IEnumerator Run(System.Action<IEnumerator> end, IEnumerator[] self)
            {
                end(self[0]);
                yield return null;
                Notes.Add("continued");
            }
        }

        [Test]
        public void A_coroutine_can_end_before_its_first_yield()
        {
            var script = Add<SelfStopping>();
            var ends = new System.Action<IEnumerator>[]
            {
                self => script.StopCoroutine(self), self => script.StopAllCoroutines(), self => script.gameObject.SetActive(false),
            };
            foreach (var end in ends)
            {
                var self = new IEnumerator[1];
                script.StartCoroutine(self[0] = script.Run(end, self));
                script.gameObject.SetActive(true);
                Frames(2);
                Assert.That(Notes, Is.Empty);
            }
        }

        [Test]
        public void A_coroutine_that_stopped_itself_does_not_wait_for_another()
        {
            var script = Add<SelfStopping>();
            var awaited = Add<SelfStopping>("other").StartCoroutine(Pause());
            script.StartCoroutine(script.WaitFor(awaited, true));
            script.StartCoroutine(script.WaitFor(awaited, false));
            Frames(2);
            Assert.That(Errors, Is.Empty);
            Assert.That(Events(), Is.EqualTo("waited"));
        }

        static IEnumerator Pause()
        {
            yield return null;
        }

        public class LastWish : MonoBehaviour
        {
            void OnDestroy() => StartCoroutine(Speak());

            IEnumerator Speak()
            {
                yield return null;
                Notes.Add("spoken");
            }
        }

        [Test]
        public void A_coroutine_that_OnDestroy_starts_ends_with_its_script()
        {
            Object.Destroy(Add<LastWish>());
            Frames(3);
            Assert.That(Notes, Is.Empty);
        }

        [Test]
        public void Start_can_be_a_coroutine()
        {
            Add<StartsAsCoroutine>();
            Frames(2);
            Assert.That(Events(), Is.EqualTo("first second"));
        }

        [Test]
        public void An_async_method_continues_on_the_main_thread_once_per_frame()
        {
            Add<StartsAsync>();
            Frames(1);
            Assert.That(Events(), Is.EqualTo("frame 0 True"));
            Frames(1);
            Assert.That(Events(), Is.EqualTo("frame 0 True frame 1 True"));
            Frames(1);
            Assert.That(Errors, Is.EqualTo(new[] { "failed" }));
            Assert.That(Loop.FailedCalls, Is.EqualTo(1));
        }
    }
}
