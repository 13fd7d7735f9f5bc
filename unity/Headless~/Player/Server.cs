using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using System.Text;
using System.Threading;
using Collektive.Bridge;
using Collektive.Unity;
using Mono.Unix;
using Mono.Unix.Native;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
using UnityEngine.Headless;

namespace Collektive.Headless
{
    /// <summary>
    /// Runs a scenario for a sweep, one or more times with the same JVM. Requests and answers are lines of JSON on the descriptor <c>--channel</c>. An
    /// answer contains the <c>id</c> of its request. The process ends when the channel is closed.
    /// </summary>
    /// <remarks>
    /// <para><c>{"start": true, "set": {KEY: VALUE}}</c> starts the JVM. In the answer, <c>keepsState</c> is the part of the scripts that could leave state
    /// for the next run, or null.</para>
    /// <para><c>{"out": FOLDER, "set": ...}</c> runs the scenario, which prints to log.txt in the folder. In the answer, <c>code</c> is the exit code, and
    /// <c>again</c> states whether another run may follow.</para>
    /// <para><c>{"check": true, "set": ...}</c> checks the scenario and the scene's fields without running them. The answer contains the <c>problem</c>, or
    /// the names of the run's <c>metrics</c>.</para>
    /// </remarks>
    internal sealed class Server
    {
        private const int CloseOnExec = 1;

        private readonly BlockingCollection<string> requests = new BlockingCollection<string>();
        private readonly Interrupt interrupt = new Interrupt();
        private readonly UnixStream channel;
        private readonly Options options;
        private ScriptState state;

        internal Server(Options options)
        {
            this.options = options;
            // Processes that scripts start must not inherit the channel. They could send answers, and would keep the channel open.
            Syscall.fcntl(options.Channel, FcntlCommand.F_SETFD, CloseOnExec);
            channel = new UnixStream(options.Channel);
            ResultFile.Syncs = false;
            JvmShutdown.IsEnabled = false;
            new Thread(ReadRequests) { IsBackground = true }.Start();
        }

        /// <summary>Answers requests until a run fails or leaves state that could affect the next run.</summary>
        internal void Serve()
        {
            while (true)
            {
                var request = (JObject)JsonFile.Parse(requests.Take());
                var answer = (bool?)request["check"] == true ? Check(request) : (bool?)request["start"] == true ? Start(request) : Run(request);
                answer.AddFirst(new JProperty("id", request["id"]));
                var line = Encoding.UTF8.GetBytes(answer.ToString(Formatting.None) + "\n");
                channel.Write(line, 0, line.Length);
                if ((bool?)answer["again"] == false) return;
            }
        }

        private void ReadRequests()
        {
            var reader = new StreamReader(channel, Encoding.UTF8);
            for (string line; (line = reader.ReadLine()) != null;) requests.Add(line);
            // The sweep has ended and closed the channel.
            Program.Exit(1);
        }

        private JObject Start(JObject request)
        {
            state = new ScriptState(Assembly.LoadFrom(options.Scripts));
            Installation.HostJar = options.HostJar;
            Installation.JavaHome = options.JavaHome;
            try
            {
                Jvm.Start(Installation.ToLaunch(Read(request).Jvm));
            }
            catch (Exception error) when (error is BridgeException || error is ScenarioException)
            {
                // The run will fail in the same way and report the error.
            }
            return new JObject(new JProperty("keepsState", state.Problem));
        }

        private JObject Check(JObject request)
        {
            string problem = null;
            IReadOnlyList<string> metrics = null;
            try
            {
                metrics = ScenarioRun.Check(Read(request), options);
            }
            catch (Exception error)
            {
                problem = Program.Describe(error);
            }
            finally
            {
                Loop.Reset();
            }
            return new JObject(new JProperty("problem", problem), new JProperty("metrics", metrics == null ? null : new JArray(metrics)));
        }

        private JObject Run(JObject request)
        {
            var folder = (string)request["out"];
            int code;
            var (output, errors) = (Console.Out, Console.Error);
            Directory.CreateDirectory(folder);
            using (var log = new StreamWriter(Path.Combine(folder, "log.txt")) { AutoFlush = true })
            {
                var writer = TextWriter.Synchronized(log);
                Console.SetOut(writer);
                Console.SetError(writer);
                try
                {
                    code = new ScenarioRun(Read(request), options.For(folder), interrupt, TimeSpan.Zero).Run();
                }
                catch (Exception error)
                {
                    code = Program.Report(error);
                }
                Console.SetOut(output);
                Console.SetError(errors);
            }
            Loop.Reset();
            return new JObject(new JProperty("code", code), new JProperty("again", code == 0 && Jvm.State == JvmState.Running && state.IsUnchanged));
        }

        private Scenario Read(JObject request)
        {
            var assignments = new List<Assignment>();
            foreach (var property in ((JObject)request["set"]).Properties()) assignments.Add(new Assignment(property.Name, property.Value.DeepClone()));
            return Scenario.Read(options.Scenario, options.Folder, options.TrustJvm, assignments.ToArray());
        }
    }
}
