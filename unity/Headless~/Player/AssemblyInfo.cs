using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Collektive.Fuzz")]
[assembly: InternalsVisibleTo("Collektive.Headless.Tests")]
