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
    /// Runs a scenario for a sweep, one or more times with one JVM. Requests and answers are lines of JSON on the descriptor <c>--channel</c>; an answer has
    /// the <c>id</c> of its request. <c>{"start": true, "set": {KEY: VALUE}}</c> starts the JVM. Its answer has <c>keepsState</c>: the part of the scripts
    /// that could leave state for the next run, or null. <c>{"out": FOLDER, "set": ...}</c> runs the scenario; the answer has its exit <c>code</c>, and
    /// <c>again</c>: whether another run may follow. A run prints to log.txt in its folder. <c>{"check": true, "set": ...}</c> reads the scenario
    /// and the scene's fields, and runs nothing; the answer has the <c>problem</c>, or the names of the scene's <c>metrics</c>. The process
    /// ends when the channel is closed.
    /// </summary>
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
            // Child processes of scripts must neither answer nor keep the channel open.
            Syscall.fcntl(options.Channel, FcntlCommand.F_SETFD, CloseOnExec);
            channel = new UnixStream(options.Channel);
            // As in the editor, the JVM keeps running when a run ends.
            Loop.IsEditor = true;
            new Thread(ReadRequests) { IsBackground = true }.Start();
        }

        /// <summary>Answers requests until a run leaves state that could affect the next one.</summary>
        internal void Serve()
        {
            while (true)
            {
                var request = JObject.Parse(requests.Take());
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
            // The sweep has ended.
            Syscall._exit(1);
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
                // The run fails in the same way, and reports it.
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
            catch (ScenarioException error)
            {
                problem = error.Message;
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
            Directory.CreateDirectory(folder);
            using (var log = new StreamWriter(Path.Combine(folder, "log.txt")) { AutoFlush = true })
            {
                var writer = TextWriter.Synchronized(log);
                Console.SetOut(writer);
                Console.SetError(writer);
                try
                {
                    code = new ScenarioRun(Read(request), options.For(folder), interrupt, DateTime.Now).Run();
                }
                catch (Exception error)
                {
                    code = Program.Report(error);
                }
                Console.SetOut(TextWriter.Null);
                Console.SetError(TextWriter.Null);
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
