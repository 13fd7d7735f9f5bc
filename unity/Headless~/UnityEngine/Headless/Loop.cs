using System;
using System.Collections.Generic;
using System.Reflection;
using System.Threading;

namespace UnityEngine.Headless
{
    /// Replaces Unity's player. Runs the scene frame by frame on the calling thread, with the phases of Unity's loop.
    public static class Loop
    {
        static readonly RuntimeInitializeLoadType[] BeforeScene =
        {
            RuntimeInitializeLoadType.SubsystemRegistration, RuntimeInitializeLoadType.AfterAssembliesLoaded,
            RuntimeInitializeLoadType.BeforeSplashScreen, RuntimeInitializeLoadType.BeforeSceneLoad,
        };

        static bool started;
        static Thread main;
        static MainThreadContext tasks;
        static int searched;
        static List<MethodInfo> found;

        /// The value of `Application.isEditor`. If it is true, the process continues after `Quit`, like the editor after play mode.
        public static bool IsEditor { get; set; }

        /// The value of `Application.isBatchMode`.
        public static bool IsBatchMode { get; set; } = true;

        /// The value of `Application.dataPath`: by default, the folder of this program.
        public static string DataPath { get; set; } = AppDomain.CurrentDomain.BaseDirectory;

        /// The asset path of the scene that the editor opened.
        public static string ScenePath { set => SceneManagement.Scene.Active.File = value; }

        /// Lists another scene in the Hierarchy window without loading it.
        public static void AddUnloadedScene() => SceneManagement.Scene.Loaded.Add(new SceneManagement.Scene("Unloaded") { IsUnloaded = true });

        /// The last address that a script opened in a browser.
        public static string OpenedUrl { get; internal set; } = "";

        /// Seed for permuting orders that Unity does not specify; 0: order of creation. Affected are the messages of a frame with the same execution order,
        /// the touches of a step and their two sides, and the enabling of objects that become active together.
        public static int OrderSeed { get => Orders.Seed; set => Orders.Reset(value); }

        /// The value of `SystemInfo.supportsComputeShaders`. In Unity, it is false with -nographics.
        public static bool HasComputeShaders { get; set; } = true;

        /// Number of physics threads of the next world. Results do not depend on it.
        public static int PhysicsThreads { get => PhysicsWorld.Threads; set => PhysicsWorld.Threads = value; }

        /// Set by `Application.Quit`. The caller must then leave its frame loop and call `Quit`.
        public static bool QuitRequested { get; private set; }
        public static int ExitCode { get; private set; }

        /// Number of message methods, coroutines and other callbacks that threw an exception.
        public static long FailedCalls { get; private set; }

        /// Whether this is the thread of the running player. Without a player, every thread is.
        internal static bool IsMainThread => main == null || main == Thread.CurrentThread;

        /// Enters play mode. Seeds `Random`, runs the methods with [RuntimeInitializeOnLoadMethod] of all loaded assemblies, and calls `buildScene` when
        /// Unity would load the first scene. Objects that were created before also belong to the scene.
        public static void Start(int seed, Action buildScene = null)
        {
            if (started) throw new InvalidOperationException("The player is already running: call Loop.Quit or Loop.Reset first.");
            started = true;
            main = Thread.CurrentThread;
            SynchronizationContext.SetSynchronizationContext(tasks = new MainThreadContext());
            Random.InitState(seed);
            var methods = InitializeMethods();
            foreach (var type in BeforeScene) Initialize(methods, type);
            buildScene?.Invoke();
            SceneManagement.SceneManager.RaiseLoaded(SceneManagement.Scene.Active, SceneManagement.LoadSceneMode.Single);
            Initialize(methods, RuntimeInitializeLoadType.AfterSceneLoad);
        }

        /// Runs one frame of `deltaTime` seconds: the fixed steps that are due, Update, coroutines, async methods, LateUpdate, destruction and
        /// the coroutines that wait for the end of the frame.
        public static void Frame(float deltaTime)
        {
            if (!started) throw new InvalidOperationException("The player is not running: call Loop.Start first.");
            DrawLog.Clear();
            Time.BeginFrame(deltaTime);
            Lifecycle.RunStarts();
            while (Time.BeginFixedStep())
            {
                Lifecycle.RunFixedUpdates();
                if (Physics.simulationMode == SimulationMode.FixedUpdate) PhysicsWorld.Step(Time.fixedDeltaTime);
                CoroutineScheduler.Run(CoroutinePhase.FixedUpdate);
                Time.EndFixedStep();
            }
            Lifecycle.RunUpdates();
            if (Physics.simulationMode == SimulationMode.Update && Time.deltaTime > 0f) PhysicsWorld.Step(Time.deltaTime);
            CoroutineScheduler.Run(CoroutinePhase.Update);
            tasks.Run();
            Lifecycle.RunLateUpdates();
            Destruction.RunDue();
            CoroutineScheduler.Run(CoroutinePhase.EndOfFrame);
        }

