using System.Diagnostics;

namespace UnityEngine
{
    /// Times in seconds. As in Unity, times return the fixed clock's values within a fixed step.
    public class Time
    {
        /// Tolerance of a clock that is the sum of many floats, in seconds.
        const double Rounding = 1e-6;

        static readonly Stopwatch Clock = Stopwatch.StartNew();
        static double frameTime, fixedClock, unscaledClock, fixedUnscaledClock, startOffset;
        static float frameDelta, unscaledFrameDelta, fixedStep, scale, frameScale;

        static Time() => ResetState();

        public static float time => (float)timeAsDouble;
        public static double timeAsDouble
        {
            get
            {
                Construction.Check(nameof(Time));
                return inFixedTimeStep ? fixedClock : frameTime;
            }
        }

        public static float timeSinceLevelLoad => time;
        public static double timeSinceLevelLoadAsDouble => timeAsDouble;
        public static float deltaTime => inFixedTimeStep ? fixedDeltaTime : frameDelta;
        public static float fixedTime => (float)fixedClock;
        public static double fixedTimeAsDouble => fixedClock;
        public static float unscaledTime => (float)unscaledTimeAsDouble;
        public static double unscaledTimeAsDouble => inFixedTimeStep ? fixedUnscaledClock : unscaledClock;
        public static float unscaledDeltaTime => inFixedTimeStep ? fixedDeltaTime / frameScale : unscaledFrameDelta;
        /// As in Unity, from 0.0001 to 10 seconds.
        public static float fixedDeltaTime { get => fixedStep; set => fixedStep = value >= 0.0001f ? Mathf.Min(value, 10f) : 0.0001f; }
        public static float maximumDeltaTime { get; set; }
        public static float timeScale
        {
            get => scale;
            set
            {
                if (value >= 0f && value < float.PositiveInfinity) scale = value;
                else Debug.LogError($"Time.timeScale is out of range: {value} is not a finite number of at least 0.");
            }
        }

        public static float captureDeltaTime { get; set; }
        public static int frameCount { get; private set; }
        public static int renderedFrameCount => frameCount;
        public static float realtimeSinceStartup => (float)realtimeSinceStartupAsDouble;
        public static double realtimeSinceStartupAsDouble => Clock.Elapsed.TotalSeconds - startOffset;
        public static bool inFixedTimeStep { get; private set; }

        internal static void ResetState()
        {
            frameTime = fixedClock = unscaledClock = fixedUnscaledClock = 0;
            frameDelta = unscaledFrameDelta = 0f;
            frameCount = 0;
            fixedDeltaTime = 0.02f;
            maximumDeltaTime = 1f / 3f;
            timeScale = 1f;
            captureDeltaTime = 0f;
            inFixedTimeStep = false;
            startOffset = Clock.Elapsed.TotalSeconds;
        }

        /// Advances the clocks by `seconds`. If `captureDeltaTime` is set, it replaces them, except for unscaled times.
        internal static void BeginFrame(float seconds)
        {
            frameCount++;
            unscaledFrameDelta = seconds;
            unscaledClock += seconds;
            if (captureDeltaTime > 0f) seconds = captureDeltaTime;
            frameScale = timeScale;
            frameDelta = Mathf.Min(seconds, maximumDeltaTime) * frameScale;
            frameTime += frameDelta;
        }

        /// Advances the fixed clock and returns true if it is at least one step behind the frame's time. As in Unity, it stops at a time scale of 0.
        internal static bool BeginFixedStep()
        {
            if (frameScale == 0f || fixedClock + fixedDeltaTime > frameTime + Rounding) return false;
            fixedClock += fixedDeltaTime;
            fixedUnscaledClock += fixedDeltaTime / frameScale;
            return inFixedTimeStep = true;
        }

        /// Returns the time at which a delay ends. It is slightly early, so that a delay of n frames ends in the n-th frame: 50 times 0.02f is less than 1.
        internal static double EndOf(float delay)
        {
            const double relativeRounding = 2.0 / (1 << 24); // of the delay and of the frames' lengths
            return timeAsDouble + delay * (1 - relativeRounding) - Rounding;
        }

        internal static void EndFixedStep() => inFixedTimeStep = false;
    }
}
