using System.Linq;
using System.Text.RegularExpressions;

namespace Collektive.Headless
{
    /// <summary>
    /// The JVM flags that a scenario file may set without <c>--trust-jvm</c>, because they cannot write files, open ports or load code. Unknown flags are
    /// considered unsafe, because new JVMs have new flags. The native library rejects flags that endanger the process, even with the option.
    /// </summary>
    internal static class SafeJvmFlags
    {
        private static readonly Regex[] SafePatterns = new[]
        {
            @"-X(mx|ms|mn|ss)[0-9]+[kKmMgGtT]?",
            @"-X(int|comp|mixed|batch|noclassgc|check:jni|share:(auto|on|off))",
            @"-XX:-\w+",
            @"-XX:\+(?!\w*(" + UnsafeSwitches + @"))\w+",
            @"-XX:(?!\w*(" + PathSuffixes + @")=)\w+=-?[0-9]+(\.[0-9]+)?[kKmMgGtT]?",
            @"-XX:(NativeMemoryTracking|DisableIntrinsic|ControlIntrinsic|ShenandoahGCHeuristics|ShenandoahGCMode)=[\w,+-]+",
            @"-Xlog(:disable|(:[\w+*=,-]*(:(stdout|stderr)?(:\w*(,\w+)*)?)?)?)",
            @"-verbose(:(gc|class|module|jni))?",
            @"-(ea|da|enableassertions|disableassertions)(:[\w.$]+)?",
            @"-(esa|dsa|enablesystemassertions|disablesystemassertions)",
            @"-D(?!(java|javax|jdk|sun|com\.sun|org\.collektive)\.)[\w.-]+(=.*)?",
            @"--(add-exports|add-opens|add-reads|enable-native-access|enable-final-field-mutation)=[\w.,/=-]+",
            @"--(enable-preview|((illegal-(access|final-field-mutation|native-access))|sun-misc-unsafe-memory-access|finalization)=\w+)",
        }.Select(form => new Regex("^(" + form + @")\z", RegexOptions.CultureInvariant | RegexOptions.Singleline)).ToArray();

        /// <summary>Parts of the names of switches with which the JVM may write files, open ports or load code.</summary>
        private const string UnsafeSwitches =
            "Dump|Save|LogVM|LogCompilation|LogFile|Record|Archive|JVMCI|Replay|ManagementServer|AttachListener|IdealGraph|PauseAt";

        /// <summary>
        /// Suffixes of the names of options that are never safe. The value is a path, even if it looks like a number, or a limit at which the JVM ends the
        /// process.
        /// </summary>
        private const string PathSuffixes = "MallocLimit|File|Path|List|Exit|At|Cache|Output|Configuration|Config|Options|Command|Recording|Only|Error|Mode";

        internal static bool Contains(string flag) => SafePatterns.Any(form => form.IsMatch(flag));
    }
}
