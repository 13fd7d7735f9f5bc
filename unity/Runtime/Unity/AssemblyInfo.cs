using System.Reflection;
using System.Runtime.CompilerServices;

[assembly: AssemblyVersion("0.2.0.0")]
[assembly: InternalsVisibleTo("Collektive.Faults")]
[assembly: InternalsVisibleTo("Collektive.Headless.Tests")]
[assembly: InternalsVisibleTo("Collektive.Player")]
[assembly: InternalsVisibleTo("Collektive.Soak")]
[assembly: InternalsVisibleTo("Collektive.Unity.Editor")]
[assembly: InternalsVisibleTo("Collektive.Unity.Editor.Tests")]
[assembly: InternalsVisibleTo("Collektive.Unity.Tests")]
