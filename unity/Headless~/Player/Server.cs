using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using System.Threading;
using Collektive.Bridge;
using Mono.Unix.Native;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
using UnityEngine.Headless;

namespace Collektive.Headless
{
    /// <summary>
    /// Runs one scenario many times in this process, with one JVM. Each line of standard input is a request, <c>{"out": FOLDER, "set": {KEY: VALUE}}</c>; the
    /// answer is a line of standard output that begins with <see cref="Mark"/>: <c>{"code": EXIT CODE, "again": WHETHER ANOTHER RUN MAY FOLLOW}</c>. What a run
    /// prints goes to log.txt in its folder. A request with <c>"check": true</c> reads the scenario and the scene's fields, and runs nothing; its
    /// answer has the problem, or the names of the scene's metrics. The end of the input ends the process, in the middle of a run, too.
    /// </summary>
    internal sealed class Server
    {
        private const string Mark = "collektive-run ";

        private readonly BlockingCollection<string> requests = new BlockingCollection<string>();
        private readonly Interrupt interrupt = new Interrupt();
        private readonly TextWriter answers = Console.Out;
        private readonly Options options;

        internal Server(Options options)
        {
            this.options = options;
            // As in the editor, the JVM stays when a run ends.
            Loop.IsEditor = true;
            new Thread(ReadRequests) { IsBackground = true }.Start();
        }

        /// <summary>Answers requests until a run leaves something behind that the next one could see.</summary>
        internal void Serve()
        {
            var state = new ScriptState(Assembly.LoadFrom(options.Scripts));
            while (true)
            {
                var request = JObject.Parse(requests.Take());
                var answer = (bool?)request["check"] == true ? Check(request) : Run(request, state);
                answers.WriteLine(Mark + answer.ToString(Formatting.None));
                answers.Flush();
                if (!(bool)answer["again"]) return;
            }
        }

        private void ReadRequests()
        {
            for (string line; (line = Console.In.ReadLine()) != null;) requests.Add(line);
            // Who asked is gone.
            Syscall._exit(1);
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
            return new JObject(
                new JProperty("problem", problem), new JProperty("metrics", metrics == null ? null : new JArray(metrics)), new JProperty("again", true));
        }

        private JObject Run(JObject request, ScriptState state)
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
