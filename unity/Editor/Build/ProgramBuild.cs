using System;
using System.Collections.Generic;
using System.IO;
using System.Threading;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Builds the jars of programs and the C# code of their schemas. The builds run one after the other in the <see cref="CompilerProcess"/>, without
    /// blocking the editor. The Progress window shows the current build. Call all members from the main thread.
    /// </summary>
    internal static class ProgramBuild
    {
        /// <summary>The compiler's exit code after an exception in the Kotlin compiler or in a plugin.</summary>
        private const int CompilerCrashed = 2;

        private const int PollMs = 10;

        /// <summary>Key in the session state for the jar whose build was interrupted by a reload of code.</summary>
        private const string CurrentKey = "Collektive.Build";

        private const string Work = "Library/Collektive/Build";

        private static readonly List<SchemaProject> Waiting = new List<SchemaProject>();

        private static SchemaProject current;
        private static string sources;
        private static DateTime startTime;
        private static string request;
        private static int progress;

        /// <summary>Whether the user cancelled the build. The Progress window may set it on another thread.</summary>
        private static volatile bool isCanceled;

        internal static bool IsRunning => current != null || Waiting.Count > 0;

        /// <summary>Builds programs in the background. If the build of a program is already running, the program is built again afterwards.</summary>
        internal static void Start(List<SchemaProject> projects)
        {
            if (!IsRunning) isCanceled = false;
            foreach (var project in projects)
            {
                Waiting.RemoveAll(other => other.Jar == project.Jar);
                Waiting.Add(project);
            }
            EditorApplication.update -= Update;
            EditorApplication.update += Update;
            Update();
        }

        /// <summary>Starts the builds of outdated jars after files or the editor's code changed.</summary>
        /// <param name="changed">Paths of the changed files, relative to the project's folder.</param>
        internal static void StartOutdated(IReadOnlyCollection<string> changed)
        {
            var interrupted = current == null ? SessionState.GetString(CurrentKey, "") : "";
            var projects = SchemaProject.FindAll();
            ToolsMenu.TryRun(() =>
            {
                // A failed build must not be repeated at each reload of code.
                projects = projects.FindAll(project => project.Jar == interrupted
                    || project.IsStale && (project.HasAny(changed) || SessionState.GetString(KeyOf(project), "") != project.Sources));
                return true;
            });
            Start(projects);
        }

        /// <summary>Blocks until all builds have ended. The user can cancel.</summary>
        internal static void Wait()
        {
            try
            {
                while (IsRunning)
                {
                    var schema = (current ?? Waiting[0]).Schema;
                    if (EditorUtility.DisplayCancelableProgressBar("Collektive", "Compiling the programs of " + schema, 0.5f)) isCanceled = true;
                    Update();
                    Thread.Sleep(PollMs);
                }
            }
            finally
            {
                EditorUtility.ClearProgressBar();
            }
        }

        /// <summary>Builds the outdated jars of the projects, and waits for them.</summary>
        /// <returns>The projects whose jars are outdated because their builds failed; the errors are logged.</returns>
        internal static List<SchemaProject> Refresh(List<SchemaProject> projects)
        {
            Start(projects.FindAll(project => project.IsStale && project.Jar != current?.Jar));
            if (IsRunning) Wait();
            return projects.FindAll(project => project.IsStale);
        }

        private static string KeyOf(SchemaProject project) => "Collektive.Built." + project.Jar;

        private static void Update()
        {
            if (isCanceled) Cancel();
            else if (current != null) Continue();
            else if (Waiting.Count > 0) Begin();
            else EditorApplication.update -= Update;
        }

        private static void Begin()
        {
            current = Waiting[0];
            Waiting.RemoveAt(0);
            progress = Progress.Start("Compiling programs", current.Schema, Progress.Options.Indefinite);
            Progress.RegisterCancelCallback(progress, () => isCanceled = true);
            Submit();
        }

        private static void Submit()
        {
            // If the Kotlin files were deleted while the build waited, it would replace the jar with one without programs.
            if (!current.HasPrograms)
            {
                Finish(Progress.Status.Canceled);
                return;
            }
            SessionState.SetString(CurrentKey, current.Jar);
            startTime = DateTime.UtcNow;
            try
            {
                sources = current.Sources;
                SessionState.SetString(KeyOf(current), sources);
                var runtime = current.Runtime;
                var options = OptionsOf(current);
                var libraries = new List<string>(runtime.Library) { Installation.HostJar, runtime.Plugin };
                libraries.AddRange(Array.FindAll(runtime.Arguments(), File.Exists));
                request = CompilerProcess.Submit(Toolchain.FindJdk(), Toolchain.FindKotlin(runtime.Kind), libraries, options);
            }
            catch (Exception error) when (error is ToolException || error is IOException || error is UnauthorizedAccessException)
            {
                Fail(error);
            }
        }

        private static void Continue()
        {
            Progress.Report(progress, -1f);
            try
            {
                if (!CompilerProcess.TryTake(request, out var code, out var output)) return;
                // A file was saved in the meantime, so the program is built again. The process was not killed then, because the compilers would have to be
                // loaded again.
                if (current.Sources != sources) Submit();
                else End(code, output);
            }
            catch (Exception error) when (error is ToolException || error is IOException || error is UnauthorizedAccessException)
            {
                Fail(error);
            }
        }

        private static void End(int code, string output)
        {
            ToolConsole.Show("the compiler for " + current.Schema, code, output);
            if (code == CompilerCrashed)
                Debug.LogError("the Kotlin compiler crashed: the compiler plugin may be built for another version of the compiler; use the plugin's version");
            var built = current;
            Finish(code == 0 ? Progress.Status.Succeeded : Progress.Status.Failed);
            if (code == 0) AssetDatabase.ImportAsset(built.Jar);
            if (built.IsUsed) UpdateWhilePlaying(code == 0);
            if (built.HasGeneratedSince(startTime)) AssetDatabase.Refresh();
        }

        /// <summary>
        /// Loads the new programs into a running simulation. If the build failed, shows in the Game view that the simulation continues with the previous
        /// programs. Does nothing if the project's settings disable reloading.
        /// </summary>
        internal static void UpdateWhilePlaying(bool isBuilt)
        {
            if (SimulationManager.Current == null || !ProjectSettings.instance.reloadWhilePlaying) return;
            BuildFailureLabel.Show(!isBuilt);
            if (isBuilt) SimulationManager.Current.ReloadPrograms();
        }

        /// <summary>Cancels the waiting builds, because they would also fail if a tool is missing.</summary>
        private static void Fail(Exception error)
        {
            Waiting.Clear();
            Debug.LogError(error.Message);
            var failed = current;
            Finish(Progress.Status.Failed);
            if (failed.IsUsed) UpdateWhilePlaying(false);
        }

        private static void Cancel()
        {
            isCanceled = false;
            Waiting.Clear();
            if (current == null) return;
            CompilerProcess.Kill();
            Finish(Progress.Status.Canceled);
        }

        private static void Finish(Progress.Status status)
        {
            current = null;
            SessionState.EraseString(CurrentKey);
            Progress.Finish(progress, status);
        }

        private static List<string> OptionsOf(SchemaProject project)
        {
            var options = new List<string>
            {
                "--flatc", Toolchain.Flatc(), "--include", Toolchain.SchemaFolder, "--schema", Path.GetFullPath(project.Schema),
                "--csharp", Path.GetFullPath(project.Generated), "--jar", Path.GetFullPath(project.Jar), "--work", Path.GetFullPath(Work),
                "--library", Installation.HostJar,
            };
            foreach (var (name, value) in project.Runtime.Marks()) options.AddRange(new[] { "--mark", name + ":" + value });
            foreach (var jar in project.Runtime.Library) options.AddRange(new[] { "--library", jar });
            foreach (var argument in project.Runtime.Arguments()) options.AddRange(new[] { "--kotlin", argument });
            options.AddRange(new[] { "--source", Path.GetFullPath(project.Programs) });
            return options;
        }
    }
}
