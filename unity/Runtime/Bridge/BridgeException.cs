using System;

namespace Collektive.Bridge
{
    /// <summary>Kinds of errors. The numbers are the codes of <c>CLK_ERRORS</c> in the shim's header.</summary>
    public enum BridgeError
    {
        /// <summary>An argument is out of range.</summary>
        Argument = -1,
        /// <summary>Out of native memory.</summary>
        Memory = -2,
        /// <summary>A slot or session handle is stale.</summary>
        Handle = -3,
        /// <summary>The time limit passed before the engine answered.</summary>
        Timeout = -4,
        /// <summary>The folder contains no usable JVM.</summary>
        JvmNotFound = -5,
        /// <summary>The JVM rejected its options.</summary>
        JvmOptions = -6,
        /// <summary>The JVM could not be created.</summary>
        JvmStart = -7,
        /// <summary>The JVM has crashed or stopped responding, and is unusable until the process restarts.</summary>
        JvmLost = -8,
        /// <summary>No JVM is running.</summary>
        JvmNotRunning = -9,
        /// <summary>A JVM is already running with other settings.</summary>
        JvmRunning = -10,
        /// <summary>The host's jar or the native library is missing or has another version.</summary>
        Host = -11,
        /// <summary>The frame is invalid and was ignored.</summary>
        Frame = -12,
        /// <summary>C# and Kotlin were generated from different schemas.</summary>
        Schema = -13,
        /// <summary>A program cannot be loaded.</summary>
        Program = -14,
        /// <summary>A round did not end in time, which ended the session.</summary>
        SessionFailed = -15,
        /// <summary>The host threw an unexpected exception.</summary>
        Java = -16,
    }

    /// <summary>An error of the shim or of the JVM. The message explains what happened and how to fix it.</summary>
    public sealed class BridgeException : Exception
    {
        /// <summary>Creates an exception of the given kind.</summary>
        internal BridgeException(BridgeError error, string message) : base(message)
        {
            Error = error;
        }

        /// <summary>The kind of error.</summary>
        public BridgeError Error { get; }
    }
}