        /// Leaves play mode. Calls OnApplicationQuit, raises `Application.quitting`, and destroys all objects.
        public static void Quit()
        {
            if (!started) return;
            var scripts = new List<MonoBehaviour>();
            foreach (var root in SceneManagement.Scene.AllRoots()) scripts.AddRange(root.GetComponentsInChildren<MonoBehaviour>());
            foreach (var script in scripts)
                if (script && script.gameObject.activeInHierarchy) Messages.Send(script.messages.OnApplicationQuit, script);
            Application.RaiseQuitting();
            Destruction.DestroyScene();
            SceneManagement.SceneManager.RaiseUnloaded(SceneManagement.Scene.Active);
            SynchronizationContext.SetSynchronizationContext(null);
            started = false;
            main = null;
        }

        /// Quits if needed, and resets all state between tests: objects, handlers, clocks and physics.
        public static void Reset()
        {
            Quit();
            Destruction.DestroyScene();
            Lifecycle.ResetState();
            CoroutineScheduler.ResetState();
            PhysicsWorld.ResetState();
            Time.ResetState();
            Random.InitState(0);
            Debug.ResetState();
            Material.ResetState();
            Mesh.ResetState();
            Object.ForgetCount();
            Application.ResetState();
            SceneManagement.SceneManager.ResetState();
            DrawLog.Clear();
            HasComputeShaders = true;
            OrderSeed = 0;
            QuitRequested = false;
            ExitCode = 0;
            FailedCalls = 0;
        }

        internal static void LogFailedCall(Exception exception, Object context = null)
        {
            FailedCalls++;
            Debug.LogException(exception, context);
        }

        /// Calls each handler. If a handler throws an exception, logs it and calls the next one.
        internal static void InvokeAll(Action handlers)
        {
            if (handlers == null) return;
            foreach (Action handler in handlers.GetInvocationList())
            {
                try
                {
                    handler();
                }
                catch (Exception exception)
                {
                    LogFailedCall(exception);
                }
            }
        }

        internal static void RequestQuit(int exitCode)
        {
            QuitRequested = true;
            ExitCode = exitCode;
        }

        /// Returns the methods with [RuntimeInitializeOnLoadMethod] in all assemblies that use UnityEngine. They are sorted by assembly name and position,
        /// so that the order is the same in every run. The result is cached until another assembly is loaded, because searching all types takes as long as
        /// a short run.
        static List<MethodInfo> InitializeMethods()
        {
            var loaded = AppDomain.CurrentDomain.GetAssemblies().Length;
            if (loaded == searched) return found;
            searched = loaded;
            var methods = found = new List<MethodInfo>();
            var engine = typeof(Loop).Assembly.GetName().Name;
            var assemblies = new List<Assembly>();
            foreach (var assembly in AppDomain.CurrentDomain.GetAssemblies())
                if (Array.Exists(assembly.GetReferencedAssemblies(), reference => reference.Name == engine)) assemblies.Add(assembly);
            assemblies.Sort((a, b) => string.CompareOrdinal(a.FullName, b.FullName));
            foreach (var assembly in assemblies)
                foreach (var type in assembly.GetTypes())
                    foreach (var method in type.GetMethods(BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
                        if (method.IsDefined(typeof(RuntimeInitializeOnLoadMethodAttribute), false)) methods.Add(method);
            return methods;
        }

        static void Initialize(List<MethodInfo> methods, RuntimeInitializeLoadType when)
        {
            foreach (var method in methods)
            {
                if (method.GetCustomAttribute<RuntimeInitializeOnLoadMethodAttribute>().loadType != when) continue;
                if (method.GetParameters().Length > 0 || method.ContainsGenericParameters)
                {
                    Debug.LogError($"'{method.DeclaringType}.{method.Name}' with [RuntimeInitializeOnLoadMethod] is not called, because it "
                        + (method.GetParameters().Length > 0 ? "has parameters." : "is generic."));
                    continue;
                }
                try
                {
                    method.Invoke(null, null);
                }
                catch (TargetInvocationException exception)
                {
                    LogFailedCall(exception.InnerException);
                }
            }
        }
    }
}
