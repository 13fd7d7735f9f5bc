using System.Reflection;
using System.Runtime.CompilerServices;

[assembly: AssemblyVersion("0.2.0.0")]
[assembly: InternalsVisibleTo("Collektive.Headless.Tests")]
[assembly: InternalsVisibleTo("Collektive.TwoEditors")]
[assembly: InternalsVisibleTo("Collektive.WithoutLibrary")]
[assembly: InternalsVisibleTo("Collektive.Unity.Editor.Tests")]
