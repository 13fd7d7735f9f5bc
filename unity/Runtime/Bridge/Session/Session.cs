using System;
using System.Collections.Generic;
using Collektive.FlatBuffers;
using Frame = org.collektive.frame;

namespace Collektive.Bridge
{
    /// <summary>
    /// One simulation on the JVM, with its nodes, links and programs. <see cref="Step"/> makes exactly one call into the JVM. Not thread-safe; steps
    /// allocate no managed memory in steady state.
    /// </summary>
    internal sealed unsafe class Session : IDisposable
    {
        private const int InitialCapacity = 64 * 1024;
        private const int FinalizerLimitMs = 1000;
        private const int OpeningWaitMs = 1000;

        /// <summary>Simulated times are multiples of a nanosecond.</summary>
        private const int TimeDecimals = 9;

        private readonly SlotAllocator slot;
        private readonly FlatBufferBuilder builder;
        private readonly AnswerMemory answerMemory = new AnswerMemory();
        private readonly ByteBuffer answerBuffer;
        private readonly int closeLimitMs;
        private double pendingDelta;
        private double lastDelta;
        // The tick and time after which all steps have had this delta time.
        private ulong lastDeltaTick;
        private double lastDeltaTime;
        private bool isPending;
        private ulong handle;

        private Session(SessionSettings settings, DataSchema schema)
        {
            closeLimitMs = settings.OpenLimitMs;
            Request = new StepRequest(schema.CreateSensors(), schema.CreateGlobals());
            Answer = new StepAnswer(schema.CreateActuators());
            answerBuffer = new ByteBuffer(answerMemory, 0);
            slot = new SlotAllocator(InitialCapacity);
            builder = new FlatBufferBuilder(new ByteBuffer(slot, 0));
        }

        /// <summary>The programs in the session's jars; null until the session is open.</summary>
        public IReadOnlyList<ProgramInfo> Programs { get; private set; }

        /// <summary>The request of the next step.</summary>
        public StepRequest Request { get; }

        /// <summary>The answer of the last step.</summary>
        public StepAnswer Answer { get; }

        /// <summary>The last tick that succeeded; 0 before the first.</summary>
        public ulong Tick { get; private set; }

        /// <summary>Simulated seconds at the end of the last tick.</summary>
        public double Time { get; private set; }

        /// <summary>Opens a session on the running JVM. Waits while a debugger stops the JVM.</summary>
        /// <exception cref="BridgeException">A jar, a program or the schema does not fit, or no JVM runs.</exception>
        public static Session Open(SessionSettings settings, DataSchema schema)
        {
            var session = BeginOpen(settings, schema);
            while (!session.TryFinish(OpeningWaitMs))
            {
            }
            return session;
        }

        /// <summary>
        /// Like <see cref="Open"/>, but does not wait for a debugger. If one is attached, the session is open only after <see cref="TryFinish"/> returned
        /// true.
        /// </summary>
        public static Session BeginOpen(SessionSettings settings, DataSchema schema)
        {
            var session = new Session(settings, schema);
            try
            {
                session.Connect(settings, schema);
                return session;
            }
            catch
            {
                session.slot.Release();
                throw;
            }
        }

        /// <summary>
        /// Runs one tick of <paramref name="deltaTime"/> simulated seconds with <see cref="Request"/>, and clears the request. After an exception of kind
        /// <see cref="BridgeError.Frame"/>, the session is unchanged.
        /// </summary>
        /// <returns>Whether the tick has ended. If not, a debugger is attached to the JVM, and <see cref="TryFinish"/> completes the tick.</returns>
        /// <exception cref="BridgeException">The step failed; see <see cref="BridgeException.Error"/>.</exception>
        public bool Step(double deltaTime, int limitMs)
        {
            if (handle == 0) throw new ObjectDisposedException(nameof(Session));
            builder.Clear();
            Request.Write(builder, Tick + 1, Time, Tick == 0 ? deltaTime : lastDelta);
            var offset = builder.DataBuffer.Position;
            var length = builder.DataBuffer.Length - offset;
            var answer = new Shim.Answer { Size = (uint)sizeof(Shim.Answer) };
            Answer.Actuators.Retain();
            pendingDelta = deltaTime;
            return TryTake(Shim.clk_step(handle, slot.Slot, offset, length, limitMs, &answer), answer);
        }

