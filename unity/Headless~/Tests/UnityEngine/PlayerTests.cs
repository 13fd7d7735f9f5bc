using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using NUnit.Framework;
using Unity.Collections;
using UnityEngine;
using UnityEngine.Headless;
using UnityEngine.SceneManagement;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class PlayerTests : PlayerFixture
    {
        static class Hooks
        {
            [RuntimeInitializeOnLoadMethod] static void Last() => Notes.Add("after scene");
            [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.BeforeSceneLoad)] static void Before() => Notes.Add("before scene");
            [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.BeforeSplashScreen)] static void Splash() => Notes.Add("splash");
            [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.AfterAssembliesLoaded)] static void Loaded() => Notes.Add("assemblies");
            [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)] static void Register() => Notes.Add("subsystems");
        }

        [Test]
        public void Start_runs_initialisers_in_order_around_the_scene()
        {
            Loop.Reset();
            Notes.Clear();
            Loop.Start(1, () => Notes.Add("scene"));
            Assert.That(Events(), Is.EqualTo("subsystems assemblies splash before scene scene after scene"));
        }

        [Test]
        public void A_player_rejects_a_second_start_and_frames_after_quitting()
        {
            Assert.Throws<InvalidOperationException>(() => Loop.Start(1));
            Loop.Quit();
            Assert.Throws<InvalidOperationException>(() => Loop.Frame(0.02f));
        }

        [Test]
        public void Reset_restores_the_initial_state()
        {
            Add<BoxCollider>();
            Time.timeScale = 2f;
            Physics.gravity = Vector3.zero;
            Physics.IgnoreLayerCollision(1, 2);
            Loop.Frame(0.02f);
            Loop.Reset();
            Assert.That(SceneManager.GetActiveScene().rootCount, Is.EqualTo(0));
            Assert.That(Physics.CheckSphere(Vector3.zero, 1f), Is.False);
            Assert.That(new[] { Time.time, Time.frameCount, Time.timeScale }, Is.EqualTo(new[] { 0f, 0f, 1f }));
            Assert.That(Physics.gravity.y, Is.EqualTo(-9.81f));
            Assert.That(Physics.GetIgnoreLayerCollision(1, 2), Is.False);
        }

        [Test]
        public void Time_has_a_frame_clock_and_a_fixed_clock()
        {
            Loop.Frame(0.05f);
            Assert.That(Time.time, Is.EqualTo(0.05f).Within(1e-6f));
            Assert.That(Time.fixedTime, Is.EqualTo(0.04f).Within(1e-6f));
            Time.timeScale = 0.5f;
            Loop.Frame(0.1f);
            Assert.That(Time.deltaTime, Is.EqualTo(0.05f).Within(1e-6f));
            Assert.That(Time.unscaledDeltaTime, Is.EqualTo(0.1f));
            Loop.Frame(100f);
            Assert.That(Time.deltaTime, Is.EqualTo(Time.maximumDeltaTime * 0.5f));
            Assert.That(Time.frameCount, Is.EqualTo(3));
        }

        [Test]
        public void A_capture_interval_replaces_the_scaled_time_only()
        {
            Time.captureDeltaTime = 0.1f;
            Loop.Frame(0.03f);
            Assert.That(new[] { Time.deltaTime, Time.time, Time.unscaledDeltaTime, Time.unscaledTime }, Is.EqualTo(new[] { 0.1f, 0.1f, 0.03f, 0.03f }));
        }

        [Test]
        public void Quit_can_be_cancelled_by_wantsToQuit()
        {
            var allowed = false;
            Application.wantsToQuit += () => allowed;
            Application.Quit(3);
            Assert.That(Loop.QuitRequested, Is.False);
            allowed = true;
            Application.Quit(3);
            Assert.That(Loop.QuitRequested, Is.True);
            Assert.That(Loop.ExitCode, Is.EqualTo(3));
        }

        [Test]
        public void A_handler_that_throws_is_logged_and_stops_nothing()
        {
            Application.wantsToQuit += () => throw new Exception("wantsToQuit");
            SceneManager.sceneLoaded += (scene, mode) => throw new Exception("sceneLoaded");
            SceneManager.sceneUnloaded += scene => throw new Exception("sceneUnloaded");
            Application.Quit();
            Assert.That(Loop.QuitRequested, Is.True);
            AdditiveScene.Unload(AdditiveScene.Load("Second", () => { }));
            Assert.That(Errors, Is.EqualTo(new[] { "wantsToQuit", "sceneLoaded", "sceneUnloaded" }));
        }

        [Test]
        public void Log_messages_are_sent_to_logMessageReceived()
        {
            Loop.Reset(); // restores the player's own log handler
            var heard = new List<string>();
            Application.logMessageReceived += (text, stack, type) => heard.Add(type + ": " + text);
            Debug.Log("note");
            Debug.LogWarningFormat("{0} of {1}", 1, 2);
            Debug.LogException(new InvalidOperationException("broken"));
            Assert.That(heard, Is.EqualTo(new[] { "Log: note", "Warning: 1 of 2", "Exception: InvalidOperationException: broken" }));
        }

        sealed class Arguments : ILogHandler
        {
            public readonly List<object> All = new List<object>();
            public void LogFormat(LogType logType, UnityEngine.Object context, string format, params object[] args) => All.AddRange(args);
            public void LogException(Exception exception, UnityEngine.Object context) { }
        }

        [Test]
        public void Log_handlers_receive_messages_as_text()
        {
            var arguments = new Arguments();
            Debug.unityLogger.logHandler = arguments;
            Debug.Log(1.5f);
            Debug.unityLogger.Log("tag", new Vector2(1f, 2f));
            Debug.Log(null);
            Assert.That(arguments.All, Is.EqualTo(new object[] { "1.5", "tag", "(1.00, 2.00)", "Null" }));
        }

        [Test]
        public void Accessing_material_creates_a_copy_for_the_renderer()
        {
            var shared = new Material(Shader.Find("Standard"));
            var renderer = GameObject.CreatePrimitive(PrimitiveType.Sphere).GetComponent<Renderer>();
            renderer.sharedMaterial = shared;
            renderer.material.color = Color.red;
            Assert.That(shared.color, Is.EqualTo(Color.white));
            Assert.That(renderer.material.color, Is.EqualTo(Color.red));

            var block = new MaterialPropertyBlock();
            block.SetColor("_Color", Color.blue);
            renderer.SetPropertyBlock(block);
            block.Clear();
            renderer.GetPropertyBlock(block);
            Assert.That(block.GetColor("_Color"), Is.EqualTo(Color.blue));
            Assert.That(renderer.bounds.size, Is.EqualTo(Vector3.one));
        }

        [Test]
        public void Renderers_with_the_same_assigned_material_have_their_own_copies()
        {
            Renderer a = Add<MeshRenderer>(), b = Add<MeshRenderer>();
            var shared = a.material = b.material = new Material(Shader.Find("Standard"));
            a.material.color = Color.red;
            Assert.That(b.material.color, Is.EqualTo(Color.white));
            Assert.That(shared.color, Is.EqualTo(Color.white));
            Assert.That(a.material, Is.SameAs(a.sharedMaterial).And.Not.SameAs(shared));
        }

        [Test]
        public void Property_blocks_are_not_copied_by_Instantiate()
        {
            var original = Add<MeshRenderer>();
            var block = new MaterialPropertyBlock();
            block.SetColor("_Color", Color.blue);
            original.SetPropertyBlock(block);
            UnityEngine.Object.Instantiate(original).GetPropertyBlock(block);
            Assert.That(block.isEmpty);
        }

        [Test]
        public void Settings_of_a_renderer_are_copied_by_Instantiate()
        {
            var original = Add<MeshRenderer>();
            original.shadowCastingMode = UnityEngine.Rendering.ShadowCastingMode.Off;
            original.receiveShadows = false;
            original.sortingOrder = 3;
            var copy = UnityEngine.Object.Instantiate(original);
            Assert.That((copy.shadowCastingMode, copy.receiveShadows, copy.sortingOrder), Is.EqualTo((original.shadowCastingMode, false, 3)));
        }

        [Test]
        public void The_first_array_of_a_property_determines_its_length()
        {
            var block = new MaterialPropertyBlock();
            block.SetVectorArray("_Places", new[] { new Vector4(1f, 0f, 0f, 0f), new Vector4(2f, 0f, 0f, 0f) });
            block.SetVectorArray("_Places", new[] { new Vector4(3f, 0f, 0f, 0f) });
            Assert.That(Array.ConvertAll(block.GetVectorArray("_Places"), place => place.x), Is.EqualTo(new[] { 3f, 2f }));
            block.SetVectorArray("_Places", new List<Vector4>(new Vector4[3]));
            Assert.That(block.GetVectorArray("_Places"), Is.EqualTo(new Vector4[2]));
            Assert.Throws<ArgumentException>(() => block.SetVectorArray("_None", new Vector4[0]));
        }

        [Test]
        public void Draws_are_recorded_for_one_frame()
        {
            var parameters = new RenderParams(new Material(Shader.Find("Standard")));
            Graphics.RenderPrimitives(in parameters, MeshTopology.Triangles, 3, 5);
            Assert.That(DrawLog.Draws.Count, Is.EqualTo(1));
            Assert.That(DrawLog.Draws[0].Instances, Is.EqualTo(5));
            Loop.Frame(0.02f);
            Assert.That(DrawLog.Draws, Is.Empty);
        }

        [Test]
        public void Instanced_draws_require_a_material_with_instancing()
        {
            var material = new Material(Shader.Find("Standard"));
            var parameters = new RenderParams(material);
            var places = new Matrix4x4[10];
            Assert.That(() => Graphics.RenderMeshInstanced(parameters, null, 0, places, 7), Throws.InvalidOperationException);
            material.enableInstancing = true;
            Graphics.RenderMeshInstanced(parameters, null, 0, places, 7);
            Graphics.RenderMeshInstanced(parameters, null, 0, places);
            Assert.That(DrawLog.Draws.Select(draw => draw.Instances), Is.EqualTo(new[] { 7, 10 }));
            Assert.That(() => Graphics.RenderMeshInstanced(parameters, null, 0, places, 7, 4), Throws.InstanceOf<System.ArgumentOutOfRangeException>());
        }

        [Test]
        public void Time_has_a_shortest_fixed_step_and_no_negative_scale()
        {
            Time.fixedDeltaTime = 0f;
            Assert.That(Time.fixedDeltaTime, Is.EqualTo(0.0001f));
            Time.timeScale = -1f;
            Assert.That(Time.timeScale, Is.EqualTo(1f));
            Assert.That(Errors.Count, Is.EqualTo(1));
        }

        [Test]
        public void Handlers_of_log_messages_can_log()
        {
            Loop.Reset();
            var received = "";
            Application.logMessageReceived += (message, stack, type) => Debug.Log("handled " + (received += message));
            Debug.Log("message");
            Assert.That(received, Is.EqualTo("message"));
        }

        [Test]
        public void Handlers_of_log_messages_can_throw()
        {
            Loop.Reset();
            var received = 0;
            Application.logMessageReceived += (message, stack, type) => throw new Exception(message);
            Application.logMessageReceivedThreaded += (message, stack, type) => received++;
            Debug.Log("message");
            Assert.That(received, Is.EqualTo(1));
        }

        [Test]
        public void Only_logMessageReceivedThreaded_receives_messages_of_other_threads()
        {
            Loop.Reset();
            Loop.Start(1);
            int main = 0, any = 0;
            Application.logMessageReceived += (message, stack, type) => main++;
            Application.logMessageReceivedThreaded += (message, stack, type) => any++;
            var thread = new Thread(() => Debug.Log("from a thread"));
            thread.Start();
            thread.Join();
            Assert.That((main, any), Is.EqualTo((0, 1)));
        }

        [Test]
        public void Native_arrays_check_their_bounds()
        {
            var array = new NativeArray<int>(4, Allocator.Temp);
            var part = array.GetSubArray(1, 2);
            Assert.Throws<IndexOutOfRangeException>(() => _ = part[2]);
            Assert.Throws<IndexOutOfRangeException>(() => _ = part[-1]);
            Assert.Throws<ArgumentOutOfRangeException>(() => array.GetSubArray(3, 2));
            array.Dispose();
        }

        [Test]
        public void A_native_array_that_was_not_created_can_be_disposed()
        {
            var array = default(NativeArray<int>);
            array.Dispose();
            array = new NativeArray<int>(4, Allocator.Temp);
            array.Dispose();
            array.Dispose();
            Assert.That(array.IsCreated, Is.False);
        }

        [Test]
        public void Copies_and_parts_of_a_disposed_native_array_cannot_be_used()
        {
            var array = new NativeArray<int>(4, Allocator.Temp);
            var copy = array;
            var part = array.GetSubArray(1, 2);
            array.GetSubArray(0, 1).Dispose();
            array[0] = 1;
            array.Dispose();
            Assert.Throws<ObjectDisposedException>(() => _ = copy[0]);
            Assert.Throws<ObjectDisposedException>(() => copy[0] = 1);
            Assert.Throws<ObjectDisposedException>(() => copy.AsSpan());
            Assert.Throws<ObjectDisposedException>(() => _ = part[0]);
            Assert.Throws<ObjectDisposedException>(() => copy.Dispose());
        }

        [Test]
        public void A_mesh_keeps_the_triangles_of_each_submesh()
        {
            var mesh = new Mesh { vertices = new Vector3[6], subMeshCount = 2 };
            mesh.SetTriangles(new[] { 0, 1, 2 }, 0);
            mesh.SetIndices(new List<int> { 0, 1, 2 }, MeshTopology.Triangles, 1, true, 3);
            Assert.That(mesh.triangles, Is.EqualTo(new[] { 0, 1, 2, 3, 4, 5 }));
            mesh.SetTriangles(new[] { 0, 1, 2 }, 2);
            Assert.That(Errors.Count, Is.EqualTo(1));
            mesh.triangles = new[] { 3, 4, 5 };
            Assert.That(mesh.triangles, Is.EqualTo(new[] { 3, 4, 5 }));
        }

        [Test]
        public void Arrays_that_do_not_fit_a_mesh_are_errors_and_change_nothing()
        {
            var mesh = new Mesh { triangles = new[] { 0, 1, 2 } };
            Assert.That((mesh.triangles.Length, Errors.Count), Is.EqualTo((0, 1)));
            mesh.vertices = new Vector3[3];
            mesh.triangles = new[] { 0, 1, 2 };
            Assert.That(Errors.Count, Is.EqualTo(1));
            mesh.triangles = new[] { 0, 1, 2, 0 };
            mesh.triangles = new[] { 0, 1, 3 };
            mesh.triangles = new[] { 0, 1, -1 };
            mesh.vertices = new Vector3[2];
            mesh.normals = new Vector3[2];
            mesh.colors = new Color[4];
            Assert.That(Errors.Count, Is.EqualTo(7));
            Assert.That((mesh.vertexCount, mesh.normals.Length, mesh.colors.Length), Is.EqualTo((3, 0, 0)));
            mesh.subMeshCount = 2;
            mesh.triangles = new[] { 0, 1, 3 };
            Assert.That((mesh.subMeshCount, Errors.Count), Is.EqualTo((2, 8)));
            Assert.That(mesh.triangles, Is.EqualTo(new[] { 0, 1, 2 }));
        }

        [Test]
        public void A_copy_of_a_mesh_has_its_normals_and_colours_even_if_vertices_were_added()
        {
            var mesh = new Mesh { vertices = new Vector3[1], normals = new[] { Vector3.up }, colors = new[] { Color.red } };
            mesh.vertices = new Vector3[2];
            var copy = UnityEngine.Object.Instantiate(mesh);
            Assert.That(Errors, Is.Empty);
            Assert.That((copy.vertexCount, copy.normals[0], copy.colors[0]), Is.EqualTo((2, Vector3.up, Color.red)));
        }
    }
}
