using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Collektive.Headless.Tests")]