        /// <summary>Waits up to <paramref name="waitMs"/> milliseconds for the pending opening or step.</summary>
        /// <returns>Whether the opening or step has finished.</returns>
        /// <exception cref="BridgeException">The opening or the step failed. A session that failed to open is closed.</exception>
        public bool TryFinish(int waitMs)
        {
            if (!isPending) return true;
            var answer = new Shim.Answer { Size = (uint)sizeof(Shim.Answer) };
            var code = Shim.clk_session_wait(handle, waitMs, &answer);
            if (Programs != null) return TryTake(code, answer);
            if (code < 0)
            {
                handle = 0;
                slot.Release();
            }
            return TryTakeOpening(code, answer);
        }

        private bool TryTakeOpening(int code, Shim.Answer answer)
        {
            isPending = code == Shim.Pending;
            if (isPending) return false;
            Shim.Check(code);
            Point(answer);
            var response = Frame.OpenResponse.GetRootAsOpenResponse(answerBuffer);
            Programs = ReadPrograms(response.ProgramsLength, i => response.Programs(i).GetValueOrDefault());
            return true;
        }

        private bool TryTake(int code, Shim.Answer answer)
        {
            isPending = code == Shim.Pending;
            if (isPending) return false;
            Shim.Check(code);
            Tick++;
            // The time is a product, because the rounding errors of a sum would accumulate.
            if (lastDelta != pendingDelta) (lastDelta, lastDeltaTick, lastDeltaTime) = (pendingDelta, Tick - 1, Time);
            Time = Math.Round(lastDeltaTime + (Tick - lastDeltaTick) * lastDelta, TimeDecimals);
            Request.Clear();
            Point(answer);
            Answer.Read(answerBuffer);
            if (Answer.HasReload) ReadReload();
            return true;
        }

        private void ReadReload()
        {
            var reload = Answer.ReloadedPrograms;
            Programs = ReadPrograms(reload.ProgramsLength, i => reload.Programs(i).GetValueOrDefault());
        }

        /// <summary>Closes a session that is still open, for example when its C# domain is unloaded.</summary>
        ~Session()
        {
            if (handle == 0) return;
            Shim.clk_session_close(handle, FinalizerLimitMs);
            Shim.clk_slot_release(slot.Slot);
        }

        /// <summary>Closes the session and releases its memory. A second call does nothing.</summary>
        public void Dispose()
        {
            GC.SuppressFinalize(this);
            if (handle == 0) return;
            var closing = handle;
            handle = 0;
            answerMemory.Detach();
            try
            {
                if (Jvm.State == JvmState.Running) Shim.Check(Shim.clk_session_close(closing, closeLimitMs));
            }
            finally
            {
                slot.Release();
            }
        }

        private void Connect(SessionSettings settings, DataSchema schema)
        {
            settings.Write(builder, schema);
            var offset = builder.DataBuffer.Position;
            var answer = new Shim.Answer { Size = (uint)sizeof(Shim.Answer) };
            ulong opened = 0;
            var code = Shim.clk_session_open(
                slot.Slot, offset, builder.DataBuffer.Length - offset, settings.OpenLimitMs, &opened, &answer);
            handle = opened;
            TryTakeOpening(code, answer);
        }

        private static ProgramInfo[] ReadPrograms(int count, Func<int, Frame.ProgramInfo> read)
        {
            var programs = new ProgramInfo[count];
            for (var i = 0; i < programs.Length; i++)
            {
                var program = read(i);
                var parameters = new ProgramParameter[program.ParametersLength];
                for (var p = 0; p < parameters.Length; p++)
                {
                    var parameter = program.Parameters(p).GetValueOrDefault();
                    var values = new string[parameter.ValuesLength];
                    for (var v = 0; v < values.Length; v++) values[v] = parameter.Values(v);
                    parameters[p] = new ProgramParameter(parameter.Name, parameter.DefaultValue, parameter.Description ?? "", values);
                }
                programs[i] = new ProgramInfo(program.Name, parameters);
            }
            return programs;
        }

        private void Point(Shim.Answer answer)
        {
            answerMemory.Point(answer);
            answerBuffer.Position = answer.Offset;
        }
    }
}
